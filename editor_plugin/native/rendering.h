#pragma once
// The functions of the engine's RenderingServer that draw chunks. Main thread only.

#include "godot/variant.h"

namespace sgm_godot {

class Rendering {
 public:
  Rendering();

  Rid createMesh(const std::vector<Variant>& surfaces) const;  // surfaces: dictionaries, as packSurfaces() returns them
  Rid createInstance(Rid mesh, Rid scenario, const Transform& place) const;
  void setVisible(Rid instance, bool visible) const;
  void setPlace(Rid instance, const Transform& place) const;
  void setMaterial(Rid mesh, int64_t surface, Rid material) const;
  void setShadow(Rid instance, bool casts) const;
  void setLayers(Rid instance, int64_t layers) const;
  void attach(Rid instance, Object owner) const;  // lets the editor select the owner by a click on the instance
  void free(Rid rid) const;

 private:
  Variant server_;
  Name mesh_create_{"mesh_create"}, mesh_add_surface_{"mesh_add_surface"}, instance_create2_{"instance_create2"},
      instance_set_transform_{"instance_set_transform"}, instance_set_visible_{"instance_set_visible"},
      mesh_surface_set_material_{"mesh_surface_set_material"}, free_rid_{"free_rid"},
      set_shadow_{"instance_geometry_set_cast_shadows_setting"}, set_layers_{"instance_set_layer_mask"},
      attach_{"instance_attach_object_instance_id"};
};

}  // namespace sgm_godot
