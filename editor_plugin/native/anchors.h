#pragma once
// Tracks which of a grammar's anchors lie in the drawn chunks. Main thread only.

#include <unordered_map>

#include "picture.h"

namespace sgm_godot {

/// The dictionary that describes an anchor to scripts: kind, name, tag, key and transform (in scene coordinates).
Variant anchorOf(const sgm_grammar* grammar, const sgm_anchor& anchor, const Placement& placement);

class Anchors {
 public:
  struct News {
    std::vector<sgm_anchor> come;
    std::vector<uint64_t> gone;  // keys of the anchors that are no longer in drawn chunks
  };
  /// Applies one frame's changes of the drawn chunks. Returns the anchors that appear and the anchors that disappear.
  /// Anchors that pass from a replaced chunk to the finer or coarser chunks in its place are not returned.
  News follow(const std::vector<Picture::Change>& changes);
  std::vector<uint64_t> clear();  // forgets all anchors, and returns their keys

 private:
  std::map<sgm_chunk_key, std::vector<uint64_t>, KeyLess> by_chunk_;
  std::unordered_map<uint64_t, int> shown_;  // anchor key -> number of drawn chunks that contain the anchor
};

}  // namespace sgm_godot
