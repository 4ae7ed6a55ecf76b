#pragma once
// The text of a derivation path, as printed in messages and written in overrides.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sgm {

/// A part of the path's text, in bytes.
struct PathPlace {
  uint32_t begin = 0, end = 0;
};

struct WrittenStep {
  std::string_view qualifier, name;  ///< `cave` and `Hall` of cave.Hall[2]; the qualifier may be empty
  std::optional<uint32_t> index;     ///< 2
  PathPlace place;                   ///< of the whole step
};

/// Holds views into the parsed text.
struct WrittenPath {
  std::string_view layer;  ///< `net` of net(0, 0, -1)/Node; empty if no cell is named
  std::array<int32_t, 3> cell{};
  PathPlace layer_place, cell_place;
  std::vector<WrittenStep> steps;  ///< at least one

  // Set if the text is not a path:
  std::string wanted;  ///< what should be there instead; empty: the text is a path
  PathPlace wrong;
};

/// [ layer "(" int "," int "," int ")" "/" ] step { "/" step }; step: [ name "." ] name [ "[" int "]" ]. Spaces are
/// allowed within the parentheses of the cell.
WrittenPath parsePath(std::string_view text);

}  // namespace sgm
