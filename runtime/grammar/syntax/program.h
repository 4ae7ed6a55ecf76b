#pragma once
// A checked grammar: immutable, shareable between threads, all names resolved. Created by compileGrammar() (compile.h).

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "base/fixed.h"
#include "base/lazy_number.h"
#include "grammar/syntax/ast.h"
#include "grammar/text/diagnostics.h"

namespace sgm::asset {
struct Polyhedron;
}

namespace sgm {

/// One source file: the root (index 0), an import, or a part of the standard library.
struct Module {
  std::pmr::string path;  ///< as named by the caller; for imports relative to the root's folder; "std/rock.sgm"
  std::pmr::string text;
  std::pmr::vector<Comment> comments;

  explicit Module(std::pmr::memory_resource* memory) : path(memory), text(memory), comments(memory) {}
};

/// A mesh that the grammar imports, to be fitted into scopes: `import "bay.glb" as bay;`.
struct Asset {
  std::pmr::string path;  ///< relative to the root's folder
  std::shared_ptr<const asset::Polyhedron> solid;
  std::pmr::vector<std::pmr::string> material_names;  ///< in the order of the faces' indices
  std::pmr::vector<uint16_t> materials;               ///< resolved: for each name an index in Program::materials; 0
                                                      ///< inherits
  uint64_t hash = 0;                                  ///< of its shape and its materials

  explicit Asset(std::pmr::memory_resource* memory) : path(memory), material_names(memory), materials(memory) {}
};

/// A number that the host sets.
struct Param {
  NameId name = kNoId;
  uint32_t module = 0;
  Dim dim;
  double value = 0;          ///< the default
  double low = 0, high = 0;  ///< the range, ends included; low = high = value if none is written
  bool has_range = false;
  bool whole = false;     ///< default and range are plain whole numbers: a count
  bool animated = false;  ///< meant to be varied over its range while the world is viewed
  NameId doc = kNoId;
  ExprId value_expr = kNoId, low_expr = kNoId, high_expr = kNoId;
  Span span;
};

/// `let name = expr;` or `let name(a, b) = expr;` outside of rules. Pure. Its frame has only its formals.
struct Let {
  NameId name = kNoId;
  uint32_t module = 0;
  bool function = false;
  IdRange formals;  ///< into Ast::formals
  ExprId body = kNoId;
  uint32_t slot_count = 0;
  Span span;
};

/// A sample-time expression with optional parameters. A global field has its own frame (its formals are the slots). A
/// local one is evaluated in the frame of its alternative, in which its formals have slots, too; `q` refers to the
/// scope in which it is used.
struct Field {
  NameId name = kNoId;
  uint32_t module = 0;
  bool local = false;
  IdRange formals;
  ExprId body = kNoId;
  uint32_t slot_count = 0;
  Span span;
};

enum class Guard : uint8_t {
  none,
  when,       ///< holds if the expression is true
  otherwise,  ///< `else`: holds only if no other alternative does
};

/// One head of a rule with its block. Choice: one of those whose guard holds, by weight (drawn by derivation path);
/// alternatives with `lod` and those without are derived independently (see lod).
struct Alternative {
  IdRange formals;  ///< into Ast::formals: slots 0 .. count - 1
  Guard guard = Guard::none;
  ExprId when = kNoId;
  ExprId weight = kNoId;      ///< ratio >= 0; kNoId is 1
  ExprId depth = kNoId;       ///< count: with this many activations of this rule on the path, use depth_call instead
  ExprId depth_call = kNoId;  ///< call of a rule or primitive
  ExprId minsize = kNoId;     ///< length: for a smaller size, use minsize_call instead
  ExprId minsize_call = kNoId;
  uint32_t size_slot = kNoId;  ///< resolved: the formal that is the size (the first length); kNoId: the longest edge of
                               ///< the scope
  ExprId lod = kNoId;          ///< length: replaces the alternatives without `lod` (which choose among themselves) at
                               ///< levels whose cell edge is at least this
  StmtId body = kNoId;         ///< a block
  uint32_t slot_count = 0;     ///< size of the frame
  Span span;                   ///< of the head
};

/// All alternatives of one name. A morphic rule has one alternative, whose body is one morph statement.
struct Rule {
  NameId name = kNoId;
  uint32_t module = 0;
  bool morphic = false;
  uint64_t name_hash = 0;  ///< hashText of the name, for path keys
  std::pmr::vector<Alternative> alternatives;
  std::pmr::vector<uint32_t> calls;      ///< rules that it may call, including its overrides, each once, ascending
  std::pmr::vector<uint32_t> overrides;  ///< those that may apply in it, each once, ascending
  Span span;                             ///< of the first name

  explicit Rule(std::pmr::memory_resource* memory) : alternatives(memory), calls(memory), overrides(memory) {}
};

/// A step of a derivation path: a use of `rule`.
struct PathStep {
  uint32_t rule = kNoId;
  uint32_t index = kNoId;  ///< among its parent's uses of the same rule; kNoId: all

  friend auto operator<=>(const PathStep&, const PathStep&) = default;
};

/// `override "net(0, 0, 0)/Node/Chamber[0]" { ... }` or `override tag "cave.hall" { ... }`: a block that replaces a use
/// of a rule, or a block with that tag. If several apply, the last of them in Program::overrides is derived, and its
/// `inner` derives the result of the others.
struct Override {
  NameId address = kNoId;  ///< as written: a path, or a tag
  bool by_tag = false;
  uint32_t layer = kNoId;  ///< by path: kNoId: in every layer
  bool one_cell = false;
  Int3 cell;
  IdRange steps;  ///< by path: into Program::path_steps, from the start on; the last one is the replaced use
  StmtId body = kNoId;
  uint32_t slot_count = 0;  ///< size of the frame; its first slots are the parameters of the last step's rule
  uint64_t hash = 0;        ///< of the address, for path keys
  Span span, address_span;
};

/// Layers are in topological order: a layer uses only layers before it.
struct Layer {
  NameId name = kNoId;  ///< "main" for a top-level start
  Int3 cell;  ///< edges of a cell in units, at least 1; on axes without cells: 0; without layers: the domain's edges
  int32_t reach = 0;  ///< in units: shapes stay within the cell's box grown by this
  std::pmr::vector<uint32_t> uses;
  ExprId start = kNoId;  ///< a call of a rule
  ExprId cell_expr = kNoId, reach_expr = kNoId;
  IntBox bound;  ///< of what the layer adds or cuts, from the cell's low corner; on axes without cells, and without
                 ///< layers, from the world's origin
  bool proven = false;  ///< `bound` lies within cell + reach; otherwise derivation must reject shapes that exceed it
  /// In units. At levels with a longer cell edge the layer shows nothing, whatever its parameters, seed and cell: by
  /// its own `detail`, or since all its shapes have one. INT32_MAX: no such edge; 0: it has no shapes.
  int32_t coarsest_cell = std::numeric_limits<int32_t>::max();
  bool by_level = true;  ///< some of its shapes may be visible only at some levels, apart from its own `detail`
  bool anchors = true;   ///< it may have anchors

  bool shows(int32_t cell_edge) const { return cell_edge <= coarsest_cell; }

  Span span;

  explicit Layer(std::pmr::memory_resource* memory) : uses(memory) {}
};

inline constexpr int32_t kDensityEdge = 10 * kUnitsPerMetre;

struct Domain {
  bool infinite = false;
  std::array<bool, 3> axes{true, true, true};  ///< infinite: axes that are cut into cells
  bool solid = false;
  bool density = false;  ///< `output density`: the solid is meant as fog
  /// Units from the surface to full density: `output density edge 20m`, or kDensityEdge if it is not written.
  int32_t density_edge = kDensityEdge;
  uint16_t material = 0;  ///< of a solid domain
  /// Finite: the world's box, centred on the origin, in units. A top-level start derives once, with its scope at the
  /// origin and this box as its size (layer "main", cell 0 0 0, whose low corner counts as the origin). Written as
  /// `domain finite box(x, y, z)`; otherwise the proven bound of the shapes, grown by 1 m.
  IntBox box;
  bool written = false;  ///< the program has a domain declaration
  Span span;
};

enum class Measure : uint8_t { watertight, components, volume, area, triangles, genus, anchors };

/// `report volume;`, `expect components(air) == 1 in block(8);`, `expect volume in 1m3..2m3 per Chamber;`
/// For the meaning, place and precision of each measure see region/expectations.h. Volumes are in m3, areas in m2.
struct Expectation {
  bool expect = false;  ///< otherwise it is a report
  Measure measure = Measure::watertight;
  NameId of = kNoId;        ///< components(air): "air" or "solid"
  ExprId above = kNoId;     ///< components(solid above 1m3): a constant
  double above_number = 0;  ///< m3; 0: not written
  bool compared = false;
  BinaryOp comparison = BinaryOp::equal;
  ExprId value = kNoId, low = kNoId, high = kNoId;  ///< comparison, or range; constants
  double value_number = 0, low_number = 0, high_number = 0;
  int32_t block = 0;     ///< in block(n): cells along an edge; 0: not written
  uint32_t per = kNoId;  ///< Program::rules
  NameId per_name = kNoId;
  Span span;
};

class Program {
 public:
  explicit Program(std::pmr::memory_resource* memory)
      : ast(memory),
        modules(memory),
        assets(memory),
        params(memory),
        lets(memory),
        fields(memory),
        rules(memory),
        layers(memory),
        materials(memory),
        tags(memory),
        names(memory),
        expectations(memory),
        overrides(memory),
        path_steps(memory),
        tag_overrides(memory),
        path_overrides(memory),
        canonical(memory) {}

  Ast ast;
  std::pmr::vector<Module> modules;  ///< modules[0] is the root
  std::pmr::vector<Asset> assets;
  std::pmr::vector<Param> params;
  std::pmr::vector<Let> lets;
  std::pmr::vector<Field> fields;
  std::pmr::vector<Rule> rules;
  std::pmr::vector<Layer> layers;
  Domain domain;
  NameId unit = kNoId;                           ///< `units`: for lengths from outside without a unit
  uint64_t seed = 0;                             ///< from `seed`; combine with the world's seed
  std::pmr::vector<std::pmr::string> materials;  ///< [0] is "" (none)
  std::pmr::vector<std::pmr::string> tags;       ///< [0] is ""
  std::pmr::vector<std::pmr::string> names;      ///< anchor kinds and names; [0] is ""
  std::pmr::vector<Expectation> expectations;
  /// Specific ones after general ones: by tag, by path in every cell, by path in one cell; otherwise in written order.
  std::pmr::vector<Override> overrides;
  std::pmr::vector<PathStep> path_steps;
  std::pmr::vector<IdRange> tag_overrides;  ///< for each of `tags`: into Ast::ids, ascending
  /// Overrides by path in the order of their steps, by rule and then by index; a path comes before its extensions.
  std::pmr::vector<uint32_t> path_overrides;
  std::pmr::string canonical;  ///< the root as `sgm fmt` writes it
  /// Of the meaning of all files: independent of layout, comments, superfluous parentheses, and of asset content other
  /// than shapes and materials.
  uint64_t hash = 0;
  LazyNumber former_hash;  ///< of formerHash (identity/former_hash.h)

  std::string_view text(NameId id) const { return id == kNoId ? std::string_view() : std::string_view(ast.names[id]); }
  const ExprNode& expr(ExprId id) const { return ast.exprs[id]; }
  const StmtNode& stmt(StmtId id) const { return ast.stmts[id]; }
  /// The i-th id of a range of children or bound arguments.
  uint32_t idAt(IdRange range, uint32_t i) const { return ast.ids[range.first + i]; }
  /// The statement inside of transforms, loops, point sets and details: the core of a block's child.
  StmtId innermost(StmtId id) const;
  /// Into Ast::ids: the overrides of blocks with this tag.
  IdRange overridesOf(uint16_t tag) const { return tag < tag_overrides.size() ? tag_overrides[tag] : IdRange{}; }
  /// kNoId if there is none.
  uint32_t findParam(std::string_view name) const;
  uint32_t findRule(std::string_view name) const;
  uint32_t findLayer(std::string_view name) const;
};

}  // namespace sgm
