#pragma once
// Options that several commands share, and functions that convert their texts to numbers.

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
  std::vector<std::string> sets;  ///< assignments NAME=VALUE of parameters
  std::string backend = "auto";
  unsigned threads = 0;
  bool json = false;
  std::string region;
  std::optional<double> cell;     ///< edge of a grid cell, metres
  std::optional<double> density;  ///< grid cells per metre (the paper's LD)
  uint64_t max_chunks = 65536;
  bool uv = false;     ///< also makes texture coordinates
  bool sharp = false;  ///< keeps the field's edges and corners sharp
  int level = 0;       ///< level of detail: cells are 2^level times the edge given by --cell or --ld
};

/// A point "x,y,z"; a number too large for a double becomes an infinity. nullopt if the text is not a point.
std::optional<std::array<double, 3>> readPoint(std::string_view text);
struct PictureSize {
  int width = 0, height = 0;
};
/// A size "1280x720", with 1 to kMaxPicture pixels on each edge; nullopt if the text is not such a size.
std::optional<PictureSize> readSize(std::string_view text);
/// Whether a file's name ends in the extension, in upper or lower case. extension: in lower case, with its dot.
bool hasExtension(const std::string& file, std::string_view extension);

/// Position and target of a camera, in metres.
using Gaze = std::array<std::array<double, 3>, 2>;
/// A gaze "x,y,z:x,y,z"; nullopt if the text is not a pair of points of the world.
std::optional<Gaze> readCamera(std::string_view text);

/// A range of levels of detail, "0..4" or "2", the finest first; nullopt if the text is not such a range.
std::optional<std::pair<int, int>> readLevels(std::string_view text);
/// The maximal number of seeds of one contact sheet.
inline constexpr size_t kMaxSeeds = 256;
/// Seeds "1..9", "3,7,11" or "1..3,9": each seed once, in the given order. Error: invalid_argument; the message shows
/// the expected form.
Result<std::vector<uint64_t>> readSeeds(std::string_view text);

/// Index and number of shards: "3/16", with the index counted from 0; nullopt if the text is not of this form.
std::optional<std::pair<uint64_t, uint64_t>> readShard(std::string_view text);

/// A box "x0,y0,z0:x1,y1,z1" in metres, converted to units, with lo below hi on each axis. Error: invalid_argument.
Result<IntBox> parseRegion(std::string_view text);
/// The edge of a grid cell in units from --cell or --ld; 0.5 m if neither is given. Error: invalid_argument.
Result<int32_t> cellUnits(const WorldOptions& options);
/// The parameters' default values with the assignments of --set applied. Error: invalid_argument.
Result<ParameterValues> parameterValues(const Program& program, const std::vector<std::string>& sets);

}  // namespace sgm::cli
