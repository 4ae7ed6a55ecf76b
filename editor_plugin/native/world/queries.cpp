#include "world/queries.h"

#include <cmath>

#include "godot/log.h"

namespace sgm_godot {
namespace {

void reportFailure(const sgm_error& error) { logError(std::string("SgmWorld3D: ") + error.message); }

Variant vector(const Transform& node, const double direction[3]) {
  return node.turn(
      {static_cast<float>(direction[0]), static_cast<float>(direction[1]), static_cast<float>(direction[2])});
}

Dictionary described(const World& world, const sgm_surface_point& point) {
  Dictionary result;
  if (point.found == 0) return result;
  const Placement here = world.node().placement();
  const sgm_grammar* grammar = world.stage().session()->grammar().get();
  const auto text = [](const char* name) { return Variant(name == nullptr ? "" : name); };
  result.value.set("position", here.toGlobal(point.position));
  result.value.set("normal", vector(here.node, point.normal));
  result.value.set("distance", point.distance);
  result.value.set("material", text(sgm_grammar_material(grammar, point.material)));
  result.value.set("tag", text(point.tag == 0 ? "" : sgm_grammar_tag(grammar, point.tag)));
  result.value.set("inside", point.inside != 0);
  return result;
}

}  // namespace

Dictionary castRay(World& world, const Vector3& from, const Vector3& direction, double length) {
  if (!world.isReady()) return {};
  const Placement here = world.node().placement();
  sgm_ray_desc desc = SGM_RAY_DESC_INIT;
  const Units start = here.toUnits(from);
  const Vector3 ahead = here.node.inverse().turn(direction);
  std::copy_n(start.data(), 3, desc.from);
  desc.direction[0] = ahead.x;
  desc.direction[1] = ahead.y;
  desc.direction[2] = ahead.z;
  desc.length = length;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_ray_cast(world.stage().session()->world(), &desc, &point, &error) < SGM_OK) {
    reportFailure(error);
    return {};
  }
  return described(world, point);
}

Dictionary findClosestPoint(World& world, const Vector3& position, double max_distance) {
  if (!world.isReady()) return {};
  sgm_closest_desc desc = SGM_CLOSEST_DESC_INIT;
  const Units units = world.node().placement().toUnits(position);
  std::copy_n(units.data(), 3, desc.position);
  desc.max_distance = max_distance;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_closest_point(world.stage().session()->world(), &desc, &point, &error) < SGM_OK) {
    reportFailure(error);
    return {};
  }
  return described(world, point);
}

Points findPath(World& world, const Vector3& from, const Vector3& to, double radius) {
  if (!world.isReady()) return {};
  const Placement here = world.node().placement();
  sgm_way_desc desc = SGM_WAY_DESC_INIT;
  const Units start = here.toUnits(from), end = here.toUnits(to);
  std::copy_n(start.data(), 3, desc.from);
  std::copy_n(end.data(), 3, desc.to);
  desc.radius = radius;
  // The search box is the box around both ends, enlarged by this margin, because the path need not be straight.
  const double edge = static_cast<double>(world.stage().session()->cellUnits()) * SGM_CHUNK_CELLS * 2;
  for (size_t axis = 0; axis < 3; ++axis) {
    desc.minimum[axis] = static_cast<int32_t>(std::max(std::min(start[axis], end[axis]) - edge, -2147000000.0));
    desc.maximum[axis] = static_cast<int32_t>(std::min(std::max(start[axis], end[axis]) + edge, 2147000000.0));
  }
  std::vector<int32_t> places(3 << 14);
  sgm_way way = SGM_WAY_INIT;
  sgm_error error = SGM_ERROR_INIT;
  for (;;) {
    desc.places = places.data();
    desc.place_room = places.size() / 3;
    const sgm_result result = sgm_world_find_way(world.stage().session()->world(), &desc, &way, &error);
    if (result < SGM_OK) {
      reportFailure(error);
      return {};
    }
    if (way.place_count <= desc.place_room) break;
    places.resize(way.place_count * 3);
  }
  Packed<Vector3> points(way.place_count);
  for (size_t i = 0; i < way.place_count; ++i) points.data()[i] = here.node.apply(here.local(places.data() + 3 * i));
  return {points.take()};
}

Array listAnchors(World& world, const Aabb& box) {
  Array list;
  if (!world.isReady()) return list;
  const Placement here = world.node().placement();
  int32_t minimum[3], maximum[3];
  here.box(box, minimum, maximum);
  std::vector<sgm_anchor> found(64);
  size_t count = found.size();
  sgm_error error = SGM_ERROR_INIT;
  sgm_result result;
  while ((result = sgm_field_anchors(world.stage().session()->field(), minimum, maximum, found.data(), 0, &count,
                                     &error)) == SGM_INCOMPLETE) {
    found.resize(count);
  }
  if (result < SGM_OK) {
    reportFailure(error);
    return list;
  }
  for (size_t i = 0; i < count; ++i)
    list.value.append(anchorOf(world.stage().session()->grammar().get(), found[i], here));
  return list;
}

Aabb drawnBounds(const World& world) {
  const Picture* picture = world.stage().pictures().current();
  if (picture == nullptr || !world.stage().isRunning()) return {};
  int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
  bool any = false;
  for (const Picture::Shown& shown : picture->shown()) {
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    if (sgm_mesh_get_view(shown.mesh, &view, nullptr) != SGM_OK || view.index_count == 0) continue;
    any = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], view.bounds_min[axis]);
      high[axis] = std::max(high[axis], view.bounds_max[axis]);
    }
  }
  if (!any) return {};
  const Placement local{Transform(), world.node().settings.origin};
  const Vector3 first = local.local(low);
  return {first, local.local(high) - first};
}

int64_t hashWorld(World& world, const Aabb& box, int64_t level) {
  if (!world.isReady()) return 0;
  int32_t minimum[3], maximum[3];
  world.node().placement().box(box, minimum, maximum);
  uint64_t hash = 0;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_hash(world.stage().session()->world(), minimum, maximum, static_cast<int32_t>(level), &hash, &error) <
      SGM_OK) {
    reportFailure(error);
    return 0;
  }
  return static_cast<int64_t>(hash);
}

}  // namespace sgm_godot
