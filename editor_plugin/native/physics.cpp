#include "physics.h"

namespace sgm_godot {
namespace {

constexpr int64_t kModeStatic = 0, kStateTransform = 0;

}  // namespace

Physics::Physics() : server_(engine().global_get_singleton(Name("PhysicsServer3D").get())) {}

Rid Physics::createBody(const Transform& place, Object owner, int64_t layer, int64_t mask) const {
  const Rid body = server_.call(body_create_).to<Rid>();
  server_.call(body_set_mode_, body, kModeStatic);
  server_.call(attach_, body, engine().object_get_instance_id(owner));
  setPlace(body, place);
  setLayers(body, layer, mask);
  return body;
}

Rid Physics::createShape(const Variant& faces) const {
  const Rid shape = server_.call(create_shape_).to<Rid>();
  Variant data = Variant::dictionary();
  data.set("faces", faces);
  data.set("backface_collision", false);
  server_.call(shape_set_data_, shape, data);
  return shape;
}

void Physics::addShape(Rid body, Rid shape) const { server_.call(body_add_shape_, body, shape); }
void Physics::setSpace(Rid body, Rid space) const { server_.call(body_set_space_, body, space); }
void Physics::setPlace(Rid body, const Transform& place) const {
  server_.call(body_set_state_, body, kStateTransform, place);
}
void Physics::setLayers(Rid body, int64_t layer, int64_t mask) const {
  server_.call(set_layer_, body, layer);
  server_.call(set_mask_, body, mask);
}
void Physics::free(Rid rid) const {
  if (rid) server_.call(free_rid_, rid);
}

}  // namespace sgm_godot
