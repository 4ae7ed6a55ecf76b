#include "field/builder.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sgm {

namespace {

float reciprocal(double x) { return static_cast<float>(std::clamp(1.0 / x, -1e18, 1e18)); }

}  // namespace

ProgramBuilder::ProgramBuilder(int32_t finest_cell, bool solid, uint32_t label, std::pmr::memory_resource* memory)
    : program_(memory), steps_(memory) {
  program_.initial = solid ? -kFar : kFar;
  program_.initial_label = label;
  program_.q_scale = quantiseScale(finest_cell);
}

// Writes a parameter word. Denormals become 0, because devices treat them differently (shaders/common/real.h,
// settleReal).
void ProgramBuilder::put(float f) {
  program_.params.push_back(std::bit_cast<uint32_t>(std::abs(f) < 1e-30f ? 0.0f : f));
}
void ProgramBuilder::put(int32_t i) { program_.params.push_back(static_cast<uint32_t>(i)); }
void ProgramBuilder::put(Int3 p) {
  put(p.x);
  put(p.y);
  put(p.z);
}

uint32_t ProgramBuilder::beginPrimitive(Int3 centre, uint32_t label) {
  const uint32_t at = mark();
  put(static_cast<int32_t>(label));
  put(centre);
  return at;
}

uint32_t ProgramBuilder::beginFramed(const Frame& frame, uint32_t label) {
  const uint32_t at = beginPrimitive(frame.origin, label);
  for (float r : frame.rows) put(r);
  return at;
}

Value ProgramBuilder::emit(Op op, uint32_t params, Value a, Value b, Value c) {
  const Value result{next_value_++};
  steps_.push_back({op, result.id, a.id, b.id, c.id, place_, params});
  return result;
}

Value ProgramBuilder::sphere(Int3 centre, float radius, uint32_t label) {
  const uint32_t at = beginPrimitive(centre, label);
  put(radius);
  return emit(Op::sphere, at);
}

Value ProgramBuilder::box(const Frame& frame, float half_x, float half_y, float half_z, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  put(half_x);
  put(half_y);
  put(half_z);
  return emit(Op::box, at);
}

Value ProgramBuilder::cylinder(const Frame& frame, float radius, float half_height, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  put(radius);
  put(half_height);
  return emit(Op::cylinder, at);
}

Value ProgramBuilder::truncone(const Frame& frame, float bottom, float top, float half_height, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  const double rise = 2.0 * double{half_height}, run = double{top} - double{bottom};
  const double slant = std::sqrt(rise * rise + run * run);
  put(bottom);
  put(top);
  put(half_height);
  put(static_cast<float>(rise / slant));
  put(static_cast<float>(-run / slant));
  put(static_cast<float>(slant));
  put(static_cast<float>(run / slant));
  put(static_cast<float>(rise / slant));
  return emit(Op::truncone, at);
}

Value ProgramBuilder::capsule(Int3 from, float axis_x, float axis_y, float axis_z, float radius, uint32_t label) {
  const uint32_t at = beginPrimitive(from, label);
  const double x = double{axis_x}, y = double{axis_y}, z = double{axis_z};
  const double squared = x * x + y * y + z * z;
  put(axis_x);
  put(axis_y);
  put(axis_z);
  put(squared > 0 ? reciprocal(squared) : 0.0f);
  put(radius);
  return emit(Op::capsule, at);
}

Value ProgramBuilder::torus(const Frame& frame, float ring, float tube, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  put(ring);
  put(tube);
  return emit(Op::torus, at);
}

Value ProgramBuilder::ellipsoid(const Frame& frame, float x, float y, float z, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  put(reciprocal(double{x}));
  put(reciprocal(double{y}));
  put(reciprocal(double{z}));
  put(std::min(x, std::min(y, z)));
  return emit(Op::ellipsoid, at);
}

Value ProgramBuilder::superquadric(const Frame& frame, float x, float y, float z, float exponent, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  put(reciprocal(double{x}));
  put(reciprocal(double{y}));
  put(reciprocal(double{z}));
  put(std::min(x, std::min(y, z)));
  put(exponent);
  return emit(Op::superquadric, at);
}

Value ProgramBuilder::powerMorph(const Frame& frame, std::span<const float, 6> size, Value t, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  for (float s : size) put(s);
  put(2.0f / kMaxPower);
  return emit(Op::power_morph, at, t);
}

Value ProgramBuilder::halfspace(const Frame& frame, uint32_t label) {
  return emit(Op::halfspace, beginFramed(frame, label));
}

Value ProgramBuilder::prism(const Frame& frame, float half_height, std::span<const Int3> corners, uint32_t label) {
  const uint32_t at = beginFramed(frame, label);
  put(half_height);
  put(static_cast<int32_t>(corners.size()));
  for (size_t i = 0; i < corners.size(); ++i) {
    const Int3 a = corners[i], b = corners[(i + 1) % corners.size()];
    const double x = double{static_cast<double>(b.x)} - a.x, z = double{static_cast<double>(b.z)} - a.z;
    const double squared = x * x + z * z;
    put(static_cast<float>(a.x));
    put(static_cast<float>(a.z));
    put(static_cast<float>(x));
    put(static_cast<float>(z));
    put(squared > 0 ? reciprocal(squared) : 0.0f);
    put(squared > 0 ? reciprocal(std::sqrt(squared)) : 0.0f);
  }
  return emit(Op::prism, at);
}

Value ProgramBuilder::lattice(const SampleLattice& at, std::span<const float> samples, float limit, uint32_t label) {
  const uint32_t params = beginPrimitive(at.origin, label);
  put(at.spacing);
  for (uint32_t count : at.count) put(static_cast<int32_t>(count));
  put(reciprocal(static_cast<double>(at.spacing)));
  put(limit);
  program_.params.reserve(program_.params.size() + samples.size());
  for (float sample : samples) put(sample);
  return emit(Op::lattice, params);
}

Value ProgramBuilder::blobWeight(Int3 centre, float radius, uint32_t label) {
  const uint32_t at = beginPrimitive(centre, label);
  const double support = double{radius} * double{kSumSupport};
  put(reciprocal(support * support));
  return emit(Op::blob, at);
}

Value ProgramBuilder::kernelWeight(Value distance, float inner_radius) {
  const uint32_t at = mark();
  put(reciprocal(double{inner_radius}));
  put(reciprocal(double{kSumSupport} * double{kSumSupport}));
  return emit(Op::kernel, at, distance);
}

Value ProgramBuilder::constant(float value) {
  const uint32_t at = mark();
  put(std::clamp(value, -1e18f, 1e18f));
  return emit(Op::constant, at);
}

Value ProgramBuilder::coordinate(Int3 anchor, float row_x, float row_y, float row_z) {
  const uint32_t at = beginPrimitive(anchor, 0);
  put(row_x / static_cast<float>(kUnitsPerMetre));
  put(row_y / static_cast<float>(kUnitsPerMetre));
  put(row_z / static_cast<float>(kUnitsPerMetre));
  return emit(Op::coordinate, at);
}

Value ProgramBuilder::noise(const NoiseSpec& spec, uint32_t octaves) {
  if (octaves == 0) return constant(0.0f);
  double whole = 0, gain = 1;
  for (uint32_t k = 0; k < spec.octaves; ++k, gain *= 0.5) whole += gain;
  const uint32_t at = mark();
  put(spec.origin);
  put(static_cast<int32_t>(octaves));
  put(static_cast<int32_t>(spec.seed));
  put(static_cast<float>(1.0 / whole));
  for (uint32_t k = 0; k < octaves; ++k) {
    const int32_t period = std::max(spec.period >> k, 1);
    put(period);
    put(reciprocal(period));
  }
  return emit(Op::noise, at);
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
  const uint32_t at = mark();
  put(static_cast<int32_t>(polyline.size() - 1));
  double before = 0;
  for (size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Int3 a = polyline[i], b = polyline[i + 1];
    const double own = length(i);
    put(a);
    put(static_cast<float>(int64_t{b.x} - a.x));
    put(static_cast<float>(int64_t{b.y} - a.y));
    put(static_cast<float>(int64_t{b.z} - a.z));
    put(own > 0 ? reciprocal(own * own) : 0.0f);
    put(whole > 0 ? static_cast<float>(before / whole) : 0.0f);
    put(whole > 0 ? static_cast<float>(own / whole) : 0.0f);
    before += own;
  }
  return emit(Op::sweep, at);
}

Value ProgramBuilder::unary(Op op, Value a) { return emit(op, 0, a); }
Value ProgramBuilder::binary(Op op, Value a, Value b) { return emit(op, 0, a, b); }
Value ProgramBuilder::ternary(Op op, Value a, Value b, Value c) { return emit(op, 0, a, b, c); }

Value ProgramBuilder::smoothstep(Value x, float lower, float upper) {
  const uint32_t at = mark();
  put(lower);
  put(reciprocal(double{upper} - double{lower}));
  return emit(Op::smoothstep, at, x);
}

ProgramBuilder::Accumulator ProgramBuilder::beginRound(float k) {
  const Value sum{next_value_++};
  return {emit(Op::round_begin, 0, {}, sum), sum, k};
}

void ProgramBuilder::addRound(const Accumulator& acc, Value d) {
  const uint32_t at = mark();
  put(acc.k);
  steps_.push_back({Op::round_add, acc.nearest.id, d.id, acc.sum.id, kNone, place_, at});
}

Value ProgramBuilder::endRound(const Accumulator& acc) {
  const uint32_t at = mark();
  put(acc.k);
  return emit(Op::round_end, at, acc.nearest, acc.sum);
}

ProgramBuilder::Accumulator ProgramBuilder::beginSum() {
  const Value sum{next_value_++};
  return {emit(Op::sum_begin, 0, {}, sum), sum, 0};
}

void ProgramBuilder::addSum(const Accumulator& acc, Value weight) {
  steps_.push_back({Op::sum_add, acc.nearest.id, weight.id, acc.sum.id, kNone, place_, 0});
}

Value ProgramBuilder::endSum(const Accumulator& acc, float threshold, float length) {
  const uint32_t at = mark();
  put(threshold);
  put(length);
  return emit(Op::sum_end, at, acc.nearest, acc.sum);
}

void ProgramBuilder::pushWarp(Value x, Value y, Value z) {
  if (place_ + 1 >= kMaxPlaces) {
    too_deep_ = true;
    return;
  }
  const uint32_t to = place_ + 1u;
  steps_.push_back({Op::warp, to, x.id, y.id, z.id, place_, 0});
  place_ = static_cast<uint8_t>(to);
}

void ProgramBuilder::popWarp() { --place_; }

Result<void> ProgramBuilder::group(Value root, const IntBox& influence, uint32_t layer, bool cut, float smooth) {
  std::pmr::vector<uint32_t> last_use(next_value_, 0, steps_.get_allocator());
  std::pmr::vector<uint8_t> home(next_value_, kMaxRegisters, steps_.get_allocator());
  auto use = [&](uint32_t id, size_t at) {
    if (id != kNone) last_use[id] = static_cast<uint32_t>(at);
  };
  for (size_t i = 0; i < steps_.size(); ++i) {
    const Step& s = steps_[i];
    use(s.a, i);
    use(s.b, i);
    use(s.c, i);
    if (s.op != Op::warp) use(s.dst, i);
  }
  last_use[root.id] = static_cast<uint32_t>(steps_.size());

  uint32_t free_registers = kMaxRegisters == 32 ? 0xFFFFFFFFu : (1u << kMaxRegisters) - 1;
  bool short_of_registers = too_deep_;
  auto release = [&](uint32_t id, size_t at) {
    if (id != kNone && last_use[id] == at && home[id] < kMaxRegisters) free_registers |= 1u << home[id];
  };
  auto settle = [&](uint32_t id) {
    if (id == kNone || home[id] < kMaxRegisters) return;
    if (free_registers == 0) {
      short_of_registers = true;
      home[id] = 0;
      return;
    }
    home[id] = static_cast<uint8_t>(std::countr_zero(free_registers));
    free_registers &= free_registers - 1;
  };
  auto of = [&](uint32_t id) { return id == kNone ? uint8_t{0} : home[id]; };

  const uint32_t first = static_cast<uint32_t>(program_.instrs.size());
  for (size_t i = 0; i < steps_.size(); ++i) {
    const Step& s = steps_[i];
    const bool begins = s.op == Op::round_begin || s.op == Op::sum_begin;
    Instr in{s.op, 0, of(s.a), 0, of(s.c), s.place, 0, s.params};
    if (begins) settle(s.b);
    in.b = of(s.b);
    // Operands that are not used later release their register first, so that the result can reuse it in place.
    release(s.a, i);
    if (!begins) release(s.b, i);
    release(s.c, i);
    if (s.op == Op::warp) {
      in.dst = static_cast<uint8_t>(s.dst);
    } else {
      settle(s.dst);
      in.dst = of(s.dst);
      release(s.dst, i);
    }
    program_.instrs.push_back(in);
  }
  const uint32_t count = static_cast<uint32_t>(steps_.size());
  const uint8_t result = of(root.id);
  steps_.clear();
  next_value_ = 0;
  place_ = 0;
  too_deep_ = false;
  if (short_of_registers) {
    program_.instrs.resize(first);
    return Error{Code::limit, "a shape is nested too deeply for a field program; split it into shallower rules"};
  }
  program_.groups.push_back({influence, first, count, layer, result, cut, true, smooth});
  return {};
}

}  // namespace sgm
