#pragma once
// A minimal engine with one streamed world, through the C interface alone: it knows only what the world's events
// report.

#include <sgm/sgm.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <tuple>
#include <vector>

namespace crowds {

template <auto End>
struct EndWith {
  template <class T>
  void operator()(T* handle) const {
    static_cast<void>(End(handle));
  }
};
template <class T, auto End>
using Owner = std::unique_ptr<T, EndWith<End>>;
using RuntimeOwner = Owner<sgm_runtime, sgm_runtime_destroy>;
using GrammarOwner = Owner<sgm_grammar, sgm_grammar_destroy>;
using FieldOwner = Owner<sgm_field, sgm_field_destroy>;
using WorldOwner = Owner<sgm_world, sgm_world_destroy>;
using MeshOwner = Owner<sgm_mesh, sgm_mesh_release>;

/// If `result` is an error, prints its message and ends the program.
void must(sgm_result result, const sgm_error& error);

using Key = std::tuple<int32_t, int32_t, int32_t, int32_t>;  ///< level, x, y, z
using Place = std::array<double, 3>;                         ///< a position in metres

/// Returns the distance in metres from a position to a chunk's box; 0 inside the box.
double distanceTo(const Key& key, const Place& place, double finest_cell_m);

class Engine {
 public:
  Engine(sgm_field* field, const sgm_world_desc& desc);

  void setViewers(std::span<const sgm_viewer> viewers);
  /// Runs one frame: updates the world, then handles all events. max_bytes: limit of mesh data in this frame.
  void frame(uint64_t max_bytes);
  sgm_world_stats stats() const;
  sgm_world_times times() const;
  sgm_world* world() const { return world_.get(); }

  /// True if at least one chunk is drawn within `radius_m` of a position, and all such chunks have grid cells of at
  /// most `cell_m`. Chunks without triangles cause no events. So a missing fine chunk is detected only if a coarser
  /// chunk is drawn in its place.
  bool isDrawn(const Place& place, double radius_m, double cell_m) const;
  size_t countDrawn(int32_t level) const;

  struct Counts {
    uint64_t failed = 0;
    uint64_t peak_bytes = 0;       ///< maximum number of mesh bytes received in one frame
    uint64_t colliders = 0;        ///< number of colliders received
    uint64_t equal_colliders = 0;  ///< number of received colliders with the same bytes as the collider that they
                                   ///< replaced
    uint64_t max_colliders = 0;    ///< maximum number of colliders received in one frame
  };
  const Counts& counts() const { return counts_; }

 private:
  void take(const sgm_world_event& event);

  WorldOwner world_;
  double finest_cell_m_;
  std::map<Key, MeshOwner> meshes_;
  std::set<Key> drawn_;
  std::map<Key, uint64_t> colliders_;  ///< for each chunk with a collider: hash of the collider's bytes
  Counts counts_;
  uint64_t bytes_ = 0, frame_colliders_ = 0;  ///< mesh bytes and colliders received in the current frame
};

}  // namespace crowds
