#pragma once
// The values of a program's parameters, as set by a host.

#include <string_view>
#include <vector>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// One number per Program::params, in its order; metres, radians and plain ratios.
struct ParameterValues {
  std::vector<double> values;

  static ParameterValues defaults(const Program& program);

  /// Rejects an unknown name, a number outside the declared range, or a fraction for an integer parameter, and then
  /// leaves the values unchanged.
  Result<void> set(const Program& program, std::string_view name, double value);
};

/// Represents a parameter in a set of parameters, by its index; several may share one bit.
inline uint64_t parameterBit(uint32_t index) { return uint64_t{1} << (index % 64); }

/// The parameters whose values differ. Precondition: both belong to the same program.
uint64_t changedParameters(const ParameterValues& a, const ParameterValues& b);

}  // namespace sgm
