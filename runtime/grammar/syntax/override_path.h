#pragma once
// Parses the text of a derivation path, as printed in messages and written in overrides.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sgm {

/// A byte range in the path's text.
struct PathPlace {
  uint32_t begin = 0, end = 0;
};

struct WrittenStep {
  std::string_view qualifier, name;  ///< for the step `cave.Hall[2]`: `cave` and `Hall`; qualifier may be empty
  std::optional<uint32_t> index;     ///< for the step `cave.Hall[2]`: 2
  PathPlace place;                   ///< byte range of the whole step in the path's text
};

/// A parsed path. Contains views into the parsed text.
struct WrittenPath {
  std::string_view layer;  ///< `net` of net(0, 0, -1)/Node; empty if the path names no layer and cell
  std::array<int32_t, 3> cell{};
  PathPlace layer_place, cell_place;
  std::vector<WrittenStep> steps;  ///< the steps of the path; at least one

  // Only set if the text is not a valid path:
  std::string wanted;  ///< the construct that is missing at `wrong`; empty: the path is valid
  PathPlace wrong;
};

/// Parses [ layer "(" int "," int "," int ")" "/" ] step { "/" step }; step: [ name "." ] name [ "[" int "]" ]. Spaces
/// are allowed only within the parentheses.
WrittenPath parsePath(std::string_view text);

}  // namespace sgm
