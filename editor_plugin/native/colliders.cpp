#include "colliders.h"

#include <atomic>
#include <chrono>
#include <cmath>

#include "godot/log.h"

namespace sgm_godot {
namespace {

using Clock = std::chrono::steady_clock;

// The engine builds a search tree over a shape's triangles in a single call. With this number of triangles, the call
// takes well below a millisecond.
constexpr size_t kTrianglesPerShape = 256;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

struct Colliders::Faces {
  std::shared_ptr<sgm_collider> collider;
  std::vector<Variant> arrays;
  std::atomic<bool> packed{false};
  int32_t origin[3] = {};
  float edge = 0;  // edge of the chunk, metres
  Body body;       // contains the shapes that have been made so far
  size_t made = 0;
};

Colliders::Colliders(Plugin& plugin, Space space) : plugin_(plugin), space_(std::move(space)) {}

Colliders::~Colliders() {
  for (auto& [key, body] : bodies_) free(body);
  for (auto& [key, faces] : waiting_) free(faces->body);
}

void Colliders::free(Body& body) {
  plugin_.physics->free(body.body);
  for (const Rid shape : body.shapes) plugin_.physics->free(shape);
  body = Body();
}

void Colliders::take(const std::vector<sgm_world_event>& events) {
  for (const sgm_world_event& event : events) {
    if (event.kind == SGM_EVENT_COLLIDER_REMOVED) {
      if (const auto next = waiting_.find(event.key); next != waiting_.end()) {
        free(next->second->body);
        waiting_.erase(next);
      }
      if (const auto body = bodies_.find(event.key); body != bodies_.end()) {
        free(body->second);
        bodies_.erase(body);
      }
      continue;
    }
    if (event.kind != SGM_EVENT_COLLIDER) continue;
    auto faces = std::make_shared<Faces>();
    faces->collider = {event.collider, EndWith<sgm_collider_release>()};
    sgm_collider_view view = SGM_COLLIDER_VIEW_INIT;
    if (sgm_collider_get_view(event.collider, &view, nullptr) != SGM_OK) continue;
    std::copy_n(view.origin, 3, faces->origin);
    std::copy_n(view.origin, 3, faces->body.origin);
    std::shared_ptr<Faces>& place = waiting_[event.key];
    if (place) free(place->body);
    place = faces;
    plugin_.background->run([faces, view] {
      try {
        faces->arrays = packFaces(view, kTrianglesPerShape);
      } catch (const std::bad_alloc&) {
        faces->arrays.clear();
        logOutOfMemory("out of memory: a chunk has no collider");
      }
      float reach = 0;
      for (uint32_t i = 0; i < view.vertex_count * 3; ++i) reach = std::max(reach, std::abs(view.positions[i]));
      faces->edge = reach;
      faces->packed.store(true, std::memory_order_release);
    });
  }
}

Vector3 Colliders::centre(const Faces& faces) const {
  const float half = faces.edge / 2;
  return space_.placement.ofCorner(faces.origin).apply({half, half, half});
}

void Colliders::build(Faces& faces) {
  const Physics& physics = *plugin_.physics;
  if (!faces.body.body) {
    faces.body.body =
        physics.createBody(space_.placement.ofCorner(faces.origin), space_.owner, space_.layer, space_.mask);
  }
  if (faces.made == faces.arrays.size()) return;
  const Rid shape = physics.createShape(faces.arrays[faces.made]);
  faces.arrays[faces.made++] = Variant();
  faces.body.shapes.push_back(shape);
  physics.addShape(faces.body.body, shape);
}

void Colliders::advance(double seconds, const std::vector<Vector3>& viewers) {
  const Clock::time_point start = Clock::now();
  do {
    auto nearest = waiting_.end();
    float least = INFINITY;
    for (auto it = waiting_.begin(); it != waiting_.end(); ++it) {
      Faces& faces = *it->second;
      if (!faces.packed.load(std::memory_order_acquire)) continue;
      float distance = viewers.empty() ? 0 : INFINITY;
      for (const Vector3 viewer : viewers) {
        const Vector3 d = centre(faces) - viewer;
        distance = std::min(distance, std::hypot(d.x, d.y, d.z) - faces.edge);
      }
      if (distance < least || nearest == waiting_.end()) {
        least = distance;
        nearest = it;
      }
    }
    if (nearest == waiting_.end()) return;
    Faces& faces = *nearest->second;
    build(faces);
    if (faces.made < faces.arrays.size()) continue;
    // The new body replaces the old one in a single step, so that no character falls through between them.
    plugin_.physics->setSpace(faces.body.body, space_.space);
    Body& body = bodies_[nearest->first];
    free(body);
    body = std::move(faces.body);
    waiting_.erase(nearest);
  } while (secondsSince(start) < seconds);
}

bool Colliders::waitsIn(const Aabb& box) const {
  for (const auto& [key, faces] : waiting_) {
    // The packing thread has not finished, so the collider's size is unknown.
    if (!faces->packed.load(std::memory_order_acquire)) return true;
    const Vector3 corner = space_.placement.ofCorner(faces->origin).origin;
    const Vector3 c = centre(*faces);
    const Vector3 extent{std::abs(c.x - corner.x), std::abs(c.y - corner.y), std::abs(c.z - corner.z)};
    const auto apart = [](float centre_at, float half, float low, float size) {
      return centre_at + half < low || centre_at - half > low + size;
    };
    if (!apart(c.x, extent.x, box.position.x, box.size.x) && !apart(c.y, extent.y, box.position.y, box.size.y) &&
        !apart(c.z, extent.z, box.position.z, box.size.z)) {
      return true;
    }
  }
  return false;
}

void Colliders::setPlacement(const Placement& placement) {
  space_.placement = placement;
  for (const auto& [key, body] : bodies_) plugin_.physics->setPlace(body.body, placement.ofCorner(body.origin));
  for (const auto& [key, faces] : waiting_) {
    if (faces->body.body) plugin_.physics->setPlace(faces->body.body, placement.ofCorner(faces->origin));
  }
}

void Colliders::setLayers(int64_t layer, int64_t mask) {
  space_.layer = layer;
  space_.mask = mask;
  for (const auto& [key, body] : bodies_) plugin_.physics->setLayers(body.body, layer, mask);
  for (const auto& [key, faces] : waiting_) {
    if (faces->body.body) plugin_.physics->setLayers(faces->body.body, layer, mask);
  }
}

}  // namespace sgm_godot
