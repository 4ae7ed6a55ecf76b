#include "tools/flight/flight_digger.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/fixed.h"
#include "tools/flight/flight_engine.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kFrameRate = 60;
constexpr double kReach = 24;  // maximum distance from the viewer to a dig, metres
constexpr int kGlances = 6;
constexpr int32_t kHole = 2 * SGM_UNITS_PER_METRE, kLump = SGM_UNITS_PER_METRE;
constexpr double kRoomForLump = 4;  // minimum distance of the viewer from a surface to which a lump is added, metres
constexpr size_t kUndoable = 64;
constexpr double kCuts = 0.75, kAdds = 0.15;  // shares of the digs that cut and that add; the rest are undos
constexpr uint64_t kDrawsAGlance = 2;

// Indices of the random numbers that determine a dig; from kGlance on, they determine the directions of search rays.
enum Draw : uint64_t { kKind, kAhead, kShape, kSmooth, kWhich, kGlance };

Metres3 anyWay(const PathKey& key, uint64_t draw) {
  const double z = 2 * key.unit(draw) - 1, turn = 2 * 3.141592653589793 * key.unit(draw + 1);
  const double side = std::sqrt(std::max(0.0, 1 - z * z));
  return {side * std::cos(turn), z, side * std::sin(turn)};
}

/// A brush that cuts a hole of 4 m with a random shape: a ball with hard or smooth edge, a tilted box, or a burrow into
/// the solid.
sgm_brush holeAt(const sgm_surface_point& at, const PathKey& key) {
  sgm_brush brush = SGM_BRUSH_INIT;
  const double shape = key.unit(kShape);
  brush.shape = shape < 0.6 ? SGM_BRUSH_SPHERE : shape < 0.8 ? SGM_BRUSH_BOX : SGM_BRUSH_CAPSULE;
  brush.radius = brush.shape == SGM_BRUSH_CAPSULE ? kHole / 2 : kHole;
  for (int axis = 0; axis < 3; ++axis) {
    brush.from[axis] = saturate(std::llround(at.position[axis]));
    brush.to[axis] = saturate(std::llround(at.position[axis] - 2.0 * kHole * at.normal[axis]));
    brush.half[axis] = kHole;
    brush.turn[axis] = static_cast<float>(at.normal[axis]);
  }
  if (key.unit(kSmooth) < 0.5) brush.smooth = SGM_UNITS_PER_METRE / 2;
  return brush;
}

sgm_brush lumpAt(const sgm_surface_point& at) {
  sgm_brush brush = SGM_BRUSH_INIT;
  brush.cut = 0;
  brush.radius = kLump;
  for (int axis = 0; axis < 3; ++axis) brush.from[axis] = saturate(std::llround(at.position[axis]));
  return brush;
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {at(0.5), at(0.99), values.back()};
}

FlightDigger::FlightDigger(sgm_world* world, uint64_t seed, double digs_a_second)
    : world_(world), key_{hashCombine(hashText("dig"), seed)}, a_frame_(digs_a_second / kFrameRate) {}

Result<sgm_surface_point> FlightDigger::surfaceNear(const FlightPlace& place, const PathKey& key, bool ahead) {
  sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  for (uint64_t glance = 0; glance < kGlances; ++glance) {
    Metres3 way = anyWay(key, kGlance + kDrawsAGlance * glance);
    if ((glm::dot(way, place.direction) > 0) != ahead) way = -way;
    sgm_ray_desc ray = SGM_RAY_DESC_INIT;
    for (int axis = 0; axis < 3; ++axis) {
      ray.from[axis] = place.position[axis] * SGM_UNITS_PER_METRE;
      ray.direction[axis] = way[axis];
    }
    ray.length = kReach;
    if (sgm_world_ray_cast(world_, &ray, &hit, &error) != SGM_OK) return errorOf(error);
    if (hit.found != 0 && hit.inside == 0) return hit;
  }
  sgm_closest_desc closest = SGM_CLOSEST_DESC_INIT;
  for (int axis = 0; axis < 3; ++axis) closest.position[axis] = place.position[axis] * SGM_UNITS_PER_METRE;
  closest.max_distance = kReach;
  if (sgm_world_closest_point(world_, &closest, &hit, &error) != SGM_OK) return errorOf(error);
  return hit;
}

Result<void> FlightDigger::plan(uint64_t frame, const FlightPlace& place) {
  planned_.reset();
  if (frame < kFrameRate) return {};
  const auto due = [this](uint64_t frames) { return std::floor(static_cast<double>(frames) * a_frame_); };
  if (due(frame + 1) == due(frame)) return {};
  const PathKey key = key_.child(0, frame);
  const double kind = key.unit(kKind);
  if (kind >= kCuts + kAdds && !last_.empty()) {
    planned_.emplace().undo = true;
    planned_->undone = static_cast<size_t>(key.unit(kWhich) * static_cast<double>(last_.size()));
    return {};
  }
  const bool add = kind >= kCuts && kind < kCuts + kAdds;
  const Result<sgm_surface_point> at = surfaceNear(place, key, !add && key.unit(kAhead) < 0.75);
  if (!at) return at.error();
  // Skip this dig if no surface is near enough.
  if (at->found == 0) return {};
  planned_.emplace().brush = add && at->distance > kRoomForLump ? lumpAt(*at) : holeAt(*at, key);
  return {};
}

Result<void> FlightDigger::dig() {
  if (!planned_) return {};
  dug_ = Clock::now();
  sgm_error error = SGM_ERROR_INIT;
  sgm_edit_id id{};
  if (planned_->undo) {
    sgm_edit_id& undone = last_[planned_->undone];
    if (sgm_world_undo(world_, &undone, &id, &error) != SGM_OK) return errorOf(error);
    undone = id;
    ++report_.undos;
  } else {
    if (sgm_world_edit(world_, &planned_->brush, &id, &error) != SGM_OK) return errorOf(error);
    last_.push_back(id);
    if (last_.size() > kUndoable) last_.pop_front();
    ++(planned_->brush.cut != 0 ? report_.cuts : report_.adds);
  }
  planned_.reset();
  return {};
}

void FlightDigger::look(const sgm_world_stats& stats) {
  // There is at most one dig per frame, so the current edit state is the first that includes this dig.
  if (dug_) waiting_.push_back({stats.edits_state, commits_, *dug_});
  dug_.reset();
  commits_ += stats.frame != frame_;
  frame_ = stats.frame;
  if (report_.digs() > 0) report_.max_queued = std::max(report_.max_queued, stats.queued);
  for (; !waiting_.empty() && waiting_.front().state <= stats.edits_drawn; waiting_.pop_front()) {
    frames_.push_back(static_cast<double>(commits_ - waiting_.front().commits));
    milliseconds_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - waiting_.front().since).count());
  }
}

DigReport FlightDigger::report() const {
  DigReport report = report_;
  report.frames = spreadOf(frames_);
  report.milliseconds = spreadOf(milliseconds_);
  return report;
}

}  // namespace sgm::cli
