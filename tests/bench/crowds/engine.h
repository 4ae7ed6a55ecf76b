#pragma once
// A small engine for one streamed world, through the C interface alone: it knows only what the world's events report.

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

/// If a call has failed, prints the error's message and ends the program.
void must(sgm_result result, const sgm_error& error);

using Key = std::tuple<int32_t, int32_t, int32_t, int32_t>;  ///< level, x, y, z
using Place = std::array<double, 3>;                         ///< a position in metres

/// Distance in metres from a place to a chunk's box; 0 inside the box.
double distanceTo(const Key& key, const Place& place, double finest_cell_m);

class Engine {
 public:
  Engine(sgm_field* field, const sgm_world_desc& desc);

  void setViewers(std::span<const sgm_viewer> viewers);
  /// One frame: an update, then all of its events.
  void frame(uint64_t max_bytes);
  sgm_world_stats stats() const;
  sgm_world_times times() const;
  sgm_world* world() const { return world_.get(); }

  /// Whether something is drawn within `radius_m` of a place, and all of it has grid cells of at most `cell_m`. No
  /// events report chunks without triangles, so only the presence of a coarser chunk shows that a finer one is missing.
  bool isDrawn(const Place& place, double radius_m, double cell_m) const;
  size_t countDrawn(int32_t level) const;

  struct Counts {
    uint64_t failed = 0;
    uint64_t peak_bytes = 0;       ///< maximum number of bytes handed over in one frame
    uint64_t colliders = 0;        ///< number of colliders handed over
    uint64_t equal_colliders = 0;  ///< number of colliders that replaced one with the same bytes
    uint64_t max_colliders = 0;    ///< maximum number of colliders handed over in one frame
  };
  const Counts& counts() const { return counts_; }

 private:
  void take(const sgm_world_event& event);

  WorldOwner world_;
  double finest_cell_m_;
  std::map<Key, MeshOwner> meshes_;
  std::set<Key> drawn_;
  std::map<Key, uint64_t> colliders_;  ///< a hash of each collider's bytes
  Counts counts_;
  uint64_t bytes_ = 0, frame_colliders_ = 0;  ///< of the current frame
};

}  // namespace crowds
