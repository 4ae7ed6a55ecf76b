#pragma once
// Caches assets that are fitted into scopes.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "asset/convex_cover.h"
#include "asset/fit.h"
#include "derive/interpret/budget.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

/// The convex pieces of an asset that is fitted to one size.
struct FittedAsset {
  std::vector<asset::ConvexPiece> pieces;
  std::string trouble;  ///< reason why the asset cannot be fitted; empty if `pieces` is valid
};

/// Caches the fitted assets of one cell, keyed by asset, size and zones.
class AssetCache {
 public:
  explicit AssetCache(const Program& program) : program_(program) {}

  /// Returns an asset fitted to a size. If it is not cached, fits it now, and counts the steps of the work in the
  /// budget. number: index in Program::assets. size: metres. The result is valid as long as the cache exists; it is
  /// empty if the budget has failed.
  const FittedAsset& fit(uint32_t number, asset::Point size, const std::vector<asset::FitZone>& zones, const Span& span,
                         uint32_t activation, Budget& budget);

 private:
  const Program& program_;
  std::map<std::vector<uint64_t>, FittedAsset> fitted_;  ///< key of an entry: asset, size and zones
};

}  // namespace sgm::interpret
