#pragma once
// Reports nested time intervals ("zones") of each thread to the host program's profiler. Without a profiler, a zone
// costs one branch.

#include <cstdint>

namespace sgm {

/// Callbacks of the host program's profiler. The struct owns nothing and is copied to all code that reports zones. The
/// callbacks must not throw exceptions or call the library. Names of zones and plots: see `zone` and `plot` below.
struct Profiler {
  uint64_t (*begin)(void* user, const char* zone) = nullptr;  ///< starts a zone and returns a value for `end`; null:
                                                              ///< there is no profiler
  void (*end)(void* user, uint64_t begun) = nullptr;  ///< ends a zone; gets the value that `begin` returned, on the
                                                      ///< same thread
  void (*thread)(void* user, const char* name) = nullptr;              ///< names the calling thread; may be null
  void (*plot)(void* user, const char* name, double value) = nullptr;  ///< reports a value over time; may be null
  void* user = nullptr;

  void nameThread(const char* name) const {
    if (thread != nullptr) thread(user, name);
  }
};

/// Names of zones and plots. Each is a single object in the whole library, because profilers use the pointer as a key.
namespace zone {
inline constexpr char kDerive[] = "sgm.derive", kCompile[] = "sgm.compile", kMesh[] = "sgm.mesh", kPack[] = "sgm.pack",
                      kPlan[] = "sgm.plan", kUpdate[] = "sgm.update", kPoll[] = "sgm.poll", kRegion[] = "sgm.region",
                      kShaders[] = "sgm.shaders";
}  // namespace zone
namespace plot {
inline constexpr char kQueued[] = "sgm.queued", kInWork[] = "sgm.in_work", kMeshBytes[] = "sgm.mesh_bytes";
}  // namespace plot

/// A zone that lasts as long as this object.
class ProfileScope {
 public:
  /// Begins a zone. The profiler must outlive this object.
  ProfileScope(const Profiler& profiler, const char* name)
      : profiler_(profiler.begin != nullptr ? &profiler : nullptr),
        begun_(profiler_ != nullptr ? profiler.begin(profiler.user, name) : 0) {}
  ~ProfileScope() {
    if (profiler_ != nullptr) profiler_->end(profiler_->user, begun_);
  }
  ProfileScope(const ProfileScope&) = delete;
  ProfileScope& operator=(const ProfileScope&) = delete;

 private:
  const Profiler* profiler_;
  uint64_t begun_;
};

}  // namespace sgm
