#include "stream/queries.h"

#include "api/barrier.h"
#include "api/field.h"

using namespace sgm::api;

namespace {

constexpr double kUnits = SGM_UNITS_PER_METRE;

std::array<double, 3> vectorOf(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// A point, or none, or why there is neither. out's struct_size and next stay.
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

/// SGM_OK where field, desc and out can be used.
template <class Desc, class Out>
sgm_result checkQuestion(sgm_error* error, const sgm_field* field, const Desc* desc, const Out* out) {
  if (field == nullptr) return nullArgument(error, "field");
  if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
  return checkDesc(error, out, "out");
}

}  // namespace

sgm_result sgm_field_ray_cast(sgm_field* field, const sgm_ray_desc* desc, sgm_surface_point* out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (sgm_result r = checkQuestion(error, field, desc, out); r != SGM_OK) return r;
    return writePoint(sgm::rayCast(sgm::queryField(field->world), vectorOf(desc->from), vectorOf(desc->direction),
                                   desc->length * kUnits),
                      *out, error);
  });
}

sgm_result sgm_field_closest_point(sgm_field* field, const sgm_closest_desc* desc, sgm_surface_point* out,
                                   sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (sgm_result r = checkQuestion(error, field, desc, out); r != SGM_OK) return r;
    return writePoint(
        sgm::closestPoint(sgm::queryField(field->world), vectorOf(desc->position), desc->max_distance * kUnits), *out,
        error);
  });
}

sgm_result sgm_field_is_walkable(sgm_field* field, const sgm_walk_desc* desc, sgm_walkable* out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (sgm_result r = checkQuestion(error, field, desc, out); r != SGM_OK) return r;
    sgm::IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      if (desc->minimum[axis] >= desc->maximum[axis])
        return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.minimum does not lie below desc.maximum on each axis");
      box.lo[axis] = desc->minimum[axis];
      box.hi[axis] = desc->maximum[axis] - 1;
    }
    sgm::Walker walker;
    walker.radius = desc->radius * kUnits;
    walker.height = desc->height * kUnits;
    walker.step = desc->step * kUnits;
    walker.slope = desc->slope;
    walker.area = desc->area * kUnits * kUnits;
    const sgm::Result<sgm::WalkableArea> area = sgm::isWalkable(sgm::queryField(field->world), box, walker);
    if (!area) return fail(error, area.error());
    out->walkable = area->walkable;
    out->sides = area->sides;
    out->standing = area->standing / (kUnits * kUnits);
    out->largest = area->largest / (kUnits * kUnits);
    return SGM_OK;
  });
}
