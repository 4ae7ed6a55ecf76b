#include "rendering.h"

namespace sgm_godot {

Rendering::Rendering() : server_(engine().global_get_singleton(Name("RenderingServer").get())) {}

Rid Rendering::createMesh(const std::vector<Variant>& surfaces) const {
  const Rid mesh = server_.call(mesh_create_).to<Rid>();
  for (const Variant& surface : surfaces) server_.call(mesh_add_surface_, mesh, surface);
  return mesh;
}

Rid Rendering::createInstance(Rid mesh, Rid scenario, const Transform& place) const {
  const Rid instance = server_.call(instance_create2_, mesh, scenario).to<Rid>();
  server_.call(instance_set_transform_, instance, place);
  server_.call(instance_set_visible_, instance, false);
  return instance;
}

void Rendering::setVisible(Rid instance, bool visible) const { server_.call(instance_set_visible_, instance, visible); }
void Rendering::setPlace(Rid instance, const Transform& place) const {
  server_.call(instance_set_transform_, instance, place);
}
void Rendering::setMaterial(Rid mesh, int64_t surface, Rid material) const {
  server_.call(mesh_surface_set_material_, mesh, surface, material);
}
void Rendering::setShadow(Rid instance, bool casts) const {
  server_.call(set_shadow_, instance, int64_t{casts ? 1 : 0});
}
void Rendering::setLayers(Rid instance, int64_t layers) const { server_.call(set_layers_, instance, layers); }
void Rendering::attach(Rid instance, Object owner) const {
  server_.call(attach_, instance, engine().object_get_instance_id(owner));
}
void Rendering::free(Rid rid) const {
  if (rid) server_.call(free_rid_, rid);
}

}  // namespace sgm_godot
