#include "store/verify.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_set>

#include "base/hash.h"
#include "base/plain_text.h"
#include "chunk/chunk_codec.h"
#include "store/closure.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

std::string placeOf(const ChunkKey& chunk) {
  return "chunk (" + std::to_string(chunk.at.x) + ", " + std::to_string(chunk.at.y) + ", " +
         std::to_string(chunk.at.z) + ") of level " + std::to_string(chunk.level);
}

/// Returns which part a decoded content contains: 0 for a body, 1 + Face for a seam. nullopt if it contains several
/// parts.
std::optional<int> partOf(const ChunkRecord& chunk) {
  std::optional<int> part = chunk.seams == 0 ? std::optional(0) : std::nullopt;
  for (int face = 0; face < 6; ++face) {
    if (chunk.seams == 1 << face) part = 1 + face;
  }
  for (int other = 0; part && other < kChunkParts; ++other) {
    if (other != *part && chunk.mesh.ranges[static_cast<size_t>(other)].index_count != 0) return std::nullopt;
  }
  return part;
}

class Verifier {
 public:
  Verifier(const Folder& store, const WorldFile& world)
      : store_(store),
        world_(world),
        closure_(world.index.region, [this](const std::string& problem) { found_.problems.add(problem); }) {}

  Verified run(const Progress& progress) {
    for (const TileEntry& tile : world_.index.tiles) {
      look(tile);
      ++found_.tiles;
      if (progress && !progress(found_.tiles, world_.index.tiles.size())) break;
    }
    if (found_.tiles == world_.index.tiles.size()) closure_.finish();
    found_.borders = closure_.borders();
    found_.contents = known_.size();
    found_.packs = packs_.size();
    return std::move(found_);
  }

 private:
  struct Looked {
    std::optional<int> part;  ///< the kind of part that the content encodes (0: body, 1 + Face: seam); nullopt if the
                              ///< content is invalid
    BorderSums borders;
  };
  using Pack = std::shared_ptr<const OpenFile>;

  void look(const TileEntry& entry) {
    const Result<TileRecord> record = world_.record(entry, memory_);
    if (!record) return found_.problems.add(record.error().message);
    std::vector<Pack> packs;
    for (const PackFile& pack : record->packs) packs.push_back(open(pack));
    std::vector<Looked> looked;
    for (const StoredContent& content : record->contents) looked.push_back(lookAt(*record, content, packs));
    for (const size_t number : chunksIn(world_.index.region, entry.key)) {
      ++found_.chunks;
      const ChunkKey chunk = chunkOf(entry.key, number);
      std::array<const BorderSums*, kChunkParts> parts{};
      for (int part = 0; part < kChunkParts; ++part) {
        if (!isBakedPart(chunk, part)) continue;
        const StoredContent* content = record->contentOf(number, part);
        if (content == nullptr) {
          found_.problems.add("'" + world_.name + "': a part of " + placeOf(chunk) + " is missing");
          continue;
        }
        const Looked& of_part = looked[static_cast<size_t>(content - record->contents.data())];
        if (of_part.part && *of_part.part != part)
          found_.problems.add("'" + world_.name + "': part " + std::to_string(part) + " of " + placeOf(chunk) +
                              " has the content of another part");
        parts[static_cast<size_t>(part)] = &of_part.borders;
      }
      closure_.add(chunk, parts);
    }
  }

  /// Opens a pack; null if it cannot be read or is damaged. At the first call for a pack, checks that the hash of the
  /// file's bytes is the pack's name.
  Pack open(const PackFile& pack) {
    const fs::path path = store_.pack(pack.name);
    const bool is_new = packs_.insert(pack.name).second;
    Result<Pack> file = OpenFile::open(path);
    if (!file) {
      if (is_new) found_.problems.add(file.error().message + ": bake the world again");
      return nullptr;
    }
    if (!is_new) return damaged_.count(pack.name) != 0 ? nullptr : std::move(*file);
    found_.bytes += (*file)->size();
    const Result<ContentId> id = idOfFile(**file);
    const auto head = (*file)->read(0, kPackHead);
    if (!id || (*file)->size() != pack.bytes || *id != pack.name) {
      found_.problems.add("'" + path.string() + "' is damaged: remove it, and bake the world again");
      damaged_.insert(pack.name);
      return nullptr;
    } else if (!head || !std::ranges::equal(*head, packHead())) {
      found_.problems.add("'" + path.string() +
                          "' is a pack of another version: bake its world again into another store");
    }
    return std::move(*file);
  }

  /// Checks the content of a chunk part, and computes the hashes of its borders. Invalid content counts as a mesh
  /// without triangles. So the borders of adjacent chunks have no counterpart there, and are reported, too.
  Looked lookAt(const TileRecord& record, const StoredContent& content, std::span<const Pack> packs) {
    known_.insert(content.id);
    const auto wrong = [&] {
      found_.problems.add("content " + nameOf(content.id) + " of '" + world_.name + "' is missing or damaged");
      return Looked{};
    };
    std::pmr::vector<std::byte> bytes(memory_);
    if (content.pack == kInlined) {
      const auto first = record.inlined.begin() + static_cast<ptrdiff_t>(content.offset);
      bytes.assign(first, first + static_cast<ptrdiff_t>(content.stored));
    } else {
      if (packs[content.pack] == nullptr) return Looked{};  // the unreadable pack was already reported by open()
      const auto frame = packs[content.pack]->read(content.offset, content.stored);
      if (!frame) return wrong();
      std::optional<std::pmr::vector<std::byte>> unpacked = unpacker_.unpack(*frame, content.bytes, memory_);
      if (!unpacked) return wrong();
      bytes = std::move(*unpacked);
    }
    if (idOf(bytes) != content.id) return wrong();
    const Result<ChunkRecord> chunk = decodeChunk(bytes, memory_);
    if (!chunk) return wrong();
    const std::optional<int> part = partOf(*chunk);
    if (!part) return wrong();
    return {part, bordersOf(chunk->mesh, *part)};
  }

  struct IdHash {
    size_t operator()(const ContentId& id) const { return static_cast<size_t>(id.low); }
  };

  const Folder& store_;
  const WorldFile& world_;
  std::pmr::memory_resource* memory_ = std::pmr::get_default_resource();
  Unpacker unpacker_;
  Verified found_;
  Closure closure_;
  std::unordered_set<ContentId, IdHash> known_;  ///< hashes of the contents that were checked
  std::set<ContentId> packs_, damaged_;          ///< names of all packs that were checked, and of the damaged ones
};

}  // namespace

Verified verify(const Folder& store, const WorldFile& world, const Progress& progress) {
  return Verifier(store, world).run(progress);
}

Result<Compared> compareWithBaking(const Bakery& bakery, const WorldFile& world, size_t chunks, uint64_t seed) {
  Compared compared;
  const std::pmr::vector<TileEntry>& tiles = world.index.tiles;
  // Draws tiles at random, and one chunk of each tile. Chunks whose body is not inlined, because it has a surface, are
  // preferred: a tile without such a chunk is skipped, except in every 16th draw.
  for (uint64_t draw = 0; compared.chunks < chunks && draw < 16 * chunks; ++draw) {
    const uint64_t random = hashCombine(seed, draw);
    const Result<TileRecord> record = world.record(tiles[random % tiles.size()], bakery.memory);
    if (!record) return record.error();
    const std::vector<size_t> all = chunksIn(world.index.region, record->key);
    std::vector<size_t> drawn;
    for (const size_t number : all) {
      const StoredContent* body = record->contentOf(number, 0);
      if (body != nullptr && body->pack != kInlined) drawn.push_back(number);
    }
    if (drawn.empty() && draw % 16 != 0) continue;
    const std::vector<size_t>& from = drawn.empty() ? all : drawn;
    const size_t number = from[(random >> 32) % from.size()];
    const ChunkKey chunk = chunkOf(record->key, number);
    const Result<std::array<ContentId, kChunkParts>> ids = idsOf(bakery, chunk);
    if (!ids) return ids.error();
    ++compared.chunks;
    for (int part = 0; part < kChunkParts; ++part) {
      if (!isBakedPart(chunk, part)) continue;
      const StoredContent* stored = record->contentOf(number, part);
      if (stored != nullptr && stored->id == (*ids)[static_cast<size_t>(part)]) continue;
      compared.problems.add("part " + std::to_string(part) + " of " + placeOf(chunk) +
                            " differs from the one that is baked here");
    }
  }
  return compared;
}

Result<Cleaned> clean(const Folder& store, std::pmr::memory_resource* memory, std::chrono::milliseconds patience) {
  const Result<StoreLock> lock = StoreLock::take(store, patience);
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
    return Error{Code::io, "'" + path.string() + "': " + systemMessage(error)};
  };
  Cleaned cleaned;
  std::vector<fs::path> alone;
  const fs::path indexes = store.root() / "worlds";
  if (fs::exists(indexes, error)) {
    for (fs::directory_iterator at(indexes, error), end; !error && at != end; at.increment(error)) {
      const fs::path name = at->path().stem();
      const auto isOf = [&](const fs::path& world) { return world.stem() == name; };
      const bool is_manifest = at->path().extension() == ".json" && name.string().size() == nameOf(ContentId()).size();
      if (is_manifest && std::none_of(worlds->begin(), worlds->end(), isOf)) alone.push_back(at->path());
    }
    if (error) return failure(indexes);
  }
  for (const fs::path& manifest : alone) {
    fs::remove(manifest, error);
    if (error) return failure(manifest);
  }
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
