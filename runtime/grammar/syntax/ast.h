#pragma once
// The syntax tree of a whole program: the nodes of all files, in common arrays. The parser sets what the text says; the
// checker sets the members marked "set by the checker", after which no name lookup is needed. Absent indices are kNoId.
// Numbers are in metres, radians and plain ratios.

#include <array>
#include <cstdint>
#include <deque>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax/builtins.h"
#include "grammar/syntax/units.h"
#include "grammar/text/diagnostics.h"

namespace sgm {

inline constexpr uint32_t kNoId = 0xFFFFFFFFu;
using ExprId = uint32_t;  ///< index of an expression in Ast::exprs
using StmtId = uint32_t;  ///< index of a statement in Ast::stmts
using NameId = uint32_t;  ///< index of a name in Ast::names

/// A range of elements in one of the Ast's arrays.
struct IdRange {
  uint32_t first = 0, count = 0;
};

enum class ExprKind : uint8_t {
  number,       ///< a literal; uses value and type.dim
  text,         ///< a text constant; its content is `name`
  vector,       ///< the vector (a, b, c) or the pair (a, b); uses children
  negate,       ///< children[0]
  logical_not,  ///< children[0]
  binary,       ///< a binary operation: children[0] and children[1], joined by the operator `binary`
  conditional,  ///< if children[0] then children[1] else children[2]
  range,        ///< children[0] .. children[1], end excluded
  name,         ///< a name with the meaning `ref` and `id`
  member,       ///< children[0] . member; `module.name` and method calls become `name` and `call` nodes instead
  call,         ///< a call; uses ref, id and bound
  query,        ///< `clear R of LAYER` or `inside R of LAYER`; children[0]: R, which may be omitted; uses ref, id
};

enum class BinaryOp : uint8_t {
  add,
  subtract,
  multiply,
  divide,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or
};

/// The meaning of a name, or of the callee of a call; set by the checker. ExprNode::id is an index into the table named
/// here.
enum class Ref : uint8_t {
  none,
  parameter,  ///< Program::params
  let,        ///< index into Program::lets; for calls and plain names
  field,      ///< index into Program::fields; for calls and plain names
  rule,       ///< index into Program::rules; only for calls
  primitive,  ///< a value of Primitive; only for calls
  builtin,    ///< a value of Builtin; for calls. The receiver of a method is bound[0]
  value,      ///< a value of BuiltinValue: cell, scope, p, q, u
  layer,      ///< index into Program::layers; only for queries
  local,      ///< index of a slot in the frame of the rule alternative, let function or field that contains the name
};

enum class Member : uint8_t { none, x, y, z, other, axis, size, center, faces, from, to, along, depth };

struct ExprNode {
  ExprKind kind = ExprKind::number;
  BinaryOp binary = BinaryOp::add;
  Ref ref = Ref::none;           ///< set by the checker: the kind of thing that `id` refers to
  Member member = Member::none;  ///< set by the checker: the member after the dot
  bool parenthesised = false;    ///< true: the text has parentheses around the expression, which the printer must keep
  bool shape = false;  ///< true: a call of a rule or primitive, so that () may be omitted if there are no arguments
  /// query: `inside` tests that the whole ball is solid; otherwise `clear` tests that all of it is void
  bool inside = false;
  /// for a call of a rule, set by the checker: the callee may, directly or indirectly, call the rule that contains this
  /// call
  bool circular = false;
  /// set by the checker; in the bodies of let functions and fields, which are checked several times: the type in the
  /// last check
  Type type;
  double value = 0;  ///< of a number
  /// name, member: the word; text: the content; number: as written, with its unit; call: the callee's last word
  NameId name = kNoId;
  /// for a call or a name: the module before the dot, such as `rock` in rock.fbm; set by the checker
  NameId qualifier = kNoId;
  uint32_t id = kNoId;   ///< set by the checker: an index into the table that `ref` selects (see Ref)
  uint32_t ordinal = 0;  ///< for rand and chance, set by the checker: index of this call within its rule, let or field
  IdRange children;      ///< the operands, a range of Ast::ids; for a method call: the receiver
  IdRange args;          ///< the arguments as written: a range of Ast::args
  /// set by the checker, a range of Ast::ids: one ExprId for each parameter of the callee, in order, then variadic
  /// arguments. kNoId: omitted (use BuiltinParam::fallback); defaults of lets, fields and rules are already filled in
  IdRange bound;
  Span span;
};

/// An argument as written: `value` or `name value`.
struct ArgNode {
  NameId name = kNoId;
  ExprId value = kNoId;
  Span span;
};

/// All kinds of statements; stmts.def describes each.
enum class StmtKind : uint8_t {
#define SGM_STMT(kind, word, role, members) kind,
#include "grammar/syntax/stmts.def"
};

/// The relation of a statement to its body, and where the statement may stand.
enum class StmtRole : uint8_t {
  plain,
  placing,  ///< the statement adds only its body's content, which it moves, repeats, or derives only at some levels
  part,     ///< the statement stands only among the parts of a treemap or a wfc, never in a block
};

/// The properties of a kind of statement, from stmts.def.
struct StmtInfo {
  std::string_view word;  ///< the word that starts a statement of this kind; empty if there is none
  StmtRole role = StmtRole::plain;
  bool has_parts = false;  ///< the statement has parts, with one child each
};

/// The properties of all kinds of statements, indexed by StmtKind.
inline constexpr auto kStmtInfos = std::to_array<StmtInfo>({
#define PARTS || true
#define SGM_STMT(kind, word, role, members) {word, StmtRole::role, false members},
#include "grammar/syntax/stmts.def"
});

constexpr const StmtInfo& infoOf(StmtKind kind) { return kStmtInfos[static_cast<size_t>(kind)]; }
constexpr bool placesBody(StmtKind kind) { return infoOf(kind).role == StmtRole::placing; }

/// The meaning of each member depends on the kind of statement; see stmts.def.
struct StmtNode {
  StmtKind kind = StmtKind::block;
  bool power = false;  ///< for a morph: by the exponent of a superquadric instead of linear interpolation
  /// for cut and inner, set by the checker: the statement stands at the top level of its body, so that a cut there
  /// removes from the domain if the rule is a layer's start
  bool layer_level = false;
  uint16_t material = 0;  ///< for a block, set by the checker: index in Program::materials; 0: inherited
  uint16_t tag = 0;       ///< for a block, set by the checker: index in Program::tags; 0: inherited
  uint32_t ordinal = 0;   ///< set by the checker: index of this statement within its rule, part of the path keys of
                          ///< random draws
  ExprId expr = kNoId;
  /// radius of a smooth union, cut or meet (length), or the declared amplitude of a displace or warp
  ExprId amount = kNoId;
  ExprId plan = kNoId;  ///< extrude, roof: the name of a footprint
  StmtId body = kNoId;
  /// for let, for_each and footprint, set by the checker: slot in the frame for the declared name's value
  uint32_t slot = kNoId;
  uint32_t extra = kNoId, extra2 = kNoId;
  /// the name as written: of a loop variable, a let, a footprint, a material, a tag or a kind of anchor
  NameId name = kNoId;
  NameId name2 = kNoId;  ///< the name of an anchor, as written
  IdRange children;      ///< child statements: a range of Ast::ids
  IdRange xforms;        ///< transforms of the scope: a range of Ast::xforms
  IdRange parts;         ///< a range of Ast::parts, with one part for each child
  Span span;
};

enum class XformKind : uint8_t {
  at,      ///< a: a point, or a, b, c: lengths (kNoId means 0): moves the scope
  rot,     ///< axis 0 1 2 (x y z); or 3: `a` is the axis, a vector that is not 0. b: angle, right-handed
  scale,   ///< a: factor > 0
  size,    ///< a, b, c: the edges of the scope's box (kNoId: unchanged), or a: a vector of all three
  mirror,  ///< axis 0 1 2: negates that coordinate
};

struct XformNode {
  XformKind kind = XformKind::at;
  uint8_t axis = 3;
  ExprId a = kNoId, b = kNoId, c = kNoId;  ///< the values of the parameters, which the checker finds in `args`
  IdRange args;                            ///< the arguments as written: a range of Ast::args
  Span span;
};

enum class ScatterArea : uint8_t {
  cell,   ///< the grammar cell: the points of a layer-wide point set that lie in the cell; only for poisson
  shell,  ///< a: radius of a sphere; b: `up`, the fraction of the sphere's area, from the top (0..1, default 1)
  box,    ///< a, b, c: edges, centred (or a: a vector)
  disc,   ///< a: radius, in the plane y = 0
};

/// A point set; the body is derived at each point, with the scope's axes. With `probe`, each point moves up or down to
/// the first surface of the layer within `distance`; a point that starts in solid, or that finds no surface, is
/// dropped. With `gap`, the body also receives the free distance from that surface to the next surface in the opposite
/// direction; points at which this distance exceeds `within` are dropped.
struct ScatterNode {
  bool poisson = false;
  ExprId count = kNoId;  ///< the number of points; for poisson: the minimum distance between them
  ScatterArea area = ScatterArea::cell;
  ExprId a = kNoId, b = kNoId, c = kNoId;  ///< the values of the parameters, which the checker finds in `args`
  IdRange args;                            ///< the arguments as written: a range of Ast::args
  int probe = 0;                           ///< 0: no probe, 1: upwards (+y), -1: downwards
  ExprId distance = kNoId;
  NameId layer_name = kNoId;
  uint32_t layer = kNoId;  ///< set by the checker: index in Program::layers
  NameId gap = kNoId;      ///< the name by which the body refers to the gap's distance; kNoId: no gap
  uint32_t slot = kNoId;   ///< set by the checker: slot in the frame for the gap's distance
  ExprId within = kNoId;
  ExprId when = kNoId;  ///< the condition, which is evaluated for each point with separate random draws; kNoId: true
  Span span;
};

/// The parts of a scope's box for `comp`; the front is +z.
enum class BoxPart : uint8_t {
  front,   ///< +z
  right,   ///< +x
  back,    ///< -z
  left,    ///< -x
  top,     ///< +y
  bottom,  ///< -y
  side,    ///< each of front, right, back and left that has no part of its own
  edges,   ///< the four edges parallel to y
  inside,  ///< the scope of the box itself, not a face
};

/// The kinds of parts of a treemap.
enum class FloorPart : uint8_t {
  room,
  corridor,  ///< derived once in each straight stretch of the corridor
  facade,    ///< derived once for each outer wall of a room
  link,      ///< a `link` statement
};

/// A part of a split, a comp, a treemap or a wfc.
struct PartNode {
  ExprId size = kNoId;    ///< split: a length, or a fraction of the scope; room or tile: its weight
  bool flexible = false;  ///< split: the length is a weight in the division of the remaining space
  bool repeated = false;  ///< split: the part belongs to the repeated group, which is one run of consecutive parts
  bool relative = false;  ///< for a split, set by the checker: size is a fraction of the scope
  BoxPart of = BoxPart::front;        ///< comp: the part of the box
  FloorPart floor = FloorPart::room;  ///< treemap: the kind of the part
  NameId label = kNoId;               ///< treemap, wfc: the name of a room or a tile
  uint32_t tile = kNoId;              ///< wfc: index in Ast::tiles
  uint16_t tag = 0;                   ///< for a room of a treemap, set by the checker: index in Program::tags
  Span span;
  Span group;  ///< if repeated: span of the whole group
};

enum class Outline : uint8_t {
  rect,     ///< a rectangle; `bound`: its edges along x and z
  regular,  ///< a regular polygon; `bound`: the number of corners, and the radius to the corners
  polygon,  ///< a polygon; `bound`: its corners, as pairs of x and z
};

struct FootprintNode {
  Outline outline = Outline::rect;
  ExprId count = kNoId;  ///< the number of merged pieces (`merge`); kNoId: one piece
  IdRange args;          ///< the arguments as written: a range of Ast::args
  /// set by the checker: the arguments by parameter, a range of Ast::ids. They are evaluated again for each piece, with
  /// new random draws
  IdRange bound;
  Span span;  ///< span of the outline in the text
};

enum class RoofForm : uint8_t { flat, gable, hip };

struct RoofNode {
  RoofForm form = RoofForm::flat;
  ExprId measure = kNoId;   ///< set by the checker: the height of a flat roof, the pitch of a gable or hip roof
  ExprId overhang = kNoId;  ///< set by the checker; kNoId: no overhang
  IdRange args;             ///< the arguments as written: a range of Ast::args
};

/// An interval along one axis of an asset, which is repeated or stretched when the asset is fitted into a scope. The
/// ends are measured from the low end of the asset's box.
struct FitZoneNode {
  uint8_t axis = 0;      ///< 0 1 2 (x y z)
  bool repeats = false;  ///< true: the zone is repeated to fill the scope; false: it is stretched
  ExprId from = kNoId, to = kNoId;
  Span span;
};

struct FitNode {
  uint32_t asset = kNoId;  ///< set by the checker: index in Program::assets
  IdRange zones;           ///< the adaptable intervals of the asset: a range of Ast::fit_zones
  Span name_span;
};

/// The lengths that a treemap uses, such as the width of its doors. Set by the checker; kNoId if omitted.
struct TreemapNode {
  IdRange args;  ///< the arguments as written: a range of Ast::args
  ExprId wall = kNoId, door = kNoId, height = kNoId, corridor = kNoId;
};

struct LinkNode {
  IdRange args;  ///< the arguments as written, a range of Ast::args; if empty, the treemap's width of doors applies
  uint32_t a = 0, b = 0;  ///< set by the checker: the joined rooms, as indices among the rooms of the treemap
  /// set by the checker; kNoId: the width or height of the treemap's doors applies
  ExprId width = kNoId, height = kNoId;
};

/// The labels of one side of a tile or of a wfc's border, as written.
struct SocketNode {
  /// the side: BoxPart::front, right, back, left, top or bottom; or BoxPart::side for all four upright sides
  BoxPart of = BoxPart::front;
  IdRange labels;  ///< into Ast::ids (NameId): the labels of this side
  IdRange meets;   ///< into Ast::ids (NameId): labels that this side may touch; empty: those in `labels`
  Span span;
};

/// A side's labels and the labels that it may touch, one bit per label; a side that is not written has all bits set.
struct SideKind {
  uint64_t labels = ~uint64_t{0}, meets = ~uint64_t{0};

  friend bool operator==(const SideKind&, const SideKind&) = default;
  bool any() const { return ~labels == 0; }
  bool fits(const SideKind& other) const { return (labels & other.meets) != 0 && (other.labels & meets) != 0; }
};

/// A tile of a wfc, or the border of a wfc.
struct TileNode {
  bool turns = false;  ///< true: the tile may be rotated by any number of quarter turns about y
  IdRange sockets;     ///< the sides as written: a range of Ast::sockets
  /// set by the checker, in the order of BoxPart: index of each side's kind in WaveNode::kinds
  std::array<uint8_t, 6> sides{};
};

/// The labels of a wfc; set by the checker.
struct WaveNode {
  IdRange labels;  ///< into Ast::ids (NameId): the label of each bit of SideKind
  IdRange kinds;   ///< into Ast::side_kinds: the distinct sides of all tiles and the border
};

/// A parameter of a rule, let function or field.
struct FormalNode {
  NameId name = kNoId;
  ExprId fallback = kNoId;  ///< the default value, as written
  /// the range as written; if a rule has several heads, the first head's ranges apply
  ExprId low_expr = kNoId, high_expr = kNoId;
  Type type;  ///< set by the checker, only for formals of rules
  /// set by the checker: slot in the frame; for rules, lets and global fields equal to the formal's position
  uint32_t slot = kNoId;
  /// set by the checker: a range is declared, in which values of dimension `dim` must lie, from `low` to `high`, ends
  /// included
  bool ranged = false;
  Dim dim;
  double low = 0, high = 0;
  Span span;
};

/// A comment in the text, stored so that the printer can reproduce it.
struct Comment {
  uint32_t begin = 0, end = 0;
  int line = 0;
  bool own_line = false;  ///< true: only white space precedes the comment on its line
};

struct Ast {
  std::pmr::vector<ExprNode> exprs;
  std::pmr::vector<StmtNode> stmts;
  std::pmr::vector<XformNode> xforms;
  std::pmr::vector<ScatterNode> scatters;
  std::pmr::vector<PartNode> parts;
  std::pmr::vector<TreemapNode> treemaps;
  std::pmr::vector<LinkNode> links;
  std::pmr::vector<SocketNode> sockets;
  std::pmr::vector<TileNode> tiles;
  std::pmr::vector<WaveNode> waves;
  std::pmr::vector<SideKind> side_kinds;
  std::pmr::vector<FootprintNode> footprints;
  std::pmr::vector<RoofNode> roofs;
  std::pmr::vector<FitNode> fits;
  std::pmr::vector<FitZoneNode> fit_zones;
  std::pmr::vector<ArgNode> args;
  std::pmr::vector<FormalNode> formals;
  std::pmr::vector<uint32_t> ids;
  std::pmr::deque<std::pmr::string> names;  ///< a deque, since views of names must stay valid when names are added

  explicit Ast(std::pmr::memory_resource* memory)
      : exprs(memory),
        stmts(memory),
        xforms(memory),
        scatters(memory),
        parts(memory),
        treemaps(memory),
        links(memory),
        sockets(memory),
        tiles(memory),
        waves(memory),
        side_kinds(memory),
        footprints(memory),
        roofs(memory),
        fits(memory),
        fit_zones(memory),
        args(memory),
        formals(memory),
        ids(memory),
        names(memory) {}
};

}  // namespace sgm
