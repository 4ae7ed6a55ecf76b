#pragma once
// Builds field programs, group by group. Only this class defines the parameter words of each op and allocates
// registers.

#include <span>

#include "base/result.h"
#include "derive/shape.h"
#include "field/lattice.h"
#include "field/op_sequence.h"
#include "field/parameter_writer.h"
#include "field/program.h"

namespace sgm {

/// Contains the program of the completed groups, and the ops of the group under construction. Not thread-safe. Lengths
/// are in units unless noted; all numbers must be finite, and sizes positive. Primitives and coordinates read the
/// current place: the sample's position, or the result of the innermost warp (pushWarp).
class ProgramBuilder {
 public:
  /// finest_cell: in units, at least 1; sets the scale of the quantised samples Q. solid, label: content and label of
  /// the domain, where no shape is.
  ProgramBuilder(int32_t finest_cell, bool solid, uint32_t label,
                 std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  Value sphere(Int3 centre, float radius, uint32_t label);
  Value box(const Frame& frame, float half_x, float half_y, float half_z, uint32_t label);
  Value cylinder(const Frame& frame, float radius, float half_height, uint32_t label);
  Value truncone(const Frame& frame, float bottom, float top, float half_height, uint32_t label);
  Value capsule(Int3 from, float axis_x, float axis_y, float axis_z, float radius, uint32_t label);
  Value torus(const Frame& frame, float ring, float tube, uint32_t label);
  Value ellipsoid(const Frame& frame, float x, float y, float z, uint32_t label);
  Value superquadric(const Frame& frame, float x, float y, float z, float exponent, uint32_t label);
  /// A superquadric that changes with t. At t = 0, it is an ellipsoid with the radii size[0..2]; at t = 1, nearly a box
  /// with the half edges size[3..5]. t is clamped to 0..1.
  Value powerMorph(const Frame& frame, std::span<const float, 6> size, Value t, uint32_t label);
  Value halfspace(const Frame& frame, uint32_t label);
  /// A prism. corners: x and z of the corners of its base, at least three, in local units, counter-clockwise seen from
  /// +y.
  Value prism(const Frame& frame, float half_height, std::span<const Int3> corners, uint32_t label);

  /// Interpolates a lattice of samples. samples: one per point, in units, multiples of 1/1024. limit: a value of at
  /// least this magnitude becomes the far value (1e18) of its sign.
  Value lattice(const SampleLattice& at, std::span<const float> samples, float limit, uint32_t label);

  /// Both functions return an operand of a kernel sum: blobWeight() for a ball, which is cheap to evaluate;
  /// kernelWeight() for any shape, given its distance and its inner radius. Radii are in units and above 0.
  Value blobWeight(Int3 centre, float radius, uint32_t label);
  Value kernelWeight(Value distance, float inner_radius);

  Value constant(float value);  ///< clamped to +-1e18
  /// Returns row . (place - anchor), in metres; the row is dimensionless.
  Value coordinate(Int3 anchor, float row_x, float row_y, float row_z);
  /// Evaluates the first `octaves` octaves of a noise. The amplitude is normalised as if all spec.octaves octaves were
  /// evaluated.
  Value noise(const NoiseSpec& spec, uint32_t octaves);
  /// Returns the parameter of the nearest point on a polyline of at least two points: 0 at the first point, 1 at the
  /// last.
  Value sweep(std::span<const Int3> polyline);
  Value unary(Op op, Value a);  ///< op: one of copy, negate, absolute, floor, square_root
  /// op: one of add, subtract, multiply, divide, less, minimum, maximum, cut, displace
  Value binary(Op op, Value a, Value b);
  Value ternary(Op op, Value a, Value b, Value c);      ///< op: one of mix, morph
  Value smoothstep(Value x, float lower, float upper);  ///< lower != upper; the result falls with x if upper < lower

  /// Makes all following ops, until popWarp(), read the position p + round(1024 (x, y, z)). p: the current place; x, y,
  /// z: in metres.
  void pushWarp(Value x, Value y, Value z) { ops_.pushWarp(x, y, z); }
  void popWarp() { ops_.popWarp(); }

  /// Ends the group. Groups must be emitted in the order of their layers; within a layer, first the groups that add,
  /// then the groups that cut. A smooth group must be the only one of its layer. smooth: width of the blend in units,
  /// at most 2^20; 0: none. Error: limit if the group needs more registers or places than exist.
  Result<void> group(Value root, const IntBox& influence, uint32_t layer, bool cut, float smooth = 0);

  FieldProgram finish() { return std::move(program_); }

 private:
  friend class RoundUnion;
  friend class KernelSum;

  ParameterWriter words() { return ParameterWriter(program_.params); }

  FieldProgram program_;
  OpSequence ops_;
};

/// Accumulates a round union over any number of operands, in two values. No other functions may read these values. The
/// builder must outlive the union, and the union must end within its group.
class RoundUnion {
 public:
  /// k: the radius of the rounding in units.
  RoundUnion(ProgramBuilder& builder, float k);
  void add(Value d);
  Value end();

 private:
  ProgramBuilder* builder_;
  float k_;
  Value sum_, nearest_;
};

/// Accumulates a sum with a compact kernel over any number of operands, in two values. The same rules as for RoundUnion
/// apply.
class KernelSum {
 public:
  explicit KernelSum(ProgramBuilder& builder);
  /// weight: never negative, because pruning drops an operand whose weight is nowhere above 0.
  void add(Value weight);
  /// threshold: the sum of weights at the surface. length: the factor in units that turns the dimensionless difference
  /// from the threshold into a distance.
  Value end(float threshold, float length);

 private:
  ProgramBuilder* builder_;
  Value sum_, nearest_;
};

}  // namespace sgm
