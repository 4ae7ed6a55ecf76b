#pragma once

#include <memory>
#include <mutex>

#include "session.h"

namespace sgm_godot {

/// The session that runs, and the place of its world that lies at the node's origin (metres), as every thread may read
/// them. The main thread alone changes them.
class ActiveSession {
 public:
  struct Placed {
    std::shared_ptr<Session> session;  // null if none runs
    Vector3i origin;
  };

  void set(std::shared_ptr<Session> session);
  void setOrigin(Vector3i origin);
  /// Main thread: no lock is needed to read.
  const std::shared_ptr<Session>& current() const { return placed_.session; }
  /// Any thread. Both are of the same moment.
  Placed placed() const;

 private:
  mutable std::mutex mutex_;  // held to change placed_, and to read it on other threads
  Placed placed_;
};

}  // namespace sgm_godot
