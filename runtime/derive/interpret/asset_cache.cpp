#include "derive/interpret/asset_cache.h"

#include <bit>
#include <utility>

namespace sgm::interpret {
namespace {

/// Number of budget steps that fitting one triangle of an asset takes.
constexpr uint64_t kStepsATriangle = 64;

FittedAsset cover(const asset::Polyhedron& body) {
  FittedAsset out;
  Result<std::vector<asset::ConvexPiece>> pieces = asset::coverWithPieces(body);
  if (pieces)
    out.pieces = std::move(*pieces);
  else
    out.trouble = "in this size " + pieces.error().message;
  return out;
}

}  // namespace

const FittedAsset& AssetCache::fit(uint32_t number, asset::Point size, const std::vector<asset::FitZone>& zones,
                                   const Span& span, uint32_t activation, Budget& budget) {
  std::vector<uint64_t> key{number};
  for (int axis = 0; axis < 3; ++axis) key.push_back(std::bit_cast<uint64_t>(size[axis]));
  for (const asset::FitZone& zone : zones) {
    key.push_back(static_cast<uint64_t>(zone.axis) << 1 | (zone.repeats ? 1 : 0));
    key.push_back(std::bit_cast<uint64_t>(zone.from));
    key.push_back(std::bit_cast<uint64_t>(zone.to));
  }
  const auto [known, fresh] = fitted_.try_emplace(std::move(key));
  FittedAsset& fitted = known->second;
  if (!fresh) return fitted;
  const asset::Polyhedron& solid = *program_.assets[number].solid;
  if (!budget.step(kStepsATriangle * solid.triangles.size(), span, activation)) return fitted;
  const Result<asset::Polyhedron> body = asset::fitInto(solid, size, zones);
  if (!body)
    fitted.trouble = body.error().message;
  else if (budget.step(kStepsATriangle * body->triangles.size(), span, activation))
    fitted = cover(*body);
  return fitted;
}

}  // namespace sgm::interpret
