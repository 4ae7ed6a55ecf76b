#pragma once
// The signatures of all built-in names. The tables are in builtins.cpp.

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "grammar/syntax/units.h"

namespace sgm {

/// Built-in values.
enum class BuiltinValue : uint8_t {
  cell,   ///< the cell being derived (rules only)
  scope,  ///< vector: edges of the scope's box (rules only); a rule starts with its layer's cell or the domain's box
  p,      ///< sample time: world position, metres
  q,      ///< sample time: position in the scope in which the field is used, metres
  u,      ///< sample time: 0..1 along the sweep (tube, beam) around it
};

/// Functions of values. Positions are in the scope with which the rule starts. A layer's start rule starts at the low
/// corner of its cell (on axes that the domain does not name: at 0), with the world's axes.
enum class Builtin : uint8_t {
  min,           ///< (a, b); any stage
  max,           ///< (a, b)
  abs,           ///< (a)
  floor,         ///< (a) ratio
  ceil,          ///< (a) ratio, derive time
  sqrt,          ///< (a): halves the dimension
  mix,           ///< (a, b, t)
  clamp,         ///< (a, low, high)
  smoothstep,    ///< (low, high, x): 0 at low, 1 at high; low and high derive time; low > high reverses it
  fract,         ///< (a) ratio: a - floor(a)
  sin,           ///< (angle), derive time
  cos,           ///< (angle), derive time
  atan2,         ///< (y, x) -> angle, derive time
  pow,           ///< (a, b) ratios, a >= 0, derive time
  length,        ///< (vector), derive time
  rand,          ///< (a, b): uniform in [a, b), by derivation path; derive time
  rand_keyed,    ///< rand(key, a, b): by the key alone (a cell, a face, a segment or a number), the same at every place
  chance,        ///< (p): true with probability p, by derivation path
  chance_keyed,  ///< chance(key, p)
  cell_noise,    ///< cellnoise(cell, period, salt = 0): smooth noise 0..1 at the centre of the cell; derive time
  fractal,       ///< (period, octaves = 1, salt = 0): fractal gradient noise of p in -1..1; sample time. The arguments
                 ///< are derive time; period is rounded to units; octaves 1..12
  cell_point,    ///< cell.point(jitter = 0.5): a point of the cell; 0 its centre, 1 anywhere in it. bound[0]: the cell
  cell_links,    ///< cell.links(tree = 3, extra = 0): faces crossed by a passage; each face by its lower cell only, so
                 ///< that a link is derived once; connected within blocks of 2^tree cells and between them
  face_point,    ///< face.point(jitter = 0.5): a point of the face. In a let the receiver may be a cell in one call and
                 ///< a face in another: decide by the value, not by the enumerator
  position,      ///< vec(x, y, z), the same as (x, y, z)
  branch,  ///< branch(n, step, turn, fork = 0): segments of a branching skeleton from the scope's origin along +y, by
           ///< derivation path; rules only. See derive/layout/skeleton.h
};

/// The most segments of one branch(): further side branches are omitted.
inline constexpr uint32_t kMostSegments = 4096;

/// Terminals. Centred on the scope's origin, axis y, unless said otherwise.
enum class Primitive : uint8_t {
  sphere,     ///< (r)
  box,        ///< (x, y, z) full edges, or (edge), or (vector), such as box(scope)
  cylinder,   ///< (r, h): h is the full height
  truncone,   ///< (h, top, bottom): radii at +h/2 and -h/2
  capsule,    ///< (a, b, r): from point a to point b
  torus,      ///< (ring, tube): radii
  ellipsoid,  ///< (x, y, z) radii, or (vector)
  superq,     ///< (radii vector, square): square 0 an ellipsoid, 1 nearly a box (exponent 2 / (1 - s + s*2/kMaxPower))
  blob,       ///< (r): a sphere; the usual leaf of `sum`
  halfspace,  ///< (below h) or (above h): y under (over) h
  tube,       ///< (a, b, r, bend = 0): round section from a to b along an arc with a sagitta of at most bend
  beam,       ///< (a, b, r, bend = 0): like tube, with a square section of half edge r
  prism,      ///< (h, (x, z), (x, z), (x, z) ...): polygon of 3 to 64 corners, extruded to full height h
  ca,         ///< (voxel, fill = 45%, rounds = 4, threshold = 50%, radius = 1, salt = 0): a cellular automaton over all
              ///< voxels of the world; the shape is its part in the layer's cell; see AutomatonLimits
};

/// A voxel starts solid with the probability `fill`. In each round all voxels change at once: a voxel becomes solid if
/// at least the share `threshold` of the voxels around it, itself included, is solid. These form a cube of 2 radius + 1
/// voxels along the axes that the layer is cut along; along other axes all voxels are alike. The same arguments give
/// the same voxels in every cell, rule and layer, so neighbours join without a seam; if arguments differ between cells,
/// voxels end at the face. The field never differs from 0 by more than 7/8 of a voxel: a larger displacement makes it
/// all solid or all void. Levels with cells larger than `coarsest_voxels` omit it. Johnson, Yannakakis, Togelius 2010.
struct AutomatonLimits {
  static constexpr int32_t least_edge = 16;   ///< of a voxel, units
  static constexpr int32_t most_voxels = 64;  ///< along a cell's edge; the fewest is one
  static constexpr int32_t most_rounds = 16;  ///< from 0
  static constexpr int32_t most_radius = 4;   ///< from 1
  static constexpr int32_t most_halo = 16;    ///< rounds times radius
  static constexpr int32_t coarsest_voxels = 4;

  /// The largest cell of a level at which voxels of this edge are visible; both in units.
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
  bool any_dim = false;  ///< numbers of any dimension; the first such argument determines it for all any_dim parameters
  bool required = true;
  double fallback = 0;      ///< the value if it is omitted
  bool named_only = false;  ///< must be written `name value`
  bool derive_only = true;  ///< a sample-time argument is an error
};

struct BuiltinInfo {
  std::string_view name;
  Builtin id;
  std::span<const BuiltinParam> params;  ///< without a method's receiver
};

struct PrimitiveInfo {
  std::string_view name;
  Primitive id;
  std::span<const BuiltinParam> params;
  bool variadic = false;  ///< prism: more pairs may follow
};

/// The valid range of a number.
struct ValueRange {
  double low, high;
  std::string_view rule;     ///< "the `step` of a branch must be positive"
  std::string_view example;  ///< "such as step 6m"
  bool holds(double value) const { return value >= low && value <= high; }
};

std::span<const BuiltinInfo> builtinTable();      ///< functions, by enumerator
std::span<const PrimitiveInfo> primitiveTable();  ///< by enumerator
std::span<const ValueRange> branchRangeTable();   ///< by parameter of branch()
// The binding of calls to these parameters: ExprNode::bound has one entry for each parameter (after the receiver of a
// method). box and ellipsoid with one argument: only bound[0] (an edge or a vector; box(edge) is a cube), bound[1] and
// bound[2] are kNoId. halfspace: bound[0] is `below`, bound[1] is `above`; exactly one of them is set. prism: further
// corners follow the first three.

/// nullptr if there is none. rand and chance give the form without a key.
const BuiltinInfo* findBuiltin(std::string_view name);
const PrimitiveInfo* findPrimitive(std::string_view name);
/// Whether `word -2m` in the arguments of a builtin or of `at` is a named argument, not a difference.
bool namesArgument(std::string_view callee, std::string_view word);

}  // namespace sgm
