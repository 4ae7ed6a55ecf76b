// Compares the time to store a chunk in the disk cache and read it back with the time to mesh it, for the chunks around
// a viewer in the cave.

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "backend/open/open_backend.h"
#include "base/hash.h"
#include "cave.h"
#include "chunk/chunk_codec.h"
#include "chunk/chunk_surface.h"
#include "measure.h"
#include "store/cache/disk_entry.h"
#include "stream/make/chunk_cache.h"

using namespace sgm;
using bench::must, bench::now;

namespace {

constexpr int kRuns = 5;
std::pmr::memory_resource* const heap = std::pmr::get_default_resource();

using Bytes = std::pmr::vector<std::byte>;

/// Returns the chunks with triangles around a viewer, with grid cells of 0.5 m. Prints the time to mesh them.
std::vector<ChunkRecord> caveChunks(const char* path) {
  const WorldField world(bench::settingsOf(path, 7), heap);
  const auto jobs = must(makeThreadPool(1));
  const auto backend = must(makeBackend({}, *jobs, heap));
  const std::vector<ChunkRequest> requests = bench::aroundViewer(world.settings().finest_cell);
  must(meshChunks(world, *backend, *jobs, requests));  // this first run derives the grammar cells, so that the second
                                                       // one measures only meshing
  const double start = now();
  const auto chunks = must(meshChunks(world, *backend, *jobs, requests));
  const double took = now() - start;
  std::vector<ChunkRecord> records;
  for (const PlacedChunk& chunk : chunks) {
    ChunkRecord record;
    record.mesh = packMesh(partsOf(chunk.mesh), nullptr, std::pmr::get_default_resource());
    record.solid_samples = chunk.mesh.solid_samples;
    if (!record.mesh.indices.empty()) records.push_back(std::move(record));
  }
  std::printf("%zu chunks of a frame, %zu of them with triangles; compile and mesh: %.0f us a chunk\n", chunks.size(),
              records.size(), 1000 * took / static_cast<double>(chunks.size()));
  return records;
}

Bytes plain(const ChunkRecord& record) {
  const PackedMesh& mesh = record.mesh;
  const size_t vertex_bytes = mesh.vertices.size() * sizeof(Vertex);
  Bytes bytes(vertex_bytes + mesh.indices.size() * sizeof(uint32_t));
  std::memcpy(bytes.data(), mesh.vertices.data(), vertex_bytes);
  std::memcpy(bytes.data() + vertex_bytes, mesh.indices.data(), bytes.size() - vertex_bytes);
  return bytes;
}

/// Returns the average time per chunk in microseconds: the best of several runs over all chunks.
template <class Work>
double each(size_t count, const Work& work) {
  const auto all = [&] {
    for (size_t i = 0; i < count; ++i) work(i);
  };
  return 1000 * bench::timed(1, kRuns, all).least / static_cast<double>(count);
}

template <class Encode>
void row(const char* name, const std::vector<ChunkRecord>& records, const Encode& encode) {
  const size_t count = records.size();
  std::vector<Bytes> encoded(count), files(count);
  const double encoding = each(count, [&](size_t i) { encoded[i] = encode(records[i]); });
  const double packing = each(count, [&](size_t i) { files[i] = *packDiskEntry({i, i}, encoded[i], heap); });
  const double unpacking = each(count, [&](size_t i) { (void)unpackDiskEntry({i, i}, files[i], heap).value(); });
  size_t bytes = 0, file_bytes = 0;
  for (size_t i = 0; i < count; ++i) {
    bytes += encoded[i].size();
    file_bytes += files[i].size();
  }
  std::printf("%-8s %6zu bytes, file %6zu; encode %5.1f us, pack %5.1f, unpack %5.1f", name, bytes / count,
              file_bytes / count, encoding, packing, unpacking);
}

void files(const std::vector<ChunkRecord>& records, const std::filesystem::path& folder) {
  const auto cache = must(DiskCache::open(folder, uint64_t{1} << 30, {}));
  const auto key = [](size_t i) { return DiskKey{mix64(i + 1), i}; };
  const double start = now();
  for (size_t i = 0; i < records.size(); ++i) cache->put(key(i), encodeChunk(records[i], heap));
  const double put = 1000 * (now() - start) / static_cast<double>(records.size());
  const double get = each(records.size(), [&](size_t i) { must(decodeChunk(cache->get(key(i), heap).value(), heap)); });
  std::printf("encode and put %.0f us a chunk; get and decode %.0f us\n", put, get);
}

/// Meshes the chunks around a viewer, with grid cells of 0.25 m, one by one as a world requests them: with and without
/// the cache.
void throughCache(const char* path, const std::filesystem::path& folder) {
  WorldFieldSettings settings = bench::settingsOf(path, 7);
  settings.finest_cell = kUnitsPerMetre / 4;
  std::vector<ChunkRequest> requests = bench::aroundViewer(settings.finest_cell);
  for (ChunkRequest& request : requests) request.signs = request.anchors = request.key.level == 0;
  const auto jobs = must(makeThreadPool(1));
  const auto backend = must(makeBackend({}, *jobs, heap));
  const auto cache = must(DiskCache::open(folder, uint64_t{1} << 30, {}));
  const auto pass = [&](const char* what, const WorldField& world, DiskCache* with) {
    double full = 0, empty = 0;
    size_t count = 0;
    for (const ChunkRequest& request : requests) {
      const double start = now();
      const MeshedChunk chunk = must(ChunkMesher{world, *backend, *jobs, heap, with}.mesh(request, nullptr));
      const bool drawn = !chunk.surface.mesh.indices.empty();
      (drawn ? full : empty) += now() - start;
      count += drawn;
    }
    const auto each = [](double time, size_t chunks) { return 1000 * time / static_cast<double>(chunks); };
    std::printf("%-24s %5zu chunks with triangles %7.0f us each, %5zu without %7.0f us\n", what, count,
                each(full, count), requests.size() - count, each(empty, requests.size() - count));
  };
  const WorldField first(settings, heap), second(settings, heap), third(settings, heap);
  pass("derive, mesh:", first, nullptr);
  pass("mesh:", first, nullptr);
  pass("derive, mesh, put:", second, cache.get());
  pass("get:", third, cache.get());
  const DiskCacheStats stats = cache->stats();
  std::printf("%llu entries, %.1f MB\n", static_cast<unsigned long long>(stats.stored),
              static_cast<double>(stats.bytes) * 1e-6);
}

void largeFolder(const std::filesystem::path& folder) {
  constexpr size_t kEntries = 100'000;
  const auto key = [](size_t i) { return DiskKey{mix64(i + 1), i}; };
  {
    const auto cache = must(DiskCache::open(folder, uint64_t{1} << 30, {}));
    for (size_t i = 0; i < kEntries; ++i) cache->put(key(i), {});
  }
  const double start = now();
  const auto cache = must(DiskCache::open(folder, kEntries * 64, {}));
  const double opened = now();
  if (!cache->get(key(0), heap)) throw std::runtime_error("an entry is gone");
  const double got = now();
  cache->put(key(kEntries), {});
  std::printf("a folder of %zu entries, all in one set: open %.2f ms, first get %.2f ms, first put %.0f ms\n", kEntries,
              opened - start, got - opened, now() - got);
}

}  // namespace

int main() try {
  const std::vector<ChunkRecord> records = caveChunks(SGM_BENCH_CAVE);
  row("plain", records, plain);
  std::printf("\n");
  row("encoded", records, [](const ChunkRecord& record) { return encodeChunk(record, heap); });
  std::vector<Bytes> encoded;
  for (const ChunkRecord& record : records) encoded.push_back(encodeChunk(record, heap));
  std::printf(", decode %.1f\n", each(records.size(), [&](size_t i) { must(decodeChunk(encoded[i], heap)); }));

  std::string folder = (std::filesystem::temp_directory_path() / "sgm_bench_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("cannot make " + folder);
  files(records, folder + "/chunks");
  throughCache(SGM_BENCH_CAVE, folder + "/frame");
  largeFolder(folder + "/large");
  std::filesystem::remove_all(folder);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_cache: error: %s\n", e.what());
  return 1;
}
