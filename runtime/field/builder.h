#pragma once
// Builds field programs, group by group. The one place that knows each op's parameter words and that hands out
// registers.

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

/// Not thread-safe. Sizes are in units unless noted; they must be finite and positive where a size is meant.
/// Primitives and coordinates read the current place: the sample's position, or the innermost warp's.
class ProgramBuilder {
 public:
  /// finest_cell in units, at least 1, sets the scale of Q; `solid` and label are the domain's.
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

  /// One sample for each point, in units, whole 1024ths. limit: a value as large as it, or beyond, counts as far
  /// (1e18).
  Value lattice(const SampleLattice& at, std::span<const float> samples, float limit, uint32_t label);

  /// Operands of a sum: the cheap ball, and any distance with its inner radius in units, greater than 0.
  Value blobWeight(Int3 centre, float radius, uint32_t label);
  Value kernelWeight(Value distance, float inner_radius);

  Value constant(float value);  ///< held to +-1e18
  /// row . (place - anchor), in metres; the row has no unit.
  Value coordinate(Int3 anchor, float row_x, float row_y, float row_z);
  /// `octaves` of spec.octaves are evaluated; the amplitude stays that of the whole sum.
  Value noise(const NoiseSpec& spec, uint32_t octaves);
  /// At least two points. 0 at the first, 1 at the last.
  Value sweep(std::span<const Int3> polyline);
  Value unary(Op op, Value a);                          ///< copy, negate, absolute, floor, square_root
  Value binary(Op op, Value a, Value b);                ///< add to divide, less, minimum, maximum, cut, displace
  Value ternary(Op op, Value a, Value b, Value c);      ///< mix and morph
  Value smoothstep(Value x, float lower, float upper);  ///< lower != upper; falls where upper < lower

  /// Round union and compact-kernel sum over any number of operands: begin, add each, end.
  /// Read by what adds to it and ends it, and by nothing else.
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

  /// Reads what follows at p + round(1024 (x, y, z)), metres, until popWarp().
  void pushWarp(Value x, Value y, Value z);
  void popWarp();

  /// Ends the group. Groups must come in order of layer, adds before cuts; one that is smooth (a width in units, at
  /// most 2^20) must be the only one of its layer. limit: more registers or places than there are.
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
