#include "store/bake.h"

#include <map>
#include <optional>

#include "base/bytes.h"
#include "base/file_reader.h"
#include "chunk/mesh_chunks.h"

namespace sgm::store {
namespace {

constexpr uint64_t kMaxTileFile = uint64_t{1} << 28;
constexpr uint32_t kTileMagic = 0x544D4753;  // "SGMT"
constexpr uint32_t kTileVersion = 3;

/// An encoded chunk part that is about to be written.
struct Made {
  ContentId id;
  std::pmr::vector<std::byte> content;
  /// the compressed content; nullopt if the content will be stored inline, in the tile's record
  std::optional<std::pmr::vector<std::byte>> frame;
};

struct MadeChunk {
  std::array<Made, kChunkParts> parts;
  measure::SurfaceSums measured;
};

Result<MadeChunk> makeChunk(const Bakery& bakery, const ChunkRequest& request, const PlacedChunk& chunk,
                            MeasuringPool& measuring) {
  MadeChunk made;
  VoidComponents voids(bakery.memory);
  if (request.signs) voids = voidsOf(chunk.mesh);
  const MeshParts parts = partsOf(chunk.mesh);
  const MeshPart none(bakery.memory);
  for (int part = 0; part < kChunkParts; ++part) {
    if (!asksFor(request, part)) continue;
    const MeshPart* mesh = parts[static_cast<size_t>(part)];
    Made& own = made.parts[static_cast<size_t>(part)];
    own.content = encodeChunkPart(part, mesh != nullptr ? *mesh : none, chunk.anchors, voids, bakery.memory);
    own.id = idOf(own.content);
    if (own.content.size() <= kMaxInlined) continue;
    Result<std::pmr::vector<std::byte>> frame = pack(own.content, bakery.memory);
    if (!frame) return frame.error();
    own.frame = std::move(*frame);
  }
  MadeMeasures measures;
  measureParts(request, chunk, nullptr, measuring, measures);
  made.measured = measures.sums;
  return made;
}

ChunkRequest requestOf(const Bakery& bakery, const ChunkKey& chunk) {
  ChunkRequest request;
  request.key = chunk;
  request.seams = seamsOf(chunk);
  request.keys = false;
  request.sharp = bakery.sharp;
  request.anchors = request.signs = chunk.level == 0;
  return request;
}

}  // namespace

Result<ContentId> worldKey(const Folder& store, const WorldField& world, bool sharp) {
  const std::optional<std::vector<std::byte>> bytes = bakedWorldInputs(world, sharp);
  if (!bytes) return Error{Code::invalid_argument, "a world without an identity cannot be baked"};
  const ContentId key = idOf(*bytes);
  std::error_code error;
  if (std::filesystem::exists(store.world(key), error)) return key;
  const ContentId former = idOf(*formerBakedWorldInputs(world, sharp));
  return std::filesystem::exists(store.world(former), error) ? former : key;
}

Result<Bakery> bakeryOf(const WorldField& world, Backend& backend, JobSystem& jobs, const BakedRegion& region,
                        bool sharp, const Folder& store, std::pmr::memory_resource* memory) {
  if (Result<void> good = check(region); !good) return good.error();
  const Result<ContentId> key = worldKey(store, world, sharp);
  if (!key) return key.error();
  const ContentId job = jobKey(*key, region);
  return Bakery{world, backend, jobs, region, sharp, *key, job, store.baking(job), nullptr, memory};
}

ContentId jobKey(const ContentId& world, const BakedRegion& region) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  putId(world, out);
  putRegion(region, out);
  return idOf(bytes);
}

Result<std::array<ContentId, kChunkParts>> idsOf(const Bakery& bakery, const ChunkKey& chunk) {
  const ChunkRequest request = requestOf(bakery, chunk);
  const Result<std::pmr::vector<PlacedChunk>> meshed =
      meshChunks(bakery.world, bakery.backend, bakery.jobs, {&request, 1});
  if (!meshed) return meshed.error();
  MeasuringPool measuring(bakery.memory);
  const Result<MadeChunk> made = makeChunk(bakery, request, meshed->front(), measuring);
  if (!made) return made.error();
  std::array<ContentId, kChunkParts> ids;
  for (size_t part = 0; part < ids.size(); ++part) ids[part] = made->parts[part].id;
  return ids;
}

std::vector<std::byte> encodeTileFile(const ContentId& job, const TileRecord& record) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  out.put(kTileMagic);
  out.put(kTileVersion);
  putId(job, out);
  const std::vector<std::byte> encoded = encodeTile(record);
  out.put(checksumOf(encoded));
  bytes.insert(bytes.end(), encoded.begin(), encoded.end());
  return bytes;
}

std::optional<TileRecord> decodeTileFile(const ContentId& job, std::span<const std::byte> bytes,
                                         std::pmr::memory_resource* memory) {
  ByteReader in(bytes);
  if (in.get<uint32_t>() != kTileMagic || in.get<uint32_t>() != kTileVersion) return std::nullopt;
  const ContentId of = getId(in);
  const auto checksum = in.get<uint64_t>();
  if (in.failed() || of != job) return std::nullopt;
  const std::span encoded = bytes.last(in.left());
  if (checksumOf(encoded) != checksum) return std::nullopt;
  return decodeTile(encoded, memory);
}

std::optional<TileRecord> madeBefore(const Bakery& bakery, const TileKey& tile) {
  const auto bytes = readFile(tileFile(bakery.folder, tile), kMaxTileFile);
  if (!bytes) return std::nullopt;
  std::optional<TileRecord> record = decodeTileFile(bakery.job, std::as_bytes(std::span(*bytes)), bakery.memory);
  if (!record || record->key != tile) return std::nullopt;
  std::error_code error;
  const uint64_t there = std::filesystem::file_size(packFile(bakery.folder, tile), error);
  if (!record->packs.empty() && (error || there != record->packs[0].bytes)) return std::nullopt;
  return record;
}

Result<TileRecord> bakeTile(const Bakery& bakery, const TileKey& tile, const Progress& progress) {
  TileRecord record(bakery.memory);
  record.key = tile;
  const std::vector<size_t> numbers = chunksIn(bakery.region, tile);
  std::vector<ChunkRequest> requests;
  for (const size_t number : numbers) requests.push_back(requestOf(bakery, chunkOf(tile, number)));
  Result<std::pmr::vector<PlacedChunk>> chunks =
      meshChunks(bakery.world, bakery.backend, bakery.jobs, requests, progress);
  if (!chunks) return chunks.error();

  MeasuringPool measuring(bakery.memory);
  std::vector<std::optional<Result<MadeChunk>>> made(numbers.size());
  parallelFor(bakery.jobs, numbers.size(),
              [&](size_t i) { made[i] = makeChunk(bakery, requests[i], (*chunks)[i], measuring); });

  std::vector<std::byte> frames = packHead();
  std::map<ContentId, uint16_t> known;
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (!*made[i]) return made[i]->error();
    MadeChunk& chunk = **made[i];
    record.measured.add(chunk.measured);
    for (int part = 0; part < kChunkParts; ++part) {
      if (!asksFor(requests[i], part)) continue;
      const Made& own = chunk.parts[static_cast<size_t>(part)];
      const auto [at, is_new] = known.try_emplace(own.id, static_cast<uint16_t>(record.contents.size() + 1));
      record.part(numbers[i], part) = at->second;
      record.unshared_bytes += own.frame ? own.frame->size() : own.content.size();
      if (!is_new) continue;
      StoredContent content{own.id, static_cast<uint32_t>(own.content.size()), 0, kInlined, record.inlined.size()};
      const std::span<const std::byte> stored = own.frame ? *own.frame : own.content;
      content.stored = static_cast<uint32_t>(stored.size());
      if (own.frame) {
        content.pack = 0;
        content.offset = frames.size();
        frames.insert(frames.end(), stored.begin(), stored.end());
      } else {
        record.inlined.insert(record.inlined.end(), stored.begin(), stored.end());
      }
      record.contents.push_back(content);
    }
  }
  record.chunks = static_cast<uint32_t>(numbers.size());
  if (frames.size() > kPackHead) {
    record.packs.push_back({idOf(frames), frames.size()});
    if (Result<void> written = writeFile(packFile(bakery.folder, tile), frames, bakery.unfinished); !written)
      return written.error();
  }
  const std::vector<std::byte> file = encodeTileFile(bakery.job, record);
  if (Result<void> written = writeFile(tileFile(bakery.folder, tile), file, bakery.unfinished); !written)
    return written.error();
  return record;
}

}  // namespace sgm::store
