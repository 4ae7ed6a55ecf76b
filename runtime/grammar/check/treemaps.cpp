// Checks the rooms and doors of the statement treemap.

#include <algorithm>

#include "grammar/check/arguments.h"
#include "grammar/check/leaf_statements.h"
#include "grammar/syntax/scope_parts.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Resolves the rooms of a link, and checks the measures of its door. Returns whether the link joins two different
/// rooms.
bool checkDoor(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s,
               const std::vector<NameId>& rooms) {
  LinkNode& link = check.program.ast.links[s.extra];
  for (const auto& [name, number] : {std::pair{s.name, &link.a}, std::pair{s.name2, &link.b}}) {
    const auto room = std::find(rooms.begin(), rooms.end(), name);
    if (room == rooms.end() && symbols.mayBeLost(types.scope().module, name)) return false;
    if (room == rooms.end()) {
      Suggestion suggestion(check.text(name));
      for (const NameId known : rooms) suggestion.offer(check.text(known));
      check.sink.error(s.span, codes::kUnknownName, join({"this treemap has no room `", check.text(name), "`"}),
                       suggestion.hintOr("name two of its rooms"));
      return false;
    }
    *number = static_cast<uint32_t>(room - rooms.begin());
  }
  const bool two = link.a != link.b;
  if (!two) check.sink.error(s.span, codes::kWrongUse, "a door leads from one room to another", "name two rooms");
  ExprId out[2] = {kNoId, kNoId};
  if (!bindWords(check, link.args, s.span, "door", {"width", "height"}, 0, out)) return two;
  types.requireRange(out[0], kLength, "the width of a door", kDoorRange);
  types.requireRange(out[1], kLength, "the height of a door", kDoorHeightRange);
  link.width = out[0];
  link.height = out[1];
  return two;
}

}  // namespace

void checkRooms(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s) {
  ExprId out[4] = {kNoId, kNoId, kNoId, kNoId};
  TreemapNode& treemap = check.program.ast.treemaps[s.extra];
  if (bindWords(check, treemap.args, s.span, "treemap", {"wall", "door", "height", "corridor"}, 0, out)) {
    types.requireRange(out[0], kLength, "the thickness of walls", kWallRange);
    types.requireRange(out[1], kLength, "the width of doors", kDoorRange);
    types.requireRange(out[2], kLength, "the height of doors", kDoorHeightRange);
    types.requireRange(out[3], kLength, "the width of a corridor", kCorridorRange);
    treemap.wall = out[0];
    treemap.door = out[1];
    treemap.height = out[2];
    treemap.corridor = out[3];
  }
  std::vector<NameId> rooms;
  int corridors = 0, facades = 0;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    PartNode& part = check.program.ast.parts[s.parts.first + i];
    if (part.floor == FloorPart::room) {
      types.requireRange(part.size, kRatio, "the area of a room", kRoomAreaRange);
      part.tag = check.tableIndex(check.program.tags, part.label, part.span);
      if (std::find(rooms.begin(), rooms.end(), part.label) != rooms.end())
        check.sink.error(part.span, codes::kDuplicate,
                         join({"this treemap has a second room `", check.text(part.label), "`"}),
                         "give each room a name of its own");
      rooms.push_back(part.label);
    }
    if ((part.floor == FloorPart::corridor && corridors++ > 0) || (part.floor == FloorPart::facade && facades++ > 0))
      check.sink.error(
          part.span, codes::kDuplicate,
          join({"`", part.floor == FloorPart::corridor ? "corridor" : "facade", "` stands twice in this treemap"}),
          "put both into one block after it");
  }
  if ((rooms.empty() && !check.isLossy(s)) || rooms.size() > kMaxRooms)
    check.sink.error(s.span, codes::kArgumentCount, "a treemap has 1 to 32 rooms", "such as `living 28: Room;`");
  std::vector<std::pair<uint32_t, uint32_t>> linked;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    if (check.program.ast.parts[s.parts.first + i].floor != FloorPart::link) continue;
    const StmtNode& door = check.program.stmt(check.program.idAt(s.children, i));
    if (!checkDoor(check, symbols, types, door, rooms)) continue;
    const LinkNode& ends = check.program.ast.links[door.extra];
    const auto pair = std::minmax(ends.a, ends.b);
    if (std::find(linked.begin(), linked.end(), std::pair<uint32_t, uint32_t>(pair)) != linked.end())
      check.sink.error(door.span, codes::kDuplicate,
                       join({"`", check.text(door.name), "` and `", check.text(door.name2), "` are linked twice"}),
                       "keep one door between two rooms, as wide as the widest of these");
    linked.emplace_back(pair);
  }
}

}  // namespace sgm
