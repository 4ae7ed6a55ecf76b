#pragma once
// A small engine around one streamed world, on the C interface alone: it believes nothing but events.

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

/// Ends the program with the error's message.
void must(sgm_result result, const sgm_error& error);

using Key = std::tuple<int32_t, int32_t, int32_t, int32_t>;  ///< level, place
using Place = std::array<double, 3>;                         ///< metres

/// Metres from a place to a chunk's box; 0 inside.
double distanceTo(const Key& key, const Place& place, double finest_cell_m);

class Engine {
 public:
  Engine(sgm_field* field, const sgm_world_desc& desc);

  void setViewers(std::span<const sgm_viewer> viewers);
  /// One frame: an update and all of its events.
  void frame(uint64_t max_bytes);
  sgm_world_stats stats() const;
  sgm_world_times times() const;
  sgm_world* world() const { return world_.get(); }

  /// Whether cells of at most `cell` metres are drawn within `radius` metres of a place, and something is. Chunks
  /// without triangles are never told of: what is coarser shows that one is not there.
  bool isDrawn(const Place& place, double radius_m, double cell_m) const;
  size_t countDrawn(int32_t level) const;

  struct Counts {
    uint64_t failed = 0;
    uint64_t most_bytes = 0;       ///< handed over in one frame
    uint64_t colliders = 0;        ///< handed over
    uint64_t equal_colliders = 0;  ///< in place of one with the same bytes
    uint64_t most_colliders = 0;   ///< in one frame
  };
  const Counts& counts() const { return counts_; }

 private:
  void take(const sgm_world_event& event);

  WorldOwner world_;
  double finest_cell_m_;
  std::map<Key, MeshOwner> meshes_;
  std::set<Key> drawn_;
  std::map<Key, uint64_t> colliders_;  ///< a hash of their bytes
  Counts counts_;
  uint64_t bytes_ = 0, frame_colliders_ = 0;  ///< of this frame
};

}  // namespace crowds
