#include "tools/preview/controls.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sgm::preview {
namespace {

constexpr std::array<const char*, 4> kLights{"auto", "sun", "lamp", "none"};
constexpr double kDegrees = 57.29577951308232;
constexpr const char* kHelp =
    "drag: turn   right drag: shift   wheel: nearer\n"
    "WASD QE: walk   H: first view   P: print the command\n"
    "click: print the rule   Esc: close";

/// The unit in which values of a dimension are displayed, and the factor that converts the program's own unit to the
/// displayed unit.
struct Unit {
  const char* format;
  double factor = 1;
};
Unit unitOf(Dim dim) {
  if (dim == kLength) return {"%.3g m"};
  if (dim == kAngle) return {"%.1f\xC2\xB0", kDegrees};
  if (dim == kArea) return {"%.3g m2"};
  if (dim == kVolume) return {"%.3g m3"};
  return {"%.3g"};
}

/// Formats a value in the syntax of the grammar language.
std::string valueText(Dim dim, double value) {
  const char* unit = dim == kLength ? "m" : dim == kAngle ? "rad" : dim == kArea ? "m2" : dim == kVolume ? "m3" : "";
  return fmt::format("{}{}", value, unit);
}

}  // namespace

Controls::Controls(const cli::RenderOptions& options) : seed_(options.seed), given_(options.sets) {
  for (size_t i = 0; i < kLights.size(); ++i)
    if (options.light == kLights[i]) light_ = static_cast<int>(i);
}

void Controls::adopt(const std::shared_ptr<const Program>& program) {
  if (program == nullptr || program == program_) return;
  ParameterValues values = ParameterValues::defaults(*program);
  const std::vector<std::string> kept = sets();
  given_.clear();
  for (const std::string& set : kept) {
    // Keep an assignment that is not valid for this program as text: it may be valid again after the next change.
    Result<ParameterValues> one = cli::parameterValues(*program, {set});
    if (!one) {
      given_.push_back(set);
      continue;
    }
    const uint32_t index = program->findParam(std::string_view(set).substr(0, set.find('=')));
    values.values[index] = one->values[index];
  }
  program_ = program;
  values_ = std::move(values.values);
}

std::string Controls::light() const { return kLights[static_cast<size_t>(light_)]; }

std::vector<std::string> Controls::sets() const {
  std::vector<std::string> sets = given_;
  for (size_t i = 0; program_ && i < values_.size(); ++i) {
    const Param& param = program_->params[i];
    if (values_[i] != param.value)
      sets.push_back(fmt::format("{}={}", program_->text(param.name), valueText(param.dim, values_[i])));
  }
  return sets;
}

bool Controls::drawParameter(const Param& param, double& value) const {
  const std::string name(program_->text(param.name));
  const Unit unit = unitOf(param.dim);
  double shown = value * unit.factor;
  bool changed = false;
  if (param.has_range && param.whole) {
    int whole = static_cast<int>(std::lround(value));
    changed = ImGui::SliderInt(name.c_str(), &whole, static_cast<int>(param.low), static_cast<int>(param.high), "%d",
                               ImGuiSliderFlags_AlwaysClamp);
    shown = whole;
  } else if (param.has_range) {
    const double low = param.low * unit.factor, high = param.high * unit.factor;
    changed = ImGui::SliderScalar(name.c_str(), ImGuiDataType_Double, &shown, &low, &high, unit.format,
                                  ImGuiSliderFlags_AlwaysClamp);
  } else {
    changed = ImGui::InputDouble(name.c_str(), &shown, 0, 0, unit.format, ImGuiInputTextFlags_EnterReturnsTrue);
  }
  if (param.doc != kNoId && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", program_->text(param.doc).data());
  if (!changed) return false;
  value = shown / unit.factor;
  if (param.whole) value = std::round(value);
  // Rounding for the display may have moved the value slightly outside the range.
  if (param.has_range) value = std::clamp(value, param.low, param.high);
  return true;
}

bool Controls::draw(const Painted& last, bool at_work) {
  bool changed = false;
  ImGui::SetNextWindowPos(ImVec2(10, 10), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(330, 0), ImGuiCond_FirstUseEver);
  ImGui::Begin("Preview", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushItemWidth(190);
  const uint64_t one = 1;
  changed |= ImGui::InputScalar("seed", ImGuiDataType_U64, &seed_, &one);
  changed |= ImGui::Combo("light", &light_, kLights.data(), static_cast<int>(kLights.size()));
  if (program_ && !values_.empty()) {
    ImGui::Separator();
    for (size_t i = 0; i < values_.size(); ++i) changed |= drawParameter(program_->params[i], values_[i]);
    if (ImGui::Button("Defaults")) {
      values_ = ParameterValues::defaults(*program_).values;
      changed = true;
    }
  }
  ImGui::Separator();
  ImGui::TextDisabled("%s", kHelp);
  if (last.region)
    ImGui::Text("%zu triangles, cells of %.3g m", last.region->meshed.mesh.indices.size() / 3,
                metres(last.region->cell));
  ImGui::Text("%s", at_work ? "drawing ..." : "up to date");
  ImGui::PopItemWidth();
  ImGui::End();
  if (!last.messages.empty()) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(10, size.y - 10), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSizeConstraints(ImVec2(200, 20), ImVec2(size.x - 20, size.y / 2));
    ImGui::Begin("Messages", nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(last.messages.c_str());
    ImGui::End();
  }
  return changed;
}

}  // namespace sgm::preview
