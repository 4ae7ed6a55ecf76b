#pragma once
// The signatures of all built-in functions, values and primitives. The tables are in builtins.cpp.

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "grammar/syntax/units.h"

namespace sgm {

/// The values that the language defines.
enum class BuiltinValue : uint8_t {
  cell,  ///< the cell that is being derived; only in rules
  /// vector: edge lengths of the scope's box; only in rules; at the start of a start rule: the edges of the layer's
  /// cell, or of the domain's box
  scope,
  p,  ///< only at sample time: the sample's position in the world, in metres
  q,  ///< only at sample time: the sample's position in the scope of the statement that uses the field, in metres
  u,  ///< only at sample time: the position along the tube or beam to which the field is applied, from 0 at its start
      ///< to 1 at its end
};

/// Built-in functions. Positions are relative to the scope with which the rule starts. The start rule of a layer starts
/// with the world's axes at the low corner of its cell; on axes along which the domain has no cells: at 0.
enum class Builtin : uint8_t {
  min,    ///< (a, b); any stage
  max,    ///< (a, b)
  abs,    ///< (a)
  floor,  ///< (a) ratio
  ceil,   ///< (a): a ratio that is known at derivation time
  sqrt,   ///< (a): the exponents of the dimension are halved
  mix,    ///< (a, b, t)
  clamp,  ///< (a, low, high)
  /// (low, high, x): 0 at low, 1 at high, also if low > high; low and high must be known at derivation time
  smoothstep,
  fract,   ///< (a) ratio: a - floor(a)
  sin,     ///< (angle), known at derivation time
  cos,     ///< (angle), known at derivation time
  atan2,   ///< (y, x), known at derivation time; returns an angle
  pow,     ///< (a, b): ratios known at derivation time, a >= 0
  length,  ///< (vector), known at derivation time
  rand,    ///< (a, b): a random number in [a, b), drawn at derivation time from the derivation path's hash
  /// rand(key, a, b): a random number that depends only on the key (a cell, a face, a segment or a number), so it is
  /// the same everywhere
  rand_keyed,
  chance,        ///< (p): true with probability p, drawn from the derivation path's hash
  chance_keyed,  ///< chance(key, p)
  /// cellnoise(cell, period, salt = 0): smooth noise in 0..1 at the centre of the cell, known at derivation time
  cell_noise,
  /// (period, octaves = 1, salt = 0): fractal gradient noise of p in -1..1, known at sample time. Its arguments must be
  /// known at derivation time; period is rounded to units; octaves 1..12
  fractal,
  /// cell.point(jitter = 0.5): a random point of the cell; with jitter 0 the cell's centre, with jitter 1 any point of
  /// the cell. bound[0] is the cell.
  cell_point,
  /// cell.links(tree = 3, extra = 0): the faces of the cell that a passage crosses (Lattice::linked). Only the lower of
  /// a face's two cells returns it, so that a link is derived once
  cell_links,
  /// face.point(jitter = 0.5): a random point of the face. In a let the receiver may be a cell in one call and a face
  /// in another: test the value's kind, not this enumerator
  face_point,
  position,  ///< vec(x, y, z), the same as (x, y, z)
  /// branch(n, step, turn, fork = 0): the segments of a branching skeleton that grows from the scope's origin along +y;
  /// depends on the derivation path; rules only. See derive/layout/skeleton.h
  branch,
};

/// The maximum number of segments of one branch(); further side branches are left out.
inline constexpr uint32_t kMaxSegments = 4096;

/// Leaf shapes. Centred on the scope's origin, with axis y, unless specified otherwise.
enum class Primitive : uint8_t {
  sphere,     ///< (r)
  box,        ///< (x, y, z) full edges, or (edge), or (vector), such as box(scope)
  cylinder,   ///< (r, h): h is the full height
  truncone,   ///< (h, top, bottom): radii at +h/2 and -h/2
  capsule,    ///< (a, b, r): from point a to point b
  torus,      ///< (ring, tube): radii
  ellipsoid,  ///< (x, y, z): radii, or (vector)
  superq,     ///< (radii vector, square): square 0 an ellipsoid, 1 nearly a box (the exponent is 2 / (1 - square +
              ///< square * 2 / kMaxPower))
  blob,       ///< (r): a sphere; the usual leaf of `sum`
  halfspace,  ///< (below h): all points with y < h; (above h): all points with y > h
  tube,       ///< (a, b, r, bend = 0): round section from a to b along an arc with a sagitta of at most bend
  beam,       ///< (a, b, r, bend = 0): like tube, with a square section of half edge r
  prism,      ///< (h, (x, z), (x, z), (x, z) ...): polygon of 3 to 64 corners, extruded to full height h
  ca,         ///< (voxel, fill = 45%, rounds = 4, threshold = 50%, radius = 1, salt = 0): a cellular automaton over all
              ///< voxels of the world; the shape is its part in the layer's cell; see AutomatonLimits
};

/// The cellular automaton `ca` (Johnson, Yannakakis, Togelius 2010, in 3D). A voxel starts solid with probability
/// `fill`. In each round all voxels change at once: a voxel becomes solid if at least the fraction `threshold` of its
/// neighbourhood, itself included, is solid. The neighbourhood is a cube of 2 radius + 1 voxels per edge, flat along
/// axes on which the layer has no cells, where all voxels are equal. The same arguments give the same voxels in every
/// cell, rule and layer, so that neighbouring cells join without a seam; if arguments differ between cells, voxels end
/// at the cell's face. The field's absolute value is at most 7/8 of a voxel's edge, so a larger displacement makes
/// everything solid or void. Levels whose cell edge exceeds `coarsest_voxels` voxels omit the shape.
struct AutomatonLimits {
  static constexpr int32_t least_edge = 16;  ///< minimum edge of a voxel, in units
  static constexpr int32_t max_voxels = 64;  ///< maximum number of voxels along a cell's edge; the minimum is 1
  static constexpr int32_t max_rounds = 16;  ///< maximum number of rounds; the minimum is 0
  static constexpr int32_t max_radius = 4;   ///< maximum radius of the neighbourhood in voxels; the minimum is 1
  /// maximum of rounds times radius: how far a voxel influences others, in voxels
  static constexpr int32_t max_halo = 16;
  static constexpr int32_t coarsest_voxels = 4;

  /// The largest cell edge of a level that shows voxels with this edge; both in units.
  static constexpr int32_t coarsestCell(int32_t edge) {
    return edge > std::numeric_limits<int32_t>::max() / coarsest_voxels ? std::numeric_limits<int32_t>::max()
                                                                        : edge * coarsest_voxels;
  }
};

/// One parameter of a builtin or a primitive.
struct BuiltinParam {
  std::string_view name;
  ValueKind kind;
  Dim dim;
  /// accepts numbers of any dimension; the first such argument determines the dimension of all any_dim parameters
  bool any_dim = false;
  bool required = true;
  double fallback = 0;      ///< the value used if the argument is omitted
  bool named_only = false;  ///< the argument must be written as `name value`
  bool derive_only = true;  ///< the argument must be known at derivation time
};

struct BuiltinInfo {
  std::string_view name;
  Builtin id;
  std::span<const BuiltinParam> params;  ///< the parameters, without the receiver of a method
};

struct PrimitiveInfo {
  std::string_view name;
  Primitive id;
  std::span<const BuiltinParam> params;
  bool variadic = false;  ///< further arguments may follow; only prism: more corners
};

/// The valid range of a number, with texts for messages.
struct ValueRange {
  double low, high;
  std::string_view rule;     ///< the requirement, for messages: "the `step` of a branch must be positive"
  std::string_view example;  ///< a valid example, for hints: "such as step 6m"
  bool holds(double value) const { return value >= low && value <= high; }
};

std::span<const BuiltinInfo> builtinTable();      ///< all built-in functions, indexed by Builtin
std::span<const PrimitiveInfo> primitiveTable();  ///< all primitives, indexed by Primitive
std::span<const ValueRange> branchRangeTable();   ///< valid ranges of branch()'s parameters, in their order
// ExprNode::bound has one entry for each of these parameters (preceded by the receiver for a method). Exceptions: box
// and ellipsoid with one argument set only bound[0], an edge or a vector (box(edge) is a cube); bound[1] and bound[2]
// are kNoId. halfspace sets exactly one of bound[0], `below`, and bound[1], `above`. prism: further corners follow the
// first three.

/// Returns nullptr if there is no such function. For rand and chance, returns the form without a key.
const BuiltinInfo* findBuiltin(std::string_view name);
const PrimitiveInfo* findPrimitive(std::string_view name);
/// True if `word -2m`, written as an argument of `callee` (a builtin, a primitive or `at`), passes the value -2m to the
/// parameter `word`. Otherwise it is the subtraction of 2m from `word`.
bool namesArgument(std::string_view callee, std::string_view word);

}  // namespace sgm
