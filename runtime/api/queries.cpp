#include "query/queries.h"

#include "api/barrier.h"
#include "api/field.h"
#include "api/world.h"

using namespace sgm::api;

namespace {

std::array<double, 3> vectorOf(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Writes the result of a query to `out`: the point, or found = 0 if the query found no point. If the query
/// failed, returns its error. Keeps struct_size and next of `out`.
sgm_result writePoint(const sgm::Result<std::optional<sgm::SurfacePoint>>& asked, sgm_surface_point& out,
                      sgm_error* error) {
  if (!asked) return fail(error, asked.error());
  out = SGM_SURFACE_POINT_INIT;
  if (!*asked) return SGM_OK;
  const sgm::SurfacePoint& point = **asked;
  out.found = 1;
  out.inside = point.inside;
  for (size_t axis = 0; axis < 3; ++axis) {
    out.position[axis] = point.position[axis];
    out.normal[axis] = point.normal[axis];
  }
  out.distance = point.distance / kUnits;
  out.material = point.material;
  out.tag = point.tag;
  return SGM_OK;
}

/// Checks the structs desc and out of a query; returns SGM_OK if both are valid.
template <class Desc, class Out>
sgm_result checkQuestion(sgm_error* error, const Desc* desc, const Out* out) {
  if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
  return checkDesc(error, out, "out");
}

sgm_result castRay(const sgm::QueryField& field, const sgm_ray_desc* desc, sgm_surface_point* out, sgm_error* error) {
  if (sgm_result r = checkQuestion(error, desc, out); r != SGM_OK) return r;
  return writePoint(sgm::rayCast(field, vectorOf(desc->from), vectorOf(desc->direction), desc->length * kUnits), *out,
                    error);
}

sgm_result findClosest(const sgm::QueryField& field, const sgm_closest_desc* desc, sgm_surface_point* out,
                       sgm_error* error) {
  if (sgm_result r = checkQuestion(error, desc, out); r != SGM_OK) return r;
  return writePoint(sgm::closestPoint(field, vectorOf(desc->position), desc->max_distance * kUnits), *out, error);
}

sgm_result findWalkable(const sgm::QueryField& field, const sgm_walk_desc* desc, sgm_walkable* out, sgm_error* error) {
  if (sgm_result r = checkQuestion(error, desc, out); r != SGM_OK) return r;
  sgm::IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    if (desc->minimum[axis] >= desc->maximum[axis])
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.minimum must be below desc.maximum on every axis");
    box.lo[axis] = desc->minimum[axis];
    box.hi[axis] = desc->maximum[axis] - 1;
  }
  sgm::Walker walker;
  walker.radius = desc->radius * kUnits;
  walker.height = desc->height * kUnits;
  walker.step = desc->step * kUnits;
  walker.slope = desc->slope;
  walker.area = desc->area * kUnits * kUnits;
  const sgm::Result<sgm::WalkableArea> area = sgm::isWalkable(field, box, walker);
  if (!area) return fail(error, area.error());
  out->walkable = area->walkable;
  out->sides = area->sides;
  out->standing = area->standing / (kUnits * kUnits);
  out->largest = area->largest / (kUnits * kUnits);
  return SGM_OK;
}

/// Common code of all queries. name: name of the parameter `owner` in the C function, for error messages; field: a
/// function that returns the field to query.
template <class Owner, class Field, class Question, class Desc, class Out>
sgm_result ask(Owner* owner, const char* name, const Field& field, const Question& question, const Desc* desc, Out* out,
               sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (owner == nullptr) return nullArgument(error, name);
    return question(field(*owner), desc, out, error);
  });
}

sgm::QueryField plain(const sgm_field& field) { return sgm::queryField(field.content->world); }
sgm::QueryField edited(const sgm_world& world) { return world.world->queryField(); }

}  // namespace

sgm_result sgm_field_ray_cast(sgm_field* field, const sgm_ray_desc* desc, sgm_surface_point* out, sgm_error* error) {
  return ask(field, "field", plain, castRay, desc, out, error);
}

sgm_result sgm_world_ray_cast(sgm_world* world, const sgm_ray_desc* desc, sgm_surface_point* out, sgm_error* error) {
  return ask(world, "world", edited, castRay, desc, out, error);
}

sgm_result sgm_field_closest_point(sgm_field* field, const sgm_closest_desc* desc, sgm_surface_point* out,
                                   sgm_error* error) {
  return ask(field, "field", plain, findClosest, desc, out, error);
}

sgm_result sgm_world_closest_point(sgm_world* world, const sgm_closest_desc* desc, sgm_surface_point* out,
                                   sgm_error* error) {
  return ask(world, "world", edited, findClosest, desc, out, error);
}

sgm_result sgm_field_is_walkable(sgm_field* field, const sgm_walk_desc* desc, sgm_walkable* out, sgm_error* error) {
  return ask(field, "field", plain, findWalkable, desc, out, error);
}

sgm_result sgm_world_is_walkable(sgm_world* world, const sgm_walk_desc* desc, sgm_walkable* out, sgm_error* error) {
  return ask(world, "world", edited, findWalkable, desc, out, error);
}
