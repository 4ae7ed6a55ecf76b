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
  sphere,           ///< size: r
  box,              ///< size: half extents x y z
  cylinder,         ///< axis y, centre at origin; size: r, half height
  truncone,         ///< axis y, centre at origin; size: bottom radius, top radius, half height
  capsule,          ///< from the origin to origin + size[1..3] (in world axes); size[0]: r. Frame::rows is unused
  torus,            ///< axis y; size: ring radius, tube radius
  ellipsoid,        ///< size: radii x y z; field (|q/radii| - 1) * min(radii)
  superquadric,     ///< size: radii x y z, exponent n >= 2 (no unit); field (||q/radii||_n - 1) * min(radii)
  halfspace,        ///< solid below the plane local y = 0
  prism,            ///< polygon in local xz, counter-clockwise seen from +y, extruded along y; size: half height
  unite,            ///< hard union of the children
  meet,             ///< hard intersection of the children
  subtract,         ///< the first child minus all others
  unite_smooth,     ///< round union, radius `amount` units: max(k, min d) - sqrt(sum max(k - d, 0)^2)
  meet_smooth,      ///< round intersection, as unite_smooth of the negated children
  subtract_smooth,  ///< the first child minus the others, rounded by `amount`
  sum,              ///< compact-kernel sum over leaves d with inner radius r (Shape::inner_radius):
        ///< (T - sum max(0, 1 - (1 + d/r)^2 / kSumSupport^2)^3) * L, T = the kernel at d = 0, so that a lone leaf keeps
        ///< its surface; L = the largest inner radius / the kernel's slope there. Zero set grows at most to the support
  morph,        ///< two children A and B: (1 - t) A + t B; t = `expr`, or `amount` if expr is kNone; clamped to 0..1
  morph_power,  ///< no child; superquadric of radii size[0..2] at t = 0 to size[3..5] at t = 1, its exponent
                ///< 2 / (1 - t + t/kMaxPower*2): from ellipsoid to box by the exponent
  displace,     ///< one child, plus 1024 * expr (expr in metres)
  warp,         ///< one child, read at p + round(1024 * (expr, expr + 1, expr + 2)) (each in metres)
  voxels,       ///< no child; size: half extents x y z, upright; max(samples of `block` (field/voxels.h), that box)
};

inline constexpr float kSumSupport = 1.6f;  ///< support of the sum's kernel as a multiple of the inner radius
inline constexpr float kMaxPower = 20.0f;   ///< exponent of the superquadric at squareness 1

struct Shape {
  ShapeKind kind = ShapeKind::sphere;
  /// index into the grammar's materials; 0: inherits the material of the solid (for a cut), or the default
  uint16_t material = 0;
  uint16_t tag = 0;                           ///< index into the grammar's tags; 0: none
  uint32_t first_child = 0, child_count = 0;  ///< range in GrammarChunk::children
  uint32_t expr = kNone;                      ///< root in GrammarChunk::exprs
  /// Range in GrammarChunk::points. A prism: its corners. A sweep (one shape, or the union of its pieces): the polyline
  /// that it follows, used only for texture coordinates.
  uint32_t first_point = 0, point_count = 0;
  uint32_t block = kNone;  ///< voxels: index in GrammarChunk::blocks
  int32_t detail = 0;      ///< the shape is dropped at levels whose cell edge is larger than this, in units; 0: never
  /// by `lod`: the shape is dropped at levels whose cell edge is smaller than this, in units; 0: never
  int32_t coarsest = 0;
  float amount = 0;             ///< radius of a smooth combiner in units, or t of a morph with constant t
  float inner_radius = 0;       ///< only for leaves in a sum, units
  std::array<float, 6> size{};  ///< by kind; for the union of a sweep's pieces: its radius, units
  Frame frame;
};

/// Expressions that the field evaluates per sample (`field ...`): a directed acyclic graph, children before parents.
/// Lengths are in metres; a comparison gives 0 or 1.
enum class ExprOp : uint8_t {
  constant,    ///< value
  coordinate,  ///< (row . float(p - anchor)) / 1024: the coordinate along any axis of the world or of a local frame
  noise,       ///< fractal gradient noise in -1..1, with the settings GrammarChunk::noises[Expr::noise]
  sweep,       ///< 0..1 along the polyline points[first_point .. first_point + point_count), at the nearest segment
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
  Int3 origin;  ///< position of a lattice corner, units
  /// lattice edge of the first octave in units, at least 1; each further octave halves it
  int32_t period = kUnitsPerMetre;
  uint32_t octaves = 1;  ///< 1..12; the field drops octaves whose period is shorter than two cells
  uint32_t seed = 0;
};

/// A box of voxels. Voxel i along an axis is centred at anchor + i * edge. Bit i of GrammarChunk::voxels, counted from
/// bit first_word * 64, is set if the block's i-th voxel (x fastest) is solid. Along an axis with a count of 0 all
/// voxels are equal.
struct VoxelBlock {
  Int3 anchor;       ///< units; common to all voxels of the world, so that neighbouring blocks share positions
  int32_t edge = 0;  ///< units
  Int3 first;        ///< index of the lowest voxel
  Int3 count;
  uint32_t first_word = 0;

  size_t size() const {
    size_t voxels = 1;
    for (int axis = 0; axis < 3; ++axis) voxels *= static_cast<size_t>(std::max(count[axis], 1));
    return voxels;
  }
  size_t words() const { return (size() + 63) / 64; }
};

/// The number of voxels that a block contains beyond its cell on every side: enough to determine the field wherever the
/// shape is evaluated, at every level (see field/voxels.h).
inline constexpr int32_t kVoxelMargin = 12;

/// A top-level shape. Groups are combined by hard min (add) or max (cut), each as a whole.
struct Group {
  uint32_t root = 0;  ///< in GrammarChunk::shapes
  bool cut = false;
  IntBox bounds;  ///< contains every point where the root shape's field is <= 0, at every level
  PathKey key;    ///< sorts the groups of a layer, so that their order does not depend on derivation
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
  std::string path;  ///< derivation path of the activation: "net(0, 0, -1)/Node/Chamber[0]", as in overrides
  int line = 0, column = 0;
};

/// Everything derived from one cell of one layer.
struct GrammarChunk {
  uint32_t layer = 0;
  Int3 cell;  ///< cell coordinates, in cells
  /// Bit set (parameterBit) of the parameters read by this cell and by the layers below it. Changing only other
  /// parameters does not change the result.
  uint64_t parameters = 0;
  std::pmr::vector<Shape> shapes;
  std::pmr::vector<uint32_t> children;
  std::pmr::vector<Expr> exprs;
  std::pmr::vector<NoiseSpec> noises;
  std::pmr::vector<Int3> points;  ///< sweep: positions in the world, units; prism: local coordinates in x and z, units
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

// Lists the members of each struct once, for all functions that hash or compare them. Each list destructures its
// struct, so that a new member does not compile until it is listed. References to other parts of the chunk are passed
// to visitor functions of their own, which may process either the index or the content that it refers to.

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

/// Without first_word: the block's voxels are visited separately.
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
