#include "store/source.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

#include "store/folder.h"
#include "store/open_store.h"

namespace sgm::store {
namespace {

class StoreSource final : public BakedParts {
 public:
  StoreSource(Log log, std::pmr::memory_resource* memory) : log_(std::move(log)), memory_(memory) {}

  Result<void> open(const std::string& place) {
    Result<std::unique_ptr<StoreFiles>> files = storeFiles(place, log_, memory_);
    if (!files && files.error().code == Code::unsupported) {
      // This build or machine cannot read the store. As with an unavailable server, this is not an error: without the
      // store the world looks the same.
      if (log_) log_("'" + shownPlace(place) + "': " + files.error().message + "; chunks are derived instead");
      return {};
    }
    if (!files) return files.error();
    if (!(*files)->isFar()) {
      if (Result<void> good = checkFormat(**files); !good) return good;
    }
    const auto tell = [this](const std::string& file, const std::string& message) { this->tell(file, message); };
    const bool is_far = (*files)->isFar();
    auto store = std::make_unique<OpenStore>(std::move(*files), tell, memory_);
    // Puts local stores before servers, because stores are searched in the order of the list. Apart from speed, the
    // order has no effect: all stores have the same bytes for a part.
    const auto first_far =
        std::find_if(stores_.begin(), stores_.end(), [](const auto& other) { return other->files().isFar(); });
    stores_.insert(is_far ? stores_.end() : first_far, std::move(store));
    return {};
  }

  DiskKey worldOf(std::span<const std::byte> inputs) const override { return idOf(inputs); }

  std::optional<BakedPart> get(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach,
                               std::pmr::memory_resource* memory) override {
    bool damaged = false;
    for (const auto& store : stores_) {
      if (reach == Reach::near && store->files().isFar()) continue;
      Result<std::optional<FoundPart>> found = findIn(*store, world, chunk, part, memory);
      damaged = damaged || (!found && found.error().code != Code::busy);
      if (!found || !*found) continue;
      const std::lock_guard lock(mutex_);
      ++stats_.hits;
      stats_.bytes += (*found)->stored;
      return BakedPart{std::move((*found)->bytes), store->files().isFar()};
    }
    {
      const std::lock_guard lock(mutex_);
      ++stats_.misses;
      stats_.damaged += damaged;
    }
    tellIfLacking(world);
    return std::nullopt;
  }

  void reject(const BakedWorld& world, const ChunkKey& chunk, int part, Reach reach) override {
    // All stores have the same bytes for a part. So the rejected part must not be returned again by any store that
    // get() may have searched.
    for (const auto& store : stores_) {
      if (reach == Reach::far || !store->files().isFar()) store->reject(keyIn(*store, world), chunk, part);
    }
    const std::lock_guard lock(mutex_);
    --stats_.hits;
    ++stats_.misses;
    ++stats_.damaged;
  }

  bool isFar() const override {
    return std::any_of(stores_.begin(), stores_.end(), [](const auto& store) { return store->files().isFar(); });
  }

  void stop() noexcept override {
    for (const auto& store : stores_) store->files().stop();
  }

  BakedStats stats() const override {
    const std::lock_guard lock(mutex_);
    return stats_;
  }

 private:
  /// Returns the key under which a store may contain a world: the former key (of version 0.2 of the library) if the
  /// world has a former key and the store has no index under the current key; otherwise the current key. Precondition:
  /// find() has searched the store for the world.
  static DiskKey keyIn(OpenStore& store, const BakedWorld& world) {
    return world.former_key && store.lacks(world.key) ? world.former_key() : world.key;
  }
  static Result<std::optional<FoundPart>> findIn(OpenStore& store, const BakedWorld& world, const ChunkKey& chunk,
                                                 int part, std::pmr::memory_resource* memory) {
    Result<std::optional<FoundPart>> found = store.find(world.key, chunk, part, memory);
    if (!found || *found) return found;
    const DiskKey key = keyIn(store, world);
    return key == world.key ? std::move(found) : store.find(key, chunk, part, memory);
  }
  /// Logs a message if no store has data of this world. Does so only for the first such world, because animated
  /// parameters create many worlds.
  void tellIfLacking(const BakedWorld& world) {
    if (has_told_lack_ || !log_ || stores_.empty()) return;
    const auto lacks = [&](const auto& store) { return store->lacks(keyIn(*store, world)); };
    if (!std::all_of(stores_.begin(), stores_.end(), lacks) || has_told_lack_.exchange(true)) return;
    std::string places;
    for (const auto& store : stores_) places += (places.empty() ? "'" : ", '") + store->files().nameOf("") + "'";
    log_(places + (stores_.size() == 1 ? " has" : " have") +
         " no data of this world, which differs in its grammar, a parameter, the seed, the cells, sharp features or "
         "the library's version (sgm store info lists the worlds): all chunks are derived");
  }
  void tell(const std::string& file, const std::string& message) {
    bool is_new = false;
    {
      const std::lock_guard lock(mutex_);
      ++stats_.errors;
      is_new = told_.insert(file).second;
    }
    if (is_new && log_) log_(message + "; chunks are derived instead");
  }

  const Log log_;
  std::pmr::memory_resource* const memory_;
  std::vector<std::unique_ptr<OpenStore>> stores_;
  std::atomic<bool> has_told_lack_ = false;
  mutable std::mutex mutex_;  ///< guards the members below
  std::set<std::string> told_;
  BakedStats stats_;
};

}  // namespace

Result<std::shared_ptr<BakedParts>> openStores(std::span<const std::string> places, Log log,
                                               std::pmr::memory_resource* memory) {
  if (Result<void> can = available(); !can) return can.error();
  auto source = std::make_shared<StoreSource>(std::move(log), memory);
  for (const std::string& place : places) {
    if (Result<void> opened = source->open(place); !opened) return opened.error();
  }
  return std::shared_ptr<BakedParts>(std::move(source));
}

}  // namespace sgm::store
