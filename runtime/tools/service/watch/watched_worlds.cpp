#include "tools/service/watch/watched_worlds.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include "base/thread_name.h"

namespace sgm::service {
namespace {

using Clock = std::chrono::steady_clock;

/// Length of the interval over which rates are computed.
constexpr std::chrono::seconds kWindow{5};
/// Age up to which a cached map of drawn chunks is reused.
constexpr std::chrono::seconds kMapAge{1};
constexpr size_t kLongestWorldName = 64;
/// Maximum number of attempts to query a list: it may grow between the query of its length and the query of its
/// elements.
constexpr int kTries = 8;

bool isName(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !name.empty() && name.size() <= kLongestWorldName && std::all_of(name.begin(), name.end(), fits);
}

Error errorOf(sgm_result result, const sgm_error& error) {
  return {result == SGM_ERR_OUT_OF_MEMORY ? Code::out_of_memory : Code::invalid_argument,
          std::string("the world cannot be sampled: ") + error.message};
}

/// Owns the references to meshes that sgm_world_get_drawn returns.
class DrawnMeshes {
 public:
  DrawnMeshes() = default;
  DrawnMeshes(const DrawnMeshes&) = delete;
  DrawnMeshes& operator=(const DrawnMeshes&) = delete;
  ~DrawnMeshes() { release(); }

  Result<void> gather(sgm_world* world) {
    sgm_error error = SGM_ERROR_INIT;
    for (int tries = 0; tries < kTries; ++tries) {
      size_t count = 0;
      if (const sgm_result r = sgm_world_get_drawn(world, nullptr, 0, &count, &error); r != SGM_OK)
        return errorOf(r, error);
      chunks_.assign(count + count / 8 + 1, {});
      count = chunks_.size();
      const sgm_result gathered = sgm_world_get_drawn(world, chunks_.data(), 0, &count, &error);
      if (gathered == SGM_INCOMPLETE) continue;
      if (gathered != SGM_OK) return errorOf(gathered, error);
      held_ = count;
      return {};
    }
    return Error{Code::busy, "the drawn chunks of the world change faster than they can be listed"};
  }
  size_t size() const { return held_; }
  const sgm_drawn_chunk& operator[](size_t i) const { return chunks_[i]; }

 private:
  void release() {
    for (size_t i = 0; i < held_; ++i) sgm_mesh_release(chunks_[i].mesh);
  }

  std::vector<sgm_drawn_chunk> chunks_;
  size_t held_ = 0;
};

/// Number of triangles in the chunk's body and in its drawn seams.
uint32_t trianglesOf(const sgm_drawn_chunk& chunk) {
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  if (sgm_mesh_get_view(chunk.mesh, &view, nullptr) != SGM_OK) return 0;
  uint32_t indices = view.body.index_count;
  for (size_t face = 0; face < std::size(view.seams); ++face)
    if (chunk.seams >> face & 1) indices += view.seams[face].index_count;
  return indices / 3;
}

/// Squared distance, in square metres, from a chunk's centre to the nearest viewer.
double distanceOf(const sgm_chunk_key& key, const WorldSample& world) {
  const double metre = 1.0 / SGM_UNITS_PER_METRE;
  const double edge = world.info.cell_units * metre * SGM_CHUNK_CELLS * static_cast<double>(1 << key.level);
  const std::array<int32_t, 3> at = {key.x, key.y, key.z};
  double nearest = std::numeric_limits<double>::infinity();
  for (const sgm_viewer& viewer : world.viewers) {
    double squared = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double away = (at[axis] + 0.5) * edge - viewer.position[axis];
      squared += away * away;
    }
    nearest = std::min(nearest, squared);
  }
  return nearest;
}

/// Indices of at most kMaxMapped chunks: the finest first, and at equal levels those nearest to a viewer first.
std::vector<size_t> mostWanted(const DrawnMeshes& drawn, const WorldSample& world) {
  struct Place {
    int32_t level;
    double distance;
    size_t number;
  };
  std::vector<Place> places;
  places.reserve(drawn.size());
  for (size_t i = 0; i < drawn.size(); ++i) places.push_back({drawn[i].key.level, distanceOf(drawn[i].key, world), i});
  const auto by = [](const Place& a, const Place& b) {
    return std::tie(a.level, a.distance, a.number) < std::tie(b.level, b.distance, b.number);
  };
  const size_t most = std::min(places.size(), kMaxMapped);
  std::partial_sort(places.begin(), places.begin() + static_cast<ptrdiff_t>(most), places.end(), by);
  std::vector<size_t> numbers;
  numbers.reserve(most);
  for (size_t i = 0; i < most; ++i) numbers.push_back(places[i].number);
  return numbers;
}

/// A world that is sampled. Contract: the caller of any function holds the mutex `looking`. The owner's forget() locks
/// it too, and thus waits until no thread uses the world.
class WatchedWorld {
 public:
  WatchedWorld(std::string name, sgm_world* world) : name_(std::move(name)), world_(world) {}

  std::mutex looking;

  void forget() { world_ = nullptr; }
  bool isForgotten() const { return world_ == nullptr; }

  Result<WorldSample> sample() {
    WorldSample now;
    now.name = name_;
    if (const Result<void> asked = ask(now); !asked) return asked.error();
    now.taken = Clock::now();
    max_in_vain_ = now.stats.chunks_in_vain = std::max(max_in_vain_, now.stats.chunks_in_vain);
    // Keep one sample older than kWindow, so that rates cover the whole interval.
    while (past_.size() > 1 && now.taken - past_[1].taken >= kWindow) past_.pop_front();
    past_.push_back({now.taken, now.stats.chunks_meshed, now.times.clock_seconds, now.times.job_seconds});
    const Past &first = past_.front(), &last = past_.back();
    const double seconds = std::chrono::duration<double>(last.taken - first.taken).count();
    if (seconds > 0) now.chunks_per_second = static_cast<double>(last.meshed - first.meshed) / seconds;
    const double worked = last.clock_seconds - first.clock_seconds;
    // If no work was done since the oldest kept sample, keep the previous value; if there is no previous value, use all
    // work since the start.
    if (worked > 0) {
      speedup_ = (last.job_seconds - first.job_seconds) / worked;
    } else if (!speedup_ && last.clock_seconds > 0) {
      speedup_ = last.job_seconds / last.clock_seconds;
    }
    // Limit the mean to the number of threads: while a job waits, its thread may run another job, and then both jobs
    // count.
    if (speedup_) now.parallel_speedup = std::min(*speedup_, static_cast<double>(now.info.threads));
    return now;
  }

  Result<std::shared_ptr<const WorldMap>> map() {
    if (map_ != nullptr && Clock::now() - mapped_ < kMapAge) return map_;
    auto made = std::make_shared<WorldMap>();
    Result<WorldSample> now = sample();
    if (!now) return now.error();
    made->world = std::move(*now);
    DrawnMeshes drawn;
    if (const Result<void> gathered = drawn.gather(world_); !gathered) return gathered.error();
    made->total = drawn.size();
    for (const size_t i : mostWanted(drawn, made->world)) {
      const sgm_chunk_key& key = drawn[i].key;
      made->chunks.push_back({key.level, key.x, key.y, key.z, trianglesOf(drawn[i])});
    }
    map_ = std::move(made);
    mapped_ = Clock::now();
    return map_;
  }

 private:
  struct Past {
    Clock::time_point taken;
    uint64_t meshed = 0;
    double clock_seconds = 0, job_seconds = 0;
  };

  Result<void> ask(WorldSample& now) {
    sgm_error error = SGM_ERROR_INIT;
    if (const sgm_result r = sgm_world_get_info(world_, &now.info, &error); r != SGM_OK) return errorOf(r, error);
    if (const sgm_result r = sgm_world_get_stats(world_, &now.stats, &error); r != SGM_OK) return errorOf(r, error);
    if (const sgm_result r = sgm_world_get_times(world_, &now.times, &error); r != SGM_OK) return errorOf(r, error);
    if ((now.info.flags & SGM_WORLD_MEASURE) != 0) {
      now.measures = sgm_world_measures SGM_WORLD_MEASURES_INIT;
      if (const sgm_result r = sgm_world_get_measures(world_, &*now.measures, &error); r != SGM_OK)
        return errorOf(r, error);
    }
    sgm_result asked = SGM_INCOMPLETE;
    size_t count = 0;
    for (int tries = 0; tries < kTries && asked == SGM_INCOMPLETE; ++tries) {
      now.viewers.resize(std::max<size_t>(count, 4), sgm_viewer SGM_VIEWER_INIT);
      count = now.viewers.size();
      asked = sgm_world_get_viewers(world_, now.viewers.data(), 0, &count, &error);
    }
    if (asked != SGM_OK) return errorOf(asked, error);
    now.viewers.resize(count);
    return {};
  }

  const std::string name_;
  sgm_world* world_;
  std::deque<Past> past_;
  uint64_t max_in_vain_ = 0;
  std::optional<double> speedup_;
  std::shared_ptr<const WorldMap> map_;
  Clock::time_point mapped_;
};

class Watcher final : public WatchedWorlds {
 public:
  explicit Watcher(std::chrono::milliseconds period) : period_(period), thread_([this] { run(); }) {}
  ~Watcher() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  Result<void> watch(const std::string& name, sgm_world* world) override {
    if (world == nullptr) return Error{Code::invalid_argument, "world is NULL"};
    if (!isName(name)) {
      return Error{Code::invalid_argument,
                   "the name of a watched world must have 1 to 64 letters, digits, '_', '-' and '.'"};
    }
    auto watched = std::make_shared<WatchedWorld>(name, world);
    Result<WorldSample> first = watched->sample();
    if (!first) return first.error();
    const std::lock_guard lock(mutex_);
    for (const auto& [other, entry] : worlds_) {
      if (other == name) return Error{Code::busy, "another world is already watched as '" + name + "'"};
      if (entry.world == world) return Error{Code::busy, "the world is already watched, as '" + other + "'"};
    }
    if (worlds_.size() >= kMaxWorlds)
      return Error{Code::limit, "at most " + std::to_string(kMaxWorlds) + " worlds can be watched concurrently"};
    worlds_.emplace(name, Entry{world, std::move(watched), std::move(*first)});
    return {};
  }

  void forget(sgm_world* world) override {
    std::shared_ptr<WatchedWorld> watched;
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::find_if(worlds_.begin(), worlds_.end(),
                                      [world](const auto& entry) { return entry.second.world == world; });
      if (found == worlds_.end()) return;
      watched = std::move(found->second.watched);
      worlds_.erase(found);
    }
    // Lock the world's mutex to wait for threads that found the world before its removal and still sample it.
    const std::lock_guard looking(watched->looking);
    watched->forget();
  }

  std::vector<WorldSample> samples() const override {
    const std::lock_guard lock(mutex_);
    std::vector<WorldSample> all;
    all.reserve(worlds_.size());
    for (const auto& entry : worlds_) all.push_back(entry.second.last);
    return all;
  }

  std::optional<WorldMap> map(const std::string& name) override {
    std::shared_ptr<WatchedWorld> watched;
    {
      const std::lock_guard lock(mutex_);
      const auto found = worlds_.find(name);
      if (found == worlds_.end()) return std::nullopt;
      watched = found->second.watched;
    }
    std::shared_ptr<const WorldMap> map;
    {
      const std::lock_guard looking(watched->looking);
      if (watched->isForgotten()) return std::nullopt;
      Result<std::shared_ptr<const WorldMap>> made = watched->map();
      if (!made) return std::nullopt;
      map = std::move(*made);
    }
    return *map;
  }

 private:
  struct Entry {
    sgm_world* world;
    std::shared_ptr<WatchedWorld> watched;
    WorldSample last;
  };

  void run() {
    nameThread("sgm watcher");
    std::unique_lock lock(mutex_);
    for (Clock::time_point next = Clock::now() + period_;; next += period_) {
      if (changed_.wait_until(lock, next, [this] { return ends_; })) return;
      lock.unlock();
      try {
        sampleAll();
      } catch (const std::bad_alloc&) {
        // Memory has run out: skip this sample. The readiness check reports when the samples are stale.
      }
      lock.lock();
      next = std::max(next, Clock::now() - period_);  // if sampling was delayed, skip the missed samples
    }
  }

  void sampleAll() {
    std::vector<std::pair<std::string, std::shared_ptr<WatchedWorld>>> all;
    {
      const std::lock_guard lock(mutex_);
      for (const auto& [name, entry] : worlds_) all.emplace_back(name, entry.watched);
    }
    for (const auto& [name, watched] : all) {
      const std::lock_guard looking(watched->looking);
      if (watched->isForgotten()) continue;
      Result<WorldSample> now = watched->sample();
      if (!now) continue;
      const std::lock_guard lock(mutex_);
      const auto found = worlds_.find(name);
      if (found != worlds_.end() && found->second.watched == watched) found->second.last = std::move(*now);
    }
  }

  const std::chrono::milliseconds period_;
  mutable std::mutex mutex_;  ///< guards all members below it; not held while a world is sampled
  std::condition_variable changed_;
  std::map<std::string, Entry> worlds_;
  bool ends_ = false;
  std::thread thread_;  ///< must be the last member: the thread uses all members above
};

}  // namespace

Result<std::unique_ptr<WatchedWorlds>> WatchedWorlds::create(std::chrono::milliseconds period) try {
  return std::unique_ptr<WatchedWorlds>(std::make_unique<Watcher>(period));
} catch (const std::system_error& e) {
  return Error{Code::io, std::string("cannot start the thread that samples worlds: ") + e.what()};
}

}  // namespace sgm::service
