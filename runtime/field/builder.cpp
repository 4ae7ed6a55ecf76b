#include "field/builder.h"

#include <algorithm>
#include <cmath>

namespace sgm {

namespace {

float reciprocal(double x) { return static_cast<float>(std::clamp(1.0 / x, -1e18, 1e18)); }

ParameterWriter beginPrimitive(ParameterWriter out, Int3 centre, uint32_t label) {
  out.put(static_cast<int32_t>(label));
  out.put(centre);
  return out;
}

ParameterWriter beginFramed(const ParameterWriter& out, const Frame& frame, uint32_t label) {
  ParameterWriter rows = beginPrimitive(out, frame.origin, label);
  for (float r : frame.rows) rows.put(r);
  return rows;
}

}  // namespace

ProgramBuilder::ProgramBuilder(int32_t finest_cell, bool solid, uint32_t label, std::pmr::memory_resource* memory)
    : program_(memory), ops_(memory) {
  program_.initial = solid ? -kFar : kFar;
  program_.initial_label = label;
  program_.q_scale = quantiseScale(finest_cell);
}

Value ProgramBuilder::sphere(Int3 centre, float radius, uint32_t label) {
  ParameterWriter out = beginPrimitive(words(), centre, label);
  out.put(radius);
  return ops_.emit(Op::sphere, out.first());
}

Value ProgramBuilder::box(const Frame& frame, float half_x, float half_y, float half_z, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  out.put(half_x);
  out.put(half_y);
  out.put(half_z);
  return ops_.emit(Op::box, out.first());
}

Value ProgramBuilder::cylinder(const Frame& frame, float radius, float half_height, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  out.put(radius);
  out.put(half_height);
  return ops_.emit(Op::cylinder, out.first());
}

Value ProgramBuilder::truncone(const Frame& frame, float bottom, float top, float half_height, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  const double rise = 2.0 * double{half_height}, run = double{top} - double{bottom};
  const double slant = std::sqrt(rise * rise + run * run);
  out.put(bottom);
  out.put(top);
  out.put(half_height);
  out.put(static_cast<float>(rise / slant));
  out.put(static_cast<float>(-run / slant));
  out.put(static_cast<float>(slant));
  out.put(static_cast<float>(run / slant));
  out.put(static_cast<float>(rise / slant));
  return ops_.emit(Op::truncone, out.first());
}

Value ProgramBuilder::capsule(Int3 from, float axis_x, float axis_y, float axis_z, float radius, uint32_t label) {
  ParameterWriter out = beginPrimitive(words(), from, label);
  const double x = double{axis_x}, y = double{axis_y}, z = double{axis_z};
  const double squared = x * x + y * y + z * z;
  out.put(axis_x);
  out.put(axis_y);
  out.put(axis_z);
  out.put(squared > 0 ? reciprocal(squared) : 0.0f);
  out.put(radius);
  return ops_.emit(Op::capsule, out.first());
}

Value ProgramBuilder::torus(const Frame& frame, float ring, float tube, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  out.put(ring);
  out.put(tube);
  return ops_.emit(Op::torus, out.first());
}

Value ProgramBuilder::ellipsoid(const Frame& frame, float x, float y, float z, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  out.put(reciprocal(double{x}));
  out.put(reciprocal(double{y}));
  out.put(reciprocal(double{z}));
  out.put(std::min(x, std::min(y, z)));
  return ops_.emit(Op::ellipsoid, out.first());
}

Value ProgramBuilder::superquadric(const Frame& frame, float x, float y, float z, float exponent, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  out.put(reciprocal(double{x}));
  out.put(reciprocal(double{y}));
  out.put(reciprocal(double{z}));
  out.put(std::min(x, std::min(y, z)));
  out.put(exponent);
  return ops_.emit(Op::superquadric, out.first());
}

Value ProgramBuilder::powerMorph(const Frame& frame, std::span<const float, 6> size, Value t, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  for (float s : size) out.put(s);
  out.put(2.0f / kMaxPower);
  return ops_.emit(Op::power_morph, out.first(), t);
}

Value ProgramBuilder::halfspace(const Frame& frame, uint32_t label) {
  return ops_.emit(Op::halfspace, beginFramed(words(), frame, label).first());
}

Value ProgramBuilder::prism(const Frame& frame, float half_height, std::span<const Int3> corners, uint32_t label) {
  ParameterWriter out = beginFramed(words(), frame, label);
  out.put(half_height);
  out.put(static_cast<int32_t>(corners.size()));
  for (size_t i = 0; i < corners.size(); ++i) {
    const Int3 a = corners[i], b = corners[(i + 1) % corners.size()];
    const double x = double{static_cast<double>(b.x)} - a.x, z = double{static_cast<double>(b.z)} - a.z;
    const double squared = x * x + z * z;
    out.put(static_cast<float>(a.x));
    out.put(static_cast<float>(a.z));
    out.put(static_cast<float>(x));
    out.put(static_cast<float>(z));
    out.put(squared > 0 ? reciprocal(squared) : 0.0f);
    out.put(squared > 0 ? reciprocal(std::sqrt(squared)) : 0.0f);
  }
  return ops_.emit(Op::prism, out.first());
}

Value ProgramBuilder::lattice(const SampleLattice& at, std::span<const float> samples, float limit, uint32_t label) {
  ParameterWriter out = beginPrimitive(words(), at.origin, label);
  out.put(at.spacing);
  for (uint32_t count : at.count) out.put(static_cast<int32_t>(count));
  out.put(reciprocal(static_cast<double>(at.spacing)));
  out.put(limit);
  program_.params.reserve(program_.params.size() + samples.size());
  for (float sample : samples) out.put(sample);
  return ops_.emit(Op::lattice, out.first());
}

Value ProgramBuilder::blobWeight(Int3 centre, float radius, uint32_t label) {
  ParameterWriter out = beginPrimitive(words(), centre, label);
  const double support = double{radius} * double{kSumSupport};
  out.put(reciprocal(support * support));
  return ops_.emit(Op::blob, out.first());
}

Value ProgramBuilder::kernelWeight(Value distance, float inner_radius) {
  ParameterWriter out = words();
  out.put(reciprocal(double{inner_radius}));
  out.put(reciprocal(double{kSumSupport} * double{kSumSupport}));
  return ops_.emit(Op::kernel, out.first(), distance);
}

Value ProgramBuilder::constant(float value) {
  ParameterWriter out = words();
  out.put(std::clamp(value, -1e18f, 1e18f));
  return ops_.emit(Op::constant, out.first());
}

Value ProgramBuilder::coordinate(Int3 anchor, float row_x, float row_y, float row_z) {
  ParameterWriter out = beginPrimitive(words(), anchor, 0);
  out.put(row_x / static_cast<float>(kUnitsPerMetre));
  out.put(row_y / static_cast<float>(kUnitsPerMetre));
  out.put(row_z / static_cast<float>(kUnitsPerMetre));
  return ops_.emit(Op::coordinate, out.first());
}

Value ProgramBuilder::noise(const NoiseSpec& spec, uint32_t octaves) {
  if (octaves == 0) return constant(0.0f);
  double whole = 0, gain = 1;
  for (uint32_t k = 0; k < spec.octaves; ++k, gain *= 0.5) whole += gain;
  ParameterWriter out = words();
  out.put(spec.origin);
  out.put(static_cast<int32_t>(octaves));
  out.put(static_cast<int32_t>(spec.seed));
  out.put(static_cast<float>(1.0 / whole));
  for (uint32_t k = 0; k < octaves; ++k) {
    const int32_t period = std::max(spec.period >> k, 1);
    out.put(period);
    out.put(reciprocal(period));
  }
  return ops_.emit(Op::noise, out.first());
}

Value ProgramBuilder::sweep(std::span<const Int3> polyline) {
  double whole = 0;
  auto length = [&](size_t i) {
    const double x = double{static_cast<double>(polyline[i + 1].x)} - polyline[i].x;
    const double y = double{static_cast<double>(polyline[i + 1].y)} - polyline[i].y;
    const double z = double{static_cast<double>(polyline[i + 1].z)} - polyline[i].z;
    return std::sqrt(x * x + y * y + z * z);
  };
  for (size_t i = 0; i + 1 < polyline.size(); ++i) whole += length(i);
  ParameterWriter out = words();
  out.put(static_cast<int32_t>(polyline.size() - 1));
  double before = 0;
  for (size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Int3 a = polyline[i], b = polyline[i + 1];
    const double own = length(i);
    out.put(a);
    out.put(static_cast<float>(int64_t{b.x} - a.x));
    out.put(static_cast<float>(int64_t{b.y} - a.y));
    out.put(static_cast<float>(int64_t{b.z} - a.z));
    out.put(own > 0 ? reciprocal(own * own) : 0.0f);
    out.put(whole > 0 ? static_cast<float>(before / whole) : 0.0f);
    out.put(whole > 0 ? static_cast<float>(own / whole) : 0.0f);
    before += own;
  }
  return ops_.emit(Op::sweep, out.first());
}

Value ProgramBuilder::unary(Op op, Value a) { return ops_.emit(op, 0, a); }
Value ProgramBuilder::binary(Op op, Value a, Value b) { return ops_.emit(op, 0, a, b); }
Value ProgramBuilder::ternary(Op op, Value a, Value b, Value c) { return ops_.emit(op, 0, a, b, c); }

Value ProgramBuilder::smoothstep(Value x, float lower, float upper) {
  ParameterWriter out = words();
  out.put(lower);
  out.put(reciprocal(double{upper} - double{lower}));
  return ops_.emit(Op::smoothstep, out.first(), x);
}

Result<void> ProgramBuilder::group(Value root, const IntBox& influence, uint32_t layer, bool cut, float smooth) {
  const auto first = static_cast<uint32_t>(program_.instrs.size());
  const Result<uint8_t> result = ops_.moveTo(program_.instrs, root);
  if (!result) return result.error();
  const auto count = static_cast<uint32_t>(program_.instrs.size()) - first;
  program_.groups.push_back({influence, first, count, layer, *result, cut, true, smooth});
  return {};
}

RoundUnion::RoundUnion(ProgramBuilder& builder, float k)
    : builder_(&builder),
      k_(k),
      sum_(builder.ops_.reserve()),
      nearest_(builder.ops_.emit(Op::round_begin, 0, {}, sum_)) {}

void RoundUnion::add(Value d) {
  ParameterWriter out = builder_->words();
  out.put(k_);
  builder_->ops_.accumulate(Op::round_add, out.first(), nearest_, d, sum_);
}

Value RoundUnion::end() {
  ParameterWriter out = builder_->words();
  out.put(k_);
  return builder_->ops_.emit(Op::round_end, out.first(), nearest_, sum_);
}

KernelSum::KernelSum(ProgramBuilder& builder)
    : builder_(&builder), sum_(builder.ops_.reserve()), nearest_(builder.ops_.emit(Op::sum_begin, 0, {}, sum_)) {}

void KernelSum::add(Value weight) { builder_->ops_.accumulate(Op::sum_add, 0, nearest_, weight, sum_); }

Value KernelSum::end(float threshold, float length) {
  ParameterWriter out = builder_->words();
  out.put(threshold);
  out.put(length);
  return builder_->ops_.emit(Op::sum_end, out.first(), nearest_, sum_);
}

}  // namespace sgm
