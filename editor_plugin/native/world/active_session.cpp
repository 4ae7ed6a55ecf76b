#include "world/active_session.h"

#include <utility>

namespace sgm_godot {

void ActiveSession::set(std::shared_ptr<Session> session) {
  {
    const std::lock_guard lock(mutex_);
    placed_.session.swap(session);
  }
  // The argument now holds the previous session. Its destructor destroys that session here, after the lock is released.
}

void ActiveSession::setOrigin(Vector3i origin) {
  const std::lock_guard lock(mutex_);
  placed_.origin = origin;
}

ActiveSession::Placed ActiveSession::placed() const {
  const std::lock_guard lock(mutex_);
  return placed_;
}

}  // namespace sgm_godot
