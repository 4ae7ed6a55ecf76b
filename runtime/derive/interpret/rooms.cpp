// Derives the statement `treemap`, which divides a floor into rooms. The box of its scope is centred on the scope's
// origin; y is up.

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/overrides.h"
#include "derive/interpret/statements.h"
#include "derive/layout/floor_plan.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::interpret {
namespace {

constexpr double kWidestFloor = 1 << 20;  ///< maximum edge of a floor, in units

/// Converts metres to a multiple of four units. Walls, doors and corridors have such sizes, so that their halves are
/// even integers.
int32_t inSteps(double metres) {
  return std::max(4, 4 * static_cast<int32_t>(detFloor(metres * (kUnitsPerMetre / 4.0) + 0.5)));
}

Vec3 middleOf(const PlanRect& r, double y) {
  return {0.5 * (r.x0 + r.x1) / kUnitsPerMetre, y, 0.5 * (r.z0 + r.z1) / kUnitsPerMetre};
}

Vec3 edgesOf(const PlanRect& r, double y) {
  return {static_cast<double>(r.width()) / kUnitsPerMetre, y, static_cast<double>(r.depth()) / kUnitsPerMetre};
}

/// Evaluates a measure of a treemap or a link; returns the fallback if it is missing or, with a note, if it is out of
/// range.
double floorMeasure(ExprId id, double fallback, const ValueRange& range, CellContext& c, const Env& env) {
  if (id == kNoId) return fallback;
  const double value = c.evaluator.real(id, env);
  if (range.holds(value) || c.budget.failed()) return value;
  c.budget.note(std::string(range.rule).append(", ").append(range.example).append("; the default is used"),
                c.program.expr(id).span, env.activation);
  return fallback;
}

void addBox(const PlanRect& r, double y, double height, const StmtNode& s, CellContext& c, const Env& env,
            ShapeList& out) {
  const double scale = env.place.scale * kUnitsPerMetre;
  const Vec3 half = 0.5 * edgesOf(r, height);
  Shape shape = shapeIn(env, ShapeKind::box);
  shape.frame = env.place.frame(middleOf(r, y));
  for (int axis = 0; axis < 3; ++axis) shape.size[static_cast<size_t>(axis)] = static_cast<float>(half[axis] * scale);
  shape.inner_radius = static_cast<float>(std::min({half.x, half.y, half.z}) * scale);
  out.push_back(c.sink.addShape(shape, s.ordinal, s.span, env));
}

/// Derives a room or a corridor: first boxes that fill its open space; then the statements of its block add shapes to
/// these boxes and cut from them. clear: rectangles of the open space; the first one is the block's scope.
void runRoom(const StmtNode& s, uint32_t index, std::span<const PlanRect> clear, PathKey key, CellContext& c,
             const Env& env, ShapeList& out) {
  if (!c.budget.step(1, s.span, env.activation)) return;
  Env inner = env;
  inner.key = key;
  inner.cut_detail = 0;
  const bool said = index != kNone;
  const StmtNode* body = said ? &c.program.stmt(c.program.idAt(s.children, index)) : nullptr;
  if (said) {
    const uint16_t tag = c.program.ast.parts[s.parts.first + index].tag;
    if (tag != 0 && inner.forced_tag == 0) inner.tag = tag;
    if (body->kind == StmtKind::block) label(*body, inner);
  }
  ShapeList own;
  for (const PlanRect& r : clear) addBox(r, 0, env.scope.y, s, c, inner, own);
  if (said) {
    inner.place = env.place.moved(middleOf(clear[0], 0));
    inner.scope = edgesOf(clear[0], env.scope.y);
    if (body->kind != StmtKind::block)
      runStatement(c.program.idAt(s.children, index), c, inner, own);
    else if (c.program.overridesOf(body->tag).count > 0)
      runTagged(*body, body->tag, c, inner, own, true);
    else
      runContents(*body, c, inner, own);
  }
  out.insert(out.end(), own.begin(), own.end());
}

/// Derives facades. Their scopes are oriented like the faces of a box: x along the outer wall, y up, z outwards, with
/// depth 0.
void runFacades(const StmtNode& s, const FloorPlan& plan, std::span<const PathKey> keys, CellContext& c, const Env& env,
                ShapeList& out) {
  const Vec3 edges = env.scope;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    if (c.program.ast.parts[s.parts.first + i].floor != FloorPart::facade) continue;
    std::vector<uint64_t> count(keys.size(), 0);
    for (const PlanFacade& f : plan.facades) {
      if (c.budget.failed() || !c.budget.step(1, s.span, env.activation)) return;
      const double middle = 0.5 * (f.low + f.high) / kUnitsPerMetre, sign = f.side < 2 ? 1 : -1;
      const bool along_x = f.side % 2 == 0;
      const Vec3 at = along_x ? Vec3{middle, 0, sign * 0.5 * edges.z} : Vec3{sign * 0.5 * edges.x, 0, middle};
      Env inner = env;
      inner.cut_detail = 0;
      inner.key = keys[f.room].child(kFacadeSalt, count[f.room]++);
      inner.place = env.place.moved(at).turned({0, 1, 0}, f.side * (kPi / 2));
      inner.scope = {static_cast<double>(f.high - f.low) / kUnitsPerMetre, edges.y, 0};
      ShapeList own;
      runStatement(c.program.idAt(s.children, i), c, inner, own);
      out.insert(out.end(), own.begin(), own.end());
    }
  }
}

}  // namespace

void runTreemap(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const TreemapNode& node = c.program.ast.treemaps[s.extra];
  const PartNode* parts = c.program.ast.parts.data() + s.parts.first;
  FloorPlanSizes sizes;
  sizes.wall = inSteps(floorMeasure(node.wall, kTreemapWall, kWallRange, c, env));
  sizes.door = inSteps(floorMeasure(node.door, 0.9, kDoorRange, c, env));
  sizes.corridor = std::max(sizes.door, inSteps(floorMeasure(node.corridor, 1.2, kCorridorRange, c, env)));
  const double height = floorMeasure(node.height, 2.1, kDoorHeightRange, c, env);
  const Vec3 edges = env.scope;
  if (c.budget.failed()) return;
  const double longest = std::max({edges.x, edges.y, edges.z}) * std::max(1.0, env.place.scale);
  if (!(std::min({edges.x, edges.y, edges.z}) > 0 && longest * kUnitsPerMetre < kWidestFloor))
    return c.budget.note(
        "this scope's box has no size, or one of more than 1 km, so it gets no rooms: give it one, such as "
        "size(12m, 3m, 9m)",
        s.span, env.activation);
  sizes.x = static_cast<int32_t>(edges.x * kUnitsPerMetre);
  sizes.z = static_cast<int32_t>(edges.z * kUnitsPerMetre);

  // rooms: for each room that is laid out, its index in `parts`. number: for each room of the statement, in order, its
  // index in `rooms`; kNone if the room is left out because of its size.
  std::vector<uint32_t> rooms, number(s.parts.count, kNone);
  std::vector<double> areas;
  for (uint32_t i = 0, room = 0; i < s.parts.count; ++i) {
    if (parts[i].floor != FloorPart::room) continue;
    const double area = c.evaluator.real(parts[i].size, env);
    if (c.budget.failed()) return;
    if (kRoomAreaRange.holds(area)) {
      number[room] = static_cast<uint32_t>(rooms.size());
      rooms.push_back(i);
      areas.push_back(area);
    } else {
      c.budget.note(
          std::string(kRoomAreaRange.rule).append(", ").append(kRoomAreaRange.example).append("; this one is left out"),
          parts[i].span, env.activation);
    }
    ++room;
  }
  std::vector<RoomLink> links;
  std::vector<double> heights;
  std::vector<uint32_t> doors;  // for each element of `links`: index in `parts` of the link that requests the door
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    if (parts[i].floor != FloorPart::link) continue;
    const LinkNode& link = c.program.ast.links[c.program.stmt(c.program.idAt(s.children, i)).extra];
    if (number[link.a] == kNone || number[link.b] == kNone) continue;
    const double width = floorMeasure(link.width, static_cast<double>(sizes.door) / kUnitsPerMetre, kDoorRange, c, env);
    links.push_back({number[link.a], number[link.b], inSteps(width)});
    doors.push_back(i);
    heights.push_back(floorMeasure(link.height, height, kDoorHeightRange, c, env));
  }
  if (c.budget.failed()) return;
  const FloorPlan plan = c.floor_plans.layOut(sizes, areas, links, s.span, env.activation, c.budget);
  if (c.budget.failed()) return;
  if (!plan.fits)
    return c.budget.note(
        "this floor has no room for these rooms between their walls; the treemap is left out: use fewer rooms, thinner "
        "walls or a larger scope",
        s.span, env.activation);

  const PathKey key = env.key.child(kLoopSalt + s.ordinal, 0);
  std::vector<PathKey> keys;
  for (size_t i = 0; i < plan.rooms.size(); ++i) {
    const PartNode& part = parts[rooms[i]];
    // Rooms are keyed by their names, so that the content of a room does not depend on the other rooms.
    keys.push_back(key.child(hashText(c.program.text(part.label)), 0));
    runRoom(s, rooms[i], plan.rooms[i].clear, keys[i], c, env, out);
    if (c.budget.failed()) return;
  }
  uint32_t corridor = kNone;
  for (uint32_t i = 0; i < s.parts.count; ++i)
    if (parts[i].floor == FloorPart::corridor) corridor = i;
  for (size_t i = 0; i < plan.corridor.size() && !c.budget.failed(); ++i)
    runRoom(s, corridor, {&plan.corridor[i], 1}, key.child(kCorridorSalt, i), c, env, out);
  for (const PlanDoor& door : plan.doors) {
    const double up = std::min(edges.y, door.link == PlanDoor::kNoLink ? height : heights[door.link]);
    addBox(door.hole, 0.5 * (up - edges.y), up, s, c, env, out);
    if (c.budget.failed()) return;
  }
  runFacades(s, plan, keys, c, env, out);
  const auto nameOf = [&](size_t room) { return std::string(c.program.text(parts[rooms[room]].label)); };
  for (const size_t link : plan.unmet)
    c.budget.note(
        "`" + nameOf(links[link].a) + "` and `" + nameOf(links[link].b) +
            "` share no wall wide enough for this door, so it is left out: use a narrower door, or other areas of "
            "rooms",
        parts[doors[link]].span, env.activation);
  if (plan.doors.empty() || plan.doors[0].from != PlanDoor::kOutside)
    c.budget.note(
        "no outer wall of these rooms is wide enough for the entrance, so nothing leads in: use a narrower door, or a "
        "larger scope",
        s.span, env.activation);
  for (const size_t room : plan.closed)
    c.budget.note("no wall of `" + nameOf(room) +
                      "` is wide enough for a door, so nothing leads into it: use a narrower door, or a larger room",
                  parts[rooms[room]].span, env.activation);
}

}  // namespace sgm::interpret
