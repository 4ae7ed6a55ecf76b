#include "api/surface.h"

#include <algorithm>
#include <bit>
#include <span>

#include "api/barrier.h"
#include "mesh/hash.h"

using namespace sgm::api;

namespace {

/// Hashes words together with their positions, in the same way as the hash of mesh parts. Positions have 32 bits; after
/// every 2^32 words they restart at 0, and another constant is mixed in, so that no two words have the same key.
class WordHash {
 public:
  void add(uint32_t word) {
    sgm::addWord(sum_, word ^ turn_, place_);
    if (++place_ == 0) turn_ += 0x9E3779B9u;
  }
  void addFloats(std::span<const float> values) {
    for (float v : values) add(std::bit_cast<uint32_t>(v));
  }
  uint64_t value() const { return sum_.value(); }

 private:
  sgm::ContentHash sum_;
  uint32_t place_ = 0, turn_ = 0;
};

}  // namespace

sgm_result sgm_surface_destroy(sgm_surface* surface) { return releaseHandle(surface, __func__); }

sgm_result sgm_surface_get_view(const sgm_surface* surface, sgm_surface_view* view, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (surface == nullptr) return nullArgument(error, "surface");
    if (sgm_result r = checkDesc(error, view, "view"); r != SGM_OK) return r;
    for (int axis = 0; axis < 3; ++axis) {
      view->origin[axis] = surface->origin[axis];
      view->extent_min[axis] = surface->extent.lo[axis];
      view->extent_max[axis] = surface->extent.hi[axis];
    }
    view->cell_units = surface->cell_units;
    view->vertex_count = surface->positions.size() / 3;
    view->index_count = surface->indices.size();
    view->positions = surface->positions.data();
    view->normals = surface->normals.data();
    view->materials = surface->materials.data();
    view->tags = surface->tags.data();
    view->indices = surface->indices.data();
    view->position_stride = 3 * sizeof(float);
    view->normal_stride = 3 * sizeof(float);
    view->material_stride = sizeof(uint16_t);
    view->tag_stride = sizeof(uint16_t);
    std::copy(surface->bounds_min.begin(), surface->bounds_min.end(), view->bounds_min);
    std::copy(surface->bounds_max.begin(), surface->bounds_max.end(), view->bounds_max);
    view->chunk_count = surface->chunk_count;
    const sgm::Unwrapped& texture = surface->texture;
    view->wedges = texture.wedges.empty() ? nullptr : reinterpret_cast<const sgm_wedge*>(texture.wedges.data());
    view->wedge_indices = texture.corners.empty() ? nullptr : texture.corners.data();
    view->wedge_count = texture.wedges.size();
    view->wedge_stride = sizeof(sgm_wedge);
    view->reserved = 0;
    return SGM_OK;
  });
}

uint64_t sgm_surface_hash(const sgm_surface* surface) {
  if (surface == nullptr) return 0;
  if (!surface->of_grid) return surface->hash;
  WordHash hash;
  hash.addFloats({surface->positions.data(), surface->positions.size()});
  hash.addFloats({surface->normals.data(), surface->normals.size()});
  for (uint32_t index : std::span(surface->indices.data(), surface->indices.size())) hash.add(index);
  return hash.value();
}
