#include "api/collider.h"

#include "api/barrier.h"

using namespace sgm::api;

sgm_result sgm_collider_acquire(sgm_collider* collider) { return acquireHandle(collider, __func__); }

sgm_result sgm_collider_release(sgm_collider* collider) { return releaseHandle(collider, __func__); }

sgm_result sgm_collider_get_view(const sgm_collider* collider, sgm_collider_view* view, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (collider == nullptr) return nullArgument(error, "collider");
    if (sgm_result r = checkDesc(error, view, "view"); r != SGM_OK) return r;
    const sgm::Collider& of = *collider->collider;
    view->key = {of.key.level, of.key.at.x, of.key.at.y, of.key.at.z};
    for (int axis = 0; axis < 3; ++axis) view->origin[axis] = of.grid.origin[axis];
    view->vertex_count = static_cast<uint32_t>(of.positions.size() / 3);
    view->index_count = static_cast<uint32_t>(of.indices.size());
    view->positions = of.positions.data();
    view->indices = of.indices.data();
    view->materials = of.materials.data();
    view->hash = of.hash;
    return SGM_OK;
  });
}
