#include "store/merge.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <unordered_map>

#include "base/file_reader.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

/// The place of an encoded chunk part in the packs of the store.
struct Place {
  uint32_t pack;  ///< index into packs_
  uint32_t stored;
  uint64_t offset;
};

struct IdHash {
  size_t operator()(const ContentId& id) const { return static_cast<size_t>(id.low); }
};

class Merger {
 public:
  Merger(const Folder& store, const Bakery& bakery) : store_(store), bakery_(bakery) {}

  /// Reads the other worlds of the store, to find out which contents (encoded chunk parts) are already stored.
  Result<void> learn(std::vector<std::string>& warnings) {
    const Result<std::vector<fs::path>> worlds = worldsOf(store_);
    if (!worlds) return worlds.error();
    for (const fs::path& path : *worlds) {
      if (path == store_.world(bakery_.key)) continue;
      const auto learnFrom = [&](TileRecord&& record) -> Result<void> {
        for (const StoredContent& content : record.contents) {
          if (content.pack == kInlined) continue;
          const uint32_t pack = numberOf(record.packs[content.pack]);
          known_.try_emplace(content.id, Place{pack, content.stored, content.offset});
        }
        return {};
      };
      const Result<WorldFile> file = WorldFile::open(path);
      const Result<void> learnt = file ? file->forRecords(bakery_.memory, learnFrom) : Result<void>(file.error());
      if (!learnt) warnings.push_back(learnt.error().message);
    }
    return {};
  }

  /// Stores those contents of a tile that the store does not have yet. Then sets the locations of all contents in the
  /// tile's record.
  Result<void> settle(TileRecord& record) {
    std::vector<size_t> fresh;
    size_t own = 0;
    for (size_t i = 0; i < record.contents.size(); ++i) {
      if (record.contents[i].pack == kInlined) continue;
      ++own;
      if (!isKnown(record.contents[i].id)) fresh.push_back(i);
    }
    if (!fresh.empty()) {
      const Result<PackFile> pack = fresh.size() < own ? thin(record, fresh) : adopt(record.key, record.packs[0]);
      if (!pack) return pack.error();
      const uint32_t number = numberOf(*pack);
      trusted_[number] = true;
      for (const size_t i : fresh) {
        const StoredContent& content = record.contents[i];
        known_.insert_or_assign(content.id, Place{number, content.stored, content.offset});
      }
    }
    std::pmr::vector<PackFile> packs(bakery_.memory);
    for (StoredContent& content : record.contents) {
      if (content.pack == kInlined) continue;
      const Place& place = known_.at(content.id);
      const auto at = static_cast<size_t>(std::find(packs.begin(), packs.end(), packs_[place.pack]) - packs.begin());
      if (at == packs.size()) packs.push_back(packs_[place.pack]);
      content.pack = static_cast<uint32_t>(at);
      content.stored = place.stored;
      content.offset = place.offset;
    }
    record.packs = std::move(packs);
    return {};
  }

  /// Blocks until the names of the new packs are on disk (fsync of their folders).
  Result<void> sync() const {
    for (const fs::path& folder : folders_) {
      if (Result<void> synced = syncFolder(folder); !synced) return synced;
    }
    return syncFolder(store_.root() / "packs");
  }

  uint64_t newBytes() const { return new_bytes_; }

 private:
  uint32_t numberOf(const PackFile& pack) {
    const auto [at, is_new] = numbers_.try_emplace(pack.name, static_cast<uint32_t>(packs_.size()));
    if (is_new) {
      packs_.push_back(pack);
      trusted_.emplace_back();
    }
    return at->second;
  }

  /// True if the store already has the content, in a pack whose bytes match the hash in its name.
  bool isKnown(const ContentId& id) {
    const auto known = known_.find(id);
    if (known == known_.end()) return false;
    std::optional<bool>& trusted = trusted_[known->second.pack];
    const PackFile& pack = packs_[known->second.pack];
    if (!trusted) trusted = isPack(store_.pack(pack.name), pack);
    return *trusted;
  }

  /// True if the store already contains the pack. Otherwise counts the pack's bytes as new. Creates the folder of the
  /// pack if it is missing.
  Result<bool> isThere(const PackFile& pack) {
    const fs::path folder = store_.pack(pack.name).parent_path();
    if (folders_.insert(folder).second) {
      if (Result<void> made = makeFolder(folder); !made) return made.error();
    }
    if (isPack(store_.pack(pack.name), pack)) return true;
    new_bytes_ += pack.bytes;
    return false;
  }

  /// Adds the tile's pack to the store unchanged: all of its contents are new. Makes a hard link to the pack's file, or
  /// else copies the file.
  Result<PackFile> adopt(const TileKey& tile, const PackFile& pack) {
    const fs::path from = packFile(bakery_.folder, tile), to = store_.pack(pack.name);
    const Result<bool> there = isThere(pack);
    if (!there) return there.error();
    if (*there) return pack;
    std::error_code error;
    fs::create_hard_link(from, to, error);
    if (!error) return pack;
    // Linking has failed: the file system has no hard links, or a damaged file already has the pack's name. So the pack
    // is copied.
    const auto bytes = readFile(from, pack.bytes);
    if (!bytes) return bytes.error();
    if (Result<void> written = writeFile(to, std::as_bytes(std::span(*bytes)), bakery_.unfinished); !written)
      return written.error();
    return pack;
  }

  /// Writes a pack that contains only the new contents, and updates their offsets in the record. fresh: indices of the
  /// new contents.
  Result<PackFile> thin(TileRecord& record, const std::vector<size_t>& fresh) {
    const auto pack_bytes = readFile(packFile(bakery_.folder, record.key), record.packs[0].bytes);
    if (!pack_bytes) return pack_bytes.error();
    const std::span bytes = std::as_bytes(std::span(*pack_bytes));
    std::vector<std::byte> frames = packHead();
    for (const size_t i : fresh) {
      StoredContent& content = record.contents[i];
      const std::span frame = bytes.subspan(content.offset, content.stored);
      content.offset = frames.size();
      frames.insert(frames.end(), frame.begin(), frame.end());
    }
    const PackFile pack{idOf(frames), frames.size()};
    const Result<bool> there = isThere(pack);
    if (!there) return there.error();
    if (*there) return pack;
    if (Result<void> written = writeFile(store_.pack(pack.name), frames, bakery_.unfinished); !written)
      return written.error();
    return pack;
  }

  const Folder& store_;
  const Bakery& bakery_;
  std::unordered_map<ContentId, Place, IdHash> known_;
  std::unordered_map<ContentId, uint32_t, IdHash> numbers_;
  std::vector<PackFile> packs_;
  /// for each element of packs_: true if the file's bytes match the hash in its name; nullopt if not checked yet
  std::vector<std::optional<bool>> trusted_;
  std::set<fs::path> folders_;  ///< folders to which packs were added
  uint64_t new_bytes_ = 0;
};

/// Returns the number of tiles that still have to be baked. These include tiles whose pack is damaged; the records of
/// such tiles are removed.
uint64_t missingOf(const Bakery& bakery, const std::vector<TileKey>& tiles) {
  uint64_t missing = 0;
  for (const TileKey& tile : tiles) {
    const std::optional<TileRecord> record = madeBefore(bakery, tile);
    if (record && (record->packs.empty() || isPack(packFile(bakery.folder, tile), record->packs[0]))) continue;
    std::error_code error;
    fs::remove(tileFile(bakery.folder, tile), error);
    ++missing;
  }
  return missing;
}

/// Removes the folder of a baking job. Renames it first: if a worker of the job still runs, it finds no folder, instead
/// of an incomplete one.
void removeJob(const Bakery& bakery) {
  fs::path aside = bakery.folder;
  aside += kMergedEnding;
  std::error_code error;
  fs::rename(bakery.folder, aside, error);
  fs::remove_all(aside, error);
}

}  // namespace

Result<bool> isBaked(const Folder& store, const Bakery& bakery) {
  const fs::path path = store.world(bakery.key);
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  const Result<WorldFile> world = WorldFile::open(path);
  if (!world) return false;
  if (jobKey(world->index.world, world->index.region) != bakery.job)
    return Error{Code::invalid_argument, "'" + store.root().string() +
                                             "' has another region of this world, or other levels: bake into another "
                                             "store (a world can stream from several), or remove '" +
                                             path.string() + "'"};
  const Result<bool> packs = hasPacks(store, *world, bakery.memory);
  return packs && *packs;
}

Result<Merged> merge(const Folder& store, const Bakery& bakery, const Manifest& manifest, const Progress& progress,
                     std::chrono::milliseconds patience) {
  for (const char* folder : {"worlds", "packs"}) {
    if (Result<void> made = makeFolder(store.root() / folder); !made) return made.error();
  }
  const Result<StoreLock> lock = StoreLock::take(store, patience);
  if (!lock) return lock.error();
  Merged merged;
  const Result<bool> baked = isBaked(store, bakery);
  if (!baked) return baked.error();
  if (*baked) {
    const Result<WorldFile> world = WorldFile::open(store.world(bakery.key));
    if (!world) return world.error();
    Result<WorldSummary> summary = summaryOf(*world, bakery.memory);
    if (!summary) return summary.error();
    merged.world = std::move(*summary);
    merged.there_before = true;
    removeJob(bakery);
    return merged;
  }
  const std::vector<TileKey> tiles = tilesOf(bakery.region);
  if (const uint64_t missing = missingOf(bakery, tiles); missing != 0)
    return Error{Code::invalid_argument, std::to_string(missing) + " of " + std::to_string(tiles.size()) +
                                             " tiles are not baked yet: run all shards to the end, with the same "
                                             "options as this merge; finished shards take no time"};
  Merger merger(store, bakery);
  if (Result<void> learnt = merger.learn(merged.warnings); !learnt) return learnt.error();
  Result<IndexWriter> writer = IndexWriter::create(store.world(bakery.key), bakery.unfinished);
  if (!writer) return writer.error();
  for (const TileKey& tile : tiles) {
    std::optional<TileRecord> record = madeBefore(bakery, tile);
    if (!record)
      return Error{Code::io, "'" + tileFile(bakery.folder, tile).string() + "' disappeared while it was merged"};
    if (Result<void> settled = merger.settle(*record); !settled) return settled.error();
    if (Result<void> added = writer->add(*record, bakery.memory); !added) return added.error();
    merged.world.add(*record);
    const uint64_t done = merged.world.tiles;
    if (progress && !progress(done, tiles.size()) && done < tiles.size())
      return Error{Code::cancelled, "merging was cancelled"};
  }
  merged.new_bytes = merger.newBytes();
  if (Result<void> synced = merger.sync(); !synced) return synced.error();
  const std::string text = manifest(merged.world);
  if (Result<void> written = writeFile(store.manifest(bakery.key), std::as_bytes(std::span(text)), bakery.unfinished);
      !written)
    return written.error();
  if (Result<void> written = writer->commit(bakery.key, bakery.region); !written) return written.error();
  if (Result<void> synced = syncFolder(store.root() / "worlds"); !synced) return synced.error();
  removeJob(bakery);
  return merged;
}

}  // namespace sgm::store
