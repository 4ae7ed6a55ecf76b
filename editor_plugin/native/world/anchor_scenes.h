#pragma once

#include <deque>
#include <unordered_map>

#include "anchors.h"
#include "world/active_session.h"
#include "world/world_node.h"

namespace sgm_godot {

/// Tracks the anchors in the drawn chunks of a world, and the scene instances at these anchors. The property
/// anchor_scenes tells which scene to instantiate at which anchor. Main thread only.
class AnchorScenes {
 public:
  explicit AnchorScenes(WorldNode& node) : node_(node) {}

  /// Processes the changes of a frame: queues signals for anchors that appear or disappear, and removes the scenes of
  /// those that disappear.
  void follow(const std::vector<Picture::Change>& changes, const sgm_grammar* grammar);
  /// Instantiates pending scenes until `seconds` have passed, but at least one scene. When a scene enters the tree, its
  /// scripts may do anything, for example end the session.
  void place(const ActiveSession& active, double seconds);
  /// Moves the scenes to the places of their anchors after the node or its origin has moved.
  void move(const sgm_grammar* grammar);
  /// Removes all anchors and their scenes. If the node is in the tree, also queues the signals that the anchors have
  /// disappeared.
  void clear();

 private:
  void remove(uint64_t key);

  struct Placed {
    uint64_t node;  // its id
    sgm_anchor anchor;
  };
  WorldNode& node_;
  Anchors anchors_;
  std::deque<sgm_anchor> unplaced_;              // anchors whose scenes are not instantiated yet
  std::unordered_map<uint64_t, Placed> scenes_;  // scenes by key of their anchors
  Lifetime lifetime_;
};

}  // namespace sgm_godot
