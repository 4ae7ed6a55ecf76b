// Tests FieldChange: it reports every chunk whose content differs between two fields.

#include "catch.h"
#include "edited_fields.h"
#include "rounds.h"

using namespace sgm;

namespace {

/// Everything that an engine receives of a chunk.
struct Content {
  std::vector<ContentHash> hashes;
  std::vector<uint64_t> anchors;
  std::vector<Frame> frames;
  friend bool operator==(const Content&, const Content&) = default;
};

std::vector<Content> contentsOf(const WorldField& field, const std::vector<ChunkRequest>& requests) {
  std::vector<Content> contents;
  for (const PlacedChunk& chunk : meshAll(field, requests, 2)) {
    Content& content = contents.emplace_back();
    content.hashes.push_back(chunk.mesh.body.hash);
    for (const MeshPart& seam : chunk.mesh.seams) content.hashes.push_back(seam.hash);
    for (const MeshPart* part : {&chunk.mesh.body}) {
      for (const auto& vertex : part->vertices) content.anchors.push_back(vertex.material);
    }
    const Program& program = *field.settings().program;
    for (const Anchor& anchor : chunk.anchors) {
      content.anchors.push_back(anchor.key.value);
      content.anchors.push_back(hashText(program.names[anchor.name]));
      content.frames.push_back(anchor.frame);
    }
  }
  return contents;
}

/// Returns requests for random chunks near the cave's halls, because most surfaces are there.
std::vector<ChunkRequest> randomChunks(std::mt19937& random, const WorldField& field, int level, size_t count) {
  const IntBox halls{{-300000, -300000, -300000}, {600000, 600000, 600000}};
  const Result<std::vector<Anchor>> anchors = field.anchors(halls);
  REQUIRE(anchors);
  REQUIRE(!anchors->empty());
  std::vector<ChunkRequest> requests;
  for (size_t i = 0; i < count; ++i) {
    ChunkRequest& request = requests.emplace_back();
    request.key.level = level;
    const Int3 hall = (*anchors)[random() % anchors->size()].frame.origin;
    for (int axis = 0; axis < 3; ++axis) {
      const int32_t off = static_cast<int32_t>(random() % 60000) - 30000;
      request.key.at[axis] = (hall[axis] + off) >> level >> 14;  // chunks of level 0 are 2^14 units wide
    }
    request.seams = 63;
    request.anchors = level == 0;
  }
  return requests;
}
static_assert(kChunkCells * kStreamedCell == 1 << 14);

/// Number of tested levels, with cells of 0.5 to 8 m: the cave's passages are omitted if cells are larger than 4 m.
constexpr int kLevels = 5;
/// Number of tested chunks of a level; half as many with a sanitizer. For every changed text, each of these chunks is
/// meshed twice, which takes most of the tests' time.
size_t chunksOf(int level) { return (rounds(4) < 4 ? 1u : 2u) * (level == 0 ? 30u : 6u); }
size_t allChunks() {
  size_t all = 0;
  for (int level = 0; level < kLevels; ++level) all += chunksOf(level);
  return all;
}

/// Compares the contents of both fields in random chunks. Returns how many of the chunks must be meshed again.
size_t checkChange(std::mt19937& random, const std::shared_ptr<const WorldField>& from,
                   const std::shared_ptr<const WorldField>& to) {
  const FieldChange change(from, to);
  size_t touched = 0;
  for (int level = 0; level < kLevels; ++level) {
    const std::vector<ChunkRequest> requests = randomChunks(random, *from, level, chunksOf(level));
    const std::vector<Content> before = contentsOf(*from, requests), after = contentsOf(*to, requests);
    for (size_t i = 0; i < requests.size(); ++i) {
      const bool differs = before[i] != after[i];
      const bool told = change.touches(requests[i].key);
      touched += told;
      INFO("level " << level << ", chunk " << requests[i].key.at.x << ' ' << requests[i].key.at.y << ' '
                    << requests[i].key.at.z);
      if (differs) CHECK(told);
    }
  }
  return touched;
}

}  // namespace

TEST_CASE("what differs between two fields is told for every chunk that it changes", "[threads]") {
  for (uint32_t seed = 1; seed <= rounds(2); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const std::string cave = drippingText();
    const auto from = fieldOf(cave);
    CHECK(checkChange(random, from, fieldOf(cave)) == 0);
    const size_t boxy = checkChange(random, from, fieldOf(cave, "boxy", 0.5));
    CHECK(boxy > 0);
    CHECK(boxy < allChunks());  // passages do not depend on the parameter
    const size_t wet = checkChange(random, from, fieldOf(cave, "wet", 0.6));
    CHECK(wet > 0);
    CHECK(wet < allChunks());
    for (const EditedText& edited : editedTexts()) {
      CAPTURE(edited.what);
      const size_t touched = checkChange(random, from, fieldOf(edited.text));
      if (edited.what == "layout alone") CHECK(touched == 0);
      if (edited.what == "the domain") CHECK(touched == allChunks());
      if (edited.what != "layout alone") CHECK(touched > 0);
    }
  }
}

TEST_CASE("cells that have read no parameter that differs are taken over and not derived again") {
  const std::string cave = drippingText();
  const auto from = fieldOf(cave);
  const uint32_t net = 0, drip = 1;
  for (int32_t x = 0; x < 3; ++x) {
    REQUIRE(from->cell(net, {x, 0, 0}));
    REQUIRE(from->cell(drip, {x, 0, 0}));
  }
  const size_t cells = from->cacheStats().cells;
  const auto wetter = fieldOf(cave, "wet", 0.7);
  wetter->adopt(*from);
  const auto cellOf = [](const WorldField& field, uint32_t layer, Int3 cell) { return *field.cell(layer, cell); };
  for (int32_t x = 0; x < 3; ++x) CHECK(cellOf(*wetter, net, {x, 0, 0}) == cellOf(*from, net, {x, 0, 0}));
  CHECK(wetter->cacheStats().misses == 0);
  CHECK(wetter->cacheStats().cells < cells);
  // A drip (a stalactite) hangs where its rule has found the ceiling of a hall by a probe (a ray). So the drip depends
  // on the shape of this hall.
  const auto boxier = fieldOf(cave, "boxy", 0.9);
  uint64_t probed = 0;
  for (int32_t x = 0; x < 8; ++x) probed |= cellOf(*from, drip, {x, 2, 2})->chunk.parameters;
  const Program& program = *from->settings().program;
  CHECK((probed & parameterBit(program.findParam("boxy"))) != 0);
  CHECK((cellOf(*from, net, {0, 0, 0})->chunk.parameters & parameterBit(program.findParam("wet"))) == 0);
}
