#pragma once
// If a group of shapes exceeds its cell's limit, and some of its parts are visible only at some levels, removes parts
// of the group until the rest is within the limit.

#include <functional>
#include <optional>
#include <vector>

#include "derive/shape.h"

namespace sgm {

/// A part that is removed from a group. bounds: the bounds of the part if it exceeds the limit by itself; otherwise the
/// bounds of the group including the part, which exceed the limit.
struct LeftOutPart {
  uint32_t shape = 0;
  IntBox bounds;
};

struct GroupParts {
  bool any = false;  ///< false: nothing remains, so the whole group must be left out
  IntBox bounds;     ///< bounds of the remaining parts
  std::vector<LeftOutPart> left_out;
};

/// Removes parts of a group until the bounds of the rest are within `limit`. Removes them level by level, from coarse
/// to fine. So a derivation for coarse levels only, which does not derive parts that are invisible there, removes the
/// same parts at these levels as a complete derivation. group: a chunk that contains only that group. step: called with
/// the amount of work before each step; if it returns false, the function returns nullopt.
std::optional<GroupParts> partsWithin(const GrammarChunk& group, const IntBox& limit,
                                      const std::function<bool(uint64_t)>& step);

/// Whether a cell with this limit may contain a group with these bounds.
bool isWithin(const IntBox& bounds, const IntBox& limit);

}  // namespace sgm
