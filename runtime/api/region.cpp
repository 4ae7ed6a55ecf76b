#include <algorithm>

#include "api/barrier.h"
#include "api/field.h"
#include "api/surface.h"
#include "chunk/surface_shapes.h"
#include "mesh/split_creases.h"
#include "mesh/vertex.h"
#include "region/region_mesh.h"
#include "region/region_texture.h"

using namespace sgm::api;

namespace {

void fillSurface(const sgm::RegionMesh& region, sgm_surface& surface) {
  const sgm::WorldMesh& mesh = region.mesh;
  const size_t count = mesh.positions.size();
  surface.positions.allocate(3 * count);
  surface.normals.allocate(3 * count);
  surface.materials.allocate(count);
  surface.tags.allocate(count);
  surface.indices.allocate(mesh.indices.size());
  std::copy(mesh.indices.begin(), mesh.indices.end(), surface.indices.data());
  for (size_t v = 0; v < count; ++v) {
    const sgm::VertexAttributes& attributes = mesh.attributes[v];
    const std::array<double, 3> normal = sgm::unpackNormal(attributes.normal_x, attributes.normal_y);
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto p = static_cast<float>(mesh.positions[v][axis]);
      surface.positions.data()[3 * v + axis] = p;
      surface.normals.data()[3 * v + axis] = static_cast<float>(normal[axis]);
      surface.bounds_min[axis] = v == 0 ? p : std::min(surface.bounds_min[axis], p);
      surface.bounds_max[axis] = v == 0 ? p : std::max(surface.bounds_max[axis], p);
    }
    surface.materials.data()[v] = attributes.material;
    surface.tags.data()[v] = attributes.tag;
  }
}

}  // namespace

sgm_result sgm_surface_from_region(sgm_field* field, const sgm_region_desc* desc, sgm_surface** out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out == nullptr) return nullArgument(error, "out");
    *out = nullptr;
    if (field == nullptr) return nullArgument(error, "field");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (sgm_result r = checkLevel(field->content->world.settings().finest_cell, desc->level, error); r != SGM_OK)
      return r;
    sgm::IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      if (desc->minimum[axis] >= desc->maximum[axis])
        return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.minimum must be below desc.maximum on every axis");
      box.lo[axis] = desc->minimum[axis];
      box.hi[axis] = desc->maximum[axis];
    }
    if ((desc->flags & ~static_cast<uint32_t>(SGM_MESHING_TEXTURE | SGM_MESHING_SHARP)) != 0)
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.flags has unknown bits: pass 0 or values of sgm_meshing_flag");
    sgm::Progress progress;
    if (desc->progress != nullptr)
      progress = [desc](uint64_t done, uint64_t total) {
        return desc->progress(desc->progress_user, done, total) == 0;
      };
    const bool sharp = (desc->flags & SGM_MESHING_SHARP) != 0;
    const sgm::ProfileScope scope(field->runtime.profiler, sgm::zone::kRegion);
    sgm::Result<sgm::RegionMesh> region =
        sgm::meshRegion(field->content->world, *field->content->backend, *field->runtime.jobs, box, desc->level,
                        desc->max_chunks != 0 ? desc->max_chunks : kDefaultMostChunks, sharp, progress);
    if (!region) return fail(error, region.error());
    if (sharp) region->mesh = sgm::splitCreases(region->mesh, field->content->world.memory());
    struct End {
      void operator()(sgm_surface* surface) const { sgm_surface_destroy(surface); }
    };
    std::unique_ptr<sgm_surface, End> owner(makeHandle<sgm_surface>(field->runtime));
    sgm_surface* surface = owner.get();
    surface->origin = region->mesh.origin;
    surface->extent = region->extent;
    surface->cell_units = field->content->world.cellAt(desc->level);
    surface->chunk_count = region->chunks;
    surface->hash = region->hash.value();
    fillSurface(*region, *surface);
    if ((desc->flags & SGM_MESHING_TEXTURE) != 0) {
      sgm::Result<sgm::TexturedRegion> textured =
          sgm::unwrapRegion(field->content->world, *field->runtime.jobs, region->mesh,
                            sgm::chunksOfLevel(field->content->world, desc->level), sgm::kTile);
      if (!textured) return fail(error, textured.error());
      surface->texture = std::move(textured->unwrapped);
    }
    *out = owner.release();
    return SGM_OK;
  });
}
