#pragma once
// Lists the members of each node of the syntax tree that are written in the text, once for all passes that visit them.
//
// Each list destructures its node, so adding a member to a node is a compile error until its list names it. The list
// passes the written members to a visitor, in order. Lists of statements are generated from stmts.def. Members computed
// by the parser or the checker are not visited: bound arguments, slots, spans.

#include <cstdint>

#include "grammar/syntax/program.h"

namespace sgm {

/// Base class of visitors: its functions ignore all members. A visitor derives from it, and hides those functions whose
/// members it needs.
struct MemberVisitor {
  void expr(ExprId) {}  ///< an expression; kNoId if the text omits it
  /// an end of a parameter's declared range: it is only checked, and never changes a value; kNoId if the text omits it
  void limit(ExprId) {}
  void stmt(StmtId) {}  ///< a statement; kNoId if the text omits it
  void name(NameId) {}  ///< a name or a text; kNoId if the text omits it
  void literal(double, const Type&) {}
  void value(uint64_t) {}  ///< an enumerator, a flag or a whole number
  void count(uint32_t) {}  ///< the number of nodes of the list that is visited next
};

namespace members {

/// Converts an enumerator, a flag or a whole number for MemberVisitor::value().
template <class T>
constexpr uint64_t wordOf(T value) {
  return static_cast<uint64_t>(value);
}

template <class V>
void visitExprs(const Program& program, IdRange range, V& v) {
  v.count(range.count);
  for (uint32_t i = 0; i < range.count; ++i) v.expr(program.idAt(range, i));
}

template <class V>
void visitStmts(const Program& program, IdRange range, V& v) {
  v.count(range.count);
  for (uint32_t i = 0; i < range.count; ++i) v.stmt(program.idAt(range, i));
}

template <class V>
void visitNames(const Program& program, IdRange range, V& v) {
  v.count(range.count);
  for (uint32_t i = 0; i < range.count; ++i) v.name(program.idAt(range, i));
}

/// Visits a range of nodes in a table.
template <class Table, class V>
void visitNodes(const Program& program, const Table& table, IdRange range, V& v) {
  v.count(range.count);
  for (uint32_t i = 0; i < range.count; ++i) visitMembers(program, table[range.first + i], v);
}

/// Visits each part of a statement, and after each part the child statement that belongs to it.
template <class V>
void visitParts(const Program& program, IdRange parts, IdRange children, V& v) {
  v.count(parts.count);
  for (uint32_t i = 0; i < parts.count; ++i) {
    visitMembers(program, program.ast.parts[parts.first + i], v);
    v.stmt(program.idAt(children, i));
  }
}

}  // namespace members

template <class V>
void visitMembers(const Program&, const ArgNode& node, V& v) {
  const auto& [name, value, span] = node;
  v.name(name);
  v.expr(value);
}

template <class V>
void visitMembers(const Program& program, const ExprNode& node, V& v) {
  const auto& [kind, binary, ref, member, parenthesised, shape, inside, circular, type, value, name, qualifier, id,
               ordinal, children, args, bound, span] = node;
  v.value(members::wordOf(kind));
  if (kind == ExprKind::number)
    v.literal(value, type);
  else
    v.name(name);
  v.value(members::wordOf(binary));
  v.value(members::wordOf(inside));
  members::visitExprs(program, children, v);
  members::visitNodes(program, program.ast.args, args, v);
}

template <class V>
void visitMembers(const Program& program, const XformNode& node, V& v) {
  const auto& [kind, axis, a, b, c, args, span] = node;
  v.value(members::wordOf(kind));
  members::visitNodes(program, program.ast.args, args, v);
}

template <class V>
void visitMembers(const Program& program, const ScatterNode& node, V& v) {
  const auto& [poisson, count, area, a, b, c, args, probe, distance, layer_name, layer, gap, slot, within, when, span] =
      node;
  v.value(members::wordOf(poisson));
  v.expr(count);
  v.value(members::wordOf(area));
  members::visitNodes(program, program.ast.args, args, v);
  v.value(members::wordOf(probe));
  v.expr(distance);
  v.name(layer_name);
  v.name(gap);
  v.expr(within);
  v.expr(when);
}

template <class V>
void visitMembers(const Program& program, const SocketNode& node, V& v) {
  const auto& [of, labels, meets, span] = node;
  v.value(members::wordOf(of));
  members::visitNames(program, labels, v);
  members::visitNames(program, meets, v);
}

template <class V>
void visitMembers(const Program& program, const TileNode& node, V& v) {
  const auto& [turns, sockets, sides] = node;
  v.value(members::wordOf(turns));
  members::visitNodes(program, program.ast.sockets, sockets, v);
}

template <class V>
void visitMembers(const Program& program, const PartNode& node, V& v) {
  const auto& [size, flexible, repeated, relative, of, floor, label, tile, tag, span, group] = node;
  v.expr(size);
  v.value(members::wordOf(flexible));
  v.value(members::wordOf(repeated));
  v.value(members::wordOf(of));
  v.value(members::wordOf(floor));
  v.name(label);
  v.count(tile == kNoId ? 0 : 1);
  if (tile != kNoId) visitMembers(program, program.ast.tiles[tile], v);
}

template <class V>
void visitMembers(const Program& program, const FootprintNode& node, V& v) {
  const auto& [outline, count, args, bound, span] = node;
  v.value(members::wordOf(outline));
  v.expr(count);
  members::visitNodes(program, program.ast.args, args, v);
}

template <class V>
void visitMembers(const Program& program, const RoofNode& node, V& v) {
  const auto& [form, measure, overhang, args] = node;
  v.value(members::wordOf(form));
  members::visitNodes(program, program.ast.args, args, v);
}

template <class V>
void visitMembers(const Program&, const FitZoneNode& node, V& v) {
  const auto& [axis, repeats, from, to, span] = node;
  v.value(members::wordOf(axis));
  v.value(members::wordOf(repeats));
  v.expr(from);
  v.expr(to);
}

template <class V>
void visitMembers(const Program& program, const FitNode& node, V& v) {
  const auto& [asset, zones, name_span] = node;
  members::visitNodes(program, program.ast.fit_zones, zones, v);
}

template <class V>
void visitMembers(const Program& program, const TreemapNode& node, V& v) {
  const auto& [args, wall, door, height, corridor] = node;
  members::visitNodes(program, program.ast.args, args, v);
}

template <class V>
void visitMembers(const Program& program, const LinkNode& node, V& v) {
  const auto& [args, a, b, width, height] = node;
  members::visitNodes(program, program.ast.args, args, v);
}

template <class V>
void visitMembers(const Program&, const FormalNode& node, V& v) {
  const auto& [name, fallback, low_expr, high_expr, type, slot, ranged, dim, low, high, span] = node;
  v.name(name);
  v.expr(fallback);
  v.limit(low_expr);
  v.limit(high_expr);
}

template <class V>
void visitMembers(const Program& program, const Field& node, V& v) {
  const auto& [name, module, local, formals, body, slot_count, span] = node;
  v.name(name);
  members::visitNodes(program, program.ast.formals, formals, v);
  v.expr(body);
}

template <class V>
void visitMembers(const Program& program, const StmtNode& node, V& v) {
  const auto& [kind, power, layer_level, material, tag, ordinal, expr, amount, plan, body, slot, extra, extra2, name,
               name2, children, xforms, parts, span] = node;
  v.value(members::wordOf(kind));
  switch (kind) {
#define EXPR(m) v.expr(m);
#define STMT(m) v.stmt(m);
#define STMTS(m) members::visitStmts(program, m, v);
#define NAME(m) v.name(m);
#define VALUE(m) v.value(members::wordOf(m));
#define NODE(m, table) visitMembers(program, program.table[m], v);
#define NODES(m, table) members::visitNodes(program, program.table, m, v);
#define PARTS members::visitParts(program, parts, children, v);
#define SGM_STMT(name, word, role, members_of_kind) \
  case StmtKind::name:                              \
    members_of_kind break;
#include "grammar/syntax/stmts.def"
  }
}

/// Calls f with each expression that directly belongs to the node, in the order of the text: without expressions nested
/// in these, and without those of statements in the node. The node is an expression, a statement, a declaration
/// (declared_members.h) or a part of one.
template <class Node, class F>
void forEachExpr(const Program& program, const Node& node, F&& f) {
  struct Exprs : MemberVisitor {
    explicit Exprs(F& call) : call_(call) {}
    void expr(ExprId id) {
      if (id != kNoId) call_(id);
    }
    void limit(ExprId id) { expr(id); }
    F& call_;
  } exprs(f);
  visitMembers(program, node, exprs);
}

/// Calls f with each statement directly within the node, in the order of the text.
template <class Node, class F>
void forEachStmt(const Program& program, const Node& node, F&& f) {
  struct Stmts : MemberVisitor {
    explicit Stmts(F& call) : call_(call) {}
    void stmt(StmtId id) {
      if (id != kNoId) call_(id);
    }
    F& call_;
  } stmts(f);
  visitMembers(program, node, stmts);
}

}  // namespace sgm
