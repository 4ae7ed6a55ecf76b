#include "tools/flight/whole_check.h"

#include <memory_resource>
#include <unordered_map>

#include "measure/bvh.h"
#include "measure/triangle_pair.h"

namespace sgm::cli {
namespace {

/// Runs jobs in the calling thread, because the runtime uses the other threads.
class NoThreads final : public JobSystem {
 public:
  unsigned concurrency() const override { return 1; }
  void submit(void (*function)(void*), void* argument, int) override { function(argument); }
  bool help() override { return false; }
};

/// Counts faulty pairs of triangles, except pairs within one body (WholeReport::between_parts).
uint64_t countBetweenParts(const CheckedChunks& chunks) {
  struct Owner {
    int level;
    bool body;
  };
  std::vector<Owner> parts;
  std::vector<uint32_t> owners;  // for each triangle, the index of its part in `parts`
  std::vector<measure::Point> points;
  std::vector<measure::Triangle> triangles;
  if (chunks.empty()) return 0;
  const Int3 origin = chunks.begin()->second.grid.origin;
  for (const auto& [key, chunk] : chunks) {
    forEachDrawn(chunk, [&, &grid = chunk.grid](const CheckedPart& part, size_t number) {
      const auto first = static_cast<uint32_t>(points.size());
      for (const VertexPlace& v : part.vertices) {
        measure::Point& p = points.emplace_back();
        const std::array<int, 3> at{v.x, v.y, v.z};
        // Coordinates in 1/256 unit are integers, so double precision represents them exactly.
        for (int axis = 0; axis < 3; ++axis)
          p[axis] = static_cast<double>((int64_t{grid.origin[axis]} - origin[axis]) * kSubcell +
                                        int64_t{at[static_cast<size_t>(axis)]} * grid.cell);
      }
      for (size_t i = 0; i < part.indices.size(); i += 3) {
        triangles.push_back({first + part.indices[i], first + part.indices[i + 1], first + part.indices[i + 2]});
        owners.push_back(static_cast<uint32_t>(parts.size()));
      }
      parts.push_back({grid.level, number == 0});
    });
  }
  NoThreads jobs;
  const measure::Bvh tree({points, triangles}, jobs);
  const auto cornersOf = [&](uint32_t t) {
    const measure::Triangle& v = triangles[t];
    return std::array<measure::Point, 3>{points[v[0]], points[v[1]], points[v[2]]};
  };
  uint64_t pairs = 0;
  for (const measure::Bvh::Pair& pair : tree.parts(1)) {
    measure::Bvh::Walk walk(pair);
    tree.visitPairs(walk, UINT64_MAX, [&](uint32_t a, uint32_t b) {
      const Owner &first = parts[owners[a]], &second = parts[owners[b]];
      if (owners[a] == owners[b]) {
        // Skip pairs within a body: countTriangles() already counts them. Triangles of one seam may coincide, so count
        // them only if they pierce each other.
        if (first.body) return;
      } else if (first.body && second.body && first.level == second.level) {
        pairs += measure::pairFault(cornersOf(a), cornersOf(b)) != PairFault::none;
        return;
      }
      pairs += measure::pierce(cornersOf(a), cornersOf(b));
    });
  }
  return pairs;
}

}  // namespace

WholeReport checkAll(const CheckedChunks& chunks) {
  WholeReport whole;
  std::pmr::unsynchronized_pool_resource pool;
  std::pmr::unordered_map<VertexKey, uint32_t, VertexKeyHash> shared(&pool);
  std::vector<uint32_t> indices, first, numbers;
  PairScratch scratch(std::pmr::new_delete_resource());
  uint32_t next = 0;
  for (const auto& [key, chunk] : chunks) {
    forEachDrawn(chunk, [&](const CheckedPart& part, size_t number) {
      if (number == 0) numberByEdge(part, first);
      const SeamOf seam = seamOf(chunk.drawn, number);
      numbers.resize(part.vertices.size());
      for (size_t i = 0; i < numbers.size(); ++i) {
        if (number == 0 && isInside(part.vertices[i])) {
          numbers[i] = first[i] == i ? next++ : numbers[first[i]];
          continue;
        }
        const auto [at, fresh] =
            shared.try_emplace(*vertexKey(chunk.grid, part.vertices[i], number == 0 ? nullptr : &seam), next);
        next += fresh;
        numbers[i] = at->second;
      }
      for (const uint32_t index : part.indices) indices.push_back(numbers[index]);
      const TriangleCounts counts = countTriangles(part, number, numbers, scratch);
      whole.frame.degenerate_triangles += counts.degenerate;
      whole.frame.flat_triangles += counts.flat;
      whole.frame.folded_triangles += counts.pairs.folded;
      whole.frame.self_intersections += counts.pairs.cut;
    });
    for (ChunkKey outer = key; outer.level < kMaxLevel;) whole.frame.overlaps += chunks.count(outer = parentOf(outer));
  }
  whole.mesh = checkTriangles(indices, next);
  whole.frame.chunks = chunks.size();
  whole.frame.triangles = whole.mesh.triangles;
  whole.frame.edges = whole.mesh.edges;
  whole.frame.open_edges = whole.mesh.unmatched_edges;
  whole.frame.nonmanifold_edges = whole.mesh.repeated_edges;
  whole.between_parts = countBetweenParts(chunks);
  return whole;
}

}  // namespace sgm::cli
