#include "field/expr_compiler.h"

#include <span>

namespace sgm {

namespace {

Op binaryOp(ExprOp op) {
  switch (op) {
    case ExprOp::add:
      return Op::add;
    case ExprOp::subtract:
      return Op::subtract;
    case ExprOp::multiply:
      return Op::multiply;
    case ExprOp::divide:
      return Op::divide;
    case ExprOp::minimum:
      return Op::minimum;
    case ExprOp::maximum:
      return Op::maximum;
    case ExprOp::less:
      return Op::less;
    case ExprOp::constant:
    case ExprOp::coordinate:
    case ExprOp::noise:
    case ExprOp::sweep:
    case ExprOp::negate:
    case ExprOp::absolute:
    case ExprOp::floor:
    case ExprOp::square_root:
    case ExprOp::smoothstep:
    case ExprOp::mix:
      break;
  }
  return Op::count;  // the expressions above are not binary operations
}

}  // namespace

uint64_t ExprCompiler::beginPlace() {
  const uint64_t outer = epoch_;
  epoch_ = ++epochs_;
  return outer;
}

Value ExprCompiler::emit(uint32_t index) {
  Known& known = known_[index];
  if (known.epoch == epoch_) return known.value;
  const Expr& e = chunk_.exprs[index];
  Value v;
  switch (e.op) {
    case ExprOp::constant:
      v = builder_.constant(e.value);
      break;
    case ExprOp::coordinate:
      v = builder_.coordinate(e.anchor, e.row[0], e.row[1], e.row[2]);
      break;
    case ExprOp::noise: {
      const NoiseSpec& n = chunk_.noises[e.noise];
      v = builder_.noise(n, octavesAt(n));
      break;
    }
    case ExprOp::sweep:
      v = builder_.sweep(std::span(chunk_.points).subspan(e.first_point, e.point_count));
      break;
    case ExprOp::negate:
      v = builder_.unary(Op::negate, emit(e.a));
      break;
    case ExprOp::absolute:
      v = builder_.unary(Op::absolute, emit(e.a));
      break;
    case ExprOp::floor:
      v = builder_.unary(Op::floor, emit(e.a));
      break;
    case ExprOp::square_root:
      v = builder_.unary(Op::square_root, emit(e.a));
      break;
    case ExprOp::smoothstep:
      v = builder_.smoothstep(emit(e.a), chunk_.exprs[e.b].value, chunk_.exprs[e.c].value);
      break;
    case ExprOp::mix: {
      const Value a = emit(e.a), b = emit(e.b);
      v = builder_.ternary(Op::mix, a, b, emit(e.c));
      break;
    }
    case ExprOp::add:
    case ExprOp::subtract:
    case ExprOp::multiply:
    case ExprOp::divide:
    case ExprOp::minimum:
    case ExprOp::maximum:
    case ExprOp::less: {
      const Value a = emit(e.a);
      v = builder_.binary(binaryOp(e.op), a, emit(e.b));
      break;
    }
  }
  known = {epoch_, v};
  return v;
}

// Returns the number of octaves to evaluate. Octaves with a period shorter than two cells would only cause aliasing.
uint32_t ExprCompiler::octavesAt(const NoiseSpec& noise) const {
  uint32_t count = 0;
  while (count < noise.octaves && (int64_t{noise.period} >> count) >= 2 * int64_t{cell_}) ++count;
  return count;
}

}  // namespace sgm
