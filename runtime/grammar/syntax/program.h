#pragma once
// The result of compilation: immutable, shareable between threads, with all names resolved. Created by compileGrammar()
// (compile.h).

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
  /// the root's path as the caller passed it; an import's path relative to the root's folder; or "std/rock.sgm"
  std::pmr::string path;
  std::pmr::string text;
  std::pmr::vector<Comment> comments;

  explicit Module(std::pmr::memory_resource* memory) : path(memory), text(memory), comments(memory) {}
};

/// A mesh that the grammar imports, to be fitted into scopes: `import "bay.glb" as bay;`.
struct Asset {
  std::pmr::string path;  ///< path of the file, relative to the root's folder
  std::shared_ptr<const asset::Polyhedron> solid;
  /// names of the materials to which the solid's faces refer by index
  std::pmr::vector<std::pmr::string> material_names;
  /// for each name in material_names, set by the checker: an index in Program::materials; 0: inherited
  std::pmr::vector<uint16_t> materials;
  uint64_t hash = 0;  ///< hash of the solid and its material names

  explicit Asset(std::pmr::memory_resource* memory) : path(memory), material_names(memory), materials(memory) {}
};

/// A number declared by `param`, which the host may set.
struct Param {
  NameId name = kNoId;
  uint32_t module = 0;
  Dim dim;
  double value = 0;          ///< the default
  double low = 0, high = 0;  ///< the permitted range, ends included; low = high = value if none is written
  bool has_range = false;
  /// the parameter's default and range are whole numbers without a unit, so its values must be whole, too
  bool whole = false;
  bool animated = false;  ///< the parameter is meant to be varied over its range while the world is viewed
  NameId doc = kNoId;
  ExprId value_expr = kNoId, low_expr = kNoId, high_expr = kNoId;
  Span span;
};

/// `let name = expr;` or `let name(a, b) = expr;` outside of rules. Pure. Its frame contains only its formals.
struct Let {
  NameId name = kNoId;
  uint32_t module = 0;
  bool function = false;
  IdRange formals;  ///< the parameters: a range of Ast::formals
  ExprId body = kNoId;
  uint32_t slot_count = 0;
  Span span;
};

/// A sample-time expression with optional parameters. A global field is evaluated in a frame of its own, whose slots
/// are its formals. A local field is evaluated in the frame of the rule alternative that declares the field; this frame
/// also has slots for the field's formals. `q` is relative to the scope of the statement that uses the field.
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
  when,       ///< the guard is the expression `when`, which must be true
  otherwise,  ///< the guard is `else`: it holds only if the guards of all other alternatives fail
};

/// One head of a rule with its block. Derivation chooses one of the alternatives whose guards hold, at random by weight
/// (drawn from the hash of the derivation path). The choice is made separately among the alternatives with `lod` and
/// those without.
struct Alternative {
  IdRange formals;  ///< range of Ast::formals; their slots are 0 .. count - 1
  Guard guard = Guard::none;
  ExprId when = kNoId;
  ExprId weight = kNoId;  ///< ratio >= 0; kNoId: 1
  /// a number: if the path already contains this many activations of the rule, depth_call is derived instead of the
  /// body
  ExprId depth = kNoId;
  ExprId depth_call = kNoId;  ///< the call of a rule or primitive that is derived at the `depth` limit
  /// a length: if the size (see size_slot) is smaller, minsize_call is derived instead of the body
  ExprId minsize = kNoId;
  ExprId minsize_call = kNoId;
  /// set by the checker: slot of the formal that is compared with minsize (the first length); kNoId: the scope's
  /// longest edge is compared
  uint32_t size_slot = kNoId;
  /// a length: at levels whose cell edge is at least this, the alternative replaces the alternatives without `lod`
  ExprId lod = kNoId;
  StmtId body = kNoId;      ///< a block
  uint32_t slot_count = 0;  ///< number of slots in the frame of this head
  Span span;                ///< place of the head in the grammar's text
};

/// All alternatives of one name. A morphic rule has one alternative, whose body is one morph statement.
struct Rule {
  NameId name = kNoId;
  uint32_t module = 0;
  bool morphic = false;
  uint64_t name_hash = 0;  ///< hashText() of the name, part of the path keys of random draws
  std::pmr::vector<Alternative> alternatives;
  std::pmr::vector<uint32_t> calls;  ///< rules that this rule may call, also in its overrides, each once, ascending
  /// overrides that may apply in this rule, as indices into Program::overrides, each once, ascending
  std::pmr::vector<uint32_t> overrides;
  Span span;  ///< place of the rule's name in its first head

  explicit Rule(std::pmr::memory_resource* memory) : alternatives(memory), calls(memory), overrides(memory) {}
};

/// A step of a derivation path: a use of `rule`.
struct PathStep {
  uint32_t rule = kNoId;
  uint32_t index = kNoId;  ///< which of the parent's activations of this rule, counted from 0; kNoId: all of them

  friend auto operator<=>(const PathStep&, const PathStep&) = default;
};

/// `override "net(0, 0, 0)/Node/Chamber[0]" { ... }` or `override tag "cave.hall" { ... }`: a block that replaces the
/// use of a rule at that path, or each block with that tag. If several overrides apply to one target, the last of them
/// in Program::overrides is derived; its `inner` stands for the result of the overrides before it.
struct Override {
  NameId address = kNoId;  ///< the path or the tag of the target, as written
  bool by_tag = false;
  uint32_t layer = kNoId;  ///< for an override by path: the layer that the path names; kNoId: it applies in every layer
  bool one_cell = false;
  Int3 cell;
  /// for an override by path: a range of Program::path_steps, from the layer's start rule to the replaced use
  IdRange steps;
  StmtId body = kNoId;
  /// number of slots in its frame; the first slots are the parameters of the rule in the last step
  uint32_t slot_count = 0;
  uint64_t hash = 0;  ///< hash of the address, for the path keys of random draws
  Span span, address_span;
};

/// A layer. Layers are in topological order: a layer uses only layers before it.
struct Layer {
  NameId name = kNoId;  ///< name of the layer; "main" for a top-level start, in a grammar without layers
  /// edges of a cell in units, at least 1; 0 on axes without cells; for a top-level start: edges of the domain
  Int3 cell;
  int32_t reach = 0;  ///< distance in units by which shapes may extend beyond the cell's box
  std::pmr::vector<uint32_t> uses;
  ExprId start = kNoId;  ///< the call of a rule that is derived in each cell
  ExprId cell_expr = kNoId, reach_expr = kNoId;
  /// Box of everything that the layer adds or cuts, in units from the cell's low corner; on axes without cells, and for
  /// a top-level start, from the world's origin.
  IntBox bound;
  /// `bound` lies within cell + reach; otherwise derivation must reject shapes that exceed that box
  bool proven = false;
  /// The largest cell edge of a level, in units, at which the layer may show anything, whatever its parameters, seed
  /// and cell. It is limited by the `detail` of the layer, or by the `detail` statements around all of its shapes.
  /// INT32_MAX: no limit; 0: the layer has no shapes.
  int32_t coarsest_cell = std::numeric_limits<int32_t>::max();
  /// some of its shapes may be visible only at some levels, by `detail` or `lod` within the layer
  bool by_level = true;
  bool anchors = true;  ///< whether the layer may derive anchors

  bool shows(int32_t cell_edge) const { return cell_edge <= coarsest_cell; }

  Span span;

  explicit Layer(std::pmr::memory_resource* memory) : uses(memory) {}
};

inline constexpr int32_t kDensityEdge = 10 * kUnitsPerMetre;

struct Domain {
  bool infinite = false;
  std::array<bool, 3> axes{true, true, true};  ///< if infinite: the axes along which the domain is divided into cells
  bool solid = false;
  bool density = false;  ///< `output density`: the solid is to be rendered as fog
  /// Distance in units from the surface to full density: `output density edge 20m`, or kDensityEdge if no edge is
  /// written.
  int32_t density_edge = kDensityEdge;
  uint16_t material = 0;  ///< material of a solid domain; index in Program::materials
  /// Of a finite domain: the world's box in units, centred on the origin. The grammar states it by `domain finite
  /// box(x, y, z)`; without such a statement, it is the proven bound of the shapes, grown by 1 m. A top-level start
  /// (layer "main") is derived once, as cell 0 0 0. Its scope is at the origin and has this box's edges as its size;
  /// the origin also counts as the cell's low corner.
  IntBox box;
  bool written = false;  ///< the program contains a domain declaration
  Span span;
};

enum class Measure : uint8_t { watertight, components, volume, area, triangles, genus, anchors };

/// `report volume;`, `expect components(air) == 1 in block(8);`, `expect volume in 1m3..2m3 per Chamber;`.
/// region/expectations.h defines where and how precisely each measure is taken. Volumes are in m3, areas in m2.
struct Expectation {
  bool expect = false;  ///< true for `expect`, false for `report`
  Measure measure = Measure::watertight;
  NameId of = kNoId;        ///< the operand of components(...): "air" or "solid"
  ExprId above = kNoId;     ///< the minimum volume in components(solid above 1m3), a constant; kNoId: not written
  double above_number = 0;  ///< value of `above` in m3; 0: not written
  bool compared = false;
  BinaryOp comparison = BinaryOp::equal;
  /// constants: value of a comparison, or low and high of a range; otherwise kNoId
  ExprId value = kNoId, low = kNoId, high = kNoId;
  double value_number = 0, low_number = 0, high_number = 0;
  int32_t block = 0;     ///< the n of `in block(n)`: cells along an edge; 0: not written
  uint32_t per = kNoId;  ///< the RULE of `per RULE`: index in Program::rules; kNoId: not written
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
  std::pmr::vector<Module> modules;  ///< all files, by module index; [0] is the root
  std::pmr::vector<Asset> assets;
  std::pmr::vector<Param> params;
  std::pmr::vector<Let> lets;
  std::pmr::vector<Field> fields;
  std::pmr::vector<Rule> rules;
  std::pmr::vector<Layer> layers;
  Domain domain;
  NameId unit = kNoId;  ///< from `units`: the unit of lengths that the host passes without a unit; kNoId: not written
  uint64_t seed = 0;    ///< from the declaration `seed` (a text is hashed); combined with the world's seed
  std::pmr::vector<std::pmr::string> materials;  ///< material names; [0] is "" (none)
  std::pmr::vector<std::pmr::string> tags;       ///< tags; [0] is "" (none)
  std::pmr::vector<std::pmr::string> names;      ///< kinds and names of anchors; [0] is "" (none)
  std::pmr::vector<Expectation> expectations;
  /// General overrides before specific ones: by tag, by path in every cell, by path in one cell; within each group in
  /// written order.
  std::pmr::vector<Override> overrides;
  std::pmr::vector<PathStep> path_steps;
  /// for each element of `tags`: overrides by this tag, a range of Ast::ids, ascending
  std::pmr::vector<IdRange> tag_overrides;
  /// Indices of the overrides by path, sorted by their steps (by rule, then by index); a path comes before its
  /// extensions.
  std::pmr::vector<uint32_t> path_overrides;
  std::pmr::string canonical;  ///< the text of the root in canonical layout, as `sgm fmt` prints it
  /// Hash of the meaning of all files. Independent of layout, comments and redundant parentheses; of an asset, only the
  /// solid and its materials count.
  uint64_t hash = 0;
  LazyNumber former_hash;  ///< result of formerHash() (identity/former_hash.h)

  std::string_view text(NameId id) const { return id == kNoId ? std::string_view() : std::string_view(ast.names[id]); }
  const ExprNode& expr(ExprId id) const { return ast.exprs[id]; }
  const StmtNode& stmt(StmtId id) const { return ast.stmts[id]; }
  /// Returns the i-th id of a range of Ast::ids.
  uint32_t idAt(IdRange range, uint32_t i) const { return ast.ids[range.first + i]; }
  /// Returns the first statement inside nested transforms, loops, scatters and details; `id` itself if it is none of
  /// these.
  StmtId innermost(StmtId id) const;
  /// Returns the overrides of blocks with this tag, as a range of Ast::ids.
  IdRange overridesOf(uint16_t tag) const { return tag < tag_overrides.size() ? tag_overrides[tag] : IdRange{}; }
  /// Return the index of the declaration with this name; kNoId if it does not exist.
  uint32_t findParam(std::string_view name) const;
  uint32_t findRule(std::string_view name) const;
  uint32_t findLayer(std::string_view name) const;
};

}  // namespace sgm
