#include "tools/flight/flight_engine.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sgm::cli {
namespace {

sgm_mesh_view viewOfDrawn(const DrawnMesh& drawn) {
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  sgm_mesh_get_view(drawn.mesh.get(), &view, nullptr);
  return view;
}

bool isNear(const sgm_mesh_view& mesh, const Metres3& place, double distance) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = place[axis] * SGM_UNITS_PER_METRE;
    const double away = std::max({mesh.bounds_min[axis] - at, at - mesh.bounds_max[axis], 0.0});
    squared += away * away;
  }
  return std::sqrt(squared) <= distance * SGM_UNITS_PER_METRE;
}

sgm_vertex vertexAt(const sgm_mesh_view& mesh, uint32_t index) {
  uint32_t number;
  std::memcpy(&number, reinterpret_cast<const char*>(mesh.indices) + size_t{mesh.index_stride} * index, sizeof number);
  sgm_vertex vertex;
  std::memcpy(&vertex, reinterpret_cast<const char*>(mesh.vertices) + size_t{mesh.vertex_stride} * number,
              sizeof vertex);
  return vertex;
}

/// Number of triangles with non-zero area in the body and in the drawn seams.
uint64_t solidTriangles(const sgm_mesh_view& mesh, uint32_t seams) {
  uint64_t triangles = 0;
  for (uint32_t part = 0; part <= SGM_FACE_COUNT; ++part) {
    if (part > 0 && (seams >> (part - 1) & 1) == 0) continue;
    const sgm_mesh_range& range = part == 0 ? mesh.body : mesh.seams[part - 1];
    for (uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
      const sgm_vertex a = vertexAt(mesh, i), b = vertexAt(mesh, i + 1), c = vertexAt(mesh, i + 2);
      const int64_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
      const int64_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
      triangles += uy * vz != uz * vy || uz * vx != ux * vz || ux * vy != uy * vx;
    }
  }
  return triangles;
}

void keepLargest(FrameReport& worst, const FrameReport& now) {
  worst.chunks = std::max(worst.chunks, now.chunks);
  worst.triangles = std::max(worst.triangles, now.triangles);
  worst.edges = std::max(worst.edges, now.edges);
  worst.open_edges = std::max(worst.open_edges, now.open_edges);
  worst.nonmanifold_edges = std::max(worst.nonmanifold_edges, now.nonmanifold_edges);
  worst.degenerate_triangles = std::max(worst.degenerate_triangles, now.degenerate_triangles);
  worst.flat_triangles = std::max(worst.flat_triangles, now.flat_triangles);
  worst.folded_triangles = std::max(worst.folded_triangles, now.folded_triangles);
  worst.self_intersections = std::max(worst.self_intersections, now.self_intersections);
  worst.overlaps = std::max(worst.overlaps, now.overlaps);
}

}  // namespace

Error errorOf(const sgm_error& error) {
  const Code code = error.code == SGM_ERR_RANGE           ? Code::range
                    : error.code == SGM_ERR_LIMIT         ? Code::limit
                    : error.code == SGM_ERR_OUT_OF_MEMORY ? Code::out_of_memory
                    : error.code == SGM_ERR_IO            ? Code::io
                    : error.code == SGM_ERR_UNSUPPORTED   ? Code::unsupported
                                                          : Code::invalid_argument;
  return {code, error.message, error.line, error.column};
}

FlightEngine::FlightEngine(bool check) {
  if (check) checker_.emplace();
}

Result<uint64_t> FlightEngine::poll(sgm_world* world) {
  uint64_t bytes = 0;
  sgm_error error = SGM_ERROR_INIT;
  for (;;) {
    size_t count = events_.size();
    if (sgm_world_poll(world, events_.data(), 0, &count, &error) != SGM_OK) return errorOf(error);
    if (count == 0) return bytes;
    for (size_t i = 0; i < count; ++i) bytes += take(events_[i]);
  }
}

uint64_t FlightEngine::take(const sgm_world_event& event) {
  const DrawnKey key{event.key.level, event.key.x, event.key.y, event.key.z};
  uint64_t bytes = 0;
  switch (event.kind) {
    case SGM_EVENT_READY: {
      ready_[key] = std::shared_ptr<sgm_mesh>(event.mesh, sgm_mesh_release);
      sgm_mesh_view view = SGM_MESH_VIEW_INIT;
      sgm_mesh_get_view(event.mesh, &view, nullptr);
      bytes = uint64_t{view.vertex_count} * view.vertex_stride + uint64_t{view.index_count} * view.index_stride;
      return bytes;
    }
    case SGM_EVENT_COLLIDER:
      colliders_[key] = std::shared_ptr<sgm_collider>(event.collider, sgm_collider_release);
      return 0;
    case SGM_EVENT_COLLIDER_REMOVED:
      colliders_.erase(key);
      return 0;
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
      return 0;
  }
  if (checker_) changed_.push_back(key);
  return 0;
}

Result<void> FlightEngine::checkFrame(bool whole, CheckedFrames& checked) {
  if (!checker_) return {};
  for (const DrawnKey& key : changed_) {
    const auto at = drawn_.find(key);
    const sgm_chunk_key name{std::get<0>(key), std::get<1>(key), std::get<2>(key), std::get<3>(key)};
    if (at == drawn_.end()) {
      checker_->erase(name);
      continue;
    }
    const DrawnParts parts{at->second.seams, at->second.coarser};
    if (Result<void> drawn = checker_->draw(viewOfDrawn(at->second), parts); !drawn) return drawn;
  }
  changed_.clear();
  const FrameReport& now = checker_->check();
  keepLargest(checked.worst, now);
  if (whole) {
    const WholeReport anew = checker_->checkWhole();
    ++checked.whole_checks;
    checked.between_parts = std::max(checked.between_parts, anew.between_parts);
    if (!anew.valid() || !(anew.frame == now)) ++checked.whole_failures;
  }
  return {};
}

bool FlightEngine::finestAt(const int32_t (&place)[3], int32_t cell) const {
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

bool FlightEngine::collidesNear(const Metres3& place, double distance) const {
  return std::all_of(drawn_.begin(), drawn_.end(), [&](const auto& chunk) {
    return colliders_.contains(chunk.first) || !isNear(viewOfDrawn(chunk.second), place, distance);
  });
}

ColliderReport FlightEngine::checkColliders(const Metres3& place, double distance) const {
  ColliderReport report;
  report.colliders = colliders_.size();
  for (const auto& [key, chunk] : drawn_) {
    const sgm_mesh_view mesh = viewOfDrawn(chunk);
    const auto at = colliders_.find(key);
    if (at == colliders_.end()) {
      report.missing += isNear(mesh, place, distance);
      continue;
    }
    sgm_collider_view collider = SGM_COLLIDER_VIEW_INIT;
    sgm_collider_get_view(at->second.get(), &collider, nullptr);
    report.unlike += collider.index_count / 3 != solidTriangles(mesh, chunk.seams);
  }
  for (const auto& [key, collider] : colliders_) report.stray += !drawn_.contains(key);
  return report;
}

}  // namespace sgm::cli
