#include "chunk/thin_shapes.h"

#include <algorithm>
#include <utility>

namespace sgm {

namespace {

/// Finds the thin shapes of one cell.
class Search {
 public:
  Search(const GrammarChunk& chunk, int32_t cell_edge) : chunk_(chunk), cell_edge_(cell_edge) {}

  std::vector<ThinShape> find() {
    for (const Group& group : chunk_.groups) visit(group.root, group.cut);
    return std::move(found_);
  }

 private:
  bool shows(const Shape& s) const {
    return (s.detail == 0 || s.detail >= cell_edge_) && (s.coarsest == 0 || s.coarsest <= cell_edge_);
  }
  uint32_t child(const Shape& s, uint32_t i) const { return chunk_.children[s.first_child + i]; }

  /// True for the union of a sweep's pieces, which counts as one shape.
  bool isSweep(const Shape& s) const { return s.kind == ShapeKind::unite && s.point_count > 0; }

  std::optional<Slab> alone(const Shape& s) const {
    return isSweep(s) ? slabOfSweep(chunk_, s, cell_edge_) : slabOfShape(chunk_, s);
  }

  /// Returns the thickness, in units, of the thickest shape in the subtree of a node; 0 if the node is invisible.
  double thickness(uint32_t index, uint32_t* thickest = nullptr) const {
    const Shape& s = chunk_.shapes[index];
    if (!shows(s)) return 0;
    if (const std::optional<Slab> slab = alone(s)) {
      if (thickest != nullptr) *thickest = index;
      return slab->thickness();
    }
    if (s.child_count == 0) return 1e30;  // half-spaces and voxels count as infinitely thick
    double most = 0;
    const bool first_alone = s.kind == ShapeKind::subtract || s.kind == ShapeKind::subtract_smooth;
    for (uint32_t i = 0; i < (first_alone ? 1 : s.child_count); ++i) {
      uint32_t of = index;
      const double one = thickness(child(s, i), &of);
      if (one > most && thickest != nullptr) *thickest = of;
      most = std::max(most, one);
    }
    return most;
  }

  void add(uint32_t index, bool cut) {
    const std::optional<Slab> slab = alone(chunk_.shapes[index]);
    if (slab && slab->thickness() < cell_edge_) found_.push_back({index, *slab, cut});
  }

  void visit(uint32_t index, bool cut) {
    const Shape& s = chunk_.shapes[index];
    if (!shows(s)) return;
    if (isSweep(s) || s.child_count == 0) return add(index, cut);
    switch (s.kind) {
      case ShapeKind::subtract:
      case ShapeKind::subtract_smooth:
        for (uint32_t i = 0; i < s.child_count; ++i) visit(child(s, i), cut != (i > 0));
        return;
      case ShapeKind::meet:
      case ShapeKind::meet_smooth: {
        // An intersection is no thicker than any of its operands.
        double least = 1e30;
        uint32_t thinnest = index;
        for (uint32_t i = 0; i < s.child_count; ++i) {
          uint32_t of = index;
          const double one = thickness(child(s, i), &of);
          if (one < least) least = one, thinnest = of;
        }
        if (least > 0) add(thinnest, cut);
        return;
      }
      case ShapeKind::sum:
      case ShapeKind::morph: {
        uint32_t thickest = index;
        if (thickness(index, &thickest) > 0) add(thickest, cut);
        return;
      }
      case ShapeKind::unite:
      case ShapeKind::unite_smooth:
      case ShapeKind::displace:
      case ShapeKind::warp:
        for (uint32_t i = 0; i < s.child_count; ++i) visit(child(s, i), cut);
        return;
      case ShapeKind::sphere:
      case ShapeKind::box:
      case ShapeKind::cylinder:
      case ShapeKind::truncone:
      case ShapeKind::capsule:
      case ShapeKind::torus:
      case ShapeKind::ellipsoid:
      case ShapeKind::superquadric:
      case ShapeKind::halfspace:
      case ShapeKind::prism:
      case ShapeKind::morph_power:
      case ShapeKind::voxels:
        return;  // these kinds have no children
    }
  }

  const GrammarChunk& chunk_;
  const int32_t cell_edge_;
  std::vector<ThinShape> found_;
};

}  // namespace

std::vector<ThinShape> findThinShapes(const GrammarChunk& chunk, int32_t cell_edge) {
  return Search(chunk, cell_edge).find();
}

}  // namespace sgm
