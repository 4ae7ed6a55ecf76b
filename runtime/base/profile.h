#pragma once
// Where time goes, told to a profiler of the caller's: zones that nest on each thread. Without one they cost a branch.

#include <cstdint>

namespace sgm {

/// The caller's functions, copied to wherever work is done; owns nothing. They let no exception out and call nothing of
/// ours. Names are those below.
struct Profiler {
  uint64_t (*begin)(void* user, const char* zone) = nullptr;           ///< null: there is no profiler
  void (*end)(void* user, uint64_t begun) = nullptr;                   ///< takes what begin gave, on the same thread
  void (*thread)(void* user, const char* name) = nullptr;              ///< or null
  void (*plot)(void* user, const char* name, double value) = nullptr;  ///< or null
  void* user = nullptr;

  void nameThread(const char* name) const {
    if (thread != nullptr) thread(user, name);
  }
};

/// What zones and plots are called. Each is one pointer in all of the library: profilers keep tables by it.
namespace zone {
inline constexpr char kDerive[] = "sgm.derive", kCompile[] = "sgm.compile", kMesh[] = "sgm.mesh", kPack[] = "sgm.pack",
                      kPlan[] = "sgm.plan", kUpdate[] = "sgm.update", kPoll[] = "sgm.poll", kRegion[] = "sgm.region",
                      kShaders[] = "sgm.shaders";
}  // namespace zone
namespace plot {
inline constexpr char kQueued[] = "sgm.queued", kInWork[] = "sgm.in_work", kMeshBytes[] = "sgm.mesh_bytes";
}  // namespace plot

/// A zone from here to the end of the block, however that is left.
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
