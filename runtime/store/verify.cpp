#include "store/verify.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>

#include "base/hash.h"
#include "stream/chunk_codec.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t kMostPack = uint64_t{1} << 33;
constexpr int kFaces = 6;

/// By face of a body, over its triangles' edges that lie there: a number of the edge less that of its reverse. Edges
/// between two triangles of the body fall out, and so do a body's with those of the neighbour's that fits.
using FaceSums = std::array<uint64_t, kFaces>;

FaceSums faceSumsOf(const PackedMesh& mesh) {
  constexpr int kFar = kChunkCells * 256;
  FaceSums sums{};
  const PackedRange& body = mesh.ranges[0];
  for (size_t i = body.first_index; i < body.first_index + body.index_count; i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const Vertex &a = mesh.vertices[mesh.indices[i + k]], &b = mesh.vertices[mesh.indices[i + (k + 1) % 3]];
      const std::array<int, 3> p{a.x, a.y, a.z}, q{b.x, b.y, b.z};
      for (size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] != q[axis] || (p[axis] != 0 && p[axis] != kFar)) continue;
        const auto place = [&](const std::array<int, 3>& at) {
          return static_cast<uint64_t>(at[(axis + 1) % 3]) << 16 | static_cast<uint64_t>(at[(axis + 2) % 3]);
        };
        sums[2 * axis + (p[axis] == 0 ? 0 : 1)] += hashCombine(place(p), place(q)) - hashCombine(place(q), place(p));
      }
    }
  }
  return sums;
}

class Verifier {
 public:
  Verifier(const Folder& store, const WorldFile& world) : store_(store), world_(world) {}

  Verified run(const Progress& progress) {
    for (const TileEntry& tile : world_.index.tiles) {
      look(tile);
      ++found_.tiles;
      if (progress && !progress(found_.tiles, world_.index.tiles.size())) break;
    }
    const std::vector<TileKey> wanted = tilesOf(world_.index.region);
    const auto has = [&](const TileKey& tile) { return world_.index.find(tile) != nullptr; };
    if (wanted.size() != world_.index.tiles.size() || !std::all_of(wanted.begin(), wanted.end(), has))
      found_.problems.add("'" + world_.path.string() + "': tiles of its region are missing");
    compareFaces();
    found_.contents = known_.size();
    found_.packs = packs_.size();
    return std::move(found_);
  }

 private:
  void look(const TileEntry& entry) {
    const Result<TileRecord> record = world_.record(entry, memory_);
    if (!record) return found_.problems.add(record.error().message);
    std::vector<std::vector<std::byte>> packs;
    for (const PackFile& pack : record->packs) packs.push_back(read(pack));
    for (size_t i = 0; i < record->contents.size(); ++i) lookAt(*record, record->contents[i], packs);
    for (const size_t number : chunksIn(world_.index.region, entry.key)) {
      ++found_.chunks;
      for (int part = 0; part < kChunkParts; ++part) {
        if (record->part(number, part) == 0)
          return found_.problems.add("'" + world_.path.string() + "': a part of a chunk is missing");
      }
      const StoredContent& body = record->contents[record->part(number, 0) - 1u];
      const auto known = known_.find(body.id);
      if (known != known_.end() && known->second != FaceSums{}) faces_[chunkOf(entry.key, number)] = known->second;
    }
  }

  /// The pack's bytes; empty where it cannot be read. Looked at once.
  std::vector<std::byte> read(const PackFile& pack) {
    const fs::path path = store_.pack(pack.name);
    Result<std::vector<std::byte>> bytes = readFile(path, kMostPack);
    const bool is_new = packs_.insert(pack.name).second;
    if (!bytes) {
      if (is_new) found_.problems.add(bytes.error().message);
      return {};
    }
    if (is_new) {
      found_.bytes += bytes->size();
      if (bytes->size() != pack.bytes || idOf(*bytes) != pack.name)
        found_.problems.add("'" + path.string() + "' is damaged: remove it, and bake the world again");
    }
    return std::move(*bytes);
  }

  void lookAt(const TileRecord& record, const StoredContent& content, std::span<const std::vector<std::byte>> packs) {
    if (known_.count(content.id) != 0) return;
    known_[content.id] = {};
    const std::vector<std::byte>& from = content.pack == kInlined ? record.inlined : packs[content.pack];
    const auto wrong = [&] {
      found_.problems.add("content " + nameOf(content.id) + " of '" + world_.path.string() + "' is missing or damaged");
    };
    if (content.offset > from.size() || content.stored > from.size() - content.offset) return wrong();
    const std::span stored = std::span(from).subspan(content.offset, content.stored);
    std::pmr::vector<std::byte> bytes(stored.begin(), stored.end(), memory_);
    if (content.pack != kInlined) {
      std::optional<std::pmr::vector<std::byte>> unpacked = unpack(stored, content.bytes, memory_);
      if (!unpacked) return wrong();
      bytes = std::move(*unpacked);
    }
    if (idOf(bytes) != content.id) return wrong();
    const Result<ChunkRecord> chunk = decodeChunk(bytes, memory_);
    if (!chunk) return wrong();
    known_[content.id] = faceSumsOf(chunk->mesh);
  }

  void compareFaces() {
    for (const auto& [chunk, sums] : faces_) {
      for (size_t face = 0; face < kFaces; ++face) {
        std::array<int, 3> step{};
        step[face / 2] = face % 2 == 0 ? -1 : 1;
        const ChunkKey other = neighbourOf(chunk, step[0], step[1], step[2]);
        const std::vector<size_t> there = chunksIn(world_.index.region, tileOf(other));
        if (!std::binary_search(there.begin(), there.end(), numberInTile(other))) continue;
        const auto known = faces_.find(other);
        const uint64_t opposite = known == faces_.end() ? 0 : known->second[face ^ 1];
        if (sums[face] == 0 && opposite == 0) continue;
        ++found_.faces;
        if (sums[face] + opposite != 0) {
          found_.problems.add("the surface is not closed between the chunks (" + std::to_string(chunk.at.x) + ", " +
                              std::to_string(chunk.at.y) + ", " + std::to_string(chunk.at.z) + ") and (" +
                              std::to_string(other.at.x) + ", " + std::to_string(other.at.y) + ", " +
                              std::to_string(other.at.z) + ") of level " + std::to_string(chunk.level));
        }
      }
    }
  }

  struct IdHash {
    size_t operator()(const ContentId& id) const { return static_cast<size_t>(id.low); }
  };

  const Folder& store_;
  const WorldFile& world_;
  std::pmr::memory_resource* memory_ = std::pmr::get_default_resource();
  Verified found_;
  std::unordered_map<ContentId, FaceSums, IdHash> known_;  ///< contents that were looked at
  std::set<ContentId> packs_;
  std::unordered_map<ChunkKey, FaceSums, ChunkKeyHash> faces_;  ///< of bodies that end in a face
};

}  // namespace

Verified verify(const Folder& store, const WorldFile& world, const Progress& progress) {
  return Verifier(store, world).run(progress);
}

Result<Problems> compareWithBaking(const Bakery& bakery, const WorldFile& world, size_t chunks, uint64_t seed) {
  Problems problems;
  const std::vector<TileEntry>& tiles = world.index.tiles;
  if (tiles.empty()) return problems;
  size_t compared = 0;
  // Of tiles that hold nothing but rock each is tried, too, but few of them are enough.
  for (uint64_t draw = 0; compared < chunks && draw < 16 * chunks; ++draw) {
    const uint64_t random = hashCombine(seed, draw);
    const Result<TileRecord> record = world.record(tiles[random % tiles.size()], bakery.memory);
    if (!record) return record.error();
    std::vector<size_t> drawn;
    for (const size_t number : chunksIn(world.index.region, record->key)) {
      const uint16_t body = record->part(number, 0);
      if (body != 0 && record->contents[body - 1u].pack != kInlined) drawn.push_back(number);
    }
    if (drawn.empty() && draw % 16 != 0) continue;
    const std::vector<size_t>& from = drawn.empty() ? chunksIn(world.index.region, record->key) : drawn;
    if (from.empty()) continue;
    const size_t number = from[(random >> 32) % from.size()];
    const ChunkKey chunk = chunkOf(record->key, number);
    const Result<std::array<ContentId, kChunkParts>> ids = idsOf(bakery, chunk);
    if (!ids) return ids.error();
    ++compared;
    for (int part = 0; part < kChunkParts; ++part) {
      const uint16_t stored = record->part(number, part);
      if (stored != 0 && record->contents[stored - 1u].id == (*ids)[static_cast<size_t>(part)]) continue;
      problems.add("part " + std::to_string(part) + " of chunk (" + std::to_string(chunk.at.x) + ", " +
                   std::to_string(chunk.at.y) + ", " + std::to_string(chunk.at.z) + ") of level " +
                   std::to_string(chunk.level) + " is not what it is baked to here");
    }
  }
  return problems;
}

Result<bool> hasPacks(const Folder& store, const WorldFile& world) {
  for (const TileEntry& tile : world.index.tiles) {
    const Result<TileRecord> record = world.record(tile, std::pmr::get_default_resource());
    if (!record) return record.error();
    for (const PackFile& pack : record->packs) {
      std::error_code error;
      if (fs::file_size(store.pack(pack.name), error) != pack.bytes || error) return false;
    }
  }
  return true;
}

Result<Cleaned> clean(const Folder& store, std::pmr::memory_resource* memory) {
  const Result<StoreLock> lock = StoreLock::take(store);
  if (!lock) return lock.error();
  const Result<std::vector<WorldFile>> worlds = WorldFile::all(store);
  if (!worlds) return worlds.error();
  std::set<fs::path> needed;
  for (const WorldFile& world : *worlds) {
    for (const TileEntry& tile : world.index.tiles) {
      const Result<TileRecord> record = world.record(tile, memory);
      if (!record) return record.error();
      for (const PackFile& pack : record->packs) needed.insert(store.pack(pack.name));
    }
  }
  Cleaned cleaned;
  std::error_code error;
  std::vector<fs::path> superfluous;
  if (fs::exists(store.root() / "packs", error)) {
    for (const auto& entry : fs::recursive_directory_iterator(store.root() / "packs", error)) {
      if (entry.path().extension() == ".sgmp" && needed.count(entry.path()) == 0) superfluous.push_back(entry.path());
    }
  }
  for (const fs::path& path : superfluous) {
    const uint64_t bytes = fs::file_size(path, error);
    if (!fs::remove(path, error) || error)
      return Error{Code::io, "'" + path.string() + "' cannot be removed: " + error.message()};
    ++cleaned.packs;
    cleaned.bytes += bytes;
  }
  if (fs::exists(store.root() / "baking", error)) {
    for (const auto& entry : fs::directory_iterator(store.root() / "baking", error))
      cleaned.unfinished += entry.is_directory();
  }
  return cleaned;
}

}  // namespace sgm::store
