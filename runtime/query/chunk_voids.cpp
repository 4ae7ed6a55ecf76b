#include "query/chunk_voids.h"

#include <algorithm>

#include "mesh/void_runs.h"

namespace sgm {

namespace {

constexpr size_t kLast = kChunkCells;

/// Takes runs of samples, each with the number of its void. Writes this number plus 1 into ChunkVoids::faces for those
/// samples of the run that lie in a face of the chunk.
class FaceWriter {
 public:
  explicit FaceWriter(ChunkVoids& chunk) : chunk_(chunk) {}

  void add(uint32_t number, size_t first, size_t last, size_t y, size_t z) {
    if (first == 0) write(Face::x_lo, number, y, y, z);
    if (last == kLast) write(Face::x_hi, number, y, y, z);
    if (y == 0) write(Face::y_lo, number, first, last, z);
    if (y == kLast) write(Face::y_hi, number, first, last, z);
    if (z == 0) write(Face::z_lo, number, first, last, y);
    if (z == kLast) write(Face::z_hi, number, first, last, y);
  }

 private:
  void write(Face face, uint32_t number, size_t first, size_t last, size_t row) {
    const auto f = static_cast<size_t>(face);
    std::pmr::vector<uint16_t>& plane = chunk_.faces[f];
    plane.resize(kVoidRows);
    for (size_t a = first; a <= last; ++a) plane[a + kChunkSamples * row] = static_cast<uint16_t>(number + 1);
    chunk_.voids[number].faces |= static_cast<uint8_t>(1u << f);
  }

  ChunkVoids& chunk_;
};

}  // namespace

ChunkVoids chunkVoids(std::span<const uint64_t> rows, Int3 owned, std::span<const Int3> marks,
                      std::pmr::memory_resource* memory) {
  VoidRuns runs(rows, memory);
  const auto faces = [&] { return std::pmr::vector<uint16_t>(memory); };
  ChunkVoids chunk{std::pmr::vector<ChunkVoids::Void>(memory),
                   {faces(), faces(), faces(), faces(), faces(), faces()},
                   std::vector<std::optional<uint32_t>>(marks.size())};
  // A void has its lowest label as root, and the loop meets this label first. So the void's number is known when the
  // loop comes to its other labels.
  std::pmr::vector<uint32_t> number(runs.labels(), memory);
  for (size_t label = 0; label < number.size(); ++label) {
    const size_t root = runs.rootOf(label);
    if (root == label) {
      number[label] = static_cast<uint32_t>(chunk.voids.size());
      chunk.voids.push_back({});
    }
    number[label] = number[root];
  }
  FaceWriter writer(chunk);
  runs.forEach([&](size_t label, size_t first, size_t last, size_t y, size_t z) {
    const uint32_t v = number[label];
    writer.add(v, first, last, y, z);
    for (size_t m = 0; m < marks.size(); ++m) {
      const auto x = static_cast<size_t>(marks[m].x);
      if (y == static_cast<size_t>(marks[m].y) && z == static_cast<size_t>(marks[m].z) && first <= x && x <= last)
        chunk.marked[m] = v;
    }
    if (y >= static_cast<size_t>(owned.y) || z >= static_cast<size_t>(owned.z)) return;
    const size_t end = std::min(last + 1, static_cast<size_t>(owned.x));
    if (first < end) chunk.voids[v].samples += static_cast<uint32_t>(end - first);
  });
  return chunk;
}

}  // namespace sgm
