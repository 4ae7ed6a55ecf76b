#pragma once
// The values of a program's parameters, which the host sets.

#include <string_view>
#include <vector>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// One number for each element of Program::params, in the same order, in metres or radians or without unit.
struct ParameterValues {
  std::vector<double> values;

  static ParameterValues defaults(const Program& program);

  /// Sets a parameter. Returns an error, and changes nothing, if the name is unknown, the value is outside of the
  /// declared range, or it is not an integer although the parameter requires one.
  Result<void> set(const Program& program, std::string_view name, double value);
};

/// Returns the bit that stands for a parameter in a bit set of parameters. Parameters whose indices are equal modulo 64
/// share a bit.
inline uint64_t parameterBit(uint32_t index) { return uint64_t{1} << (index % 64); }

/// Returns the bit set of the parameters whose values differ. Precondition: both belong to the same program.
uint64_t changedParameters(const ParameterValues& a, const ParameterValues& b);

}  // namespace sgm
