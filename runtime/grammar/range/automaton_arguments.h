#pragma once
// The valid arguments of `ca`, for the compiler, which knows ranges, and for derivation, which knows values.

#include <optional>
#include <string>

#include "grammar/range/interval.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// In the order of writing. The voxel is in metres; counts are already whole.
struct AutomatonArguments {
  Interval voxel, fill, rounds, threshold, radius;
};

struct AutomatonFault {
  uint32_t argument = 0;  ///< index of the argument
  std::string message, hint;
};

/// The first argument that is certainly wrong. cell: edge of the layer's cell in units, above 0.
std::optional<AutomatonFault> faultOf(const AutomatonArguments& arguments, int32_t cell);

}  // namespace sgm
