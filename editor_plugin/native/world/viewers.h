#pragma once

#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "world/world_node.h"

namespace sgm_godot {

/// The places that a world is streamed around, and for each viewer's node its last position and whether it has ground
/// to walk on. Main thread.
class Viewers {
 public:
  explicit Viewers(WorldNode& node) : node_(node) {}

  /// Finds the current places: those of the viewers' nodes, else of the camera; in the editor, of the editor's camera.
  /// `delta`: seconds since the previous call; 0 if unknown, then no viewer has a velocity.
  void gather(double delta);
  void clear();
  /// `fov`: degrees.
  void setEditorView(const Transform& view, double fov);

  /// Announces `walkable` for each viewer that has no ground yet, if there is some below its position (scene).
  void lookForGround(const std::function<bool(Vector3 position)>& has_ground);
  void forgetGround();

  // One element for each viewer.
  const std::vector<sgm_viewer>& all() const { return viewers_; }
  const std::vector<Vector3>& places() const { return places_; }  // in the scene
  const std::vector<Units>& units() const { return units_; }      // in the world

 private:
  struct Watched {
    Vector3 position;
    bool walkable = false;
    bool seen = false;
  };
  struct Seen {
    Transform place;
    double fov, weight;
    bool directional;
  };
  void add(uint64_t id, const Seen& viewer, const Placement& placement, double delta);

  WorldNode& node_;
  std::vector<sgm_viewer> viewers_;
  std::vector<Vector3> places_;
  std::vector<Units> units_;
  std::unordered_map<uint64_t, Watched> watched_;  // by the id of the viewer's node
  std::optional<Transform> editor_view_;
  double editor_fov_ = 70;
};

}  // namespace sgm_godot
