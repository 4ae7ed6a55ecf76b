#pragma once
// The parser's result for one file, apart from the arrays in Program: the order of its declarations, and the names that
// the checker has yet to resolve. Exists only during compilation and printing.

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

/// A declaration, stored in the order of the source. index: into the array of its kind in Program or ModuleSyntax. sub:
/// for rules, the index of the alternative.
struct Item {
  ItemKind kind = ItemKind::version;
  uint32_t index = 0, sub = 0;
  Span span;
};

struct ImportDecl {
  NameId path = kNoId, alias = kNoId;
  uint32_t module = kNoId;  ///< index of the loaded module; kNoId: not loaded, or an asset
  uint32_t asset = kNoId;   ///< index in Program::assets of the loaded asset; kNoId: not loaded, or a grammar file
  Span path_span, alias_span;
};

/// A name in the source that is not resolved yet.
struct NamedPlace {
  NameId name = kNoId;
  Span span;
};

struct LayerDecl {
  NameId name = kNoId;
  ExprId cell = kNoId, reach = kNoId, start = kNoId;
  /// The length after the word `detail`: levels whose cell edge is longer do not show the layer. kNoId: `detail` is not
  /// written.
  ExprId detail = kNoId;
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
  IdRange box_args;  ///< arguments of box(...), if `box` is set: a range of Ast::args
  Span span;
};

struct ModuleSyntax {
  uint32_t module = 0;
  std::vector<Item> items;
  std::vector<ImportDecl> imports;
  std::vector<LayerDecl> layers;
  DomainDecl domain;
  NameId unit = kNoId;
  ExprId seed = kNoId;   ///< the declared seed, a whole number or a text; kNoId: not written
  ExprId start = kNoId;  ///< the call of a top-level `start`; kNoId: not written
  Span unit_span, seed_span, start_span;

  /// The whole text was parsed without skipping a part after an error.
  bool complete = true;
  bool readable = true;  ///< false if nothing of the text was parsed
  /// False if a part of the text was skipped after an error, and this part may have bounded the extent of the shapes:
  /// for example a domain, or an operand of a meet or a sum.
  bool bounded = true;
  std::set<NameId> in_doubt;  ///< words in skipped parts, which may be names that are declared there

  bool mayDeclare(NameId name) const { return !readable || in_doubt.contains(name); }
};

}  // namespace sgm
