#pragma once
// What a world draws, in the engine's scene: takes the runtime's events over, frame by frame. Main thread; meshes are
// packed on the background thread.

#include <map>
#include <memory>
#include <set>

#include "handles.h"
#include "packing.h"
#include "placement.h"
#include "plugin.h"

namespace sgm_godot {

struct KeyLess {
  bool operator()(const sgm_chunk_key& a, const sgm_chunk_key& b) const {
    return std::tie(a.level, a.x, a.y, a.z) < std::tie(b.level, b.x, b.y, b.z);
  }
};

/// How chunks are drawn: what all of them share.
struct Look {
  Rid scenario;
  Placement placement;
  std::vector<uint16_t> slots;  // by material of the grammar
  std::vector<Rid> materials;   // by slot
  bool shadow = true, visible = true;
  int64_t layers = 1;
  Object owner = nullptr;
};

class Picture {
 public:
  Picture(Plugin& plugin, Look look);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Events of one update, all of them, in their order; takes meshes over.
  void take(const std::vector<sgm_world_event>& events);
  /// Everything that a world draws, for who comes later than its events; takes the meshes over. `before` took the
  /// events up to now: what was handed to it and is not drawn yet is taken from there.
  void takeDrawn(const std::vector<sgm_drawn_chunk>& chunks, const Picture& before);

  /// A chunk that came, went, or is another one now.
  struct Change {
    enum Kind { kShown, kReplaced, kRemoved } kind;
    sgm_chunk_key key;
    MeshOwner mesh;  // of kShown and kReplaced
  };
  /// Uploads meshes until `seconds` are over, one at least, and shows whatever frames are complete then: each of them
  /// as a whole, so that no half of a change is ever seen.
  std::vector<Change> advance(double seconds);
  /// Uploads and shows all that was taken; waits for the background thread.
  std::vector<Change> finish();

  void setPlacement(const Placement& placement);
  void setMaterials(const std::vector<Rid>& materials);
  void setLook(bool shadow, bool visible, int64_t layers);

  struct Counts {
    size_t chunks = 0, waiting = 0, triangles = 0;
  };
  Counts counts() const { return {chunks_.size(), uploads_.size(), triangles_}; }
  bool complete() const { return frames_.empty(); }

  /// The chunks that are shown: key, mesh and the seams that are drawn.
  struct Shown {
    sgm_chunk_key key;
    const sgm_mesh* mesh;
    uint32_t seams;
  };
  std::vector<Shown> shown() const;

 private:
  /// A part of a mesh on its way to the screen.
  struct Upload;
  using UploadOwner = std::shared_ptr<Upload>;
  struct Step {
    sgm_event_kind kind;
    sgm_chunk_key key;
    std::shared_ptr<sgm_mesh> mesh;
    UploadOwner body, seams;  // what is to be drawn from now on; null: as before
    uint32_t mask;
  };
  struct Chunk {
    std::shared_ptr<sgm_mesh> mesh;
    UploadOwner body, seams;
    uint32_t mask = 0;
  };
  using Frame = std::vector<Step>;

  UploadOwner submit(const std::shared_ptr<sgm_mesh>& mesh, Part part);
  void upload(Upload& upload);
  void show(const UploadOwner& upload, bool visible);
  void drop(UploadOwner& upload);
  template <class Visit>
  void eachUploaded(const Visit& visit);  // shown and to be shown
  void apply(Frame& frame, std::vector<Change>& changes);

  Plugin& plugin_;
  Look look_;
  std::map<sgm_chunk_key, Chunk, KeyLess> chunks_;                     // drawn
  std::map<sgm_chunk_key, std::shared_ptr<sgm_mesh>, KeyLess> known_;  // as of the events: the mesh that was READY last
  std::map<sgm_chunk_key, UploadOwner, KeyLess> ready_;                // bodies of these that are not drawn yet
  std::deque<UploadOwner> uploads_;
  std::deque<Frame> frames_;
  std::vector<sgm_chunk_key> gone_;  // that the picture before has shown, and this one will not
  size_t triangles_ = 0;
};

}  // namespace sgm_godot
