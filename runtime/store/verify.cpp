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

std::string placeOf(const ChunkKey& chunk) {
  return "chunk (" + std::to_string(chunk.at.x) + ", " + std::to_string(chunk.at.y) + ", " +
         std::to_string(chunk.at.z) + ") of level " + std::to_string(chunk.level);
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
    compareFaces();
    found_.contents = known_.size();
    found_.packs = packs_.size();
    return std::move(found_);
  }

 private:
  using Pack = std::shared_ptr<const OpenFile>;

  void look(const TileEntry& entry) {
    const Result<TileRecord> record = world_.record(entry, memory_);
    if (!record) return found_.problems.add(record.error().message);
    std::vector<Pack> packs;
    for (const PackFile& pack : record->packs) packs.push_back(open(pack));
    for (const StoredContent& content : record->contents) {
      if (known_.count(content.id) == 0) known_[content.id] = lookAt(*record, content, packs);
    }
    for (const size_t number : chunksIn(world_.index.region, entry.key)) {
      ++found_.chunks;
      for (int part = 0; part < kChunkParts; ++part) {
        if (record->part(number, part) == 0)
          return found_.problems.add("'" + world_.name + "': a part of a chunk is missing");
      }
      const StoredContent& body = record->contents[record->part(number, 0) - 1u];
      if (const FaceSums& sums = known_.at(body.id); sums != FaceSums{}) faces_[chunkOf(entry.key, number)] = sums;
    }
  }

  /// Null where it cannot be read. The first time all its bytes are compared.
  Pack open(const PackFile& pack) {
    const fs::path path = store_.pack(pack.name);
    const bool is_new = packs_.insert(pack.name).second;
    Result<Pack> file = OpenFile::open(path);
    if (!file) {
      if (is_new) found_.problems.add(file.error().message);
      return nullptr;
    }
    if (!is_new) return std::move(*file);
    found_.bytes += (*file)->size();
    const Result<ContentId> id = idOfFile(**file);
    const auto head = (*file)->read(0, kPackHead);
    if (!id || (*file)->size() != pack.bytes || *id != pack.name) {
      found_.problems.add("'" + path.string() + "' is damaged: remove it, and bake the world again");
    } else if (!head || !std::ranges::equal(*head, packHead())) {
      found_.problems.add("'" + path.string() +
                          "' is a pack of another version: bake its world anew into another store");
    }
    return std::move(*file);
  }

  FaceSums lookAt(const TileRecord& record, const StoredContent& content, std::span<const Pack> packs) {
    const auto wrong = [&] {
      found_.problems.add("content " + nameOf(content.id) + " of '" + world_.name + "' is missing or damaged");
      return FaceSums{};
    };
    std::pmr::vector<std::byte> bytes(memory_);
    if (content.pack == kInlined) {
      const auto first = record.inlined.begin() + static_cast<ptrdiff_t>(content.offset);
      bytes.assign(first, first + static_cast<ptrdiff_t>(content.stored));
    } else {
      if (packs[content.pack] == nullptr) return wrong();
      const auto frame = packs[content.pack]->read(content.offset, content.stored);
      if (!frame) return wrong();
      std::optional<std::pmr::vector<std::byte>> unpacked = unpack(*frame, content.bytes, memory_);
      if (!unpacked) return wrong();
      bytes = std::move(*unpacked);
    }
    if (idOf(bytes) != content.id) return wrong();
    const Result<ChunkRecord> chunk = decodeChunk(bytes, memory_);
    if (!chunk) return wrong();
    return faceSumsOf(chunk->mesh);
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
          found_.problems.add("the surface is not closed between " + placeOf(chunk) + " and " + placeOf(other));
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
  std::unordered_map<ContentId, FaceSums, IdHash> known_;       ///< contents that were looked at
  std::set<ContentId> packs_;                                   ///< likewise
  std::unordered_map<ChunkKey, FaceSums, ChunkKeyHash> faces_;  ///< of bodies that end in a face
};

}  // namespace

Verified verify(const Folder& store, const WorldFile& world, const Progress& progress) {
  return Verifier(store, world).run(progress);
}

Result<Compared> compareWithBaking(const Bakery& bakery, const WorldFile& world, size_t chunks, uint64_t seed) {
  Compared compared;
  const std::vector<TileEntry>& tiles = world.index.tiles;
  // Of tiles that hold nothing but rock each is tried, too, but few of them are enough.
  for (uint64_t draw = 0; compared.chunks < chunks && draw < 16 * chunks; ++draw) {
    const uint64_t random = hashCombine(seed, draw);
    const Result<TileRecord> record = world.record(tiles[random % tiles.size()], bakery.memory);
    if (!record) return record.error();
    const std::vector<size_t> all = chunksIn(world.index.region, record->key);
    std::vector<size_t> drawn;
    for (const size_t number : all) {
      const uint16_t body = record->part(number, 0);
      if (body != 0 && record->contents[body - 1u].pack != kInlined) drawn.push_back(number);
    }
    if (drawn.empty() && draw % 16 != 0) continue;
    const std::vector<size_t>& from = drawn.empty() ? all : drawn;
    const size_t number = from[(random >> 32) % from.size()];
    const ChunkKey chunk = chunkOf(record->key, number);
    const Result<std::array<ContentId, kChunkParts>> ids = idsOf(bakery, chunk);
    if (!ids) return ids.error();
    ++compared.chunks;
    for (int part = 0; part < kChunkParts; ++part) {
      const uint16_t stored = record->part(number, part);
      if (stored != 0 && record->contents[stored - 1u].id == (*ids)[static_cast<size_t>(part)]) continue;
      compared.problems.add("part " + std::to_string(part) + " of " + placeOf(chunk) +
                            " is not what it is baked to here");
    }
  }
  return compared;
}

Result<Cleaned> clean(const Folder& store, std::pmr::memory_resource* memory) {
  const Result<StoreLock> lock = StoreLock::take(store);
  if (!lock) return lock.error();
  const Result<std::vector<fs::path>> worlds = worldsOf(store);
  if (!worlds) return worlds.error();
  std::set<fs::path> needed, done;
  for (const fs::path& path : *worlds) {
    const Result<WorldFile> world = WorldFile::open(path);
    if (!world) return world.error();
    done.insert(store.baking(jobKey(world->index.world, world->index.region)));
    const Result<void> read = world->forRecords(memory, [&](TileRecord&& record) -> Result<void> {
      for (const PackFile& pack : record.packs) needed.insert(store.pack(pack.name));
      return {};
    });
    if (!read) return read.error();
  }
  std::error_code error;
  const auto failure = [&](const fs::path& path) {
    return Error{Code::io, "'" + path.string() + "': " + error.message()};
  };
  Cleaned cleaned;
  const fs::path packs = store.root() / "packs", baking = store.root() / "baking";
  std::vector<std::pair<fs::path, uint64_t>> superfluous;
  if (fs::exists(packs, error)) {
    for (fs::recursive_directory_iterator at(packs, error), end; !error && at != end; at.increment(error)) {
      if (at->path().extension() == ".sgmp" && needed.count(at->path()) == 0)
        superfluous.emplace_back(at->path(), at->file_size(error));
    }
    if (error) return failure(packs);
  }
  for (const auto& [path, bytes] : superfluous) {
    fs::remove(path, error);
    if (error) return failure(path);
    ++cleaned.packs;
    cleaned.bytes += bytes;
  }
  if (!fs::exists(baking, error)) return cleaned;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator at(baking, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() == kMergedEnding || done.count(at->path()) != 0) {
      leftovers.push_back(at->path());
    } else {
      ++cleaned.unfinished;
    }
  }
  if (error) return failure(baking);
  for (const fs::path& path : leftovers) {
    fs::remove_all(path, error);
    if (error) return failure(path);
  }
  return cleaned;
}

}  // namespace sgm::store
