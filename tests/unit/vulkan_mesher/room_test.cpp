// Tests buffers that are too small for a batch.

#include "catch.h"
#include "mesher.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

TEST_CASE("parts without room are left out whole", "[vulkan_mesher]") {
  const auto mesher = Mesher::create();
  if (!mesher) return;
  for (unsigned round = 0; round < rounds(15); ++round) {
    const uint64_t seed = 7300 + round;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const MeshInput input = randomInput(random, 1 + random() % 12);
    const auto parts = meshOnCpu(input);
    Room room = roomFor(input, parts);
    uint32_t& scarce = round % 3 == 0 ? room.vertices : round % 3 == 1 ? room.indices : room.cells;
    scarce = static_cast<uint32_t>(random() % (scarce + 1));
    CAPTURE(room.vertices, room.indices, room.cells);

    size_t fitting = 0, chunk = 0;
    Room used{0, 0, 0};
    for (; fitting < parts.size(); ++fitting) {
      used.vertices += static_cast<uint32_t>(parts[fitting].vertices.size());
      used.indices += static_cast<uint32_t>(parts[fitting].indices.size());
      if (fitting < input.bodies()) {
        while (!input.with_body[chunk]) ++chunk;
        used.cells += activeCells(input.chunks[chunk++]);
      }
      if (used.vertices > room.vertices || used.indices > room.indices || used.cells > room.cells) break;
    }
    const auto output = mesher->run(input, room);
    REQUIRE(output.inputs_kept);
    REQUIRE(output.guards_kept);
    requireParts(output, parts, fitting);
    for (size_t i = fitting; i < parts.size(); ++i) {
      CAPTURE(i);
      CHECK(output.parts[i].first_vertex == batch::kNoRoom);
      CHECK(output.parts[i].first_index == batch::kNoRoom);
      CHECK((output.parts[i].hash[0] | output.parts[i].hash[1]) == 0);
      // For parts that did not fit, the output contains the numbers that they need, so that the next try has enough
      // room.
      CHECK(output.parts[i].vertices == parts[i].vertices.size());
      CHECK(output.parts[i].indices == parts[i].indices.size());
    }
  }
  for (const std::string& message : mesher->messages()) UNSCOPED_INFO(message);
  CHECK(mesher->messages().empty());
}
