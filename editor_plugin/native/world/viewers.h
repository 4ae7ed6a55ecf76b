#pragma once

#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "world/world_node.h"

namespace sgm_godot {

/// The positions around which a world is streamed. Also stores, for each viewer's node, its last position and whether
/// it has ground to walk on. Main thread only.
class Viewers {
 public:
  explicit Viewers(WorldNode& node) : node_(node) {}

  /// Finds the current viewers: the nodes of the class SgmViewer3D; without any, the camera; in the editor, the
  /// editor's camera. `delta`: seconds since the previous call; 0 if unknown, so that viewers get no velocity.
  void gather(double delta);
  void clear();
  /// `fov`: degrees.
  void setEditorView(const Transform& view, double fov);

  /// Queues the signal `walkable` for each viewer that had no ground so far, and for whose position (in scene
  /// coordinates) has_ground() now returns true.
  void lookForGround(const std::function<bool(Vector3 position)>& has_ground);
  void forgetGround();

  // Each of the following lists has one element for each viewer.
  const std::vector<sgm_viewer>& all() const { return viewers_; }
  const std::vector<Vector3>& places() const { return places_; }  // positions in scene coordinates
  const std::vector<Units>& units() const { return units_; }      // positions in the world, in units

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
  std::unordered_map<uint64_t, Watched> watched_;  // state of each viewer, by the id of its node
  std::optional<Transform> editor_view_;
  double editor_fov_ = 70;
};

}  // namespace sgm_godot
