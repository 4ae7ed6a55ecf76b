#pragma once
// Reports nested time intervals ("zones") of each thread to the caller's profiler. Without a profiler, a zone costs a
// branch.

#include <cstdint>

namespace sgm {

/// The caller's functions, copied to every place that does work; owns nothing. They must not throw exceptions or call
/// the library. The names of zones and plots are listed below.
struct Profiler {
  uint64_t (*begin)(void* user, const char* zone) = nullptr;  ///< null: there is no profiler
  void (*end)(void* user, uint64_t begun) = nullptr;  ///< receives the value that begin returned, on the same thread
  void (*thread)(void* user, const char* name) = nullptr;              ///< may be null
  void (*plot)(void* user, const char* name, double value) = nullptr;  ///< may be null
  void* user = nullptr;

  void nameThread(const char* name) const {
    if (thread != nullptr) thread(user, name);
  }
};

/// The names of zones and plots. Each has one address in the whole library: profilers key tables by the pointer.
namespace zone {
inline constexpr char kDerive[] = "sgm.derive", kCompile[] = "sgm.compile", kMesh[] = "sgm.mesh", kPack[] = "sgm.pack",
                      kPlan[] = "sgm.plan", kUpdate[] = "sgm.update", kPoll[] = "sgm.poll", kRegion[] = "sgm.region",
                      kShaders[] = "sgm.shaders";
}  // namespace zone
namespace plot {
inline constexpr char kQueued[] = "sgm.queued", kInWork[] = "sgm.in_work", kMeshBytes[] = "sgm.mesh_bytes";
}  // namespace plot

/// A zone from the constructor to the end of the block.
class ProfileScope {
 public:
  /// The profiler must outlive the scope.
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
