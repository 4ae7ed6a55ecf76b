#pragma once
// The remainder of a group that exceeds its reach, if levels may leave parts of it out.

#include <functional>
#include <optional>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A part of a group that is left out, and the extent that it, or the shape that contains it, would have.
struct LeftOutPart {
  uint32_t shape = 0;
  IntBox bounds;
};

struct GroupParts {
  bool any = false;  ///< otherwise the whole group is left out
  IntBox bounds;     ///< of the remainder
  std::vector<LeftOutPart> left_out;
};

/// Removes parts until the remainder has bounds within `limit`. Levels with large cells do not derive parts that they
/// do not show, and must produce the same result: so the coarsest level that shows a part decides whether it stays.
///
/// group: a chunk with only that group. step: receives the amount of work before each step; nullopt if it returns
/// false.
std::optional<GroupParts> partsWithin(const GrammarChunk& group, const IntBox& limit,
                                      const std::function<bool(uint64_t)>& step);

/// True if a cell with this limit may own a group with these bounds.
bool isWithin(const IntBox& bounds, const IntBox& limit);

}  // namespace sgm
