#include "tools/support/region_notes.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "derive/layout/floor_plan.h"
#include "tools/support/surroundings.h"

namespace sgm::cli {
namespace {

int32_t thinnest(const IntBox& box) {
  int64_t edge = std::numeric_limits<int32_t>::max();
  for (int axis = 0; axis < 3; ++axis) edge = std::min(edge, int64_t{box.hi[axis]} - box.lo[axis]);
  return static_cast<int32_t>(edge);
}

/// Thickness of a treemap's walls in metres; nullopt if the grammar computes it by an expression.
std::optional<double> wallOf(const Program& program, const StmtNode& s) {
  const ExprId wall = program.ast.treemaps[s.extra].wall;
  if (wall == kNoId) return kTreemapWall;
  const ExprNode& n = program.expr(wall);
  return n.kind == ExprKind::number ? std::optional(n.value) : std::nullopt;
}

/// A length for users, such as "4 cm", "2.5 cm" or "1.2 m".
std::string lengthText(int32_t units) {
  const double length = metres(units);
  return length < 1 ? fmt::format("{:.3g} cm", 100 * length) : fmt::format("{:.3g} m", length);
}

}  // namespace

Result<std::string> whyEmpty(const WorldField& world, const Region& region) {
  const bool solid = region.program->domain.solid;
  const Result<std::vector<IntBox>> shapes = shapesIn(world, region.meshed.extent);
  if (!shapes) return shapes.error();
  if (shapes->empty())
    return std::string(solid ? "nothing is cut from the rock in this region" : "no shape lies in this region") +
           ": the shapes may lie elsewhere (choose another --region), or be left out (see the warnings)";
  if (!solid && region.meshed.solid_samples == region.samples())
    return std::string("this region lies entirely inside the solid: choose a larger --region");
  const bool thin = std::ranges::all_of(*shapes, [&](const IntBox& box) { return thinnest(box) < region.cell; });
  if (thin)
    return fmt::format("the shapes here are thinner than a cell of {} m: choose smaller cells with --cell",
                       metres(region.cell));
  return fmt::format("{} here, or thinner than a cell of {} m: check the cuts, or choose smaller cells with --cell",
                     solid ? "all cuts are filled again" : "all shapes are cut away", metres(region.cell));
}

void sayThinParts(const std::vector<ThinPart>& parts, int32_t cell) {
  constexpr size_t kMaxNotes = 10;
  for (size_t i = 0; i < std::min(parts.size(), kMaxNotes); ++i) {
    const ThinPart& part = parts[i];
    fmt::print(stderr, "note: {}{} is {} {}, cells {}: it may be invisible ({}{} {})\n", part.cut ? "a cut in " : "",
               part.rule, lengthText(part.thickness), part.cut ? "wide" : "thick", lengthText(cell),
               part.is_about ? "about " : "", part.uses, part.uses == 1 ? "use" : "uses");
  }
  if (parts.size() > kMaxNotes)
    fmt::print(stderr, "note: {} more rules have parts thinner than a cell\n", parts.size() - kMaxNotes);
}

void warnOfThinWalls(const std::string& file, const Program& program, int32_t cell) {
  for (const StmtNode& s : program.ast.stmts) {
    if (s.kind != StmtKind::treemap) continue;
    const std::optional<double> wall = wallOf(program, s);
    if (!wall || *wall >= metres(cell)) continue;
    fmt::print(stderr,
               "{}:{}:{}: warning: the walls of this treemap, {} m, are thinner than a cell of {} m, and may have "
               "holes or be missing: choose smaller cells, such as --cell {:.2g}\n",
               s.span.file == 0 ? file : std::string(program.modules[s.span.file].path), s.span.line, s.span.column,
               *wall, metres(cell), *wall / 2);
  }
}

}  // namespace sgm::cli
