#pragma once
// The parser's result for one file besides the shared arrays of Program: the order of its declarations, and the parts
// that the checker resolves. Exists only while compiling and printing.

#include <cstdint>
#include <memory_resource>
#include <set>
#include <vector>

#include "grammar/syntax/program.h"

namespace sgm {

enum class ItemKind : uint8_t {
  version,
  import,
  units,
  param,
  seed,
  let,
  field,
  domain,
  layer,
  start,
  alternative,
  overriding,
  expectation
};

/// A declaration in source order. index: in the array of its kind; sub: the alternative of a rule.
struct Item {
  ItemKind kind = ItemKind::version;
  uint32_t index = 0, sub = 0;
  Span span;
};

struct ImportDecl {
  NameId path = kNoId, alias = kNoId;
  uint32_t module = kNoId;  ///< once loaded; kNoId for an asset
  uint32_t asset = kNoId;   ///< Program::assets, once loaded
  Span path_span, alias_span;
};

/// A word of the source that is not resolved yet.
struct NamedPlace {
  NameId name = kNoId;
  Span span;
};

struct LayerDecl {
  NameId name = kNoId;
  ExprId cell = kNoId, reach = kNoId, start = kNoId;
  ExprId detail = kNoId;  ///< or kNoId: visible at every level
  std::vector<NamedPlace> uses;
  Span span;
};

struct DomainDecl {
  bool present = false;
  bool infinite = false, solid = false, empty = false, density = false;
  std::array<bool, 3> axes{true, true, true};
  bool axes_written = false;
  ExprId density_edge = kNoId;
  NameId material = kNoId;
  bool box = false;
  IdRange box_args;  ///< into Ast::args
  Span span;
};

struct ModuleSyntax {
  uint32_t module = 0;
  std::vector<Item> items;
  std::vector<ImportDecl> imports;
  std::vector<LayerDecl> layers;
  DomainDecl domain;
  NameId unit = kNoId;
  ExprId seed = kNoId;   ///< a whole number or a text
  ExprId start = kNoId;  ///< top level
  Span unit_span, seed_span, start_span;

  /// Whether all of the text was parsed.
  bool complete = true;
  bool readable = true;       ///< false: none of it was parsed
  bool bounded = true;        ///< false: an unparsed part may bound the rest: a domain, or an operand of meet or sum
  std::set<NameId> in_doubt;  ///< words of unparsed parts, where they may be declared

  bool mayDeclare(NameId name) const { return !readable || in_doubt.contains(name); }
};

}  // namespace sgm
