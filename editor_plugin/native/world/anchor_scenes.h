#pragma once

#include <deque>
#include <unordered_map>

#include "anchors.h"
#include "world/active_session.h"
#include "world/world_node.h"

namespace sgm_godot {

/// The anchors in what a world draws, and the scenes that the setting anchor_scenes puts there. Main thread.
class AnchorScenes {
 public:
  explicit AnchorScenes(WorldNode& node) : node_(node) {}

  /// Takes the changes of a frame: announces anchors that come and go, and removes the scenes of the latter.
  void follow(const std::vector<Picture::Change>& changes, const sgm_grammar* grammar);
  /// Makes the missing scenes until `seconds` are over, at least one. A scene may do anything as it enters the tree,
  /// such as end the session.
  void place(const ActiveSession& active, double seconds);
  /// Moves the scenes to where the node and its origin are now.
  void move(const sgm_grammar* grammar);
  /// Removes all anchors and their scenes; announces it while the node is in the tree.
  void clear();

 private:
  void remove(uint64_t key);

  struct Placed {
    uint64_t node;  // its id
    sgm_anchor anchor;
  };
  WorldNode& node_;
  Anchors anchors_;
  std::deque<sgm_anchor> unplaced_;              // anchors whose scenes are missing
  std::unordered_map<uint64_t, Placed> scenes_;  // by the anchor's key
  Lifetime lifetime_;
};

}  // namespace sgm_godot
