#pragma once
// Options that several commands share, and the conversion of their texts to numbers.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/fixed.h"
#include "base/result.h"
#include "derive/parameters.h"
#include "tools/render/image.h"

namespace sgm::cli {

struct WorldOptions {
  std::string file;
  uint64_t seed = 0;
  std::vector<std::string> sets;  ///< name=value
  std::string backend = "auto";
  unsigned threads = 0;
  bool json = false;
  std::string region;
  std::optional<double> cell;     ///< metres
  std::optional<double> density;  ///< the paper's LD
  uint64_t max_chunks = 65536;
  bool uv = false;     ///< with texture coordinates
  bool sharp = false;  ///< with the field's edges and corners
  int level = 0;       ///< level of detail: cells of 2^level times the edge of --cell or --ld
};

/// "x,y,z"; a number too large for a double is an infinity. nullopt if the text is not a point.
std::optional<std::array<double, 3>> readPoint(std::string_view text);
struct PictureSize {
  int width = 0, height = 0;
};
/// "1280x720", with 1 to kMaxPicture pixels each; nullopt if the text is not such a size.
std::optional<PictureSize> readSize(std::string_view text);
/// Whether a file's name ends so, in any case. extension: with its dot, in lower case.
bool hasExtension(const std::string& file, std::string_view extension);

/// Position and target, in metres.
using Gaze = std::array<std::array<double, 3>, 2>;
/// "x,y,z:x,y,z"; nullopt if the text is not such a pair of points of the world.
std::optional<Gaze> readCamera(std::string_view text);

/// "0..4" or "2"; nullopt if the text is not such a range of levels, the finest first.
std::optional<std::pair<int, int>> readLevels(std::string_view text);
/// The maximal number of seeds of one contact sheet.
inline constexpr size_t kMostSeeds = 256;
/// "1..9", "3,7,11" or "1..3,9": each seed once, in this order. Error: invalid_argument, with the expected form.
Result<std::vector<uint64_t>> readSeeds(std::string_view text);

/// "3/16", counted from 0; nullopt if the text is not such a share.
std::optional<std::pair<uint64_t, uint64_t>> readShard(std::string_view text);

/// "x0,y0,z0:x1,y1,z1" in metres as a box of units, lo below hi on each axis. Error: invalid_argument.
Result<IntBox> parseRegion(std::string_view text);
/// The cell edge in units from --cell or --ld; 0.5 m without either. Error: invalid_argument.
Result<int32_t> cellUnits(const WorldOptions& options);
/// The defaults, changed by --set. Error: invalid_argument.
Result<ParameterValues> parameterValues(const Program& program, const std::vector<std::string>& sets);

}  // namespace sgm::cli
