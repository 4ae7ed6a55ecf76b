#pragma once
// The collision bodies of a world in the engine's physics. They are made from the runtime's colliders, nearest first.
// Main thread only; a background thread prepares the triangles.

#include <map>

#include "picture.h"

namespace sgm_godot {

class Colliders {
 public:
  struct Space {
    Rid space;
    Placement placement;
    Object owner = nullptr;
    int64_t layer = 1, mask = 1;
  };
  Colliders(Plugin& plugin, Space space);
  ~Colliders();
  Colliders(const Colliders&) = delete;
  Colliders& operator=(const Colliders&) = delete;

  /// Takes the collider events out of `events` and becomes the owner of their colliders.
  void take(const std::vector<sgm_world_event>& events);

  /// Makes collision shapes for `seconds`, but at least one if any is pending. Chunks near one of `viewers` (scene
  /// coordinates) come first. A chunk keeps its previous body until all shapes of the new body exist.
  void advance(double seconds, const std::vector<Vector3>& viewers);

  void setPlacement(const Placement& placement);
  void setLayers(int64_t layer, int64_t mask);

  struct Counts {
    size_t chunks = 0, waiting = 0;
  };
  Counts counts() const { return {bodies_.size(), waiting_.size()}; }
  /// Returns whether a collider that touches the box (scene coordinates) has not been made yet.
  bool waitsIn(const Aabb& box) const;

 private:
  struct Faces;
  struct Body {
    Rid body;
    std::vector<Rid> shapes;
    int32_t origin[3] = {};
  };
  void free(Body& body);
  void build(Faces& faces);
  Vector3 centre(const Faces& faces) const;

  Plugin& plugin_;
  Space space_;
  std::map<sgm_chunk_key, Body, KeyLess> bodies_;
  std::map<sgm_chunk_key, std::shared_ptr<Faces>, KeyLess> waiting_;
};

}  // namespace sgm_godot
