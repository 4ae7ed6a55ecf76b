#pragma once
// Octrees of a field's chunks, meshed through the public interface and drawn into a frame checker.

#include <map>
#include <random>
#include <vector>

#include "fixture.h"
#include "stream/plan/frame.h"
#include "stream/random_tree.h"
#include "tools/flight/frame_checker.h"

namespace sgm {

/// Two closed worlds around the origin whose coarse levels lack pebbles and octaves of noise.
inline constexpr const char* kClosedWorlds[] = {
    "sgm 1;\nimport \"std/rock.sgm\" as rock;\nunits m;\ndomain finite box(120m, 120m, 120m) empty;\nstart Rock;\n"
    "rule Rock {\n"
    "  at(4m, -3m, 5m) displace rock.fbm(period 9m, amp 4m) { sphere(30m); }\n"
    "  repeat 9 at(3m, 4m, 2m) detail 1m { at(0m, 0m, -35m) sphere(1.2m); }\n}\n",
    "sgm 1;\nimport \"std/rock.sgm\" as rock;\nunits m;\ndomain finite box(120m, 120m, 120m) solid limestone;\n"
    "start Cave;\nrule Cave {\n"
    "  cut {\n"
    "    at(4m, -3m, 5m) displace rock.fbm(period 7m, amp 3m) { sphere(20m); }\n"
    "    tube((4m, -3m, 5m), (0m, 6m, 46m), 3m, bend 6m);\n"
    "    tube((4m, -3m, 5m), (-40m, -14m, -24m), 2m, bend 9m);\n  }\n"
    "  repeat 8 at(2m, 1m, 1m) detail 1m { at(-8m, -6m, -4m) sphere(0.9m); }\n}\n"};
/// A closed world of rotated boxes, whose coarse levels lack pebbles.
inline constexpr const char* kBoxWorld =
    "sgm 1;\nunits m;\ndomain finite box(120m, 120m, 120m) empty;\nstart Heap;\nrule Heap {\n"
    "  at(4m, -3m, 5m) rot(y, 25deg) rot(x, 35deg) box(34m, 21m, 27m);\n"
    "  at(-20m, 5m, -15m) rot(y, 45deg) { box(24m, 30m, 16m); cut { rot(x, 15deg) box(9m, 40m, 9m); } }\n"
    "  repeat 9 at(3m, 4m, 2m) detail 1m { at(0m, 0m, -35m) rot(y, 30deg) box(1.2m, 2m, 0.7m); }\n}\n";
inline constexpr int kTop = 3;
inline constexpr int32_t kFinestCell = 256;

/// An octree of the whole closed world, refined at random places around its middle.
inline Octree randomTree(std::mt19937& random) {
  const int splits = 1 + static_cast<int>(random() % 6);
  return randomTree(random, kTop, kFinestCell, splits, 32768);
}

inline sgm_chunk_key publicKey(const ChunkKey& key) { return {key.level, key.at.x, key.at.y, key.at.z}; }

/// For each chunk of an octree, the parts to draw.
using Drawing = std::map<ChunkKey, cli::DrawnParts>;
inline Drawing drawingOf(const Octree& tree) {
  Drawing drawing;
  for (const ChunkRequest& request : frameRequests(tree)) drawing[request.key] = {request.seams, request.coarser};
  return drawing;
}

/// The field of a closed world, and the meshes of the chunks requested so far, with all seams.
class MeshedWorld {
 public:
  /// flags: bits of sgm_meshing_flag.
  explicit MeshedWorld(const char* grammar, uint32_t flags = 0)
      : flags_(flags),
        runtime_(makeRuntime()),
        grammar_(compile(runtime_.get(), grammar)),
        field_(makeField(runtime_.get(), grammar_.get(), kFinestCell)) {}

  void want(const Drawing& drawing) {
    std::vector<sgm_chunk_request> requests;
    for (const auto& [key, parts] : drawing) {
      if (meshes_.count(key) != 0) continue;
      requests.push_back(chunkAt(publicKey(key), 63));
      requests.back().coarser = parts.coarser;
    }
    if (requests.empty()) return;
    std::vector<MeshOwner> made = meshChunks(field_.get(), requests, flags_);
    for (size_t i = 0; i < made.size(); ++i) {
      const sgm_chunk_key& key = requests[i].key;
      meshes_.emplace(ChunkKey{key.level, {key.x, key.y, key.z}}, std::move(made[i]));
    }
  }
  const sgm_grammar* grammar() const { return grammar_.get(); }
  sgm_mesh_view view(const ChunkKey& key) const { return viewOf(meshes_.at(key)); }
  bool empty(const ChunkKey& key) const { return view(key).index_count == 0; }

 private:
  uint32_t flags_;
  RuntimeOwner runtime_;
  GrammarOwner grammar_;
  FieldOwner field_;
  std::map<ChunkKey, MeshOwner> meshes_;
};

}  // namespace sgm
