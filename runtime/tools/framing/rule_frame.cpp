#include "tools/framing/rule_frame.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "grammar/help/declarations.h"
#include "grammar/syntax/override_path.h"
#include "grammar/text/sink.h"

namespace sgm::cli {
namespace {

constexpr size_t kMaxUses = 50'000;
// Minimum and maximum edge of a grid cell, in units.
constexpr int32_t kSmallestCell = 16, kLargestCell = kUnitsPerMetre / 2;
// Minimum number of grid cells across a use (application) of a rule; there are fewer if the cells would be smaller than
// kSmallestCell.
constexpr int32_t kCellsAcross = 12;
constexpr int64_t kRegionCells = 352;  // number of grid cells along the region's longest edge

Error refusal(std::string message) { return {Code::invalid_argument, std::move(message)}; }

/// Maps the names of imports in the root file to indices of modules.
std::map<std::string, uint32_t> importsOf(const Program& program) {
  std::map<std::string, uint32_t> imports;
  for (const DeclaredName& declared : declarationsOf(program.modules[0].text).names) {
    if (declared.kind != NameKind::import) continue;
    for (uint32_t module = 0; module < program.modules.size(); ++module)
      if (std::string_view(program.modules[module].path) == declared.path) imports[declared.name] = module;
  }
  return imports;
}

/// Maps all names that --frame accepts, as the root file writes them, to indices of rules.
std::map<std::string, uint32_t> namesOf(const Program& program) {
  std::map<std::string, uint32_t> names;
  const std::map<std::string, uint32_t> imports = importsOf(program);
  for (uint32_t rule = 0; rule < program.rules.size(); ++rule) {
    const std::string name(program.text(program.rules[rule].name));
    if (program.rules[rule].module == 0) names[name] = rule;
    for (const auto& [alias, module] : imports)
      if (module == program.rules[rule].module) names[alias + "." + name] = rule;
  }
  return names;
}

/// Returns the known name that is most similar to `wanted`; "" if none is similar. The result includes the name of the
/// import, even if `wanted` does not.
std::string nearName(const std::map<std::string, uint32_t>& names, const std::string& wanted) {
  Suggestion whole(wanted), bare(wanted);
  std::map<std::string, std::string> without;
  for (const auto& [name, rule] : names) {
    whole.offer(name);
    const std::string last = name.substr(name.find('.') + 1);
    without.emplace(last, name);
    bare.offer(last);
  }
  if (!whole.best().empty()) return std::string(whole.best());
  return bare.best().empty() ? std::string() : without[std::string(bare.best())];
}

std::string listed(const std::map<std::string, uint32_t>& names) {
  constexpr size_t kMost = 12;
  std::string text;
  size_t count = 0;
  for (const auto& [name, rule] : names) {
    if (count++ == kMost) return text + fmt::format(" and {} more", names.size() - kMost);
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

int64_t longestEdge(const IntBox& box) {
  int64_t longest = 1;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, int64_t{box.hi[axis]} - box.lo[axis]);
  return longest;
}

double squareFromOrigin(const IntBox& box) {
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = (static_cast<double>(box.lo[axis]) + box.hi[axis]) / 2;
    square += middle * middle;
  }
  return square;
}

FrameRegion around(const IntBox& use) {
  const int64_t size = longestEdge(use);
  // Long and thin shapes need smaller cells, which resolve their thickness.
  int64_t detail = size;
  for (int axis = 0; axis < 3; ++axis) detail = std::min(detail, int64_t{use.hi[axis]} - use.lo[axis]);
  detail = std::max(detail, size / kCellsAcross);
  FrameRegion frame;
  frame.cell = kLargestCell;
  while (frame.cell > kSmallestCell && frame.cell * kCellsAcross > detail) frame.cell /= 2;
  // Add space around the shapes of the rule's use, for the camera and the background.
  const int64_t wanted = std::max<int64_t>(6 * size, int64_t{24} * kUnitsPerMetre);
  const int64_t half = std::max(std::min(wanted, kRegionCells / 2 * frame.cell), size);
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t middle = (int64_t{use.lo[axis]} + use.hi[axis]) / 2;
    frame.region.lo[axis] = saturate(middle - half);
    frame.region.hi[axis] = saturate(middle + half);
  }
  return frame;
}

}  // namespace

Result<FramedRule> findFramedRule(const Program& program, std::string_view text) {
  const WrittenPath path = parsePath(text);
  if (!path.wanted.empty())
    return refusal(
        fmt::format("--frame: '{}' is neither a rule nor a path such as Row/Post[2]: expected {}", text, path.wanted));
  const std::map<std::string, uint32_t> names = namesOf(program);
  const WrittenStep& last = path.steps.back();
  FramedRule framed{std::string(text), {}, path.steps.size() > 1 || last.index || !path.layer.empty()};
  std::string name(last.name);
  if (!last.qualifier.empty()) name = fmt::format("{}.{}", last.qualifier, last.name);
  if (framed.by_path) {
    // If a path passes through an imported file, its further names are qualified by that file's own import names, which
    // `names` does not contain. So select candidate rules by the last name only; matchesPath() compares the whole path
    // later.
    for (uint32_t rule = 0; rule < program.rules.size(); ++rule)
      if (program.text(program.rules[rule].name) == last.name) framed.rules.push_back(rule);
  } else if (const auto found = names.find(name); found != names.end()) {
    framed.rules.push_back(found->second);
  }
  if (!framed.rules.empty()) return framed;
  const std::string near = nearName(names, name);
  return refusal(
      fmt::format("--frame: there is no rule '{}': {}", name,
                  near.empty() ? "the grammar has " + listed(names) : fmt::format("did you mean '{}'?", near)));
}

bool matchesPath(std::string_view wanted, std::string_view path) {
  const WrittenPath asked = parsePath(wanted), whole = parsePath(path);
  if (!asked.wanted.empty() || !whole.wanted.empty() || asked.steps.size() > whole.steps.size()) return false;
  if (!asked.layer.empty() &&
      (asked.layer != whole.layer || asked.cell != whole.cell || asked.steps.size() != whole.steps.size()))
    return false;
  const size_t before = whole.steps.size() - asked.steps.size();
  for (size_t i = 0; i < asked.steps.size(); ++i) {
    const WrittenStep &a = asked.steps[i], &b = whole.steps[before + i];
    if (a.name != b.name || (!a.qualifier.empty() && a.qualifier != b.qualifier)) return false;
    if (a.index && a.index != b.index) return false;
  }
  return true;
}

Result<std::vector<RuleUse>> usesIn(const WorldField& world, const FramedRule& wanted, const IntBox& box) {
  std::vector<RuleUse> uses;
  for (const uint32_t rule : wanted.rules) {
    Result<std::vector<RuleInstance>> instances = world.instances(rule, box, kMaxUses);
    if (!instances) return instances.error();
    for (RuleInstance& instance : *instances) {
      if (!instance.bounded || (wanted.by_path && !matchesPath(wanted.text, instance.path))) continue;
      IntBox bounds;
      for (const Group& group : instance.chunk.groups)
        if (!group.cut) bounds = bounds.joined(group.bounds);
      if (bounds.empty()) continue;
      uses.push_back({std::move(instance.path), bounds,
                      std::make_shared<const DerivedCell>(std::move(instance.chunk), world.memory())});
    }
  }
  return uses;
}

Result<FrameRegion> regionAround(const WorldField& world, const FramedRule& wanted) {
  const Domain& domain = world.settings().program->domain;
  const auto nearestIn = [&](const IntBox& box) -> Result<std::optional<IntBox>> {
    const Result<std::vector<RuleUse>> uses = usesIn(world, wanted, box);
    if (!uses) return uses.error();
    if (uses->empty()) return std::optional<IntBox>();
    std::vector<int64_t> sizes;
    for (const RuleUse& use : *uses) sizes.push_back(longestEdge(use.bounds));
    std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2));
    std::optional<IntBox> nearest;
    for (const RuleUse& use : *uses) {
      if (longestEdge(use.bounds) < sizes[sizes.size() / 2]) continue;
      if (!nearest || squareFromOrigin(use.bounds) < squareFromOrigin(*nearest)) nearest = use.bounds;
    }
    return nearest;
  };
  for (const int64_t metres : {16, 48, 128, 512}) {
    IntBox box = domain.box;
    if (domain.infinite) {
      const int32_t half = saturate(metres * kUnitsPerMetre);
      box = {{-half, -half, -half}, {half, half, half}};
    }
    const Result<std::optional<IntBox>> nearest = nearestIn(box);
    if (!nearest) return nearest.error();
    if (*nearest) {
      FrameRegion frame = around(**nearest);
      if (!domain.infinite) frame.region = frame.region.clipped(domain.box);
      return frame;
    }
    if (!domain.infinite) break;
  }
  return refusal(fmt::format(
      "--frame: '{}' is not used {}: {}", wanted.text, domain.infinite ? "within 512 m of the origin" : "in this world",
      domain.infinite ? "choose a region with --region, or another --seed" : "choose another --seed, or another rule"));
}

}  // namespace sgm::cli
