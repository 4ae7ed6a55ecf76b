#pragma once
// Assets fitted into scopes.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "asset/convex_cover.h"
#include "asset/fit.h"
#include "derive/interpret/budget.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

/// The convex pieces of an asset in one size, or the reason why there are none.
struct FittedAsset {
  std::vector<asset::ConvexPiece> pieces;
  std::string trouble;
};

/// The assets of the cell in the sizes to which they were fitted so far.
class AssetCache {
 public:
  explicit AssetCache(const Program& program) : program_(program) {}

  /// number: in Program::assets. size: metres. Counts the work of a new size. The result stays valid with the cache,
  /// and is empty if the budget has failed.
  const FittedAsset& fit(uint32_t number, asset::Point size, const std::vector<asset::FitZone>& zones, const Span& span,
                         uint32_t activation, Budget& budget);

 private:
  const Program& program_;
  std::map<std::vector<uint64_t>, FittedAsset> fitted_;  ///< by asset, size and zones
};

}  // namespace sgm::interpret
