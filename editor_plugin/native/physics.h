#pragma once
// The functions of the engine's PhysicsServer3D that collision needs. With the project setting
// physics/3d/run_on_separate_thread the engine executes them in its own thread; otherwise they run on the calling
// thread.

#include "godot/variant.h"

namespace sgm_godot {

class Physics {
 public:
  Physics();

  /// Makes a static body that does not yet belong to a space.
  Rid createBody(const Transform& place, Object owner, int64_t layer, int64_t mask) const;
  Rid createShape(const Variant& faces) const;  // faces: a PackedVector3Array with three corners for each triangle
  void addShape(Rid body, Rid shape) const;
  void setSpace(Rid body, Rid space) const;  // an empty `space` takes the body out of its current space
  void setPlace(Rid body, const Transform& place) const;
  void setLayers(Rid body, int64_t layer, int64_t mask) const;
  void free(Rid rid) const;

 private:
  Variant server_;
  Name body_create_{"body_create"}, body_set_mode_{"body_set_mode"}, body_set_state_{"body_set_state"},
      attach_{"body_attach_object_instance_id"}, set_layer_{"body_set_collision_layer"},
      set_mask_{"body_set_collision_mask"}, create_shape_{"concave_polygon_shape_create"},
      shape_set_data_{"shape_set_data"}, body_add_shape_{"body_add_shape"}, body_set_space_{"body_set_space"},
      free_rid_{"free_rid"};
};

}  // namespace sgm_godot
