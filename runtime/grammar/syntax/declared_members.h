#pragma once
// Lists, for each kind of declaration, the members that are written in the text, as members.h does for nodes of the
// syntax tree.

#include "grammar/syntax/members.h"
#include "grammar/syntax/syntax.h"

namespace sgm {

template <class V>
void visitMembers(const Program&, const ImportDecl& node, V& v) {
  const auto& [path, alias, module, asset, path_span, alias_span] = node;
  v.name(path);
  v.name(alias);
}

/// The members `animated` and `doc` are not visited: they concern only the host application and do not affect the
/// meaning.
template <class V>
void visitMembers(const Program&, const Param& node, V& v) {
  const auto& [name, module, dim, value, low, high, has_range, whole, animated, doc, value_expr, low_expr, high_expr,
               span] = node;
  v.name(name);
  v.expr(value_expr);
  v.expr(low_expr);
  v.expr(high_expr);
}

template <class V>
void visitMembers(const Program& program, const Let& node, V& v) {
  const auto& [name, module, function, formals, body, slot_count, span] = node;
  v.name(name);
  v.value(members::wordOf(function));
  members::visitNodes(program, program.ast.formals, formals, v);
  v.expr(body);
}

template <class V>
void visitMembers(const Program& program, const DomainDecl& node, V& v) {
  const auto& [present, infinite, solid, empty, density, axes, axes_written, density_edge, material, box, box_args,
               span] = node;
  for (const bool flag : {infinite, solid, empty, density, axes_written}) v.value(members::wordOf(flag));
  for (const bool axis : axes) v.value(members::wordOf(axis));
  v.expr(density_edge);
  v.name(material);
  v.value(members::wordOf(box));
  members::visitNodes(program, program.ast.args, box_args, v);
}

template <class V>
void visitMembers(const Program&, const LayerDecl& node, V& v) {
  const auto& [name, cell, reach, start, detail, uses, span] = node;
  v.name(name);
  v.expr(cell);
  v.expr(reach);
  v.expr(detail);
  v.count(static_cast<uint32_t>(uses.size()));
  for (const NamedPlace& layer : uses) v.name(layer.name);
  v.expr(start);
}

template <class V>
void visitMembers(const Program& program, const Alternative& node, V& v) {
  const auto& [formals, guard, when, weight, depth, depth_call, minsize, minsize_call, size_slot, lod, body, slot_count,
               span] = node;
  members::visitNodes(program, program.ast.formals, formals, v);
  v.value(members::wordOf(guard));
  v.expr(when);
  v.expr(weight);
  v.expr(depth);
  v.expr(depth_call);
  v.expr(minsize);
  v.expr(minsize_call);
  v.expr(lod);
  v.stmt(body);
}

template <class V>
void visitMembers(const Program&, const Override& node, V& v) {
  const auto& [address, by_tag, layer, one_cell, cell, steps, body, slot_count, hash, span, address_span] = node;
  v.name(address);
  v.value(members::wordOf(by_tag));
  v.stmt(body);
}

template <class V>
void visitMembers(const Program&, const Expectation& node, V& v) {
  const auto& [expect, measure, of, above, above_number, compared, comparison, value, low, high, value_number,
               low_number, high_number, block, per, per_name, span] = node;
  v.value(members::wordOf(expect));
  v.value(members::wordOf(measure));
  v.name(of);
  v.expr(above);
  v.value(members::wordOf(compared));
  v.value(members::wordOf(comparison));
  v.expr(value);
  v.expr(low);
  v.expr(high);
  v.value(members::wordOf(block));
  v.name(per_name);
}

/// A declaration, as listed in ModuleSyntax::items.
struct Declaration {
  const ModuleSyntax& syntax;
  const Item& item;
};

template <class V>
void visitMembers(const Program& program, const Declaration& declaration, V& v) {
  const auto& [syntax, item] = declaration;
  v.value(members::wordOf(item.kind));
  switch (item.kind) {
    case ItemKind::version:
      break;
    case ItemKind::import:
      return visitMembers(program, syntax.imports[item.index], v);
    case ItemKind::units:
      return v.name(syntax.unit);
    case ItemKind::param:
      return visitMembers(program, program.params[item.index], v);
    case ItemKind::seed:
      return v.expr(syntax.seed);
    case ItemKind::let:
      return visitMembers(program, program.lets[item.index], v);
    case ItemKind::field:
      return visitMembers(program, program.fields[item.index], v);
    case ItemKind::domain:
      return visitMembers(program, syntax.domain, v);
    case ItemKind::layer:
      return visitMembers(program, syntax.layers[item.index], v);
    case ItemKind::start:
      return v.expr(syntax.start);
    case ItemKind::alternative: {
      const Rule& rule = program.rules[item.index];
      v.name(rule.name);
      v.value(members::wordOf(rule.morphic));
      return visitMembers(program, rule.alternatives[item.sub], v);
    }
    case ItemKind::overriding:
      return visitMembers(program, program.overrides[item.index], v);
    case ItemKind::expectation:
      return visitMembers(program, program.expectations[item.index], v);
  }
}

}  // namespace sgm
