#pragma once
// Collects the output of a derivation: shapes, cuts of the domain, anchors.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "derive/draft.h"
#include "derive/interpret/budget.h"
#include "derive/interpret/cell_inputs.h"
#include "derive/interpret/env.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// Returns a shape with the material and the tag of the environment.
Shape shapeIn(const Env& env, ShapeKind kind);

/// The output of a cell so far: the shapes (in the draft), which of them cut the domain, and the anchors.
class ShapeSink {
 public:
  ShapeSink(const CellInputs& in, Draft& draft, Budget& budget) : limits_(in.limits), draft_(draft), budget_(budget) {}

  /// Adds a shape, and returns its index in the draft. If the cell has too many shapes or uses too much memory, the
  /// derivation of the cell fails. A shape with inner_radius 0 gets the inner radius of its children. ordinal: ordinal
  /// of the statement or expression, part of the shape's key.
  uint32_t addShape(Shape s, uint32_t ordinal, const Span& span, const Env& env, const ShapeList& children = {});
  /// Returns one shape for a non-empty list: its only element, or a hard union of all elements.
  uint32_t unite(const ShapeList& list, const StmtNode& s, const Env& env);

  /// Restricts the shapes of a list, from index `from` on, to levels whose cell edge is at least `coarsest` and at most
  /// `detail` units; 0: no limit.
  void limitLevels(ShapeList& list, size_t from, int32_t coarsest, int32_t detail);

  /// Returns the indices, in the draft, of the shapes that cut the layer's domain.
  ShapeList& layerCuts() { return layer_cuts_; }

  void addAnchor(const Anchor& anchor);
  const std::vector<Anchor>& anchors() const { return anchors_; }

 private:
  const DeriveLimits& limits_;
  Draft& draft_;
  Budget& budget_;
  ShapeList layer_cuts_;
  std::vector<Anchor> anchors_;
};

}  // namespace sgm::interpret
