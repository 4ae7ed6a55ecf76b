#include "cli/flight.h"

#include <ctime>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

namespace sgm::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFramesASecond = 60;
constexpr uint64_t kWholeCheckEvery = 500;
constexpr double kWalkable = 16;  // metres
constexpr int kRaysAFrame = 6, kRaysToWalk = 48;
constexpr uint64_t kFramesToForget = 2;

double threadMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Error errorOf(const sgm_error& error) {
  const Code code = error.code == SGM_ERR_RANGE           ? Code::range
                    : error.code == SGM_ERR_LIMIT         ? Code::limit
                    : error.code == SGM_ERR_OUT_OF_MEMORY ? Code::out_of_memory
                                                          : Code::invalid_argument;
  return {code, error.message, error.line, error.column};
}

/// The n-th direction of a sequence that covers the sphere evenly, however many are taken.
Metres3 directionOf(uint64_t n) {
  const double index = static_cast<double>(n);
  const double z = 1 - 2 * std::fmod((index + 0.5) * 0.6180339887498949, 1.0);
  const double turn = 2 * 3.141592653589793 * std::fmod(index * 0.7548776662466927, 1.0);
  const double side = std::sqrt(std::max(0.0, 1 - z * z));
  return {side * std::cos(turn), z, side * std::sin(turn)};
}

/// An engine's side of the world: what it draws, and the checker of that.
class Engine {
 public:
  explicit Engine(bool check) {
    if (check) checker_.emplace();
  }

  /// Takes over all events. The checker's work on them waits for checkFrame().
  Result<void> poll(sgm_world* world) {
    sgm_error error = SGM_ERROR_INIT;
    for (;;) {
      size_t count = events_.size();
      if (sgm_world_poll(world, events_.data(), 0, &count, &error) != SGM_OK) return errorOf(error);
      if (count == 0) return {};
      for (size_t i = 0; i < count; ++i) take(events_[i]);
    }
  }

  Result<void> checkFrame(uint64_t frame, FlightReport& report) {
    if (!checker_) return {};
    for (const Key& key : changed_) {
      const auto at = drawn_.find(key);
      const sgm_chunk_key name{std::get<0>(key), std::get<1>(key), std::get<2>(key), std::get<3>(key)};
      if (at == drawn_.end()) {
        checker_->erase(name);
        continue;
      }
      sgm_mesh_view view = SGM_MESH_VIEW_INIT;
      sgm_error error = SGM_ERROR_INIT;
      if (sgm_mesh_get_view(at->second.mesh.get(), &view, &error) != SGM_OK) return errorOf(error);
      if (Result<void> drawn = checker_->draw(view, {at->second.seams, at->second.coarser}); !drawn) return drawn;
    }
    changed_.clear();
    const FrameReport& now = checker_->check();
    report.worst.chunks = std::max(report.worst.chunks, now.chunks);
    report.worst.triangles = std::max(report.worst.triangles, now.triangles);
    report.worst.edges = std::max(report.worst.edges, now.edges);
    report.worst.open_edges = std::max(report.worst.open_edges, now.open_edges);
    report.worst.nonmanifold_edges = std::max(report.worst.nonmanifold_edges, now.nonmanifold_edges);
    report.worst.degenerate_triangles = std::max(report.worst.degenerate_triangles, now.degenerate_triangles);
    report.worst.overlaps = std::max(report.worst.overlaps, now.overlaps);
    if (frame % kWholeCheckEvery == kWholeCheckEvery - 1) {
      const WholeReport whole = checker_->checkWhole();
      ++report.whole_checks;
      if (!whole.closed() || !(whole.frame == now)) ++report.whole_failures;
    }
    return {};
  }

  /// Whether a place of the surface is drawn at level 0: a chunk of that level with triangles holds it, or all but
  /// touches it.
  bool finestAt(const int32_t (&place)[3], int32_t cell) const {
    const int64_t edge = int64_t{SGM_CHUNK_CELLS} * cell;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<int32_t, 3> at{};
      for (size_t axis = 0; axis < 3; ++axis) {
        const int64_t p = int64_t{place[axis]} + ((corner >> axis & 1) != 0 ? cell : -cell);
        at[axis] = static_cast<int32_t>(floorDiv(p, edge));
      }
      if (drawn_.contains({0, at[0], at[1], at[2]})) return true;
    }
    return false;
  }

  const DrawnMeshes& drawn() const { return drawn_; }

 private:
  using Key = DrawnMeshes::key_type;

  void take(const sgm_world_event& event) {
    const Key key{event.key.level, event.key.x, event.key.y, event.key.z};
    switch (event.kind) {
      case SGM_EVENT_READY:
        ready_[key] = std::shared_ptr<sgm_mesh>(event.mesh, sgm_mesh_release);
        return;
      case SGM_EVENT_SHOWN:
      case SGM_EVENT_REPLACED:
        drawn_[key] = {ready_[key], event.seams, event.coarser};
        break;
      case SGM_EVENT_SEAMS:
        drawn_[key].seams = event.seams;
        drawn_[key].coarser = event.coarser;
        break;
      case SGM_EVENT_REMOVED:
        drawn_.erase(key);
        ready_.erase(key);
        break;
      default:
        return;
    }
    if (checker_) changed_.push_back(key);
  }

  std::array<sgm_world_event, 256> events_;
  DrawnMeshes drawn_;
  std::map<Key, std::shared_ptr<sgm_mesh>> ready_;
  std::vector<Key> changed_;  ///< since the last checkFrame(), where there is a checker
  std::optional<FrameChecker> checker_;
};

class Flight {
 public:
  Flight(sgm_world* world, sgm_field* field, FlightPath& path, const FlightSettings& settings)
      : world_(world), field_(field), path_(path), settings_(settings), engine_(settings.check) {}

  Result<FlightReport> run(const AfterFrame& after_frame) {
    const uint64_t leg = settings_.teleports == 0 ? 0 : settings_.frames / (settings_.teleports + 1);
    Clock::time_point due = Clock::now();
    for (uint64_t frame = 0; frame < settings_.frames; ++frame) {
      if (leg != 0 && frame > 0 && frame % leg == 0 && teleported_ < settings_.teleports) {
        if (Result<void> moved = path_.teleport(++teleported_); !moved) return moved.error();
        flown_ = 0;
        teleport_frame_ = frame;
      }
      // A path is planned before its frame begins: an engine knows where its camera is.
      const Result<FlightPlace> place = path_.at(flown_);
      if (!place) return place.error();
      if (settings_.paced) {
        std::this_thread::sleep_until(due);
        due = std::max(due + std::chrono::microseconds(16667), Clock::now() - std::chrono::milliseconds(50));
      }
      const Clock::time_point begun = Clock::now();
      if (frame == 0) start_ = begun;
      if (Result<void> drawn = drawFrame(*place); !drawn) return drawn.error();
      if (Result<void> looked = look(*place, frame); !looked) return looked.error();
      if (Result<void> checked = engine_.checkFrame(frame, report_); !checked) return checked.error();
      report_.seconds += since(begun) / 1e3;
      ++report_.frames;
      flown_ += settings_.speed / kFramesASecond;
      if (after_frame && !after_frame(frame, *place, engine_.drawn())) break;
    }
    if (settings_.paced) report_.seconds = since(start_) / 1e3;
    return finish();
  }

 private:
  Result<void> drawFrame(const FlightPlace& place) {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    for (int axis = 0; axis < 3; ++axis) {
      viewer.position[axis] = place.position[axis];
      viewer.direction[axis] = static_cast<float>(place.direction[axis]);
      viewer.velocity[axis] = static_cast<float>(place.direction[axis] * settings_.speed);
    }
    sgm_error error = SGM_ERROR_INIT;
    const double before = threadMilliseconds();
    if (sgm_world_set_viewers(world_, &viewer, 0, 1, &error) != SGM_OK) return errorOf(error);
    if (sgm_world_update(world_, settings_.frame_bytes, &error) != SGM_OK) return errorOf(error);
    if (Result<void> polled = engine_.poll(world_); !polled) return polled;
    times_.push_back(threadMilliseconds() - before);
    return {};
  }

  /// Looks around: are the surfaces that can be seen nearby drawn at level 0?
  Result<void> look(const FlightPlace& place, uint64_t frame) {
    if (teleport_frame_ && (frame == *teleport_frame_ || frame == *teleport_frame_ + kFramesToForget)) {
      sgm_world_stats stats = SGM_WORLD_STATS_INIT;
      if (sgm_world_get_stats(world_, &stats, nullptr) == SGM_OK) {
        (frame == *teleport_frame_ ? report_.stale_before : report_.stale_after) += stats.stale;
      }
    }
    if (report_.walkable_ms < 0) {
      const Result<Sight> sight = see(place, kWalkable, kRaysToWalk);
      if (!sight) return sight.error();
      if (sight->seen > 0 && sight->finest == sight->seen) report_.walkable_ms = since(start_);
      return {};
    }
    // Where a teleport has just led to everything is new.
    if (teleport_frame_ && frame < *teleport_frame_ + static_cast<uint64_t>(kFramesASecond)) return {};
    const Result<Sight> sight = see(place, settings_.finest_distance, kRaysAFrame);
    if (!sight) return sight.error();
    report_.seen += sight->seen;
    report_.seen_finest += sight->finest;
    if (sight->seen > 0) ++report_.frames_seen;
    if (sight->seen > 0 && sight->finest == sight->seen) ++report_.frames_covered;
    return {};
  }

  struct Sight {
    uint64_t seen = 0, finest = 0;
  };
  Result<Sight> see(const FlightPlace& place, double distance, int rays) {
    Sight sight;
    for (int i = 0; i < rays; ++i) {
      const Metres3 direction = directionOf(rays_++);
      sgm_ray_desc ray = SGM_RAY_DESC_INIT;
      for (int axis = 0; axis < 3; ++axis) {
        ray.from[axis] = place.position[axis] * SGM_UNITS_PER_METRE;
        ray.direction[axis] = direction[axis];
      }
      ray.length = distance;
      sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
      sgm_error error = SGM_ERROR_INIT;
      const sgm_result result = sgm_field_ray_cast(field_, &ray, &hit, &error);
      if (result != SGM_OK) return errorOf(error);
      if (hit.found == 0) continue;
      int32_t at[3];
      for (int axis = 0; axis < 3; ++axis) at[axis] = static_cast<int32_t>(hit.position[axis]);
      ++sight.seen;
      if (engine_.finestAt(at, settings_.cell_units)) ++sight.finest;
    }
    return sight;
  }

  Result<FlightReport> finish() {
    std::sort(times_.begin(), times_.end());
    if (!times_.empty()) {
      const auto at = [this](double share) {
        return times_[static_cast<size_t>(share * static_cast<double>(times_.size() - 1))];
      };
      report_.main_thread = {at(0.5), at(0.99), times_.back()};
    }
    sgm_error error = SGM_ERROR_INIT;
    if (sgm_world_get_stats(world_, &report_.stats, &error) != SGM_OK) return errorOf(error);
    report_.commits = report_.stats.frame;
    return report_;
  }

  sgm_world* world_;
  sgm_field* field_;
  FlightPath& path_;
  const FlightSettings& settings_;
  Engine engine_;
  FlightReport report_;
  Clock::time_point start_;
  std::vector<double> times_;
  double flown_ = 0;  ///< metres along the path
  uint64_t teleported_ = 0, rays_ = 0;
  std::optional<uint64_t> teleport_frame_;
};

}  // namespace

Result<FlightReport> fly(sgm_world* world, sgm_field* field, FlightPath& path, const FlightSettings& settings,
                         const AfterFrame& after_frame) {
  return Flight(world, field, path, settings).run(after_frame);
}

}  // namespace sgm::cli
