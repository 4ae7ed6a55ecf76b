#pragma once

#include <deque>
#include <unordered_map>

#include "anchors.h"
#include "world/active_session.h"
#include "world/world_node.h"

namespace sgm_godot {

/// Tracks the anchors in the drawn chunks of a world, and the scenes that the setting anchor_scenes instantiates at
/// them. Main thread only.
class AnchorScenes {
 public:
  explicit AnchorScenes(WorldNode& node) : node_(node) {}

  /// Processes the changes of a frame: announces anchors that appear and disappear, and removes the scenes of anchors
  /// that disappear.
  void follow(const std::vector<Picture::Change>& changes, const sgm_grammar* grammar);
  /// Instantiates pending scenes for `seconds`, but at least one. A scene's scripts may do anything when it enters the
  /// tree, such as end the session.
  void place(const ActiveSession& active, double seconds);
  /// Moves the scenes to the places of their anchors after the node or its origin has moved.
  void move(const sgm_grammar* grammar);
  /// Removes all anchors and their scenes. Announces the removal if the node is in the tree.
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
