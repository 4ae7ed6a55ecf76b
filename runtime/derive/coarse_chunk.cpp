#include "derive/coarse_chunk.h"

#include <algorithm>

#include "derive/draft.h"
#include "grammar/builtins.h"

namespace sgm {
namespace {

/// Decides shape by shape, children before those that they are part of, and takes hidden children out.
class CoarseShapes {
 public:
  CoarseShapes(GrammarChunk& chunk, int32_t cell_edge)
      : chunk_(chunk), cell_edge_(cell_edge), shows_(chunk.shapes.size(), false) {
    for (uint32_t i = 0; i < chunk.shapes.size(); ++i) shows_[i] = decide(chunk_.shapes[i]);
  }

  bool shows(uint32_t shape) const { return shows_[shape]; }

 private:
  bool decide(Shape& s) {
    if (s.detail != 0 && cell_edge_ > s.detail) return false;
    if (s.kind == ShapeKind::voxels) return cell_edge_ <= AutomatonLimits::coarsestCell(chunk_.blocks[s.block].edge);
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
        // All of them tell its scale.
        return std::any_of(first, first + s.child_count, shown);
      default:
        return std::all_of(first, first + s.child_count, shown);
    }
  }

  /// Moves those that show to the front; returns how many there are.
  uint32_t keep(std::pmr::vector<uint32_t>::iterator first, uint32_t count) {
    const auto end = std::remove_if(first, first + count, [&](uint32_t child) { return !shows_[child]; });
    return static_cast<uint32_t>(end - first);
  }

  GrammarChunk& chunk_;
  const int32_t cell_edge_;
  std::vector<bool> shows_;
};

}  // namespace

GrammarChunk coarseChunk(const GrammarChunk& chunk, int32_t cell_edge, std::pmr::memory_resource* memory) {
  GrammarChunk whole(chunk);
  const CoarseShapes shapes(whole, cell_edge);
  std::erase_if(whole.groups, [&](const Group& group) { return !shapes.shows(group.root); });
  GrammarChunk out(memory);
  DraftCopier(whole).copy(whole.groups, out);
  out.layer = chunk.layer;
  out.cell = chunk.cell;
  out.parameters = chunk.parameters;
  return out;
}

}  // namespace sgm
