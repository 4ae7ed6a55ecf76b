#pragma once
// Sets a grammar's parameters by name, from a number or from text with a unit.

#include <cstdint>
#include <string_view>

#include "base/result.h"
#include "derive/parameters.h"

namespace sgm::api {

/// Returns the index of a parameter in Program::params. Error: invalid_argument; the message suggests the nearest name.
Result<uint32_t> findParameter(const Program& program, std::string_view name);

/// Sets a parameter from text in the grammar's number syntax: "0.3", "50%", "12m", "-30deg". 0 needs no unit. Errors:
/// bad_input (not a number, or an unknown or wrong unit); those of findParameter and ParameterValues::set.
Result<void> setFromText(const Program& program, std::string_view name, std::string_view text, ParameterValues& values);

}  // namespace sgm::api
