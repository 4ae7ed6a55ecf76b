#pragma once
// The syntax tree of a whole program: the nodes of all files, in common arrays. The parser sets what the text says; the
// checker sets the members marked "resolved", after which no name lookup is needed. Absent indices are kNoId. Numbers
// are in metres, radians and plain ratios.

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
using ExprId = uint32_t;  ///< into Ast::exprs
using StmtId = uint32_t;  ///< into Ast::stmts
using NameId = uint32_t;  ///< into Ast::names

/// A range of elements in one of the Ast's arrays.
struct IdRange {
  uint32_t first = 0, count = 0;
};

enum class ExprKind : uint8_t {
  number,       ///< uses value, type.dim
  text,         ///< uses name: the text's content
  vector,       ///< (a, b, c) or the pair (a, b): children
  negate,       ///< children[0]
  logical_not,  ///< children[0]
  binary,       ///< children[0] binary children[1]
  conditional,  ///< if children[0] then children[1] else children[2]
  range,        ///< children[0] .. children[1], end excluded
  name,         ///< uses ref, id
  member,       ///< children[0] . member; `module.name` and method calls become `name` and `call` nodes instead
  call,         ///< uses ref, id, bound
  query,        ///< clear [children[0]: radius] of LAYER, or inside [radius] of LAYER; uses ref, id
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

/// The meaning of a name, or of the callee of a call (resolved). ExprNode::id is an index into the table named here.
enum class Ref : uint8_t {
  none,
  parameter,  ///< Program::params
  let,        ///< Program::lets; for calls and plain names
  field,      ///< Program::fields; for calls and plain names
  rule,       ///< Program::rules; only for calls
  primitive,  ///< static_cast<uint32_t>(Primitive); only for calls
  builtin,    ///< static_cast<uint32_t>(Builtin); for calls; of a method, bound[0] is the receiver
  value,      ///< static_cast<uint32_t>(BuiltinValue): cell, scope, p, q, u
  layer,      ///< Program::layers; only for queries
  local,      ///< index of a slot in the frame of the rule alternative, let function or field that contains the name
};

enum class Member : uint8_t { none, x, y, z, other, axis, size, center, faces, from, to, along, depth };

struct ExprNode {
  ExprKind kind = ExprKind::number;
  BinaryOp binary = BinaryOp::add;
  Ref ref = Ref::none;           ///< resolved
  Member member = Member::none;  ///< resolved
  bool parenthesised = false;    ///< written in parentheses that the printer must keep
  bool shape = false;  ///< call of a rule or primitive, which may be written without () if it has no arguments
  /// query: `inside` tests that the whole ball is solid; otherwise `clear` tests that all of it is void
  bool inside = false;
  /// resolved, call of a rule: the callee may, directly or indirectly, call the rule that contains this call
  bool circular = false;
  /// resolved; in the bodies of let functions and fields, which are checked several times: the type in the last check
  Type type;
  double value = 0;  ///< of a number
  /// name, member: the word; text: the content; number: as written, with its unit; call: the callee's last word
  NameId name = kNoId;
  NameId qualifier = kNoId;  ///< call and name: `rock` of rock.fbm, after the checker has found that it is a module
  uint32_t id = kNoId;       ///< resolved: see Ref
  uint32_t ordinal = 0;      ///< resolved; for rand and chance: index of this call within its rule, let or field
  IdRange children;          ///< into Ast::ids; of a method call: the receiver
  IdRange args;              ///< into Ast::args: the arguments as written
  /// resolved, into Ast::ids: one ExprId for each parameter of the callee, in order, then variadic arguments. kNoId:
  /// omitted (use BuiltinParam::fallback); defaults of lets, fields and rules are already filled in
  IdRange bound;
  Span span;
};

/// An argument as written: `value` or `name value`.
struct ArgNode {
  NameId name = kNoId;
  ExprId value = kNoId;
  Span span;
};

/// The kinds of statements; stmts.def describes each.
enum class StmtKind : uint8_t {
#define SGM_STMT(kind, word, role, members) kind,
#include "grammar/syntax/stmts.def"
};

/// The relation of a statement to its body, and where the statement may stand.
enum class StmtRole : uint8_t {
  plain,
  placing,  ///< adds only its body's content: moved, repeated, or only at some levels
  part,     ///< stands only among the parts of a treemap or a wfc, never in a block
};

/// The properties of a kind of statement, from stmts.def.
struct StmtInfo {
  std::string_view word;  ///< the word that starts the statement; empty if there is no such word
  StmtRole role = StmtRole::plain;
  bool has_parts = false;  ///< the statement has parts, with one child each
};

/// In the order of StmtKind.
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
  bool power = false;  ///< morph: by exponent instead of linear interpolation
  /// resolved, cut and inner: the cut removes from the domain if the rule is a layer's start
  bool layer_level = false;
  uint16_t material = 0;  ///< resolved, block: index in Program::materials; 0: inherited
  uint16_t tag = 0;       ///< resolved, block: index in Program::tags; 0: inherited
  uint32_t ordinal = 0;   ///< resolved: index of this statement within its rule, part of path keys
  ExprId expr = kNoId;
  /// radius of a smooth union, cut or meet (length), or the declared amplitude of a displace or warp
  ExprId amount = kNoId;
  ExprId plan = kNoId;  ///< extrude, roof: the name of a footprint
  StmtId body = kNoId;
  uint32_t slot = kNoId;  ///< resolved; let, for_each, footprint: frame slot of the declared name
  uint32_t extra = kNoId, extra2 = kNoId;
  NameId name = kNoId;   ///< as written: loop variable, let, footprint, mat, tag, anchor kind
  NameId name2 = kNoId;  ///< as written: anchor name
  IdRange children;      ///< into Ast::ids: child statements
  IdRange xforms;        ///< into Ast::xforms
  IdRange parts;         ///< into Ast::parts: one for each child
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
  ExprId a = kNoId, b = kNoId, c = kNoId;  ///< resolved from `args`
  IdRange args;                            ///< into Ast::args: the arguments as written
  Span span;
};

enum class ScatterArea : uint8_t {
  cell,   ///< the box between the scope's origin and the edges of the cell; only for poisson
  shell,  ///< a: radius of a sphere; b: `up`, the fraction of the sphere's area, from the top (0..1, default 1)
  box,    ///< a, b, c: edges, centred (or a: a vector)
  disc,   ///< a: radius, in the plane y = 0
};

/// A point set; the body is derived at each point, with the scope's axes. With `probe`, each point moves up or down to
/// the first surface of the layer within `distance`; a point that starts in solid, or that finds no surface, is
/// dropped. With `gap`, the free distance from there in the opposite direction to the next surface is passed to the
/// body; points where it exceeds `within` are dropped.
struct ScatterNode {
  bool poisson = false;
  ExprId count = kNoId;  ///< the number of points; for poisson: the minimum distance between them
  ScatterArea area = ScatterArea::cell;
  ExprId a = kNoId, b = kNoId, c = kNoId;  ///< resolved from `args`
  IdRange args;                            ///< into Ast::args: the arguments as written
  int probe = 0;                           ///< 0: no probe, 1: upwards (+y), -1: downwards
  ExprId distance = kNoId;
  NameId layer_name = kNoId;
  uint32_t layer = kNoId;  ///< resolved: Program::layers
  NameId gap = kNoId;      ///< the name by which the body refers to the gap's distance; kNoId: no gap
  uint32_t slot = kNoId;   ///< resolved: frame slot of that name
  ExprId within = kNoId;
  ExprId when = kNoId;  ///< condition, evaluated for each point with its own random draws; kNoId: true
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
  side,    ///< those of front, right, back and left that have no part of their own
  edges,   ///< the four edges parallel to y
  inside,  ///< the box itself
};

/// The parts of a treemap.
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
  bool relative = false;  ///< resolved, split: size is a fraction of the scope
  BoxPart of = BoxPart::front;        ///< comp: which part of the box
  FloorPart floor = FloorPart::room;  ///< treemap: the kind of part
  NameId label = kNoId;               ///< treemap, wfc: the name of a room or a tile
  uint32_t tile = kNoId;              ///< wfc: index in Ast::tiles
  uint16_t tag = 0;                   ///< resolved, room of a treemap: index in Program::tags
  Span span;
  Span group;  ///< if repeated: span of the whole group
};

enum class Outline : uint8_t {
  rect,     ///< bound: edges along x and z
  regular,  ///< bound: number of corners, radius to the corners
  polygon,  ///< bound: the corners, as pairs of x and z
};

struct FootprintNode {
  Outline outline = Outline::rect;
  ExprId count = kNoId;  ///< the number of merged pieces (`merge`); kNoId: one piece
  IdRange args;          ///< into Ast::args: the arguments as written
  IdRange bound;         ///< resolved, into Ast::ids; evaluated again for each piece, with new random draws
  Span span;             ///< of the outline
};

enum class RoofForm : uint8_t { flat, gable, hip };

struct RoofNode {
  RoofForm form = RoofForm::flat;
  ExprId measure = kNoId;   ///< resolved; flat: the height; gable, hip: the pitch
  ExprId overhang = kNoId;  ///< resolved; kNoId: 0
  IdRange args;             ///< into Ast::args: the arguments as written
};

/// An interval of an asset along one axis, measured from the low end of its box, that adapts when the asset is fitted.
struct FitZoneNode {
  uint8_t axis = 0;      ///< 0 1 2 (x y z)
  bool repeats = false;  ///< the zone is repeated to fill the scope; otherwise it is stretched
  ExprId from = kNoId, to = kNoId;
  Span span;
};

struct FitNode {
  uint32_t asset = kNoId;  ///< resolved: Program::assets
  IdRange zones;           ///< into Ast::fit_zones
  Span name_span;
};

/// The lengths of a treemap; resolved, or kNoId if omitted.
struct TreemapNode {
  IdRange args;  ///< into Ast::args: the arguments as written
  ExprId wall = kNoId, door = kNoId, height = kNoId, corridor = kNoId;
};

struct LinkNode {
  IdRange args;                          ///< into Ast::args: as written; empty: the treemap's width of doors applies
  uint32_t a = 0, b = 0;                 ///< resolved: indices among the rooms of the treemap
  ExprId width = kNoId, height = kNoId;  ///< resolved, or kNoId: that of the treemap applies
};

/// The labels of one side of a tile or of a wfc's border, as written.
struct SocketNode {
  BoxPart of = BoxPart::front;  ///< front to bottom, or side (all four upright sides)
  IdRange labels;               ///< into Ast::ids (NameId): the labels of this side
  IdRange meets;                ///< into Ast::ids (NameId): labels that this side may touch; empty: those in `labels`
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
  bool turns = false;              ///< may be rotated by any number of quarter turns about y
  IdRange sockets;                 ///< into Ast::sockets: the sides as written
  std::array<uint8_t, 6> sides{};  ///< resolved, in the order of BoxPart: index of each side's kind in WaveNode::kinds
};

/// The labels of a wfc; resolved.
struct WaveNode {
  IdRange labels;  ///< into Ast::ids (NameId): the label of each bit of SideKind
  IdRange kinds;   ///< into Ast::side_kinds: the distinct sides of all tiles and the border
};

/// A parameter of a rule, let function or field.
struct FormalNode {
  NameId name = kNoId;
  ExprId fallback = kNoId;  ///< the default as written
  /// the range as written; if a rule has several heads, the first head's ranges apply
  ExprId low_expr = kNoId, high_expr = kNoId;
  Type type;  ///< resolved; only for rules
  /// resolved: slot in the frame; for rules, lets and global fields equal to the formal's position
  uint32_t slot = kNoId;
  /// resolved: a range is declared, in which values of dimension `dim` must lie: from `low` to `high`, ends included
  bool ranged = false;
  Dim dim;
  double low = 0, high = 0;
  Span span;
};

/// A comment in the text, stored so that the printer can reproduce it.
struct Comment {
  uint32_t begin = 0, end = 0;
  int line = 0;
  bool own_line = false;  ///< only white space precedes it on its line
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
