#pragma once
// Values that a host gives to a grammar's parameters: by name, from a number or from a text with a unit, checked.

#include <cstdint>
#include <string_view>

#include "base/result.h"
#include "grammar/program.h"

namespace sgm::api {

/// Index in Program::params. The message of the error offers the nearest name.
Result<uint32_t> findParameter(const Program& program, std::string_view name);

/// Whether a parameter may have the value (in metres, radians or as a plain ratio): finite, in range, whole where it is
/// a count.
Result<void> checkParameter(const Program& program, uint32_t index, double value);

/// Reads "0.3", "50%", "12 m", "30deg" as a value of the parameter and checks it. Lengths and angles need a unit; 0 does
/// not. Errors: bad_input (no number, wrong unit), invalid_argument (as checkParameter).
Result<double> readParameter(const Program& program, uint32_t index, std::string_view text);

}  // namespace sgm::api
