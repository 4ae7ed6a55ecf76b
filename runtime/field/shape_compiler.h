#pragma once
// Compiles the shapes of a grammar chunk to ops of a field program.

#include <memory_resource>
#include <optional>
#include <span>

#include "base/result.h"
#include "derive/shape.h"
#include "field/builder.h"
#include "field/expr_compiler.h"
#include "field/shape_labels.h"

namespace sgm {

/// Compiles shapes of one grammar chunk recursively, and keeps track of the warps and the sweep that enclose the
/// current shape.
class ShapeCompiler {
 public:
  /// box: contains every position that will be sampled; cell_number: the value for ShapeLabels::Source::cell; shapes:
  /// the table that numbers the shapes, if the labels of the field identify shapes; null if they are materials and
  /// tags.
  ShapeCompiler(const GrammarChunk& chunk, uint32_t cell_number, const IntBox& box, int32_t cell, ShapeLabels* shapes,
                ProgramBuilder& builder, std::pmr::memory_resource* memory)
      : chunk_(chunk),
        cell_number_(cell_number),
        read_(box),
        cell_(cell),
        shapes_(shapes),
        builder_(builder),
        memory_(memory),
        exprs_(chunk, cell, builder, memory) {}

  /// Emits a shape; nullopt if the level drops the whole shape.
  Result<std::optional<Value>> root(uint32_t shape) {
    exprs_.beginGroup();
    return emit(shape, 0);
  }

 private:
  using Emitted = Result<std::optional<Value>>;

  static Emitted some(Value v) { return std::optional<Value>(v); }
  std::span<const uint32_t> children(const Shape& s) const {
    return std::span(chunk_.children).subspan(s.first_child, s.child_count);
  }
  bool dropped(const Shape& s) const;
  /// Returns a shape's material and tag, or its number in the table of shapes; the pieces of one sweep share a number.
  uint32_t labelOf(uint32_t index);

  Emitted emit(uint32_t index, int depth);
  /// Emits a hard union or intersection, operand by operand. If the level drops an operand of an intersection, it drops
  /// the whole intersection.
  Emitted chain(const Shape& s, Op op, int depth, bool all);
  Emitted subtract(const Shape& s, int depth);
  /// Emits the round union of the children. Intersection and subtraction are round unions with negated operands: an
  /// intersection negates all operands, a subtraction only the first: -(round union of -a, b, c, ...).
  Emitted round(const Shape& s, int depth, bool negated, bool only_first);
  Emitted sum(const Shape& s, int depth);
  /// True if the kernel weight of a ball is 0 at every position that will be sampled, so that omitting the ball changes
  /// no bit. Always false under a warp, which moves the positions.
  bool weighsNothing(const Shape& ball) const;
  Emitted morph(const Shape& s, int depth);
  Value voxels(const Shape& s, uint32_t label);
  Emitted warp(const Shape& s, int depth);

  const GrammarChunk& chunk_;
  uint32_t cell_number_;
  IntBox read_;    ///< box that contains every position that will be sampled
  int warps_ = 0;  ///< number of warps around the current shape
  int32_t cell_;
  ShapeLabels* shapes_;
  std::optional<uint32_t> sweep_;  ///< label of the sweep whose piece is compiled now; nullopt outside of sweeps
  ProgramBuilder& builder_;
  std::pmr::memory_resource* memory_;
  ExprCompiler exprs_;
};

}  // namespace sgm
