#pragma once
// A grammar chunk under construction: appends shapes and expressions, folds constants, and finally copies the elements
// that are used.

#include <array>
#include <compare>
#include <map>
#include <memory_resource>
#include <span>
#include <vector>

#include "derive/shape.h"
#include "grammar/text/diagnostics.h"

namespace sgm {

/// A number: either a constant known during derivation, or an expression that the field evaluates (`node`: its index in
/// GrammarChunk::exprs).
struct Num {
  double value = 0;
  uint32_t node = kNone;
  bool constant() const { return node == kNone; }
};

/// The origin of a shape: its key, and the rule activation and the place in the grammar that added it.
struct Origin {
  PathKey key;
  uint32_t activation = 0;  ///< index in interpret::Activations of the activation that added the shape
  Span span;
};

/// Copies groups, and everything that they refer to, from one chunk to others, preserving the order of elements. One
/// copier can make many copies; the time for a copy is proportional to the copied content. The chunk must outlive the
/// copier unchanged.
class DraftCopier {
 public:
  explicit DraftCopier(const GrammarChunk& from);

  /// Appends the groups' content to `out`, which must be empty. The caller must set layer, cell, anchors and notes.
  void copy(std::span<const Group> groups, GrammarChunk& out);
  /// Returns, for each shape of the last copy, in order, its index in the original chunk.
  std::span<const uint32_t> copied() const { return shapes_; }

 private:
  void mark(std::span<const Group> groups);
  void markExpr(uint32_t root);
  void copyExprs(GrammarChunk& out);
  void copyShapes(GrammarChunk& out);
  uint32_t copyPoints(uint32_t first, uint32_t count, GrammarChunk& out) const;
  uint32_t copyBlock(uint32_t block, GrammarChunk& out) const;

  const GrammarChunk& from_;
  /// maps an index in the original chunk to the index in the copy; kNone: not copied
  std::vector<uint32_t> shape_at_, expr_at_, noise_at_;
  std::vector<uint32_t> shapes_, exprs_, noises_;  ///< the copied elements as indices in the original chunk, ascending
  std::vector<uint32_t> open_;
};

class Draft {
 public:
  explicit Draft(std::pmr::memory_resource* memory);

  // Arithmetic on numbers: folds constants in double precision, and reuses equal expressions.
  Num unary(ExprOp op, Num a);
  Num binary(ExprOp op, Num a, Num b);
  Num mix(Num a, Num b, Num t);
  Num smoothstep(double low, double high, Num x);
  Num clamp(Num x, Num low, Num high) { return binary(ExprOp::minimum, binary(ExprOp::maximum, x, low), high); }
  /// Returns the expression dot(row, p - anchor) in metres, for the sample position p; the row is dimensionless.
  Num coordinate(Int3 anchor, std::array<double, 3> row);
  Num noise(const NoiseSpec& spec);
  Num sweep(uint32_t polyline);

  /// Returns the index of a number's expression; creates an expression for a constant.
  uint32_t expression(Num n);
  /// Appends three consecutive expressions, as `warp` requires them; returns the index of the first.
  uint32_t triple(const std::array<Num, 3>& n);

  uint32_t addPolyline(std::vector<Int3> points);
  /// Links the shape to the polyline that it follows, for texture coordinates (Shape::first_point).
  void setLine(uint32_t shape, uint32_t polyline);
  /// Appends the corners of a prism, in either direction; stores them counter-clockwise seen from +y, as
  /// ProgramBuilder::prism requires. Returns the index of the first corner.
  uint32_t addPrismPoints(std::span<const Int3> points);
  /// Appends a block of voxels, and returns its index. solid: block.size() values, 0 or 1, x fastest. Sets
  /// block.first_word.
  uint32_t addVoxels(VoxelBlock block, std::span<const uint8_t> solid);

  /// Appends a shape and the list of its children (sets s.first_child and s.child_count), and returns the shape's
  /// index.
  uint32_t addShape(Shape s, const Origin& origin, std::span<const uint32_t> children = {});
  /// Replaces a shape's children by a subset of them, in the same order.
  void keepChildren(uint32_t shape, std::span<const uint32_t> children);

  Shape& shape(uint32_t i) { return chunk_.shapes[i]; }
  const Shape& shape(uint32_t i) const { return chunk_.shapes[i]; }
  const Origin& origin(uint32_t shape) const { return origins_[shape]; }
  /// Returns the first polyline along which the shape or one of its parts is swept; kNone if none is.
  uint32_t sweepOf(uint32_t shape) const { return sweeps_[shape]; }
  void setSweep(uint32_t shape, uint32_t polyline) { sweeps_[shape] = polyline; }
  const GrammarChunk& chunk() const { return chunk_; }

  /// Returns the approximate memory of the draft in bytes.
  size_t bytes() const;

 private:
  using ExprKey = std::array<uint64_t, 6>;
  Num intern(const Expr& e);

  GrammarChunk chunk_;
  std::pmr::vector<Origin> origins_;
  std::pmr::vector<uint32_t> sweeps_;
  /// index in chunk_.points of the first point of each polyline
  std::pmr::vector<uint32_t> polyline_first_;
  std::pmr::vector<uint32_t> polyline_count_;
  std::pmr::map<ExprKey, uint32_t> interned_;
  std::pmr::map<std::array<uint64_t, 2>, uint32_t> noises_;
};

}  // namespace sgm
