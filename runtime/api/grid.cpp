#include "api/grid_mesh.h"

#include <cmath>

#include "api/barrier.h"
#include "api/surface.h"

using namespace sgm::api;

namespace {

constexpr uint32_t kMaxAxisSamples = 16384;   // maximum number of samples along an axis
constexpr uint64_t kMaxSamples = 1ull << 33;  // maximum total number of samples
constexpr double kSmallestCell = 1e-30, kLargestCell = 1e30;

sgm_result checkGrid(const sgm_grid_desc& desc, GridSamples& grid, sgm_error* error) {
  if (desc.values == nullptr) return nullArgument(error, "desc.values");
  if (!(desc.cell >= kSmallestCell && desc.cell <= kLargestCell))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.cell is not a number from 1e-30 to 1e30");
  for (size_t axis = 0; axis < 3; ++axis) {
    if (desc.size[axis] < 2 || desc.size[axis] > kMaxAxisSamples)
      return fail(error, SGM_ERR_INVALID_ARGUMENT,
                  "desc.size[" + std::to_string(axis) + "] is not between 2 and " + std::to_string(kMaxAxisSamples));
    grid.size[axis] = desc.size[axis];
  }
  if (uint64_t{desc.size[0]} * desc.size[1] * desc.size[2] > kMaxSamples)
    return fail(error, SGM_ERR_LIMIT, "the grid has more than 2^33 samples");
  grid.stride_y = desc.stride_y != 0 ? desc.stride_y : grid.size[0];
  if (grid.stride_y < grid.size[0]) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.stride_y is below desc.size[0]");
  size_t rows = 0, planes = 0;
  if (__builtin_mul_overflow(grid.stride_y, grid.size[1], &rows))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.stride_y is too large");
  grid.stride_z = desc.stride_z != 0 ? desc.stride_z : rows;
  if (grid.stride_z < rows)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.stride_z is below desc.size[1] * desc.stride_y");
  if (__builtin_mul_overflow(grid.stride_z, grid.size[2], &planes) || planes > SIZE_MAX / sizeof(float))
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.stride_z is too large");
  if (desc.normals != 0 && desc.normals != 1)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.normals is neither 0 nor 1");
  if (desc.reserved != 0 || desc.reserved2 != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.reserved and desc.reserved2 must be 0");
  grid.values = desc.values;
  grid.cell = desc.cell;
  grid.normals = desc.normals != 0;
  return SGM_OK;
}

}  // namespace

sgm_result sgm_surface_from_grid(sgm_runtime* runtime, const sgm_grid_desc* desc, sgm_surface** out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out == nullptr) return nullArgument(error, "out");
    *out = nullptr;
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    GridSamples grid;
    if (sgm_result r = checkGrid(*desc, grid, error); r != SGM_OK) return r;
    sgm::Result<GridMesh> mesh = meshGrid(grid, *runtime->jobs, &runtime->memory);
    if (!mesh) return fail(error, mesh.error());
    *out = makeHandle<sgm_surface>(*runtime, std::move(*mesh));
    return SGM_OK;
  });
}
