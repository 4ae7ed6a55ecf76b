#pragma once
// The result of deriving a cell: implicit shapes with bounds and tags, and anchors; never triangles.
//
// All types are plain data in world units (1/1024 m), so that a grammar chunk can be hashed, cached, moved by an
// integer offset, and compiled to a field program (field/compile.h) without the grammar.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <vector>

#include "base/fixed.h"
#include "base/hash.h"

namespace sgm {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;

/// A transform from the world to local coordinates: q = rows * float(p - origin). The rows are orthonormal; scales are
/// already applied to the sizes of shapes.
struct Frame {
  Int3 origin;
  std::array<float, 9> rows{1, 0, 0, 0, 1, 0, 0, 0, 1};

  friend bool operator==(const Frame&, const Frame&) = default;
};

/// Leaves give a distance in units, negative inside; their comments describe Shape::size, in units unless noted.
/// Combiners combine the fields of their children. Formulas: shaders/common/primitives.h and shaders/common/combine.h.
enum class ShapeKind : uint8_t {
  sphere,        ///< size: r
  box,           ///< size: half extents x y z
  cylinder,      ///< axis y, centre at origin; size: r, half height
  truncone,      ///< axis y, centre at origin; size: bottom radius, top radius, half height
  capsule,       ///< from the origin to origin + size[1..3] (in world axes); size[0]: r. Frame::rows is unused
  torus,         ///< axis y; size: ring radius, tube radius
  ellipsoid,     ///< size: radii x y z; field (|q/radii| - 1) * min(radii)
  superquadric,  ///< size: radii x y z, exponent n >= 2 (no unit); field (||q/radii||_n - 1) * min(radii)
  halfspace,     ///< solid below the plane y = 0 of the local frame
  prism,     ///< polygon in the local x-z plane, counter-clockwise seen from +y, extruded along y; size: half height
  unite,     ///< hard union of the children
  meet,      ///< hard intersection of the children
  subtract,  ///< the first child minus all others
  unite_smooth,     ///< round union, radius `amount` units: max(k, min d) - sqrt(sum max(k - d, 0)^2)
  meet_smooth,      ///< round intersection: the negated unite_smooth of the negated children
  subtract_smooth,  ///< the first child minus the others, rounded by `amount`
  /// Smooth sum of leaves with a compact kernel. d: distance of a leaf, r: its inner radius (Shape::inner_radius).
  /// Field: (T - sum max(0, 1 - (1 + d/r)^2 / kSumSupport^2)^3) * L. T is the kernel at d = 0, so that a single leaf
  /// keeps its surface; L is the largest inner radius divided by the kernel's slope at d = 0. The surface grows at most
  /// to the kernel's support.
  sum,
  morph,  ///< two children A and B: (1 - t) A + t B; t = `expr`, or `amount` if expr is kNone; clamped to 0..1
  /// No child. A superquadric with radii size[0..2] at t = 0 and size[3..5] at t = 1. The exponent 2 / (1 - t +
  /// t/kMaxPower*2) changes it from an ellipsoid to a box.
  morph_power,
  displace,  ///< field of the only child plus 1024 * expr (expr in metres)
  /// field of the only child at p + round(1024 * (expr, expr + 1, expr + 2)) (three consecutive expressions, in metres)
  warp,
  /// no child; size: half extents x y z of an axis-aligned box; field: max(samples of `block` (field/voxels.h), box)
  voxels,
};

/// radius within which a leaf's kernel in a sum is not 0, as a multiple of the leaf's inner radius
inline constexpr float kSumSupport = 1.6f;
inline constexpr float kMaxPower = 20.0f;  ///< exponent of a superquadric with the maximum squareness, 1

struct Shape {
  ShapeKind kind = ShapeKind::sphere;
  /// index into the grammar's materials; 0: a cut keeps the material of the solid that it cuts, and any other shape has
  /// the default material
  uint16_t material = 0;
  uint16_t tag = 0;                           ///< index into the grammar's tags; 0: none
  uint32_t first_child = 0, child_count = 0;  ///< range of the children in GrammarChunk::children
  uint32_t expr = kNone;                      ///< index in GrammarChunk::exprs of the root expression; kNone: none
  /// Range in GrammarChunk::points. A prism: its corners. A sweep (one shape, or the union of its pieces): the polyline
  /// that it follows, used only for texture coordinates.
  uint32_t first_point = 0, point_count = 0;
  uint32_t block = kNone;  ///< for a shape of kind `voxels`: index in GrammarChunk::blocks
  /// the shape is dropped at levels whose cell edge is larger than this, in units; 0: it has no such limit
  int32_t detail = 0;
  /// the shape is dropped at levels whose cell edge is smaller than this, in units (set by `lod`); 0: it has no such
  /// limit
  int32_t coarsest = 0;
  float amount = 0;  ///< radius of a smooth combiner in units, or t of a morph with constant t
  /// about the radius of the largest ball inside the leaf, in units; used only for leaves in a sum
  float inner_radius = 0;
  /// sizes, described at ShapeKind; for the union of a sweep's pieces: the sweep's radius, units
  std::array<float, 6> size{};
  Frame frame;
};

/// Expressions that the field evaluates per sample (`field ...`): a directed acyclic graph, children before parents.
/// Lengths are in metres; a comparison gives 0 or 1.
enum class ExprOp : uint8_t {
  constant,    ///< value
  coordinate,  ///< (row . float(p - anchor)) / 1024: the coordinate along any axis of the world or of a local frame
  noise,       ///< fractal gradient noise in -1..1, with the settings GrammarChunk::noises[Expr::noise]
  /// position along the polyline points[first_point .. first_point + point_count), 0 to 1, of the point nearest to the
  /// sample
  sweep,
  negate,
  absolute,
  floor,
  square_root,
  add,
  subtract,
  multiply,
  divide,
  minimum,
  maximum,
  less,        ///< 1 if a < b, otherwise 0
  smoothstep,  ///< a: x, b: lower edge, c: upper edge (both constants, lower < upper or the reverse)
  mix,         ///< (1 - c) a + c b, exactly a at c = 0 and b at c = 1
};

struct Expr {
  ExprOp op = ExprOp::constant;
  uint32_t a = kNone, b = kNone, c = kNone;
  float value = 0;
  Int3 anchor;
  std::array<float, 3> row{};
  uint32_t noise = kNone;
  uint32_t first_point = 0, point_count = 0;
};

struct NoiseSpec {
  Int3 origin;  ///< position of one lattice corner, units
  /// lattice edge of the first octave in units, at least 1; each further octave halves it
  int32_t period = kUnitsPerMetre;
  uint32_t octaves = 1;  ///< number of octaves, 1 to 12; the field drops octaves whose period is shorter than two cells
  uint32_t seed = 0;
};

/// A box of voxels. Voxel i along an axis is centred at anchor + i * edge. Bit i of GrammarChunk::voxels, counted from
/// bit first_word * 64, is set if the block's i-th voxel (x fastest) is solid. Along an axis with a count of 0 all
/// voxels are equal.
struct VoxelBlock {
  /// centre of voxel 0 0 0, units; common to all voxels of the world, so that neighbouring blocks share positions
  Int3 anchor;
  int32_t edge = 0;  ///< units
  Int3 first;        ///< index of the lowest voxel along each axis
  Int3 count;
  uint32_t first_word = 0;

  size_t size() const {
    size_t voxels = 1;
    for (int axis = 0; axis < 3; ++axis) voxels *= static_cast<size_t>(std::max(count[axis], 1));
    return voxels;
  }
  size_t words() const { return (size() + 63) / 64; }
};

/// The number of voxels that a block contains beyond its cell on every side. With so many, the block determines the
/// field wherever the shape is evaluated, at every level (see field/voxels.h).
inline constexpr int32_t kVoxelMargin = 12;

/// A top-level shape. Each group adds to the field by a hard min, or cuts from it by a hard max.
struct Group {
  uint32_t root = 0;  ///< index of the top-level shape in GrammarChunk::shapes
  bool cut = false;
  IntBox bounds;  ///< contains every point where the root shape's field is <= 0, at every level
  PathKey key;    ///< sort key of the groups of a layer, so that their order does not depend on the order of derivation
};

/// An oriented point for gameplay, emitted only by the cell that contains it.
struct Anchor {
  Frame frame;
  uint16_t kind = 0, name = 0;  ///< indices in Program::names
  uint16_t tag = 0;
  PathKey key;

  friend bool operator==(const Anchor&, const Anchor&) = default;
};

/// A note about a shape that was left out, with the reason; the rest of the cell is complete.
struct DeriveNote {
  std::string message;
  /// derivation path of the activation, such as "net(0, 0, -1)/Node/Chamber[0]", in the format of overrides
  std::string path;
  int line = 0, column = 0;
};

/// Everything derived from one cell of one layer.
struct GrammarChunk {
  uint32_t layer = 0;
  Int3 cell;  ///< coordinates of the cell, counted in cells
  /// Bit set (parameterBit) of the parameters read by this cell and by the layers below it. Changing only other
  /// parameters does not change the result.
  uint64_t parameters = 0;
  std::pmr::vector<Shape> shapes;
  std::pmr::vector<uint32_t> children;
  std::pmr::vector<Expr> exprs;
  std::pmr::vector<NoiseSpec> noises;
  /// points of sweeps: world positions in units; points of prisms: local x and z in units
  std::pmr::vector<Int3> points;
  std::pmr::vector<VoxelBlock> blocks;
  std::pmr::vector<uint64_t> voxels;
  std::pmr::vector<Group> groups;
  std::pmr::vector<Anchor> anchors;
  std::pmr::vector<DeriveNote> notes;

  explicit GrammarChunk(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : shapes(memory),
        children(memory),
        exprs(memory),
        noises(memory),
        points(memory),
        blocks(memory),
        voxels(memory),
        groups(memory),
        anchors(memory),
        notes(memory) {}
};

// Each function lists the members of one struct, for all code that hashes or compares them. It destructures the struct,
// so that a new member does not compile until it is listed. References to other parts of the chunk are passed to
// separate visitor functions, which may process either the index or the content that it refers to.

template <class V>
void visitMembers(const Shape& shape, V& v) {
  const auto& [kind, material, tag, first_child, child_count, expr, first_point, point_count, block, detail, coarsest,
               amount, inner_radius, size, frame] = shape;
  v.labels(kind, material, tag);
  v.children(first_child, child_count);
  v.points(first_point, point_count);
  v.expr(expr);
  v.value(detail);
  v.value(coarsest);
  v.value(amount);
  v.value(inner_radius);
  for (const float edge : size) v.value(edge);
  v.value(frame);
  v.block(block);
}

template <class V>
void visitMembers(const Expr& node, V& v) {
  const auto& [op, a, b, c, value, anchor, row, noise, first_point, point_count] = node;
  v.value(uint64_t{static_cast<uint8_t>(op)});
  for (const uint32_t operand : {a, b, c}) v.operand(operand);
  v.value(value);
  v.value(anchor);
  for (const float part : row) v.value(part);
  v.noise(noise);
  v.points(first_point, point_count);
}

template <class V>
void visitMembers(const NoiseSpec& spec, V& v) {
  const auto& [origin, period, octaves, seed] = spec;
  v.value(origin);
  v.value(period);
  v.value(uint64_t{octaves} | uint64_t{seed} << 32);
}

/// Does not visit first_word, which depends on the order in memory; the voxels are visited separately.
template <class V>
void visitMembers(const VoxelBlock& block, V& v) {
  const auto& [anchor, edge, first, count, first_word] = block;
  v.value(anchor);
  v.value(edge);
  v.value(first);
  v.value(count);
}

template <class V>
void visitMembers(const Anchor& anchor, V& v) {
  const auto& [frame, kind, name, tag, key] = anchor;
  v.value(frame);
  v.names(kind, name, tag);
  v.key(key);
}

}  // namespace sgm
