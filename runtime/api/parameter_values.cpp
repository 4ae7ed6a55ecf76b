#include "api/parameter_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace sgm::api {
namespace {

struct Unit {
  std::string_view name;
  Dim dim;
  double factor;
};

constexpr std::array kUnits{
    Unit{"", kRatio, 1},        Unit{"%", kRatio, 0.01},
    Unit{"m", kLength, 1},      Unit{"cm", kLength, 0.01},
    Unit{"mm", kLength, 0.001}, Unit{"km", kLength, 1000},
    Unit{"rad", kAngle, 1},     Unit{"deg", kAngle, std::numbers::pi / 180},
    Unit{"m2", kArea, 1},       Unit{"m3", kVolume, 1},
};

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Changes (insert, delete, replace a byte) that make b of a.
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// The shortest text that reads back as the value: locale-free, unlike printf.
std::string numberText(double value) {
  char buffer[32];
  const auto [end, why] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

}  // namespace

Result<uint32_t> findParameter(const Program& program, std::string_view name) {
  if (const uint32_t index = program.findParam(name); index != kNoId) return index;
  std::string message = "the grammar has no parameter '" + std::string(name) + "'";
  std::string_view nearest;
  size_t best = std::max<size_t>(2, name.size() / 3) + 1;
  for (const Param& param : program.params) {
    const std::string_view candidate = program.text(param.name);
    if (const size_t distance = editDistance(name, candidate); distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty()) {
    message += "; did you mean '" + std::string(nearest) + "'?";
  } else if (program.params.empty()) {
    message += ": it has none";
  }
  return Error{Code::invalid_argument, message, 0, 0};
}

Result<void> checkParameter(const Program& program, uint32_t index, double value) {
  const Param& param = program.params[index];
  const std::string name(program.text(param.name));
  if (!std::isfinite(value)) return Error{Code::invalid_argument, "parameter '" + name + "' needs a finite number", 0, 0};
  if (param.whole && value != std::floor(value))
    return Error{Code::invalid_argument, "parameter '" + name + "' needs a whole number", 0, 0};
  if (param.has_range && (value < param.low || value > param.high))
    return Error{Code::invalid_argument,
                 "parameter '" + name + "' is " + numberText(value) + ", outside its range " + numberText(param.low) +
                     ".." + numberText(param.high),
                 0, 0};
  return {};
}

Result<double> readParameter(const Program& program, uint32_t index, std::string_view text) {
  const Param& param = program.params[index];
  const std::string name(program.text(param.name));
  const std::string_view whole = trimmed(text);
  double number = 0;
  const auto [rest, why] = std::from_chars(whole.data(), whole.data() + whole.size(), number);
  if (why != std::errc() || !std::isfinite(number))
    return Error{Code::bad_input, "parameter '" + name + "': '" + std::string(text) + "' is no number", 0, 0};
  const std::string_view unit = trimmed(whole.substr(static_cast<size_t>(rest - whole.data())));
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return u.name == unit; });
  if (found == kUnits.end())
    return Error{Code::bad_input, "parameter '" + name + "': unknown unit '" + std::string(unit) + "'", 0, 0};
  const bool zero = number == 0 && unit.empty();
  if (!(found->dim == param.dim) && !zero)
    return Error{Code::bad_input,
                 "parameter '" + name + "' needs a value of dimension " + dimName(param.dim) + ", '" +
                     std::string(whole) + "' is of dimension " + dimName(found->dim),
                 0, 0};
  const double value = number * found->factor;
  if (Result<void> ok = checkParameter(program, index, value); !ok) return ok.error();
  return value;
}

}  // namespace sgm::api
