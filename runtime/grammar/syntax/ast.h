#pragma once
// The syntax tree of a whole program, all files in one set of arrays. The parser sets the written part; the checker
// sets everything marked "resolved": after it no name lookup is needed. Absent indices are kNoId. Numbers are in
// metres, radians and plain ratios.

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

/// A range of one of the Ast's index arrays.
struct IdRange {
  uint32_t first = 0, count = 0;
};

enum class ExprKind : uint8_t {
  number,       ///< value, type.dim
  text,         ///< name: its content
  vector,       ///< (a, b, c) or the pair (a, b): children
  negate,       ///< children[0]
  logical_not,  ///< children[0]
  binary,       ///< children[0] binary children[1]
  conditional,  ///< if children[0] then children[1] else children[2]
  range,        ///< children[0] .. children[1], end excluded
  name,         ///< ref, id
  member,       ///< children[0] . member; replaced for `module.name` and for calls of methods
  call,         ///< ref, id, bound
  query,        ///< clear or `inside` [children[0]: radius] of name: a layer; ref, id
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

/// The meaning of a name or of the callee of a call (resolved); `id` is an index into the table named here.
enum class Ref : uint8_t {
  none,
  parameter,  ///< Program::params
  let,        ///< Program::lets; calls and plain names
  field,      ///< Program::fields; calls and plain names
  rule,       ///< Program::rules; calls only
  primitive,  ///< static_cast<uint32_t>(Primitive); calls only
  builtin,    ///< static_cast<uint32_t>(Builtin); calls; a method's receiver is bound[0]
  value,      ///< static_cast<uint32_t>(BuiltinValue): cell, scope, p, q, u
  layer,      ///< Program::layers; queries only
  local,      ///< slot of the frame of the rule alternative, let function or field that contains the name
};

enum class Member : uint8_t { none, x, y, z, other, axis, size, center, faces, from, to, along, depth };

struct ExprNode {
  ExprKind kind = ExprKind::number;
  BinaryOp binary = BinaryOp::add;
  Ref ref = Ref::none;           ///< resolved
  Member member = Member::none;  ///< resolved
  bool parenthesised = false;    ///< written in parentheses that the printer must keep
  bool shape = false;            ///< call of a rule or terminal: needs no () without arguments
  bool inside = false;           ///< query: whether all is solid; else whether all is void
  bool circular = false;         ///< resolved, call of a rule: it may lead back to the rule that contains it
  Type type;                     ///< resolved; for let functions and fields: of the last instance
  double value = 0;              ///< number
  NameId name = kNoId;           ///< name, member, text; number: as written, with its unit; call: last part
  NameId qualifier = kNoId;      ///< call and name: `rock` of rock.fbm, once resolved to a module
  uint32_t id = kNoId;           ///< resolved: see Ref
  uint32_t ordinal = 0;          ///< resolved: rand, chance: index of this draw within its rule, let or field
  IdRange children;              ///< into Ast::ids; for a call of a method: the receiver
  IdRange args;                  ///< into Ast::args: as written
  IdRange bound;                 ///< resolved, into Ast::ids: one ExprId for each parameter of the callee, in order;
                                 ///< kNoId: omitted (use BuiltinParam::fallback). Defaults of lets, fields and rules
                                 ///< are filled in. Variadic tails follow
  Span span;
};

/// An argument as written: `value` or `name value`.
struct ArgNode {
  NameId name = kNoId;
  ExprId value = kNoId;
  Span span;
};

/// The statements: stmts.def describes each.
enum class StmtKind : uint8_t {
#define SGM_STMT(kind, word, role, members) kind,
#include "grammar/syntax/stmts.def"
};

/// What a statement does with its body, and where it may stand.
enum class StmtRole : uint8_t {
  plain,
  placing,  ///< only adds its body's content: elsewhere, several times, or not at every level
  part,     ///< stands among the parts of another statement, and in no block
};

/// A line of stmts.def.
struct StmtInfo {
  std::string_view word;  ///< that begins it; empty if it begins with something else
  StmtRole role = StmtRole::plain;
  bool has_parts = false;  ///< it has parts with a child for each
};

/// In the order of StmtKind.
inline constexpr auto kStmtInfos = std::to_array<StmtInfo>({
#define PARTS || true
#define SGM_STMT(kind, word, role, members) {word, StmtRole::role, false members},
#include "grammar/syntax/stmts.def"
});

constexpr const StmtInfo& infoOf(StmtKind kind) { return kStmtInfos[static_cast<size_t>(kind)]; }
constexpr bool placesBody(StmtKind kind) { return infoOf(kind).role == StmtRole::placing; }

/// stmts.def says which statement uses which member for what.
struct StmtNode {
  StmtKind kind = StmtKind::block;
  bool power = false;        ///< morph: by exponent
  bool layer_level = false;  ///< resolved, cut and inner: cuts the domain if its rule is a layer's start
  uint16_t material = 0;     ///< resolved, block: Program::materials, 0 inherits
  uint16_t tag = 0;          ///< resolved, block: Program::tags, 0 inherits
  uint32_t ordinal = 0;      ///< resolved: index of this statement within its rule, for path keys
  ExprId expr = kNoId;
  ExprId amount = kNoId;  ///< smooth radius (length) or declared amplitude
  ExprId plan = kNoId;    ///< extrude, roof: a name
  StmtId body = kNoId;
  uint32_t slot = kNoId;  ///< resolved: let, for_each, footprint
  uint32_t extra = kNoId, extra2 = kNoId;
  NameId name = kNoId;   ///< as written: loop variable, let, footprint, mat, tag, anchor kind
  NameId name2 = kNoId;  ///< as written: anchor name
  IdRange children;      ///< into Ast::ids (StmtId)
  IdRange xforms;        ///< into Ast::xforms
  IdRange parts;         ///< into Ast::parts: as many as children
  Span span;
};

enum class XformKind : uint8_t {
  at,      ///< a: a point, or a, b, c: lengths (kNoId means 0): moves the scope
  rot,     ///< axis 0 1 2, or a: vector (any length but 0) if axis is 3; b: angle, right-handed
  scale,   ///< a: factor > 0
  size,    ///< a, b, c: the edges of the scope's box (kNoId keeps one), or a: a vector of all three
  mirror,  ///< axis 0 1 2: negates that coordinate
};

struct XformNode {
  XformKind kind = XformKind::at;
  uint8_t axis = 3;
  ExprId a = kNoId, b = kNoId, c = kNoId;  ///< resolved from args
  IdRange args;                            ///< into Ast::args: as written
  Span span;
};

enum class ScatterArea : uint8_t {
  cell,   ///< the box from the scope's origin to the cell's size; poisson only
  shell,  ///< a: radius; b: up, the share of the sphere from the top (0..1, default 1)
  box,    ///< a, b, c: edges, centred (or a: a vector)
  disc,   ///< a: radius, in the plane y = 0
};

/// Points keep the scope's axes. With probe: the point moves to the first surface of the layer within the distance; it
/// is dropped if there is none, or if it does not start in the void. With gap: the body gets the distance from there
/// through the void to the next surface in the opposite direction; a point where this exceeds `within` is dropped.
struct ScatterNode {
  bool poisson = false;
  ExprId count = kNoId;  ///< a count, or the least distance with poisson
  ScatterArea area = ScatterArea::cell;
  ExprId a = kNoId, b = kNoId, c = kNoId;  ///< resolved from args
  IdRange args;                            ///< into Ast::args: as written
  int probe = 0;                           ///< 0 none, 1 up (+y), -1 down
  ExprId distance = kNoId;
  NameId layer_name = kNoId;
  uint32_t layer = kNoId;  ///< resolved: Program::layers
  NameId gap = kNoId;      ///< the name of that distance, or none
  uint32_t slot = kNoId;   ///< its slot among the locals
  ExprId within = kNoId;
  ExprId when = kNoId;  ///< evaluated for each point, with its own random draws
  Span span;
};

/// The parts of a box for `comp`, seen from the front, which is +z.
enum class BoxPart : uint8_t {
  front,   ///< +z
  right,   ///< +x
  back,    ///< -z
  left,    ///< -x
  top,     ///< +y
  bottom,  ///< -y
  side,    ///< those of the first four without a part of their own
  edges,   ///< the four parallel to y
  inside,  ///< the box itself
};

/// The parts of a treemap.
enum class FloorPart : uint8_t {
  room,
  corridor,  ///< derived in each stretch of it
  facade,    ///< at each outer wall of a room
  link,      ///< a statement of that kind
};

/// A part of a split, a comp, a treemap or a wfc.
struct PartNode {
  ExprId size = kNoId;          ///< of a split: a length, or a share of the scope; of a room or a tile: its weight
  bool flexible = false;        ///< of a split: the length is a weight for the space that the others leave
  bool repeated = false;        ///< of a split: in the repeated group, which is one run of parts
  bool relative = false;        ///< resolved, of a split: size is a share
  BoxPart of = BoxPart::front;  ///< of a comp
  FloorPart floor = FloorPart::room;  ///< of a treemap
  NameId label = kNoId;               ///< of a room or a tile
  uint32_t tile = kNoId;              ///< of a wfc: Ast::tiles
  uint16_t tag = 0;                   ///< resolved, of a room: Program::tags
  Span span;
  Span group;  ///< if repeated: of the whole group
};

enum class Outline : uint8_t {
  rect,     ///< bound: edges along x and z
  regular,  ///< bound: number of corners, radius to them
  polygon,  ///< bound: corners, pairs of x and z
};

struct FootprintNode {
  Outline outline = Outline::rect;
  ExprId count = kNoId;  ///< merge, or kNoId: one piece
  IdRange args;          ///< into Ast::args: as written
  IdRange bound;         ///< resolved, into Ast::ids; evaluated for each piece, with its own random draws
  Span span;             ///< of the outline
};

enum class RoofForm : uint8_t { flat, gable, hip };

struct RoofNode {
  RoofForm form = RoofForm::flat;
  ExprId measure = kNoId;   ///< resolved: flat: the height, else the pitch
  ExprId overhang = kNoId;  ///< resolved, or kNoId: 0
  IdRange args;             ///< into Ast::args: as written
};

/// A part of an asset, along an axis from the low end of its box.
struct FitZoneNode {
  uint8_t axis = 0;      ///< 0 1 2
  bool repeats = false;  ///< otherwise it is stretched
  ExprId from = kNoId, to = kNoId;
  Span span;
};

struct FitNode {
  uint32_t asset = kNoId;  ///< resolved: Program::assets
  IdRange zones;           ///< into Ast::fit_zones
  Span name_span;
};

/// Lengths; resolved, or kNoId.
struct TreemapNode {
  IdRange args;  ///< into Ast::args: as written
  ExprId wall = kNoId, door = kNoId, height = kNoId, corridor = kNoId;
};

struct LinkNode {
  IdRange args;                          ///< into Ast::args: as written; empty if the treemap gives the width of doors
  uint32_t a = 0, b = 0;                 ///< resolved: indices among the rooms of the treemap
  ExprId width = kNoId, height = kNoId;  ///< resolved, or kNoId: as in the treemap
};

/// One side of a tile or of the border, as written.
struct SocketNode {
  BoxPart of = BoxPart::front;  ///< front to bottom, or side
  IdRange labels;               ///< into Ast::ids (NameId): its labels
  IdRange meets;                ///< the same: the labels it meets; empty: its own
  Span span;
};

/// The labels of a side and those it meets, a bit for each label; all bits for an unwritten side.
struct SideKind {
  uint64_t labels = ~uint64_t{0}, meets = ~uint64_t{0};

  friend bool operator==(const SideKind&, const SideKind&) = default;
  bool any() const { return ~labels == 0; }
  bool fits(const SideKind& other) const { return (labels & other.meets) != 0 && (other.labels & meets) != 0; }
};

/// A tile of a wfc, or its border.
struct TileNode {
  bool turns = false;              ///< may be rotated by any number of quarter turns about y
  IdRange sockets;                 ///< into Ast::sockets: as written
  std::array<uint8_t, 6> sides{};  ///< resolved, in the order of BoxPart: indices of their kinds
};

/// Resolved.
struct WaveNode {
  IdRange labels;  ///< into Ast::ids (NameId): in the order of their bits
  IdRange kinds;   ///< into Ast::side_kinds
};

/// A parameter of a rule, let function or field.
struct FormalNode {
  NameId name = kNoId;
  ExprId fallback = kNoId;                     ///< written default
  ExprId low_expr = kNoId, high_expr = kNoId;  ///< written range; the first of a rule's heads applies
  Type type;                                   ///< resolved for rules
  uint32_t slot = kNoId;  ///< resolved: its slot in the frame; for rules, lets and global fields: its position
  bool ranged = false;    ///< resolved: a number of `dim` from `low` to `high`, ends included
  Dim dim;
  double low = 0, high = 0;
  Span span;
};

/// A comment, kept for the printer.
struct Comment {
  uint32_t begin = 0, end = 0;
  int line = 0;
  bool own_line = false;  ///< nothing precedes it on its line
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
