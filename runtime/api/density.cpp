#include "query/density_grid.h"

#include "api/barrier.h"
#include "api/field.h"
#include "api/world.h"

using namespace sgm::api;

namespace {

constexpr uint32_t kMaxPoints = 16384;         // maximum number of points along an axis
constexpr uint64_t kMaxInVolume = 1ull << 33;  // maximum total number of points

/// Converts a row or slice pitch from bytes to a number of values, and checks it; 0 becomes the minimum pitch.
sgm_result takePitch(sgm_error* error, size_t bytes, size_t value, size_t least, const char* name, size_t& pitch) {
  if (bytes == 0) {
    pitch = least;
    return SGM_OK;
  }
  pitch = bytes / value;
  if (bytes % value == 0 && pitch >= least) return SGM_OK;
  return fail(error, SGM_ERR_INVALID_ARGUMENT,
              std::string(name) + " is below " + std::to_string(least * value) + " or not a multiple of " +
                  std::to_string(value));
}

sgm_result takeGrid(sgm_error* error, const sgm_density_desc& desc, const sgm::Domain& domain, sgm::DensityGrid& grid) {
  if (desc.spacing < 1) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.spacing is below 1");
  for (size_t axis = 0; axis < 3; ++axis) {
    if (desc.size[axis] < 1 || desc.size[axis] > kMaxPoints)
      return fail(error, SGM_ERR_INVALID_ARGUMENT,
                  "desc.size[" + std::to_string(axis) + "] is not between 1 and " + std::to_string(kMaxPoints));
    grid.size[axis] = desc.size[axis];
  }
  if (uint64_t{desc.size[0]} * desc.size[1] * desc.size[2] > kMaxInVolume)
    return fail(error, SGM_ERR_LIMIT, "the volume has more than 2^33 points");
  grid.origin = {desc.origin[0], desc.origin[1], desc.origin[2]};
  grid.spacing = desc.spacing;
  grid.edge = desc.edge == 0 ? domain.density_edge : desc.edge * SGM_UNITS_PER_METRE;
  return SGM_OK;
}

sgm_result takeRows(sgm_error* error, const sgm_density_desc& desc, sgm::DensityRows& rows) {
  if (desc.reserved != 0) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.reserved must be 0");
  if (desc.values == nullptr) return nullArgument(error, "desc.values");
  if (desc.format != SGM_DENSITY_UNORM8 && desc.format != SGM_DENSITY_FLOAT32)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.format is not a valid sgm_density_format");
  const bool bytes = desc.format == SGM_DENSITY_UNORM8;
  const size_t value = bytes ? 1 : sizeof(float);
  if (sgm_result r = takePitch(error, desc.row_pitch, value, desc.size[0], "desc.row_pitch", rows.row_pitch);
      r != SGM_OK)
    return r;
  size_t slice = 0, all = 0;
  if (__builtin_mul_overflow(rows.row_pitch, desc.size[1], &slice))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.row_pitch is too large");
  if (sgm_result r = takePitch(error, desc.slice_pitch, value, slice, "desc.slice_pitch", rows.slice_pitch);
      r != SGM_OK)
    return r;
  if (__builtin_mul_overflow(rows.slice_pitch, desc.size[2], &all) || all > SIZE_MAX / value)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.slice_pitch is too large");
  if (bytes) {
    rows.bytes = static_cast<uint8_t*>(desc.values);
  } else {
    rows.values = static_cast<float*>(desc.values);
  }
  return SGM_OK;
}

sgm_result sampleVolume(sgm_error* error, const sgm::QueryField& asked, const sgm::WorldField& world,
                        sgm_runtime& runtime, const sgm_density_desc& desc) {
  sgm::DensityGrid grid;
  if (sgm_result r = takeGrid(error, desc, world.settings().program->domain, grid); r != SGM_OK) return r;
  sgm::DensityRows rows;
  if (sgm_result r = takeRows(error, desc, rows); r != SGM_OK) return r;
  sgm::Progress progress;
  if (desc.progress != nullptr)
    progress = [&desc](uint64_t done, uint64_t total) { return desc.progress(desc.progress_user, done, total) == 0; };
  const sgm::Result<sgm::DensityFigures> filled = sgm::sampleDensity(asked, grid, *runtime.jobs, rows, progress);
  return filled ? SGM_OK : fail(error, filled.error());
}

}  // namespace

sgm_result sgm_field_sample_density(sgm_field* field, const sgm_density_desc* desc, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (field == nullptr) return nullArgument(error, "field");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    const sgm::WorldField& world = field->content->world;
    if (sgm_result r = checkLevel(world.settings().finest_cell, desc->level, error); r != SGM_OK) return r;
    sgm::QueryField asked = sgm::queryField(world);
    asked.at = [&world, level = desc->level](const sgm::IntBox& box) { return world.compile(box, level); };
    return sampleVolume(error, asked, world, field->runtime, *desc);
  });
}

sgm_result sgm_world_sample_density(sgm_world* world, const sgm_density_desc* desc, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (sgm_result r = checkLevel(world->finest_cell, desc->level, error); r != SGM_OK) return r;
    // This reference keeps the field alive until the function returns, even if sgm_world_set_field gives the world
    // another field in the meantime.
    const std::shared_ptr<const sgm::WorldField> field = world->world->field();
    return sampleVolume(error, world->world->queryField(desc->level), *field, world->runtime, *desc);
  });
}
