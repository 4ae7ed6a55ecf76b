// Measures the savings by streaming from a baked store: in one run, reads chunks of the cave from the store, and
// derives and meshes the same chunks.
//
//   sgm_bench_store FOLDER [METRES] [LEVELS] [ADDRESS]
//
//   FOLDER   folder for the store, on the disk to be measured
//   ADDRESS  http://... URL of that folder on a web server; the store is then read from there
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "backend/open/open_backend.h"
#include "chunk/chunk_part.h"
#include "grammar/compile.h"
#include "measure.h"
#include "store/merge.h"
#include "store/source.h"
#include "stream/make/chunk_cache.h"

namespace {

using namespace sgm;
namespace fs = std::filesystem;

template <class T>
T orDie(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "sgm_bench_store: error: %s\n", result.error().message.c_str());
  std::exit(1);
}

WorldFieldSettings caveSettings() {
  std::ifstream file(SGM_BENCH_CAVE);
  std::stringstream text;
  text << file.rdbuf();
  WorldFieldSettings settings;
  settings.program = compileGrammar(text.str(), "cave.sgm").program;
  settings.parameters = ParameterValues::defaults(*settings.program);
  settings.seed = 3;
  settings.finest_cell = kUnitsPerMetre / 4;
  return settings;
}

/// Meshes the chunks one after the other; returns the milliseconds of each. Index look-ups in a store on a server
/// happen beforehand, as in a streamed world.
std::vector<double> meshAll(const ChunkMesher& mesher, const std::vector<ChunkRequest>& requests) {
  std::vector<double> times;
  for (const ChunkRequest& request : requests) {
    const double start = bench::now();
    std::optional<FoundParts> found = mesher.find(request, nullptr);
    const MeshOrder order{request, nullptr, found ? &*found : nullptr};
    if (!mesher.mesh({&order, 1}, nullptr).front()) std::exit(1);
    times.push_back(bench::now() - start);
  }
  return times;
}

double sum(const std::vector<double>& times) {
  double all = 0;
  for (const double time : times) all += time;
  return all;
}

void print(const char* what, std::vector<double> times, double unit) {
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<size_t>(share * static_cast<double>(times.size() - 1))] * unit;
  };
  std::printf("%-34s %8.1f a second, us: median %7.1f, p99 %7.1f, most %7.1f\n", what,
              1e3 * static_cast<double>(times.size()) / sum(times), at(0.5), at(0.99), at(1));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: sgm_bench_store FOLDER [METRES] [LEVELS] [ADDRESS]\n");
    return 2;
  }
  const std::string place = argc > 4 ? argv[4] : argv[1];
  const int metres = argc > 2 ? std::atoi(argv[2]) : 128, levels = argc > 3 ? std::atoi(argv[3]) : 3;
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  const std::unique_ptr<JobSystem> jobs = orDie(makeThreadPool(1));
  const std::unique_ptr<Backend> backend = orDie(makeBackend({}, *jobs, memory));
  const WorldField world(caveSettings(), memory);
  const int32_t edge = metres * kUnitsPerMetre;
  const store::BakedRegion region{{{0, 0, 0}, {edge, edge, edge}}, 0, levels - 1, world.settings().finest_cell};
  const store::Folder folder(argv[1]);
  if (!folder.make()) return 1;
  const store::Bakery bakery = orDie(store::bakeryOf(world, *backend, *jobs, region, false, folder, memory));
  if (!store::makeFolder(bakery.folder)) return 1;
  const double start = bench::now();
  for (const store::TileKey& tile : store::tilesOf(region)) orDie(store::bakeTile(bakery, tile));
  const double baked = bench::now();
  const store::Merged merged =
      orDie(store::merge(folder, bakery, [](const store::WorldSummary&) { return std::string(); }));
  const double seconds = bench::now() - baked;
  std::printf("baked: %llu chunks in %.2f s on one thread, merged in %.3f s; %.2f bytes a triangle, %llu contents\n",
              static_cast<unsigned long long>(merged.world.chunks), (baked - start) / 1e3, seconds / 1e3,
              static_cast<double>(merged.world.pack_bytes + fs::file_size(folder.world(bakery.key))) /
                  static_cast<double>(merged.world.measured.triangles),
              static_cast<unsigned long long>(merged.world.contents));

  // Collects requests for chunks that have a surface, with three of their seams, which is what a world requests most
  // often.
  std::vector<ChunkRequest> requests;
  const ChunkMesher derived{world, *backend, *jobs, memory};
  for (const store::TileKey& tile : store::tilesOf(region)) {
    for (const size_t number : store::chunksIn(region, tile)) {
      ChunkRequest request;
      request.key = store::chunkOf(tile, number);
      request.seams = store::seamsOf(request.key);
      request.keys = false;
      request.anchors = request.signs = tile.level == 0;
      if (!orDie(derived.mesh(request, nullptr)).surface.mesh.indices.empty()) requests.push_back(request);
    }
  }
  for (int round = 0; round < 3; ++round) {
    // Start with new worlds in which nothing is derived or loaded yet, as when a viewer arrives at a new place.
    const WorldField fresh(caveSettings(), memory), other(caveSettings(), memory);
    const std::shared_ptr<BakedParts> source = orDie(store::openStores(std::array{place}, {}, memory));
    ChunkMesher stored{other, *backend, *jobs, memory};
    stored.baked = source.get();
    const std::vector<double> meshing = meshAll({fresh, *backend, *jobs, memory}, requests);
    const std::vector<double> reading = meshAll(stored, requests);
    std::vector<double> decoding;
    for (const ChunkRequest& request : requests) {
      const auto inputs = ChunkPartInputs::of(world, request, nullptr)->asBaked();
      const DiskKey key = source->worldOf(*bakedWorldInputs(world, false));
      const double begun = bench::now();
      for (int part = 0; part < kChunkParts; ++part) {
        if (!asksFor(request, part)) continue;
        const auto part_there = source->get({key}, request.key, part, Reach::far, memory);
        if (!part_there || !decodeChunkPart(part_there->bytes, part, inputs, memory, BytesAre::whole)) return 1;
      }
      decoding.push_back(bench::now() - begun);
    }
    std::printf("%zu chunks with a surface, three seams each\n", requests.size());
    print("derived and meshed", meshing, 1e3);
    print("from the store", reading, 1e3);
    print("  of that, read and decoded", decoding, 1e3);
    std::printf("%.1f times the chunks\n", sum(meshing) / sum(reading));
  }
  return 0;
}
