#pragma once
// The drawn chunks of a world in the engine's scene. Receives the runtime's events frame by frame. Main thread only;
// the background thread packs meshes.

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

/// Properties that all drawn chunks of a world share.
struct Look {
  Rid scenario;
  Placement placement;
  std::vector<uint16_t> slots;  // slot in `materials` of each of the grammar's materials
  std::vector<Rid> materials;   // the engine's id of each material, indexed by slot
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

  /// Receives all events of one update, in their order, and becomes the owner of their meshes.
  void take(const std::vector<sgm_world_event>& events);
  /// Receives everything that a world draws. Used for a picture that starts after the world's first events. Becomes the
  /// owner of the meshes. `before`: the picture that has received all events so far; its meshes that are not drawn yet
  /// move to this picture.
  void takeDrawn(const std::vector<sgm_drawn_chunk>& chunks, const Picture& before);

  /// A chunk that appeared, disappeared, or got another mesh.
  struct Change {
    enum Kind { kShown, kReplaced, kRemoved } kind;
    sgm_chunk_key key;
    MeshOwner mesh;  // the mesh of a chunk that is shown or replaced; null if the chunk is removed
  };
  /// Uploads meshes until `seconds` have passed, but at least one mesh. Then shows the changes of all frames whose
  /// meshes are uploaded. The changes of a frame are shown together, so that no partial change is visible.
  std::vector<Change> advance(double seconds);
  /// Uploads and shows everything that was received. Blocks until the background thread has packed it.
  std::vector<Change> finish();

  void setPlacement(const Placement& placement);
  void setMaterials(const std::vector<Rid>& materials);
  void setLook(bool shadow, bool visible, int64_t layers);

  struct Counts {
    size_t chunks = 0, waiting = 0, triangles = 0;
  };
  Counts counts() const { return {chunks_.size(), uploads_.size(), triangles_}; }
  bool complete() const { return frames_.empty(); }

  /// A drawn chunk: key, mesh and mask of the drawn seams.
  struct Shown {
    sgm_chunk_key key;
    const sgm_mesh* mesh;
    uint32_t seams;
  };
  std::vector<Shown> shown() const;

 private:
  /// A part of a mesh that is being packed or uploaded.
  struct Upload;
  using UploadOwner = std::shared_ptr<Upload>;
  struct Step {
    sgm_event_kind kind;
    sgm_chunk_key key;
    std::shared_ptr<sgm_mesh> mesh;
    // New parts, which replace the drawn parts once they are uploaded. If only body is null, the drawn body stays. If
    // the chunk is removed, both are null.
    UploadOwner body, seams;
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
  void eachUploaded(const Visit& visit);  // visits drawn parts and parts that will be drawn
  void apply(Frame& frame, std::vector<Change>& changes);

  Plugin& plugin_;
  Look look_;
  std::map<sgm_chunk_key, Chunk, KeyLess> chunks_;  // drawn chunks
  // For each chunk key, the mesh of the last READY event.
  std::map<sgm_chunk_key, std::shared_ptr<sgm_mesh>, KeyLess> known_;
  // uploads of the bodies of meshes in known_ that are not drawn yet
  std::map<sgm_chunk_key, UploadOwner, KeyLess> ready_;
  std::deque<UploadOwner> uploads_;
  std::deque<Frame> frames_;
  // keys of chunks that the previous picture has shown, and that this picture will not show
  std::vector<sgm_chunk_key> gone_;
  size_t triangles_ = 0;
};

}  // namespace sgm_godot
