// Tests the bodies that the shaders make for whole batches against polygonizeBody.

#include "catch.h"
#include "mesh/tables.h"
#include "mesh/vertex.h"
#include "mesher.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// For each row of one body, returns the values that the shader must compute: the numbers of vertices, indices and
/// active cells before the row, and a mask of the row's active cells.
std::vector<std::array<uint32_t, 4>> rowsOf(const ChunkSamples& samples, const MeshPart& part) {
  constexpr size_t kSide = kChunkSamples;
  std::vector<std::array<uint32_t, 4>> rows(kSide * kSide);
  std::array<uint32_t, 3> before{};
  size_t vertex = 0;
  for (size_t r = 0; r < rows.size(); ++r) {
    for (size_t i = 0; i < 3; ++i) rows[r][i] = before[i];
    for (; vertex < part.vertices.size(); ++vertex, ++before[0])
      if (edgeOfBodyVertex(part.vertices[vertex]).sample() / kSide != r) break;
    if (r % kSide == kChunkCells || r / kSide == kChunkCells) continue;
    for (size_t x = 0; x < kChunkCells; ++x) {
      size_t solid = 0;
      for (size_t c = 0; c < 8; ++c)
        solid |= (samples.signs[r + (c >> 1 & 1) + (c >> 2) * kSide] >> (x + (c & 1)) & 1) << c;
      if (solid == 0 || solid == 255) continue;
      before[1] += 3u * kCubeTriangles[solid];
      ++before[2];
      rows[r][3] |= 1u << x;
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("shaders mesh bodies to the bytes of the CPU", "[vulkan_mesher]") {
  const auto mesher = Mesher::create();
  if (!mesher) return;
  for (unsigned round = 0; round < rounds(12); ++round) {
    const uint64_t seed = 7100 + round;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    MeshInput input = randomInput(random, 1 + random() % 20);
    input.seams.clear();
    const auto expected = meshOnCpu(input);
    Room room = roomFor(input, expected);
    if (round % 2 == 0) room.vertices += 100, room.indices += 100, room.cells += 100;
    const auto output = mesher->run(input, room, static_cast<uint32_t>(random() % 3));
    REQUIRE(output.inputs_kept);
    REQUIRE(output.guards_kept);
    requireParts(output, expected, expected.size());
    CHECK(output.head.cells == roomFor(input, expected).cells);
    CHECK(output.head.dispatch[0] == (output.head.cells + 63) / 64);
    size_t body = 0;
    uint32_t cells = 0;
    for (size_t i = 0; i < input.chunks.size(); ++i) {
      if (!input.with_body[i]) continue;
      CAPTURE(i);
      CHECK(output.parts[body].cells == activeCells(input.chunks[i]));
      CHECK(output.parts[body].middle == cells);
      cells += output.parts[body].cells;
      const auto rows = rowsOf(input.chunks[i], expected[body]);
      const auto row = std::mismatch(rows.begin(), rows.end(),
                                     output.rows.begin() + static_cast<std::ptrdiff_t>(body * rows.size()));
      REQUIRE(row.first - rows.begin() == static_cast<std::ptrdiff_t>(rows.size()));
      ++body;
    }
  }
  for (const std::string& message : mesher->messages()) UNSCOPED_INFO(message);
  CHECK(mesher->messages().empty());
}
