// The work that a Stage does in every frame.

#include <algorithm>
#include <chrono>
#include <thread>

#include "colliders.h"
#include "godot/log.h"
#include "world/ground.h"
#include "world/stage.h"

namespace sgm_godot {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint64_t kBytesAFrame = 4 << 20;
// maximum number of pending uploads; at or above this number, no events are taken from the runtime
constexpr size_t kMaxWaiting = 512;

}  // namespace

Failure Stage::setViewers() {
  const std::vector<sgm_viewer>& all = viewers_.all();
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_set_viewers(session()->world(), all.data(), 0, all.size(), &error) < SGM_OK) return error.message;
  return std::nullopt;
}

void Stage::stream(double delta, const std::function<double()>& seconds_left) {
  viewers_.gather(delta);
  if (Failure failure = setViewers(); failure && node_.messages.error() != *failure) {
    logWarning("SgmWorld3D: " + *failure);
    node_.messages.fail(*failure);
  }
  if (pictures_.current()->counts().waiting < kMaxWaiting) {
    std::vector<sgm_world_event> events;
    if (Failure failure = session()->update(kBytesAFrame, events)) node_.messages.fail(*failure);
    receive(events);
  }
  // True if the previous frame had no time left for colliders. Colliders are then made first: players must not fall
  // through ground that is drawn.
  const bool is_first = std::exchange(colliders_first_, false);
  if (is_first && colliders_) colliders_->advance(seconds_left(), viewers_.places());
  show(pictures_.current()->advance(seconds_left()));
  if (!is_first && colliders_) {
    if (seconds_left() > 0) {
      colliders_->advance(seconds_left(), viewers_.places());
    } else {
      colliders_first_ = true;
    }
  }
  pictures_.materials().update(viewers_.places(),
                               node_.settings.morph ? morphRanges(pictures_.current()->shown(), viewers_.units(),
                                                                  session()->cellUnits(), session()->topLevel())
                                                    : MorphRanges(),
                               node_.settings.cell_size, node_.placement());
  const bool is_idle = isIdle();
  // when idle, the previous picture is dropped even if nothing of the new world is in view
  if (is_idle) pictures_.dropPrevious();
  if (is_idle && !was_idle_) node_.messages.announce("became_idle");
  was_idle_ = is_idle;
  anchor_scenes_.place(active_, seconds_left());
}

void Stage::receive(const std::vector<sgm_world_event>& events) {
  if (events.empty()) return;
  pictures_.current()->take(events);
  if (colliders_) {
    colliders_->take(events);
  } else {
    for (const sgm_world_event& event : events) static_cast<void>(sgm_collider_release(event.collider));
  }
  for (const sgm_world_event& event : events) {
    if (event.kind != SGM_EVENT_FAILED) continue;
    const std::string message = "the chunk at " + std::to_string(event.key.x) + ", " + std::to_string(event.key.y) +
                                ", " + std::to_string(event.key.z) + " of level " + std::to_string(event.key.level) +
                                " cannot be made: " + sgm_result_name(event.result);
    if (node_.messages.error().empty()) {
      logWarning("SgmWorld3D: " + message + " (further ones are told by `failed` alone)");
    }
    node_.messages.fail(message);
  }
}

void Stage::show(const std::vector<Picture::Change>& changes) {
  if (changes.empty()) return;
  const auto shows = [](const Picture::Change& change) { return change.kind != Picture::Change::kRemoved; };
  if (std::any_of(changes.begin(), changes.end(), shows)) pictures_.dropPrevious();
  for (const Picture::Change& change : changes) {
    const Vector4i key{change.key.x, change.key.y, change.key.z, change.key.level};
    node_.messages.announce(shows(change) ? "chunk_ready" : "chunk_removed", key);
  }
  anchor_scenes_.follow(changes, session()->grammar().get());
}

void Stage::lookForGround() {
  viewers_.lookForGround([this](Vector3 position) { return hasGround(position, node_, *colliders_, *session()); });
}

bool Stage::isIdle() const {
  const Picture* picture = pictures_.current();
  if (!isRunning() || picture == nullptr || !picture->complete()) return false;
  if (colliders_ && colliders_->counts().waiting > 0) return false;
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  return sgm_world_get_stats(session()->world(), &stats, nullptr) == SGM_OK && stats.idle != 0 &&
         !viewers_.all().empty();
}

bool Stage::waitUntilIdle(double seconds) {
  viewers_.gather(0);
  if (Failure failure = setViewers()) {
    node_.messages.fail(*failure);
    return false;
  }
  const Clock::time_point limit = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e6)));
  for (;;) {
    std::vector<sgm_world_event> events;
    if (Failure failure = session()->update(kBytesAFrame, events)) {
      node_.messages.fail(*failure);
      return false;
    }
    receive(events);
    show(pictures_.current()->finish());
    if (colliders_) colliders_->advance(0.01, viewers_.places());
    const bool is_idle = isIdle();
    if (is_idle || Clock::now() >= limit) return is_idle;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace sgm_godot
