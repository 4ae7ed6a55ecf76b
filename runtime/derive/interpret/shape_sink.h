#pragma once
// The output of a derivation: shapes, cuts of the domain, anchors.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "derive/draft.h"
#include "derive/interpret/budget.h"
#include "derive/interpret/cell_inputs.h"
#include "derive/interpret/env.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// A shape with the material and the tag of the environment.
Shape shapeIn(const Env& env, ShapeKind kind);

/// The output of the cell so far: the shapes in its draft, those of them that cut the domain, and its anchors.
class ShapeSink {
 public:
  ShapeSink(const CellInputs& in, Draft& draft, Budget& budget) : limits_(in.limits), draft_(draft), budget_(budget) {}

  /// Returns the index of the new shape in the draft; the cell fails if it has too many shapes or takes too much
  /// memory. Without an inner radius of its own, the shape gets that of its children. ordinal: of the statement or the
  /// expression, for its key.
  uint32_t addShape(Shape s, uint32_t ordinal, const Span& span, const Env& env, const ShapeList& children = {});
  /// Returns one shape for a non-empty list: its only element, or a hard union.
  uint32_t unite(const ShapeList& list, const StmtNode& s, const Env& env);

  /// Restricts the shapes of a list from an index on to levels with cell edges from `coarsest` to `detail` units; 0:
  /// any.
  void limitLevels(ShapeList& list, size_t from, int32_t coarsest, int32_t detail);

  /// Shapes that cut the layer's domain; in the draft.
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
