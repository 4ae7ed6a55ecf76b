#include "grammar/print/print_expressions.h"

#include <array>

#include "grammar/syntax/keywords.h"
#include "grammar/syntax/lexer.h"
#include "grammar/syntax/precedence.h"
#include "grammar/text/sink.h"

namespace sgm {

namespace {

constexpr std::array<std::string_view, 12> kBinary = {
    " + ", " - ", "*", "/", " < ", " <= ", " > ", " >= ", " == ", " != ", " and ", " or "};

int levelOf(const ExprNode& node) {
  switch (node.kind) {
    case ExprKind::conditional:
    case ExprKind::range:
      return kLoosest;
    case ExprKind::binary:
      return precedenceOf(node.binary);
    case ExprKind::logical_not:
      return kComparison;
    case ExprKind::negate:
      return kUnary;
    default:
      return kPostfix;
  }
}

}  // namespace

std::string_view binaryText(BinaryOp op) { return kBinary[static_cast<size_t>(op)]; }

void LinePrinter::expr(std::string& out, ExprId id, int lowest) const {
  if (id == kNoId) return;
  const ExprNode& node = program_.expr(id);
  const bool vector = node.kind == ExprKind::vector;
  const bool parentheses = !vector && (levelOf(node) < lowest || (node.parenthesised && !meaning_));
  if (parentheses) out += '(';
  auto child = [&](uint32_t i, int level) { expr(out, program_.idAt(node.children, i), level); };
  switch (node.kind) {
    case ExprKind::number:
      if (meaning_ && node.type.kind == ValueKind::number)
        out += join({numberText(node.value), "~", std::to_string(node.type.dim.length), "~",
                     std::to_string(node.type.dim.angle)});
      else
        out += program_.text(node.name);
      break;
    case ExprKind::text:
      out += quoteText(program_.text(node.name));
      break;
    case ExprKind::vector:
      out += '(';
      for (uint32_t i = 0; i < node.children.count; ++i) {
        if (i > 0) out += ", ";
        child(i, 0);
      }
      out += ')';
      break;
    case ExprKind::negate:
      out += '-';
      child(0, kUnary);
      break;
    case ExprKind::logical_not:
      out += "not ";
      child(0, kComparison);
      break;
    case ExprKind::binary: {
      const int level = precedenceOf(node.binary);
      child(0, level == kComparison ? kComparison + 1 : level);
      out += binaryText(node.binary);
      child(1, level + 1);
      break;
    }
    case ExprKind::conditional:
      out += "if ";
      child(0, 0);
      out += " then ";
      child(1, 0);
      out += " else ";
      child(2, 0);
      break;
    case ExprKind::range:
      child(0, 1);
      out += "..";
      child(1, 1);
      break;
    case ExprKind::name:
      out += program_.text(node.name);
      break;
    case ExprKind::member:
      child(0, kPostfix);
      out += join({".", program_.text(node.name)});
      break;
    case ExprKind::call:
      if (node.children.count > 0) {
        child(0, kPostfix);
        out += '.';
      }
      out += program_.text(node.name);
      // A call of a rule without arguments is written without parentheses. Calls of lets and functions keep theirs,
      // since without them they would be plain names.
      if (node.args.count > 0 || !node.shape) args(out, node.args, program_.text(node.name));
      break;
    case ExprKind::query:
      out += node.inside ? "query inside " : "query clear ";
      if (node.children.count > 0) {
        child(0, kLoosest);
        out += ' ';
      }
      out += join({"of ", program_.text(node.name)});
      break;
  }
  if (parentheses) out += ')';
}

void LinePrinter::args(std::string& out, IdRange range, std::string_view callee) const {
  out += '(';
  for (uint32_t i = 0; i < range.count; ++i) {
    const ArgNode& arg = program_.ast.args[range.first + i];
    if (i > 0) out += ", ";
    if (arg.name != kNoId) {
      const std::string_view name = program_.text(arg.name);
      std::string value;
      expr(value, arg.value);
      const bool touching = value.starts_with('-') || value.starts_with('(');
      out += join({name, touching && !namesArgument(callee, name) ? " = " : " ", value});
    } else {
      expr(out, arg.value);
    }
  }
  out += ')';
}

void LinePrinter::formals(std::string& out, IdRange range) const {
  if (range.count == 0) return;
  out += '(';
  for (uint32_t i = 0; i < range.count; ++i) {
    const FormalNode& formal = program_.ast.formals[range.first + i];
    if (i > 0) out += ", ";
    out += program_.text(formal.name);
    if (formal.fallback != kNoId) {
      out += " = ";
      expr(out, formal.fallback);
    }
    // Ranges only reject calls and never change what is derived, so they are not part of the meaning.
    if (formal.low_expr == kNoId || meaning_) continue;
    out += " in ";
    expr(out, formal.low_expr, kOr);
    out += "..";
    expr(out, formal.high_expr, kOr);
  }
  out += ')';
}

void LinePrinter::xforms(std::string& out, IdRange range) const {
  for (uint32_t i = 0; i < range.count; ++i) {
    const XformNode& node = program_.ast.xforms[range.first + i];
    if (i > 0) out += ' ';
    const std::string_view word = transformTable()[static_cast<size_t>(node.kind)];
    out += word;
    args(out, node.args, word);
  }
}

void LinePrinter::field(std::string& out, const Field& field) const {
  out += join({"field ", program_.text(field.name)});
  formals(out, field.formals);
  out += " = ";
  expr(out, field.body);
  out += ';';
}

}  // namespace sgm
