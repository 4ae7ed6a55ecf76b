#pragma once
// Values of a program's parameters, as a host sets them.

#include <string_view>
#include <vector>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// One number for each of Program::params, in its order; metres, radians and plain ratios.
struct ParameterValues {
  std::vector<double> values;

  static ParameterValues defaults(const Program& program);

  /// Refuses an unknown name, a number outside of the declared range, or a fraction for a whole parameter, and leaves
  /// the values as they are.
  Result<void> set(const Program& program, std::string_view name, double value);
};

/// Stands for a parameter in a set of them, by its index; a few may share one bit.
inline uint64_t parameterBit(uint32_t index) { return uint64_t{1} << (index % 64); }

/// The parameters whose values differ. Precondition: both are one program's.
uint64_t changedParameters(const ParameterValues& a, const ParameterValues& b);

}  // namespace sgm
