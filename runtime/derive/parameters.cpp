#include "derive/parameters.h"

#include <bit>
#include <cmath>

#include "base/math.h"
#include "base/plain_text.h"

namespace sgm {
namespace {

std::string numberText(double v) { return generalText(v); }

/// Returns the parameters' names as the end of an error message, such as "; it has boxy, wet".
std::string namesOf(const Program& program) {
  std::string list;
  for (const Param& param : program.params)
    list.append(list.empty() ? "; it has " : ", ").append(program.text(param.name));
  return list;
}

}  // namespace

ParameterValues ParameterValues::defaults(const Program& program) {
  ParameterValues result;
  for (const Param& param : program.params) result.values.push_back(param.value);
  return result;
}

Result<void> ParameterValues::set(const Program& program, std::string_view name, double value) {
  const uint32_t index = program.findParam(name);
  if (index == kNoId || index >= values.size()) {
    return Error{Code::invalid_argument, "the grammar has no parameter " + std::string(name) + namesOf(program)};
  }
  const Param& param = program.params[index];
  const std::string quoted = "parameter " + std::string(name);
  if (!std::isfinite(value)) return Error{Code::invalid_argument, quoted + " must be a finite number"};
  if (param.whole && detFloor(value) != value) {
    return Error{Code::invalid_argument, quoted + " must be a whole number, not " + numberText(value)};
  }
  if (param.has_range && (value < param.low || value > param.high)) {
    const bool percent =
        param.dim == kRatio && param.high <= 1 && value / 100 >= param.low && value / 100 <= param.high;
    return Error{Code::invalid_argument,
                 quoted + " must lie in " + numberText(param.low) + ".." + numberText(param.high) + ", not be " +
                     numberText(value) +
                     (percent ? ": " + numberText(value) + " % is " + numberText(value / 100) : "")};
  }
  values[index] = value;
  return {};
}

uint64_t changedParameters(const ParameterValues& a, const ParameterValues& b) {
  uint64_t changed = 0;
  for (uint32_t i = 0; i < a.values.size(); ++i) {
    if (std::bit_cast<uint64_t>(a.values[i]) != std::bit_cast<uint64_t>(b.values[i])) changed |= parameterBit(i);
  }
  return changed;
}

}  // namespace sgm
