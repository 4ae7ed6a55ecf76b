#include "derive/interpret/cell_groups.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <utility>

#include "base/plain_text.h"
#include "derive/bounds.h"
#include "derive/interpret/group_parts.h"

namespace sgm::interpret {
namespace {

std::string metresText(int64_t units) { return fixedText(static_cast<double>(units) / kUnitsPerMetre, 2); }

/// Returns the distance in units by which `box` exceeds `limit`.
int64_t excess(const IntBox& box, const IntBox& limit) {
  int64_t most = 0;
  for (int a = 0; a < 3; ++a) {
    most = std::max({most, int64_t{limit.lo[a]} - box.lo[a], int64_t{box.hi[a]} - limit.hi[a]});
  }
  return most;
}

/// True if every unbounded side of `box` lies at an end of the world that `limit` reaches too, on an axis along which
/// the layer is divided into cells.
bool endsWithWorld(const Layer& layer, const IntBox& limit, IntBox box) {
  const IntBox all = IntBox::everything();
  for (int a = 0; a < 3; ++a) {
    if (layer.cell[a] <= 0) continue;
    if (limit.lo[a] == all.lo[a]) box.lo[a] = std::max(box.lo[a], all.lo[a] + 1);
    if (limit.hi[a] == all.hi[a]) box.hi[a] = std::min(box.hi[a], all.hi[a] - 1);
  }
  return isBounded(box);
}

/// Adds a note about a shape that is left out because its box exceeds the limit of the cell.
void noteBeyond(uint32_t shape, const IntBox& box, CellContext& c) {
  const IntBox limit = cellLimit(c.program, c.in.layer_index, c.in.cell);
  const Origin& origin = c.draft.origin(shape);
  const std::string by = isBounded(box) ? metresText(excess(box, limit) + kReachSlack) + " m" : std::string();
  c.budget.note(
      !isBounded(box) && endsWithWorld(c.in.layer, limit, box)
          ? "this shape may pass the end of the world, about 2,097 km from the origin; it is left out whole"
      : !isBounded(box)
          ? "this shape has no bound, so no cell can own it; meet it with a box, or give the displacement an amplitude"
      : !isWhole(c.in.layer) ? "this shape may pass the reach of its cell by " + by +
                                   "; it is left out whole: raise `reach` or make it smaller"
                             : "this shape may pass the domain's box by " + by +
                                   "; it is left out whole: enlarge the box or make it smaller",
      origin.span, origin.activation);
}

/// Adds a group to the chunk, with its bounds clipped to the proven bounds of the layer (Layer::bound). Precondition:
/// the group's bounds are within the cell's limit.
void addGroup(Group group, CellContext& c, GrammarChunk& out) {
  const IntBox proven = shapeLimit(c.program, c.in.layer_index, c.in.cell);
  if (!proven.contains(group.bounds)) {
    // A warp rounds positions to units. The bounds of a shape include a margin for this rounding, but the proven bound
    // of the layer does not. So a group may exceed the proven bound by one unit for each warp.
    const std::pmr::vector<Shape>& shapes = c.draft.chunk().shapes;
    const auto warps =
        std::count_if(shapes.begin(), shapes.end(), [](const Shape& s) { return s.kind == ShapeKind::warp; });
    const int64_t over = excess(group.bounds, proven);
    assert(over <= warps);
    if (over > warps) {
      const Origin& origin = c.draft.origin(group.root);
      c.budget.note("this shape passes the proven bound of its layer by " + metresText(over) +
                        " m and ends there: a bug in the library, please report it",
                    origin.span, origin.activation);
    }
    // A mesh chunk loads only those cells whose proven bounds reach the chunk. Without clipping, parts beyond the
    // proven bound would therefore be visible in some chunks and missing in others.
    group.bounds = group.bounds.clipped(proven);
  }
  if (!group.bounds.empty()) out.groups.push_back(group);
}

}  // namespace

void collectGroups(const ShapeList& list, bool cut, CellContext& c, GrammarChunk& out) {
  const ShapeBounds bounds(c.draft.chunk());
  const IntBox limit = cellLimit(c.program, c.in.layer_index, c.in.cell);
  std::optional<DraftCopier> copier;
  std::vector<std::pair<uint32_t, std::vector<uint32_t>>> parted;
  for (uint32_t root : list) {
    const IntBox box = bounds.level(root, 0);
    if (box.empty()) continue;
    Group group{root, cut, box, c.draft.origin(root).key};
    if (isWithin(box, limit)) {
      addGroup(group, c, out);
      continue;
    }
    if (!copier) copier.emplace(c.draft.chunk());
    GrammarChunk alone;
    copier->copy({&group, 1}, alone);
    const std::vector<uint32_t> from(copier->copied().begin(), copier->copied().end());
    const Origin& origin = c.draft.origin(root);
    const auto parts =
        partsWithin(alone, limit, [&](uint64_t work) { return c.budget.step(work, origin.span, origin.activation); });
    if (!parts) return;
    if (!parts->any) {
      noteBeyond(root, box, c);
      continue;
    }
    std::vector<bool> gone(from.size(), false);
    for (const LeftOutPart& part : parts->left_out) {
      noteBeyond(from[part.shape], part.bounds, c);
      gone[part.shape] = true;
    }
    for (uint32_t i = 0; i < from.size(); ++i) {
      const Shape& s = alone.shapes[i];
      std::vector<uint32_t> kept;
      for (uint32_t k = 0; k < s.child_count; ++k)
        if (const uint32_t child = alone.children[s.first_child + k]; !gone[child]) kept.push_back(from[child]);
      if (kept.size() < s.child_count) parted.emplace_back(from[i], std::move(kept));
    }
    group.bounds = parts->bounds;
    if (!group.bounds.empty()) addGroup(group, c, out);
  }
  for (const auto& [shape, kept] : parted) c.draft.keepChildren(shape, kept);
}

bool collectAlone(const ShapeList& list, bool cut, const ShapeBounds& bounds, const CellContext& c,
                  std::vector<Group>& out) {
  for (uint32_t root : list) {
    const IntBox box = bounds.level(root, 0);
    if (box.empty()) continue;
    if (!cut && !isBounded(box)) return false;
    out.push_back({root, cut, box, c.draft.origin(root).key});
  }
  return true;
}

}  // namespace sgm::interpret
