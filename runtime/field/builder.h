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

/// The program of the groups so far, and the ops of the group under construction. Not thread-safe. Lengths are in units
/// unless noted; all numbers must be finite, and sizes positive. Primitives and coordinates read the current place, a
/// position: the sample's, or the result of the innermost warp (pushWarp).
class ProgramBuilder {
 public:
  /// finest_cell: in units, at least 1; sets the scale of the quantised samples Q. solid, label: of the domain, which
  /// has no shape.
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
  /// An ellipsoid of powers whose radii change from size[0..2] at t = 0 to size[3..5] at t = 1.
  Value powerMorph(const Frame& frame, std::span<const float, 6> size, Value t, uint32_t label);
  Value halfspace(const Frame& frame, uint32_t label);
  /// A prism with this base: x and z of at least three local corners, in units, counter-clockwise seen from +y.
  Value prism(const Frame& frame, float half_height, std::span<const Int3> corners, uint32_t label);

  /// Interpolates a lattice of samples. samples: one per point, in units, multiples of 1/1024. limit: a value of at
  /// least this magnitude becomes the far value (1e18) of its sign.
  Value lattice(const SampleLattice& at, std::span<const float> samples, float limit, uint32_t label);

  /// An operand of a sum: a ball, which is cheap, or any distance with its inner radius. Radii are in units and above
  /// 0.
  Value blobWeight(Int3 centre, float radius, uint32_t label);
  Value kernelWeight(Value distance, float inner_radius);

  Value constant(float value);  ///< clamped to +-1e18
  /// row . (place - anchor), in metres; the row is dimensionless.
  Value coordinate(Int3 anchor, float row_x, float row_y, float row_z);
  /// Evaluates the first `octaves` octaves of a noise; the amplitude stays normalised for all spec.octaves.
  Value noise(const NoiseSpec& spec, uint32_t octaves);
  /// The parameter along a polyline of at least two points: 0 at the first point, 1 at the last.
  Value sweep(std::span<const Int3> polyline);
  Value unary(Op op, Value a);                          ///< op: copy, negate, absolute, floor, square_root
  Value binary(Op op, Value a, Value b);                ///< op: add to divide, less, minimum, maximum, cut, displace
  Value ternary(Op op, Value a, Value b, Value c);      ///< op: mix, morph
  Value smoothstep(Value x, float lower, float upper);  ///< lower != upper; falling if upper < lower

  /// Evaluates the values that follow at the position p + round(1024 (x, y, z)), until popWarp(). p: the current place;
  /// x, y, z: in metres.
  void pushWarp(Value x, Value y, Value z) { ops_.pushWarp(x, y, z); }
  void popWarp() { ops_.popWarp(); }

  /// Ends the group. Groups must be emitted in order of layer, and adds before cuts within a layer; a smooth group must
  /// be the only one of its layer. smooth: width of the blend in units, at most 2^20; 0: none. Error: limit if the
  /// group needs more registers or places than exist.
  Result<void> group(Value root, const IntBox& influence, uint32_t layer, bool cut, float smooth = 0);

  FieldProgram finish() { return std::move(program_); }

 private:
  friend class RoundUnion;
  friend class KernelSum;

  ParameterWriter words() { return ParameterWriter(program_.params); }

  FieldProgram program_;
  OpSequence ops_;
};

/// A round union over any number of operands: the two values that accumulate them. No other functions may read these
/// values. The builder must outlive the union, and the union must end within its group.
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

/// A sum with a compact kernel over any number of operands: the two values that accumulate them, as in RoundUnion.
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
