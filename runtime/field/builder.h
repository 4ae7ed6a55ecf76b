#pragma once
// Builds field programs, group by group. The only place that defines each op's parameter words and allocates registers.

#include <span>

#include "base/result.h"
#include "derive/shape.h"
#include "field/lattice.h"
#include "field/program.h"

namespace sgm {

/// A value of the group under construction.
struct Value {
  uint32_t id = kNone;
};

/// Not thread-safe. Lengths are in units unless noted; all numbers must be finite, and sizes positive. Primitives and
/// coordinates read the current place: the sample's position, or that of the innermost warp.
class ProgramBuilder {
 public:
  /// finest_cell in units, at least 1, sets the scale of Q; `solid` and `label` are those of the domain.
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
  /// Radii from (size[0..2]) at t = 0 to (size[3..5]) at t = 1.
  Value powerMorph(const Frame& frame, std::span<const float, 6> size, Value t, uint32_t label);
  Value halfspace(const Frame& frame, uint32_t label);
  /// Corners in local xz (x and z of each point, in units), counter-clockwise seen from +y, at least three.
  Value prism(const Frame& frame, float half_height, std::span<const Int3> corners, uint32_t label);

  /// One sample per point, in units, multiples of 1/1024. limit: a value of at least this magnitude counts as far
  /// (1e18).
  Value lattice(const SampleLattice& at, std::span<const float> samples, float limit, uint32_t label);

  /// Operands of a sum: the cheap ball, and any distance with its inner radius in units, greater than 0.
  Value blobWeight(Int3 centre, float radius, uint32_t label);
  Value kernelWeight(Value distance, float inner_radius);

  Value constant(float value);  ///< clamped to +-1e18
  /// row . (place - anchor), in metres; the row is dimensionless.
  Value coordinate(Int3 anchor, float row_x, float row_y, float row_z);
  /// Evaluates `octaves` of spec.octaves; the amplitude stays that of the whole sum.
  Value noise(const NoiseSpec& spec, uint32_t octaves);
  /// At least two points. 0 at the first, 1 at the last.
  Value sweep(std::span<const Int3> polyline);
  Value unary(Op op, Value a);                          ///< copy, negate, absolute, floor, square_root
  Value binary(Op op, Value a, Value b);                ///< add to divide, less, minimum, maximum, cut, displace
  Value ternary(Op op, Value a, Value b, Value c);      ///< mix and morph
  Value smoothstep(Value x, float lower, float upper);  ///< lower != upper; falling if upper < lower

  /// Round union and compact-kernel sum over any number of operands: begin, add each, end.
  /// Only the functions that add to an accumulator and end it may read it.
  struct Accumulator {
    Value nearest, sum;
    float k = 0;
  };
  Accumulator beginRound(float k);
  void addRound(const Accumulator& acc, Value d);
  Value endRound(const Accumulator& acc);
  Accumulator beginSum();
  /// weight: never negative, since pruning drops an operand that is nowhere above 0.
  void addSum(const Accumulator& acc, Value weight);
  /// threshold: the weight of the surface; length in units turns the dimensionless difference into a distance.
  Value endSum(const Accumulator& acc, float threshold, float length);

  /// Evaluates the following values at p + round(1024 (x, y, z)), metres, until popWarp().
  void pushWarp(Value x, Value y, Value z);
  void popWarp();

  /// Ends the group. Groups must be in order of layer, adds before cuts; a smooth one (a width in units, at most 2^20)
  /// must be the only one of its layer. Error: limit if it needs more registers or places than exist.
  Result<void> group(Value root, const IntBox& influence, uint32_t layer, bool cut, float smooth = 0);

  FieldProgram finish() { return std::move(program_); }

 private:
  struct Step {
    Op op;
    uint32_t dst = kNone, a = kNone, b = kNone, c = kNone;
    uint8_t place = 0;
    uint32_t params = 0;
  };

  uint32_t beginPrimitive(Int3 centre, uint32_t label);
  uint32_t beginFramed(const Frame& frame, uint32_t label);
  Value emit(Op op, uint32_t params, Value a = {}, Value b = {}, Value c = {});
  void put(float f);
  void put(int32_t i);
  void put(Int3 p);
  uint32_t mark() const { return static_cast<uint32_t>(program_.params.size()); }

  FieldProgram program_;
  std::pmr::vector<Step> steps_;
  uint32_t next_value_ = 0;
  uint8_t place_ = 0;
  bool too_deep_ = false;
};

}  // namespace sgm
