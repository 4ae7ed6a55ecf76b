#include "store/merge.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <unordered_map>

#include "store/world_file.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

/// Where a content lies that the store has already.
struct Place {
  uint32_t pack;  ///< number among the store's packs
  uint32_t stored;
  uint64_t offset;
};

struct IdHash {
  size_t operator()(const ContentId& id) const { return static_cast<size_t>(id.low); }
};

class Merger {
 public:
  Merger(const Folder& store, const Bakery& bakery, const ContentId& world)
      : store_(store), bakery_(bakery), world_(world) {}

  /// What the store's other worlds have, in the order of their names.
  Result<void> learn() {
    const Result<std::vector<WorldFile>> worlds = WorldFile::all(store_);
    if (!worlds) return worlds.error();
    for (const WorldFile& file : *worlds) {
      if (file.index.world == world_) continue;
      for (const TileEntry& tile : file.index.tiles) {
        const Result<TileRecord> record = file.record(tile, bakery_.memory);
        if (!record) return record.error();
        for (const StoredContent& content : record->contents) {
          if (content.pack == kInlined) continue;
          known_.try_emplace(content.id, Place{numberOf(record->packs[content.pack]), content.stored, content.offset});
        }
      }
    }
    return {};
  }

  /// Puts the tile's contents where they belong, and says so in its record.
  Result<void> settle(TileRecord& record) {
    std::vector<PackFile> packs;
    const auto use = [&](uint32_t number) {
      const auto at = static_cast<size_t>(std::find(packs.begin(), packs.end(), packs_[number]) - packs.begin());
      if (at == packs.size()) packs.push_back(packs_[number]);
      return static_cast<uint32_t>(at);
    };
    std::vector<size_t> fresh;
    for (size_t i = 0; i < record.contents.size(); ++i) {
      if (record.contents[i].pack != kInlined && known_.find(record.contents[i].id) == known_.end()) fresh.push_back(i);
    }
    size_t own = 0;
    for (const StoredContent& content : record.contents) own += content.pack != kInlined;
    std::optional<uint32_t> number;
    if (!fresh.empty()) {
      PackFile pack = record.packs[0];
      if (fresh.size() < own) {
        Result<PackFile> thinned = thin(record, fresh);
        if (!thinned) return thinned.error();
        pack = *thinned;
      } else if (Result<void> moved = adopt(record.key, pack); !moved) {
        return moved;
      }
      number = numberOf(pack);
      for (const size_t i : fresh)
        known_.try_emplace(record.contents[i].id, Place{*number, record.contents[i].stored, record.contents[i].offset});
    }
    for (StoredContent& content : record.contents) {
      if (content.pack == kInlined) continue;
      const Place& place = known_.at(content.id);
      content.pack = use(place.pack);
      content.stored = place.stored;
      content.offset = place.offset;
    }
    record.packs = std::move(packs);
    return {};
  }

  uint64_t new_bytes() const { return new_bytes_; }
  size_t known() const { return known_.size(); }

 private:
  uint32_t numberOf(const PackFile& pack) {
    const auto [at, is_new] = numbers_.try_emplace(pack.name, static_cast<uint32_t>(packs_.size()));
    if (is_new) packs_.push_back(pack);
    return at->second;
  }

  /// The tile's pack becomes the store's as it is.
  Result<void> adopt(const TileKey& tile, const PackFile& pack) {
    const fs::path from = packFile(bakery_.folder, tile), to = store_.pack(pack.name);
    if (Result<void> made = makeFolder(to.parent_path()); !made) return made;
    std::error_code error;
    new_bytes_ += pack.bytes;
    if (fs::exists(to, error)) return {};
    fs::create_hard_link(from, to, error);
    if (!error || error == std::errc::file_exists) return {};
    // A file system without links.
    const Result<std::vector<std::byte>> bytes = readFile(from, pack.bytes);
    if (!bytes) return bytes.error();
    return writeFile(to, *bytes, bakery_.unfinished);
  }

  /// A pack of only these contents, whose places change.
  Result<PackFile> thin(TileRecord& record, const std::vector<size_t>& fresh) {
    const fs::path from = packFile(bakery_.folder, record.key);
    const Result<std::vector<std::byte>> bytes = readFile(from, record.packs[0].bytes);
    if (!bytes) return bytes.error();
    if (bytes->size() != record.packs[0].bytes)
      return Error{Code::bad_input, "'" + from.string() + "' is damaged: remove it, and bake again"};
    std::vector<std::byte> frames = packHead();
    for (const size_t i : fresh) {
      StoredContent& content = record.contents[i];
      const auto first = bytes->begin() + static_cast<ptrdiff_t>(content.offset);
      content.offset = frames.size();
      frames.insert(frames.end(), first, first + static_cast<ptrdiff_t>(content.stored));
    }
    const PackFile pack{idOf(frames), frames.size()};
    const fs::path to = store_.pack(pack.name);
    if (Result<void> made = makeFolder(to.parent_path()); !made) return made.error();
    new_bytes_ += pack.bytes;
    std::error_code error;
    if (fs::exists(to, error)) return pack;
    if (Result<void> written = writeFile(to, frames, bakery_.unfinished); !written) return written.error();
    return pack;
  }

  const Folder& store_;
  const Bakery& bakery_;
  const ContentId world_;
  std::unordered_map<ContentId, Place, IdHash> known_;
  std::unordered_map<ContentId, uint32_t, IdHash> numbers_;
  std::vector<PackFile> packs_;
  uint64_t new_bytes_ = 0;
};

}  // namespace

Result<Merged> merge(const Folder& store, const Bakery& bakery, const Progress& progress) {
  const Result<ContentId> world = worldKey(bakery.world, bakery.sharp);
  if (!world) return world.error();
  const std::vector<TileKey> tiles = tilesOf(bakery.region);
  size_t missing = 0;
  for (const TileKey& tile : tiles) {
    std::error_code error;
    missing += !fs::exists(tileFile(bakery.folder, tile), error);
  }
  const auto lacking = [&](size_t count) {
    return Error{Code::invalid_argument, std::to_string(count) + " of " + std::to_string(tiles.size()) +
                                             " tiles are not baked yet: run the shards that are missing again"};
  };
  if (missing != 0) return lacking(missing);
  for (const char* folder : {"worlds", "packs"}) {
    if (Result<void> made = makeFolder(store.root() / folder); !made) return made.error();
  }
  const Result<StoreLock> lock = StoreLock::take(store);
  if (!lock) return lock.error();
  Merger merger(store, bakery, *world);
  if (Result<void> learnt = merger.learn(); !learnt) return learnt.error();
  const fs::path file = store.world(*world);
  Result<IndexWriter> writer = IndexWriter::create(file, bakery.unfinished);
  if (!writer) return writer.error();
  Merged merged;
  std::set<ContentId> packs, inlined;
  for (const TileKey& tile : tiles) {
    std::optional<TileRecord> record = madeBefore(bakery, tile);
    if (!record) return lacking(1);
    if (Result<void> settled = merger.settle(*record); !settled) return settled.error();
    if (Result<void> added = writer->add(*record, bakery.memory); !added) return added.error();
    for (const PackFile& pack : record->packs) packs.insert(pack.name);
    for (const StoredContent& content : record->contents) {
      if (content.pack == kInlined) inlined.insert(content.id);
    }
    ++merged.tiles;
    merged.chunks += record->chunks;
    merged.plain_bytes += record->plain_bytes;
    merged.measured.add(record->measured);
    if (progress && !progress(merged.tiles, tiles.size()) && merged.tiles < tiles.size())
      return Error{Code::cancelled, "merging was cancelled"};
  }
  if (Result<void> written = writer->commit(*world, bakery.region); !written) return written.error();
  merged.contents = merger.known() + inlined.size();
  merged.packs = packs.size();
  merged.pack_bytes = merger.new_bytes();
  std::error_code error;
  merged.index_bytes = fs::file_size(file, error);
  fs::remove_all(bakery.folder, error);
  return merged;
}

}  // namespace sgm::store
