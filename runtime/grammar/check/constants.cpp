#include "grammar/check/constants.h"

namespace sgm {

std::optional<double> Constants::fold(ExprId id, int depth) {
  if (id == kNoId || depth > 400) return std::nullopt;
  const ExprNode& n = program_.expr(id);
  auto operand = [&](uint32_t i) { return fold(program_.idAt(n.children, i), depth + 1); };
  switch (n.kind) {
    case ExprKind::number:
      return n.value;
    case ExprKind::negate:
      if (const auto a = operand(0)) return -*a;
      return std::nullopt;
    case ExprKind::name: {
      if (n.ref != Ref::let || program_.lets[n.id].function) return std::nullopt;
      if (const auto known = lets_.find(n.id); known != lets_.end()) return known->second;
      const auto value = fold(program_.lets[n.id].body, depth + 20);
      if (value) lets_.emplace(n.id, *value);
      return value;
    }
    case ExprKind::binary: {
      const auto a = operand(0), b = a ? operand(1) : std::nullopt;
      if (!a || !b) return std::nullopt;
      switch (n.binary) {
        case BinaryOp::add:
          return *a + *b;
        case BinaryOp::subtract:
          return *a - *b;
        case BinaryOp::multiply:
          return *a * *b;
        case BinaryOp::divide:
          return *b == 0 ? std::nullopt : std::optional(*a / *b);
        default:
          return std::nullopt;
      }
    }
    default:
      return std::nullopt;
  }
}

bool isLiteral(const Program& program, ExprId id) {
  const ExprNode& n = program.expr(id);
  if (n.kind != ExprKind::number && n.kind != ExprKind::negate && n.kind != ExprKind::binary &&
      n.kind != ExprKind::vector)
    return false;
  for (uint32_t i = 0; i < n.children.count; ++i)
    if (!isLiteral(program, program.idAt(n.children, i))) return false;
  return true;
}

}  // namespace sgm
