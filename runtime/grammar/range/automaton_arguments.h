#pragma once
// Checks the arguments of `ca`. Used by the compiler, which knows their ranges, and by derivation, which knows their
// values.

#include <optional>
#include <string>

#include "grammar/range/interval.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// The arguments of a call of `ca`, in the order of its parameters. voxel is in metres; fill and threshold are ratios;
/// rounds and radius are whole numbers.
struct AutomatonArguments {
  Interval voxel, fill, rounds, threshold, radius;
};

struct AutomatonFault {
  uint32_t argument = 0;  ///< index of the invalid argument
  std::string message, hint;
};

/// Returns the first argument that is invalid for all its possible values; nullopt if there is none. cell: edge of the
/// layer's cell in units, above 0.
std::optional<AutomatonFault> faultOf(const AutomatonArguments& arguments, int32_t cell);

}  // namespace sgm
