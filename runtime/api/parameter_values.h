#pragma once
// Values that a host gives to a grammar's parameters, by name, from a number or from a text with a unit.

#include <cstdint>
#include <string_view>

#include "base/result.h"
#include "derive/parameters.h"

namespace sgm::api {

/// Index in Program::params. Error: invalid_argument, offering the nearest name.
Result<uint32_t> findParameter(const Program& program, std::string_view name);

/// Sets a parameter from a text as the language writes numbers, "0.3", "50%", "12m", "-30deg". 0 needs no unit.
/// Errors: bad_input (no number, unknown or wrong unit), and those of findParameter and ParameterValues::set.
Result<void> setFromText(const Program& program, std::string_view name, std::string_view text, ParameterValues& values);

}  // namespace sgm::api
