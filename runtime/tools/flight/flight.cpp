#include "tools/flight/flight.h"

#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

namespace sgm::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFramesASecond = 60;
constexpr auto kFrame = std::chrono::microseconds(16667);
/// If the flight is not paced, the next frame begins as soon as the world has made its next plan or is idle, or at the
/// latest after this time.
constexpr auto kLongestWait = std::chrono::milliseconds(4);
constexpr auto kBetweenLooksForNews = std::chrono::microseconds(100);
constexpr auto kBetweenLooksWhileStanding = std::chrono::milliseconds(4);
constexpr auto kLongestStill = std::chrono::seconds(20);
constexpr uint64_t kWholeCheckEvery = 500;
constexpr int kRaysAFrame = 6;
constexpr uint64_t kRaysToWalk = 48;
constexpr uint64_t kFramesToForget = 2;
/// Maximum number of frames that are drawn at the end until all digs are visible; then the flight waits until the world
/// is idle.
constexpr int kFramesToDraw = 600;
/// Maximum number of attempts to wait until the world is idle. An attempt may fail because the world needs memory that
/// is only freed when the engine polls.
constexpr int kWaits = 16;

double threadMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The n-th direction of an infinite sequence. For every k, the first k directions cover the sphere evenly.
Metres3 directionOf(uint64_t n) {
  const double index = static_cast<double>(n);
  const double z = 1 - 2 * std::fmod((index + 0.5) * 0.6180339887498949, 1.0);
  const double turn = 2 * 3.141592653589793 * std::fmod(index * 0.7548776662466927, 1.0);
  const double side = std::sqrt(std::max(0.0, 1 - z * z));
  return {side * std::cos(turn), z, side * std::sin(turn)};
}

/// Computes the viewer's position in each frame from the path, the speed and the teleports.
class Course {
 public:
  struct Stop {
    FlightPlace place;
    bool leapt = false;  ///< true if the viewer is teleported to this place
  };

  Course(FlightPath& path, const FlightSettings& settings)
      : path_(path),
        step_(settings.speed / kFramesASecond),
        leg_(settings.teleports == 0 ? 0 : settings.frames / (settings.teleports + 1)),
        teleports_(settings.teleports) {}

  Result<Stop> next() {
    Stop stop;
    if (leg_ != 0 && frame_ > 0 && frame_ % leg_ == 0 && teleported_ < teleports_) {
      if (Result<void> moved = path_.teleport(++teleported_); !moved) return moved.error();
      flown_ = 0;
      // Stand still for some frames after the teleport, so that pending requests become obsolete only by the teleport,
      // not by later motion (FlightReport::stale).
      stands_ = kFramesToForget;
      stop.leapt = true;
    }
    const Result<FlightPlace> place = path_.at(flown_);
    if (!place) return place.error();
    stop.place = *place;
    ++frame_;
    if (stands_ > 0) {
      --stands_;
    } else {
      flown_ += step_;
    }
    return stop;
  }

 private:
  FlightPath& path_;
  const double step_;  ///< distance in metres that the viewer moves per frame
  const uint64_t leg_, teleports_;
  uint64_t frame_ = 0, teleported_ = 0, stands_ = 0;
  double flown_ = 0;  ///< distance in metres along the path so far
};

class Flight {
 public:
  Flight(sgm_world* world, FlightPath& path, const FlightSettings& settings)
      : world_(world), course_(path, settings), settings_(settings), engine_(settings.check) {
    if (settings.edits > 0) digger_.emplace(world, settings.seed, settings.edits);
  }

  Result<FlightReport> run(const FlightWatch& watch) {
    if (Result<void> planned = plan(watch); !planned) return planned.error();
    Clock::time_point due = Clock::now();
    for (uint64_t frame = 0; frame < settings_.frames; ++frame) {
      const Result<Course::Stop> stop = settings_.paced ? planned_[frame] : course_.next();
      if (!stop) return stop.error();
      if (digger_) {
        if (Result<void> found = digger_->plan(frame, stop->place); !found) return found.error();
      }
      if (settings_.paced) {
        std::this_thread::sleep_until(due);
        due = std::max(due + kFrame, Clock::now() - 3 * kFrame);
      }
      if (stop->leapt) leap(frame);
      const Clock::time_point begun = Clock::now();
      if (frame == 0) start_ = begun;
      place_ = stop->place;
      if (Result<void> flown = flyFrame(frame); !flown) return flown.error();
      if (watch.pictured && watch.pictured(frame)) {
        if (Result<void> stood = standUntilDrawn(); !stood) return stood.error();
      }
      if (!settings_.paced) {
        if (const Result<void> waited = awaitNews(); !waited) return waited.error();
      }
      report_.seconds += since(begun) / 1e3;
      ++report_.frames;
      if (watch.flown && !watch.flown(frame, place_, engine_.drawn())) return Error{Code::cancelled, "ended"};
    }
    if (settings_.paced) report_.seconds = since(start_) / 1e3;
    return finish();
  }

 private:
  Result<void> plan(const FlightWatch& watch) {
    if (!settings_.paced) return {};
    for (uint64_t frame = 0; frame < settings_.frames; ++frame) {
      const Result<Course::Stop> stop = course_.next();
      if (!stop) return stop.error();
      planned_.push_back(*stop);
      if (watch.planned) watch.planned(frame);
    }
    return {};
  }

  /// Waits until the world has made a new plan or is idle, at most kLongestWait: before that, a frame would draw the
  /// same picture again.
  Result<void> awaitNews() const {
    const Clock::time_point latest = Clock::now() + kLongestWait;
    sgm_error error = SGM_ERROR_INIT;
    for (sgm_world_stats now = SGM_WORLD_STATS_INIT; Clock::now() < latest;) {
      if (sgm_world_get_stats(world_, &now, &error) != SGM_OK) return errorOf(error);
      if (now.plans != stats_.plans || now.idle != 0) return {};
      std::this_thread::sleep_for(kBetweenLooksForNews);
    }
    return {};
  }

  /// Handles a teleport: records how many requests are pending for the previous place.
  void leap(uint64_t frame) {
    teleport_frame_ = frame;
    arrived_ = false;
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    sgm_world_get_stats(world_, &stats, nullptr);
    report_.work_at_teleports.push_back(stats.queued + stats.in_work);
  }

  Result<void> flyFrame(uint64_t frame) {
    const Result<double> time = drawFrame();
    if (!time) return time.error();
    times_.push_back(*time);
    if (settings_.paced && teleport_frame_ && frame == *teleport_frame_ + kFramesToForget) {
      const uint64_t work = report_.work_at_teleports.back();
      if (work > 0) {
        const uint64_t left = std::min(work, stats_.stale);
        report_.stale.push_back(static_cast<double>(left) / static_cast<double>(work));
      }
    }
    if (Result<void> looked = look(frame); !looked) return looked;
    return engine_.checkFrame(frame % kWholeCheckEvery == kWholeCheckEvery - 1, report_.checked);
  }

  /// Draws frames without moving until the surroundings are drawn, or until nothing changes any more, for example
  /// because memory for meshes is short.
  Result<void> standUntilDrawn() {
    Clock::time_point changed = Clock::now();
    for (uint64_t made = 0; !arrived_ && Clock::now() < changed + kLongestStill;) {
      if (made != stats_.chunks_meshed + stats_.frame) changed = Clock::now();
      made = stats_.chunks_meshed + stats_.frame;
      const Result<bool> walkable = isWalkable();
      if (!walkable) return walkable.error();
      arrived_ = *walkable || stats_.idle != 0;
      if (*walkable && report_.walkable_ms < 0) report_.walkable_ms = since(start_);
      if (arrived_) return {};
      std::this_thread::sleep_for(kBetweenLooksWhileStanding);
      if (const Result<double> drawn = drawFrame(); !drawn) return drawn.error();
      if (Result<void> checked = engine_.checkFrame(false, report_.checked); !checked) return checked;
    }
    return {};
  }

  /// Simulates one frame. Returns its CPU time on this thread, in milliseconds.
  Result<double> drawFrame() {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    for (int axis = 0; axis < 3; ++axis) {
      viewer.position[axis] = place_.position[axis];
      viewer.direction[axis] = static_cast<float>(place_.direction[axis]);
      viewer.velocity[axis] = static_cast<float>(place_.direction[axis] * settings_.speed);
    }
    sgm_error error = SGM_ERROR_INIT;
    const double before = threadMilliseconds();
    if (digger_) {
      if (Result<void> dug = digger_->dig(); !dug) return dug.error();
    }
    if (settings_.each_frame) {
      const double seconds = static_cast<double>(times_.size()) / kFramesASecond;
      if (Result<void> done = settings_.each_frame(seconds); !done) return done.error();
    }
    if (sgm_world_set_viewers(world_, &viewer, 0, 1, &error) != SGM_OK) return errorOf(error);
    if (sgm_world_update(world_, settings_.frame_bytes, &error) != SGM_OK) return errorOf(error);
    const Result<uint64_t> handed_over = engine_.poll(world_);
    if (!handed_over) return handed_over.error();
    const double time = threadMilliseconds() - before;
    report_.peak_handed_over = std::max(report_.peak_handed_over, *handed_over);
    const uint64_t drawn = stats_.frame;
    if (sgm_world_get_stats(world_, &stats_, &error) != SGM_OK) return errorOf(error);
    commits_ += stats_.frame != drawn;
    report_.peak_collider_bytes = std::max(report_.peak_collider_bytes, stats_.collider_bytes);
    if (digger_) digger_->look(stats_);
    return time;
  }

  /// Casts rays to count the visible surfaces nearby, and how many of them are drawn at level 0.
  Result<void> look(uint64_t frame) {
    if (report_.walkable_ms < 0) {
      const double now = since(start_);
      const Result<bool> walkable = isWalkable();
      if (!walkable) return walkable.error();
      if (*walkable) report_.walkable_ms = now;
      return {};
    }
    // In the first second after a teleport, surfaces cannot be drawn yet: these frames do not count.
    if (teleport_frame_ && frame < *teleport_frame_ + static_cast<uint64_t>(kFramesASecond)) return {};
    const Result<Observation> sight = see(settings_.finest_distance, kRaysAFrame);
    if (!sight) return sight.error();
    report_.seen += sight->seen;
    report_.seen_finest += sight->finest;
    if (sight->seen > 0) ++report_.frames_seen;
    if (sight->seen > 0 && sight->finest == sight->seen) ++report_.frames_covered;
    return {};
  }

  /// Whether the surroundings are walkable (kWalkableDistance). Casting rays takes far longer than a frame and competes
  /// with the meshing that is being timed, so each call begins with the ray that failed in the previous call.
  Result<bool> isWalkable() {
    if (!engine_.collidesNear(place_.position, kWalkableDistance)) return false;
    bool seen = false;
    for (uint64_t i = 0; i < kRaysToWalk; ++i) {
      const Result<Surface> surface = surfaceAlong((coarse_ray_ + i) % kRaysToWalk, kWalkableDistance);
      if (!surface) return surface.error();
      seen = seen || *surface != Surface::none;
      if (*surface != Surface::coarse) continue;
      coarse_ray_ = (coarse_ray_ + i) % kRaysToWalk;
      return false;
    }
    return seen;
  }

  struct Observation {
    uint64_t seen = 0, finest = 0;
  };
  Result<Observation> see(double distance, int rays) {
    Observation sight;
    for (int i = 0; i < rays; ++i) {
      const Result<Surface> surface = surfaceAlong(rays_++, distance);
      if (!surface) return surface.error();
      sight.seen += *surface != Surface::none;
      sight.finest += *surface == Surface::finest;
    }
    return sight;
  }

  enum class Surface { none, coarse, finest };
  /// Casts a ray and classifies the surface that it hits. If the viewer is inside a solid, for example an added lump,
  /// the result is Surface::none.
  Result<Surface> surfaceAlong(uint64_t direction_number, double distance) const {
    const Metres3 direction = directionOf(direction_number);
    sgm_ray_desc ray = SGM_RAY_DESC_INIT;
    for (int axis = 0; axis < 3; ++axis) {
      ray.from[axis] = place_.position[axis] * SGM_UNITS_PER_METRE;
      ray.direction[axis] = direction[axis];
    }
    ray.length = distance;
    sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
    sgm_error error = SGM_ERROR_INIT;
    if (sgm_world_ray_cast(world_, &ray, &hit, &error) != SGM_OK) return errorOf(error);
    if (hit.found == 0 || hit.inside != 0) return Surface::none;
    int32_t at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis] = static_cast<int32_t>(hit.position[axis]);
    return engine_.finestAt(at, settings_.cell_units) ? Surface::finest : Surface::coarse;
  }

  Result<FlightReport> finish() {
    report_.stats = stats_;
    report_.commits = commits_;
    report_.main_thread = spreadOf(times_);
    if (Result<void> rested = rest(); !rested) return rested.error();
    report_.colliders = engine_.checkColliders(place_.position, kWalkableDistance);
    if (digger_) report_.digs = digger_->report();
    return report_;
  }

  Result<void> rest() {
    // Draw more frames until the last digs (edits) are visible, so that the report includes the time that this takes.
    for (int frame = 0; frame < kFramesToDraw && digger_ && digger_->waits(); ++frame) {
      std::this_thread::sleep_for(kFrame);
      if (const Result<double> drawn = drawFrame(); !drawn) return drawn.error();
      if (Result<void> checked = engine_.checkFrame(false, report_.checked); !checked) return checked;
    }
    sgm_error error = SGM_ERROR_INIT;
    sgm_result waited = SGM_ERR_LIMIT;
    for (int wait = 0; waited == SGM_ERR_LIMIT && wait < kWaits; ++wait) {
      waited = sgm_world_wait_idle(world_, nullptr, nullptr, &error);
      if (const Result<uint64_t> polled = engine_.poll(world_); !polled) return polled.error();
    }
    if (waited != SGM_OK) return errorOf(error);
    if (digger_) {
      if (sgm_world_get_stats(world_, &stats_, &error) != SGM_OK) return errorOf(error);
      digger_->look(stats_);
    }
    return engine_.checkFrame(true, report_.checked);
  }

  sgm_world* world_;
  Course course_;
  const FlightSettings& settings_;
  FlightEngine engine_;
  std::optional<FlightDigger> digger_;
  FlightReport report_;
  std::vector<Course::Stop> planned_;             ///< viewer positions of all frames of a paced flight, planned ahead
  FlightPlace place_;                             ///< viewer position in the current frame
  sgm_world_stats stats_ = SGM_WORLD_STATS_INIT;  ///< statistics of the world after the current frame
  Clock::time_point start_;
  std::vector<double> times_;
  uint64_t rays_ = 0, coarse_ray_ = 0, commits_ = 0;
  std::optional<uint64_t> teleport_frame_;
  bool arrived_ = false;  ///< whether all nearby surfaces have been drawn since the start or the last teleport
};

}  // namespace

Result<FlightReport> fly(sgm_world* world, FlightPath& path, const FlightSettings& settings, const FlightWatch& watch) {
  return Flight(world, path, settings).run(watch);
}

}  // namespace sgm::cli
