#pragma once
// What a world collides with, in the engine's physics: takes colliders over, nearest first. Main thread; their
// triangles are arranged on the background thread.

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

  /// The events of colliders among these; takes them over.
  void take(const std::vector<sgm_world_event>& events);

  /// Makes shapes until `seconds` are over, one at least where one waits; chunks near one of `viewers` (scene) come
  /// first. A chunk's earlier collider stays until all of the next one is there.
  void advance(double seconds, const std::vector<Vector3>& viewers);

  void setPlacement(const Placement& placement);
  void setLayers(int64_t layer, int64_t mask);

  struct Counts {
    size_t chunks = 0, waiting = 0;
  };
  Counts counts() const { return {bodies_.size(), waiting_.size()}; }
  /// Whether a collider that touches the box (scene) still waits.
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
