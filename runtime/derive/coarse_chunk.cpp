#include "derive/coarse_chunk.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "derive/draft.h"
#include "grammar/syntax/builtins.h"

namespace sgm {
namespace {

/// Decides for each shape whether it is visible at the level of detail with the given cell edge, and removes invisible
/// children from their parents. Visits children before parents.
class CoarseShapes {
 public:
  CoarseShapes(GrammarChunk& chunk, int32_t cell_edge, const std::vector<bool>& left_out)
      : chunk_(chunk), cell_edge_(cell_edge), shows_(chunk.shapes.size(), false) {
    for (uint32_t i = 0; i < chunk.shapes.size(); ++i) shows_[i] = !left_out[i] && decide(chunk_.shapes[i]);
  }

  std::vector<bool> shows() && { return std::move(shows_); }

 private:
  bool decide(Shape& s) {
    if (cell_edge_ > coarsestOf(chunk_, s)) return false;
    if (s.child_count == 0) return true;
    const auto first = chunk_.children.begin() + static_cast<std::ptrdiff_t>(s.first_child);
    const auto shown = [&](uint32_t child) { return shows_[child]; };
    switch (s.kind) {
      case ShapeKind::unite:
      case ShapeKind::unite_smooth:
        s.child_count = keep(first, s.child_count);
        return s.child_count > 0;
      case ShapeKind::subtract:
      case ShapeKind::subtract_smooth:
        if (!shown(*first)) return false;
        s.child_count = 1 + keep(first + 1, s.child_count - 1);
        return true;
      case ShapeKind::sum:
        // The scale of the sum depends on all its children, so a sum keeps all of them if any is visible.
        return std::any_of(first, first + s.child_count, shown);
      default:
        return std::all_of(first, first + s.child_count, shown);
    }
  }

  /// Moves the indices of visible children to the front of the range; returns the number of visible children.
  uint32_t keep(std::pmr::vector<uint32_t>::iterator first, uint32_t count) {
    const auto end = std::remove_if(first, first + count, [&](uint32_t child) { return !shows_[child]; });
    return static_cast<uint32_t>(end - first);
  }

  GrammarChunk& chunk_;
  const int32_t cell_edge_;
  std::vector<bool> shows_;
};

}  // namespace

std::vector<bool> hideShapes(GrammarChunk& chunk, int32_t cell_edge, const std::vector<bool>& left_out) {
  return CoarseShapes(chunk, cell_edge, left_out).shows();
}

int32_t coarsestOf(const GrammarChunk& chunk, const Shape& s) {
  const int32_t own = s.detail != 0 ? s.detail : std::numeric_limits<int32_t>::max();
  if (s.kind != ShapeKind::voxels) return own;
  return std::min(own, AutomatonLimits::coarsestCell(chunk.blocks[s.block].edge));
}

bool isFreePart(ShapeKind of, uint32_t operand) {
  if (of == ShapeKind::subtract || of == ShapeKind::subtract_smooth) return operand > 0;
  return of == ShapeKind::unite || of == ShapeKind::unite_smooth;
}

GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge, std::pmr::memory_resource* memory) {
  GrammarChunk whole(chunk);
  const std::vector<bool> shows = hideShapes(whole, cell_edge, std::vector<bool>(whole.shapes.size(), false));
  std::erase_if(whole.groups, [&](const Group& group) { return !shows[group.root]; });
  GrammarChunk out(memory);
  DraftCopier(whole).copy(whole.groups, out);
  out.layer = chunk.layer;
  out.cell = chunk.cell;
  out.parameters = chunk.parameters;
  return out;
}

}  // namespace sgm
