#include "field/op_sequence.h"

#include <bit>

namespace sgm {

Value OpSequence::emit(Op op, uint32_t params, Value a, Value b, Value c) {
  const Value result = reserve();
  steps_.push_back({op, result.id, a.id, b.id, c.id, place_, params});
  return result;
}

void OpSequence::accumulate(Op op, uint32_t params, Value nearest, Value operand, Value sum) {
  steps_.push_back({op, nearest.id, operand.id, sum.id, kNone, place_, params});
}

void OpSequence::pushWarp(Value x, Value y, Value z) {
  if (place_ + 1 >= kMaxPlaces) {
    too_deep_ = true;
    return;
  }
  const uint32_t to = place_ + 1u;
  steps_.push_back({Op::warp, to, x.id, y.id, z.id, place_, 0});
  place_ = static_cast<uint8_t>(to);
}

Result<uint8_t> OpSequence::moveTo(std::pmr::vector<Instr>& instrs, Value root) {
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

  const size_t first = instrs.size();
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
    instrs.push_back(in);
  }
  const uint8_t result = of(root.id);
  steps_.clear();
  next_value_ = 0;
  place_ = 0;
  too_deep_ = false;
  if (short_of_registers) {
    instrs.resize(first);
    return Error{Code::limit, "a shape is nested too deeply for a field program; split it into shallower rules"};
  }
  return result;
}

}  // namespace sgm
