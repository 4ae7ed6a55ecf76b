#pragma once
// A small profiler of an engine: counts how often each zone was entered, and the time spent in each zone without the
// zones nested in it.

#include <sgm/sgm.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <string_view>
#include <vector>

class EngineProfiler {
 public:
  using Clock = std::chrono::steady_clock;
  struct Zone {
    uint64_t count = 0;
    Clock::duration alone{};    ///< total time in the zone, without the zones nested in it
    Clock::duration longest{};  ///< longest single stay in the zone, including nested zones
  };

  sgm_profiler table() {
    sgm_profiler profiler{};
    profiler.begin = [](void*, const char* zone) { return begin(zone); };
    profiler.end = [](void* user, uint64_t begun) { static_cast<EngineProfiler*>(user)->end(begun); };
    profiler.plot = [](void* user, const char* name, double value) {
      auto& self = *static_cast<EngineProfiler*>(user);
      const std::lock_guard lock(self.mutex_);
      self.highest_[name] = std::max(self.highest_[name], value);
    };
    profiler.user = this;
    return profiler;
  }

  // The following functions may be called only when no other thread uses the profiler any more.
  const std::map<std::string_view, Zone>& zones() const { return zones_; }
  /// the highest value that each plot has received
  const std::map<std::string_view, double>& highest() const { return highest_; }
  /// true if, so far, each zone that was ended was the innermost open zone of its thread
  bool nested() const { return nested_; }

 private:
  struct Open {
    const char* zone;
    Clock::time_point since;
    Clock::duration inside{};
  };
  static std::vector<Open>& openHere() {
    thread_local std::vector<Open> open;
    return open;
  }

  static uint64_t begin(const char* zone) noexcept {
    std::vector<Open>& open = openHere();
    open.push_back({zone, Clock::now()});
    return open.size();
  }

  void end(uint64_t begun) noexcept {
    const Clock::time_point now = Clock::now();
    std::vector<Open>& open = openHere();
    const std::lock_guard lock(mutex_);
    if (open.size() != begun) {
      nested_ = false;
      return;
    }
    const Open ended = open.back();
    open.pop_back();
    const Clock::duration taken = now - ended.since;
    if (!open.empty()) open.back().inside += taken;
    Zone& zone = zones_[ended.zone];
    ++zone.count;
    zone.alone += taken - ended.inside;
    zone.longest = std::max(zone.longest, taken);
  }

  std::mutex mutex_;
  std::map<std::string_view, Zone> zones_;
  std::map<std::string_view, double> highest_;
  bool nested_ = true;
};
