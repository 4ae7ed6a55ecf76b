#include "tools/support/drawable_region.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "grammar/text/sink.h"
#include "tools/support/render_options.h"
#include "tools/support/surroundings.h"

namespace sgm::cli {
namespace {

/// The error message if no anchor of the region has the name, kind or tag `wanted`. Suggests a similar one.
std::string noAnchor(const Program& program, std::span<const Anchor> anchors, const std::string& wanted) {
  Suggestion suggestion(wanted);
  std::set<std::string> known;
  for (const Anchor& anchor : anchors)
    for (const auto& name : {program.names[anchor.name], program.names[anchor.kind], program.tags[anchor.tag]})
      if (!name.empty()) known.emplace(name);
  for (const std::string& name : known) suggestion.offer(name);
  const std::string hint = known.empty()               ? "it has no anchors"
                           : suggestion.best().empty() ? fmt::format("it has {}", fmt::join(known, ", "))
                                                       : fmt::format("did you mean '{}'?", suggestion.best());
  return fmt::format("--at: the region has no anchor of the name, kind or tag '{}'; {}", wanted, hint);
}

}  // namespace

Result<void> checkAnchor(const Program& program, std::span<const Anchor> anchors, const std::string& wanted) {
  const auto is_wanted = [&](const Anchor& anchor) { return isWanted(program, anchor, wanted); };
  if (wanted.empty() || std::ranges::any_of(anchors, is_wanted)) return {};
  return Error{Code::invalid_argument, noAnchor(program, anchors, wanted)};
}

Result<void> checkDrawable(const RenderOptions& options, const Region& region) {
  if (Result<void> anchor = checkAnchor(*region.program, region.anchors, options.at); !anchor) return anchor;
  if (region.meshed.mesh.indices.empty())
    return Error{Code::invalid_argument, "there is no surface to draw: " + region.empty_because};
  return {};
}

}  // namespace sgm::cli
