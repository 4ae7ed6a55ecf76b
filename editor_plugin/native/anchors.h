#pragma once
// Which of a grammar's anchors lie in what is drawn, and the scenes that a game puts there. Main thread.

#include <unordered_map>

#include "picture.h"

namespace sgm_godot {

/// An anchor for scripts: kind, name, tag, key and transform (scene).
Variant anchorOf(const sgm_grammar* grammar, const sgm_anchor& anchor, const Placement& placement);

class Anchors {
 public:
  struct News {
    std::vector<sgm_anchor> come;
    std::vector<uint64_t> gone;  // keys
  };
  /// What a frame's changes make of them. A chunk that gives way to finer or coarser ones hands its anchors on: they
  /// neither come nor go.
  News follow(const std::vector<Picture::Change>& changes);
  std::vector<uint64_t> clear();  // keys of all that were there

 private:
  std::map<sgm_chunk_key, std::vector<uint64_t>, KeyLess> by_chunk_;
  std::unordered_map<uint64_t, int> shown_;  // key -> chunks that have it
};

}  // namespace sgm_godot
