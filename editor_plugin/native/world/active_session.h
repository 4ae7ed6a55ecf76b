#pragma once

#include <memory>
#include <mutex>

#include "session.h"

namespace sgm_godot {

/// The running session, and its origin: the position in the session's world, in metres, that lies at the node's origin.
/// Any thread may read both; only the main thread changes them.
class ActiveSession {
 public:
  struct Placed {
    std::shared_ptr<Session> session;  // null if no session runs
    Vector3i origin;
  };

  void set(std::shared_ptr<Session> session);
  void setOrigin(Vector3i origin);
  /// Main thread only: this thread may read the session without a lock.
  const std::shared_ptr<Session>& current() const { return placed_.session; }
  /// Returns a consistent copy of session and origin. Thread-safe.
  Placed placed() const;

 private:
  mutable std::mutex mutex_;  // locked to write placed_, and to read it on threads other than the main thread
  Placed placed_;
};

}  // namespace sgm_godot
