// Tests the check of borders in a store: it accepts chunks that were meshed from one field, on all levels, and detects
// a missing or reversed triangle.

#include "store/closure.h"
#include "seed.h"
#include "store_support.h"

using namespace sgm;

namespace {

struct Meshed {
  ChunkKey key;
  std::array<PackedMesh, kChunkParts> parts;
  std::array<store::BorderSums, kChunkParts> borders;
};

/// Meshes all chunks of the region, and packs each part separately, as in a store.
std::vector<std::unique_ptr<Meshed>> meshedRegion(const Excerpt& scene, const store::BakedRegion& region, bool sharp) {
  const Machine machine;
  const WorldField world(scene.settings(), std::pmr::get_default_resource());
  std::vector<std::unique_ptr<Meshed>> all;
  for (const store::TileKey& tile : store::tilesOf(region)) {
    for (const size_t number : store::chunksIn(region, tile)) {
      ChunkRequest request;
      request.key = store::chunkOf(tile, number);
      request.seams = store::seamsOf(request.key);
      request.sharp = sharp;
      const auto chunks = meshChunks(world, *machine.backend, *machine.jobs, {&request, 1});
      REQUIRE(chunks);
      const MeshParts parts = partsOf(chunks->front().mesh);
      all.push_back(std::make_unique<Meshed>());
      all.back()->key = request.key;
      for (size_t part = 0; part < parts.size(); ++part) {
        MeshParts one{};
        one[part] = parts[part];
        all.back()->parts[part] = packMesh(one, nullptr, std::pmr::get_default_resource());
        all.back()->borders[part] = store::bordersOf(all.back()->parts[part], static_cast<int>(part));
      }
    }
  }
  return all;
}

struct Judged {
  std::vector<std::string> told;
  uint64_t borders = 0;
};

Judged judge(const std::vector<std::unique_ptr<Meshed>>& chunks, const store::BakedRegion& region) {
  Judged judged;
  store::Closure closure(region, [&](const std::string& problem) { judged.told.push_back(problem); });
  for (const auto& chunk : chunks) {
    std::array<const store::BorderSums*, kChunkParts> parts{};
    for (size_t part = 0; part < parts.size(); ++part) {
      if (!chunk->parts[part].indices.empty()) parts[part] = &chunk->borders[part];
    }
    closure.add(chunk->key, parts);
  }
  closure.finish();
  judged.borders = closure.borders();
  return judged;
}

/// True if the triangle has an edge that another part or another chunk may share.
bool touchesBorder(const Meshed& chunk, size_t part, size_t triangle) {
  if (part != 0) return true;
  for (size_t k = 0; k < 3; ++k) {
    const Vertex& a = chunk.parts[part].vertices[chunk.parts[part].indices[triangle + k]];
    const Vertex& b = chunk.parts[part].vertices[chunk.parts[part].indices[triangle + (k + 1) % 3]];
    for (const auto axis : {&Vertex::x, &Vertex::y, &Vertex::z}) {
      if (a.*axis == b.*axis && (a.*axis == 0 || a.*axis == kChunkCells * kSubcell)) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("chunks of all levels fit together, and no damage to a border passes", "[store]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (const bool sharp : {false, true}) {
    CAPTURE(sharp);
    const Excerpt& scene = scenes()[sharp ? 2 : 0];
    const store::BakedRegion region = regionOf(scene, 0, 2);
    auto chunks = meshedRegion(scene, region, sharp);
    std::shuffle(chunks.begin(), chunks.end(), random);
    const Judged whole = judge(chunks, region);
    CAPTURE(whole.told);
    CHECK(whole.told.empty());
    CHECK(whole.borders > 50);
    std::vector<std::pair<Meshed*, size_t>> drawn;
    for (const auto& chunk : chunks) {
      for (size_t part = 0; part < kChunkParts; ++part) {
        if (!chunk->parts[part].indices.empty()) drawn.emplace_back(chunk.get(), part);
      }
    }
    std::array<unsigned, 2> tried{};
    for (unsigned i = 0; i < rounds(200); ++i) {
      const auto [chunk, part] = drawn[random() % drawn.size()];
      PackedMesh& mesh = chunk->parts[part];
      const store::BorderSums before = chunk->borders[part];
      const size_t triangle = random() % (mesh.indices.size() / 3) * 3;
      const bool at_border = touchesBorder(*chunk, part, triangle);
      const auto first = mesh.indices.begin() + static_cast<ptrdiff_t>(triangle);
      CAPTURE(i, chunk->key.level, part, triangle, at_border);
      // The hashes of the border (BorderSums) do not depend on which corner of a triangle comes first.
      std::rotate(first, first + 1, first + 3);
      CHECK(store::bordersOf(mesh, static_cast<int>(part)) == before);
      const std::array<uint32_t, 3> was{first[0], first[1], first[2]};
      if (i % 2 == 0) {
        std::swap(first[0], first[1]);
      } else {
        first[1] = first[2] = first[0];
      }
      chunk->borders[part] = store::bordersOf(mesh, static_cast<int>(part));
      const bool shows = chunk->borders[part] != before;
      // With sharp features, the parts of a chunk may have feature vertices that lie in a face of the chunk, but not on
      // the mesh's border in this face.
      if (!sharp) CHECK(shows == at_border);
      if (shows) {
        const size_t problems = judge(chunks, region).told.size();
        tried[problems != 0] += 1;
        // Nothing needs to match the outer border of a seam at the coarsest level, because the region has no coarser
        // neighbour there.
        if (part != 0 && chunk->key.level < 2) CHECK(problems != 0);
      }
      std::copy(was.begin(), was.end(), first);
      chunk->borders[part] = before;
    }
    // At each of its faces, a body borders on a seam or on a neighbour's body. Exception: at a face in the
    // region's border, nothing needs to match.
    CHECK(tried[1] > 4 * tried[0]);
    // If the borders of two chunks are swapped, the check must find it.
    for (unsigned i = 0; i < 4; ++i) {
      const auto [chunk, part] = drawn[random() % drawn.size()];
      const auto [other, same] = drawn[random() % drawn.size()];
      if (part != same || chunk->borders[part] == other->borders[part]) continue;
      std::swap(chunk->borders[part], other->borders[part]);
      CHECK(!judge(chunks, region).told.empty());
      std::swap(chunk->borders[part], other->borders[part]);
    }
    CHECK(judge(chunks, region).told.empty());
  }
}
