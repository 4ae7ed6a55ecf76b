// Floor plans: treemap and its links.

#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/syntax/scope_parts.h"
#include "grammar/text/codes.h"

namespace sgm {

void Checker::treemap(const StmtNode& s) {
  ExprId out[4] = {kNoId, kNoId, kNoId, kNoId};
  TreemapNode& treemap = program_.ast.treemaps[s.extra];
  if (bindWords(treemap.args, s.span, "treemap", {"wall", "door", "height", "corridor"}, 0, out)) {
    demandRange(out[0], kLength, "the thickness of walls", kWallRange);
    demandRange(out[1], kLength, "the width of doors", kDoorRange);
    demandRange(out[2], kLength, "the height of doors", kDoorHeightRange);
    demandRange(out[3], kLength, "the width of a corridor", kCorridorRange);
    treemap.wall = out[0];
    treemap.door = out[1];
    treemap.height = out[2];
    treemap.corridor = out[3];
  }
  std::vector<NameId> rooms;
  int corridors = 0, facades = 0;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    PartNode& part = program_.ast.parts[s.parts.first + i];
    if (part.floor == FloorPart::room) {
      demandRange(part.size, kRatio, "the area of a room", kRoomAreaRange);
      part.tag = tableIndex(program_.tags, part.label, part.span);
      if (std::find(rooms.begin(), rooms.end(), part.label) != rooms.end())
        sink_.error(part.span, codes::kDuplicate, join({"this treemap has a second room `", text(part.label), "`"}),
                    "give each room a name of its own");
      rooms.push_back(part.label);
    }
    if ((part.floor == FloorPart::corridor && corridors++ > 0) || (part.floor == FloorPart::facade && facades++ > 0))
      sink_.error(
          part.span, codes::kDuplicate,
          join({"`", part.floor == FloorPart::corridor ? "corridor" : "facade", "` stands twice in this treemap"}),
          "put both into one block after it");
  }
  if ((rooms.empty() && !isLossy(s)) || rooms.size() > kMostRooms)
    sink_.error(s.span, codes::kArgumentCount, "a treemap has 1 to 32 rooms", "such as `living 28: Room;`");
  std::vector<std::pair<uint32_t, uint32_t>> linked;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    if (program_.ast.parts[s.parts.first + i].floor != FloorPart::link) continue;
    const StmtNode& door = program_.stmt(program_.idAt(s.children, i));
    if (!link(door, rooms)) continue;
    const LinkNode& ends = program_.ast.links[door.extra];
    const auto pair = std::minmax(ends.a, ends.b);
    if (std::find(linked.begin(), linked.end(), std::pair<uint32_t, uint32_t>(pair)) != linked.end())
      sink_.error(door.span, codes::kDuplicate,
                  join({"`", text(door.name), "` and `", text(door.name2), "` are linked twice"}),
                  "keep one door between two rooms, as wide as the widest of these");
    linked.emplace_back(pair);
  }
  partStatements(s);
}

bool Checker::link(const StmtNode& s, const std::vector<NameId>& rooms) {
  LinkNode& link = program_.ast.links[s.extra];
  for (const auto& [name, number] : {std::pair{s.name, &link.a}, std::pair{s.name2, &link.b}}) {
    const auto room = std::find(rooms.begin(), rooms.end(), name);
    if (room == rooms.end() && mayBeLost(scope_.module, name)) return false;
    if (room == rooms.end()) {
      Suggestion suggestion(text(name));
      for (const NameId known : rooms) suggestion.offer(text(known));
      sink_.error(s.span, codes::kUnknownName, join({"this treemap has no room `", text(name), "`"}),
                  suggestion.hintOr("name two of its rooms"));
      return false;
    }
    *number = static_cast<uint32_t>(room - rooms.begin());
  }
  const bool two = link.a != link.b;
  if (!two) sink_.error(s.span, codes::kWrongUse, "a door leads from one room to another", "name two rooms");
  ExprId out[2] = {kNoId, kNoId};
  if (!bindWords(link.args, s.span, "door", {"width", "height"}, 0, out)) return two;
  demandRange(out[0], kLength, "the width of a door", kDoorRange);
  demandRange(out[1], kLength, "the height of a door", kDoorHeightRange);
  link.width = out[0];
  link.height = out[1];
  return two;
}

}  // namespace sgm
