#pragma once
// What the arguments of `ca` may be, for the compiler, which knows ranges, and for derivation, which knows values.

#include <optional>
#include <string>

#include "grammar/range/interval.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// In the order in which they are written. The voxel in metres; counts already whole.
struct AutomatonArguments {
  Interval voxel, fill, rounds, threshold, radius;
};

struct AutomatonFault {
  uint32_t argument = 0;  ///< which of those
  std::string message, hint;
};

/// The first that is wrong for sure. cell: edge of the layer's cell in units, greater than 0.
std::optional<AutomatonFault> faultOf(const AutomatonArguments& arguments, int32_t cell);

}  // namespace sgm
