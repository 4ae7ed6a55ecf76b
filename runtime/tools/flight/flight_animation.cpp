#include "tools/flight/flight_animation.h"

#include <algorithm>
#include <cmath>

#include "tools/flight/flight_engine.h"

namespace sgm::cli {

namespace {

constexpr double kFieldsASecond = 10, kSecondsThereAndBack = 10;

Result<sgm_parameter_info> findParameter(const sgm_grammar* grammar, const sgm_parameters* parameters,
                                         const std::string& name) {
  sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
  for (uint32_t i = 0; i < sgm_grammar_parameter_count(grammar); ++i) {
    if (sgm_grammar_parameter(grammar, i, &info) == SGM_OK && name == info.name) return info;
  }
  // The parameter does not exist: call sgm_parameters_get for its error message, which suggests the nearest name.
  double value = 0;
  sgm_error error = SGM_ERROR_INIT;
  static_cast<void>(sgm_parameters_get(parameters, name.c_str(), &value, &error));
  return Error{Code::invalid_argument, std::string("--animate: ") + error.message};
}

}  // namespace

Result<FlightAnimation> FlightAnimation::of(sgm_runtime* runtime, const sgm_field_desc& field,
                                            sgm_parameters* parameters, const std::vector<std::string>& names) {
  FlightAnimation animation(runtime, field, parameters);
  const auto drive = [&](const sgm_parameter_info& info) {
    animation.driven_.push_back({info.name, info.minimum, info.maximum, info.whole != 0});
  };
  for (const std::string& name : names) {
    const Result<sgm_parameter_info> info = findParameter(field.grammar, parameters, name);
    if (!info) return info.error();
    if (!std::isfinite(info->minimum)) {
      return Error{Code::invalid_argument,
                   "--animate: the parameter `" + name + "` has no range; write `in LOW..HIGH` in the grammar"};
    }
    drive(*info);
  }
  sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
  for (uint32_t i = 0; names.empty() && i < sgm_grammar_parameter_count(field.grammar); ++i) {
    if (sgm_grammar_parameter(field.grammar, i, &info) == SGM_OK && info.animated != 0) drive(info);
  }
  if (animation.driven_.empty()) {
    return Error{Code::invalid_argument,
                 "--animate: the grammar declares no animated parameter; name one, or write `param NAME = ... in "
                 "LOW..HIGH animated` in the grammar"};
  }
  return animation;
}

Result<void> FlightAnimation::show(sgm_world* world, double seconds) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  if (sgm_world_get_stats(world, &stats, &error) != SGM_OK) return errorOf(error);
  drawn_ += stats.field_drawn != last_drawn_;
  last_drawn_ = stats.field_drawn;
  if (seconds * kFieldsASecond < static_cast<double>(fields_ + 1)) return {};
  const double turn = std::fmod(seconds / kSecondsThereAndBack, 1.0);
  const double part = 1 - std::fabs(1 - 2 * turn);
  for (const Driven& parameter : driven_) {
    const double value = std::min(parameter.low + part * (parameter.high - parameter.low), parameter.high);
    const double shown = parameter.whole ? std::floor(value + 0.5) : value;
    if (sgm_parameters_set(parameters_, parameter.name.c_str(), shown, &error) != SGM_OK) return errorOf(error);
  }
  sgm_field* field = nullptr;
  if (sgm_field_create(runtime_, &field_, &field, &error) != SGM_OK) return errorOf(error);
  const sgm_result set = sgm_world_set_field(world, field, &error);
  // The world holds its own reference to the field, so the field can be released here.
  static_cast<void>(sgm_field_destroy(field));
  if (set != SGM_OK) return errorOf(error);
  ++fields_;
  return {};
}

}  // namespace sgm::cli
