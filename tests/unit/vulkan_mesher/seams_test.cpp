// Tests seams of all faces against polygonizeSeam.

#include <algorithm>

#include "../mesh/fields.h"
#include "catch.h"
#include "mesher.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

TEST_CASE("shaders mesh seams to the bytes of the CPU", "[vulkan_mesher]") {
  const auto mesher = Mesher::create();
  if (!mesher) return;
  for (unsigned round = 0; round < rounds(12); ++round) {
    const uint64_t seed = 7200 + round;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    MeshInput input = randomInput(random, 1 + random() % 8);
    // Random signs that are independent of each other give the longest loops.
    const double density = std::uniform_real_distribution<double>(0.2, 0.8)(random);
    const LatticeField noise = [=](Int3 p, int level) {
      return randomQ(pointHash(seed + static_cast<uint64_t>(level), p), density);
    };
    const ChunkGrid grid = latticeChunk({0, 0, 0}, 0);
    input.chunks.push_back(sampleChunk(noise, grid));
    input.with_body.push_back(round % 2 == 0);
    for (int f = 0; f < 6; ++f) {
      const Face face = static_cast<Face>(f);
      input.seams.push_back({input.chunks.size() - 1, face, sampleFace(noise, grid, face)});
    }
    const auto expected = meshOnCpu(input);
    const auto output = mesher->run(input, roomFor(input, expected));
    REQUIRE(output.inputs_kept);
    REQUIRE(output.guards_kept);
    requireParts(output, expected, expected.size());
    for (size_t i = input.bodies(); i < expected.size(); ++i) {
      CAPTURE(i);
      const auto ofKind = [&](uint16_t kind) {
        return std::count_if(expected[i].vertices.begin(), expected[i].vertices.end(),
                             [=](const Vertex& v) { return v.kind == kind; });
      };
      CHECK(output.parts[i].cells == ofKind(kOwnEdge));
      CHECK(output.parts[i].middle == ofKind(kCoarserEdge));
    }
  }
  for (const std::string& message : mesher->messages()) UNSCOPED_INFO(message);
  CHECK(mesher->messages().empty());
}
