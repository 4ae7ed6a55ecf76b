#pragma once
// Options that several commands share, and functions that parse their values.

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
  std::vector<std::string> sets;  ///< assignments NAME=VALUE of grammar parameters, from --set
  std::string backend = "auto";
  unsigned threads = 0;
  bool json = false;
  std::string region;
  std::optional<double> cell;     ///< edge of a grid cell in metres, from --cell
  std::optional<double> density;  ///< grid cells per metre, from --ld (LD in the paper)
  uint64_t max_chunks = 65536;
  bool uv = false;     ///< whether texture coordinates are made
  bool sharp = false;  ///< whether edges and corners of the field stay sharp in the mesh
  int level = 0;       ///< level of detail: cells are 2^level times the edge given by --cell or --ld
};

/// Parses a point "x,y,z"; nullopt if the text is not one. A number too large for a double becomes infinity.
std::optional<std::array<double, 3>> readPoint(std::string_view text);
struct PictureSize {
  int width = 0, height = 0;
};
/// Parses a size "1280x720", with 1 to kMaxPicture pixels on each edge; nullopt if the text is not one.
std::optional<PictureSize> readSize(std::string_view text);
/// Whether the file name ends in the extension, in upper or lower case. extension: in lower case, including its dot.
bool hasExtension(const std::string& file, std::string_view extension);

/// Position and target of a camera, in metres.
using Gaze = std::array<std::array<double, 3>, 2>;
/// Parses a camera "x,y,z:x,y,z", position and target in metres; nullopt if the text is not a pair of points within the
/// world.
std::optional<Gaze> readCamera(std::string_view text);

/// Parses a range of levels of detail, "0..4" or "2", the finest level first; nullopt if the text is not one.
std::optional<std::pair<int, int>> readLevels(std::string_view text);
/// Maximum number of seeds of a contact sheet.
inline constexpr size_t kMaxSeeds = 256;
/// Parses seeds "1..9", "3,7,11" or "1..3,9": each seed once, in the given order. Error: invalid_argument, with the
/// expected form in its message.
Result<std::vector<uint64_t>> readSeeds(std::string_view text);

/// Parses "3/16", the index of a shard, counted from 0, and the number of shards; nullopt if the text is not of this
/// form.
std::optional<std::pair<uint64_t, uint64_t>> readShard(std::string_view text);

/// Parses a box "x0,y0,z0:x1,y1,z1" in metres and converts it to units; lo is below hi on each axis. Error:
/// invalid_argument.
Result<IntBox> parseRegion(std::string_view text);
/// The edge of a grid cell in units, from --cell or --ld; 0.5 m if neither is given. Error: invalid_argument.
Result<int32_t> cellUnits(const WorldOptions& options);
/// The values of the grammar's parameters: their defaults, replaced by the assignments in `sets` (--set). Error:
/// invalid_argument.
Result<ParameterValues> parameterValues(const Program& program, const std::vector<std::string>& sets);

}  // namespace sgm::cli
