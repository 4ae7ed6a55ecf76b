#pragma once
// What is left of a group that passes its reach, where levels may leave parts of it out.

#include <functional>
#include <optional>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// Part of a group that is left out, and how far what it is in, or it alone, would extend.
struct LeftOutPart {
  uint32_t shape = 0;
  IntBox bounds;
};

struct GroupParts {
  bool any = false;  ///< otherwise all of it is left out
  IntBox bounds;     ///< of what is left
  std::vector<LeftOutPart> left_out;
};

/// Takes out parts until all that is left has bounds within `limit`. Levels with large cells derive no parts that they
/// do not show, and must come to the same: so a part stays or goes by what shows at the coarsest level that shows it.
///
/// group: a chunk with that group alone. step: told of work before it is done; nothing where it refuses.
std::optional<GroupParts> partsWithin(const GrammarChunk& group, const IntBox& limit,
                                      const std::function<bool(uint64_t)>& step);

/// Whether bounds are those of a group that a cell with this limit may own.
bool isWithin(const IntBox& bounds, const IntBox& limit);

}  // namespace sgm
