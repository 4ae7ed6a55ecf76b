#pragma once
// A navigation mesh for one kind of agent, made with Recast and Detour as games do.

#include <DetourNavMesh.h>
#include <DetourNavMeshBuilder.h>
#include <DetourNavMeshQuery.h>
#include <Recast.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "catch.h"
#include "mesh/weld.h"

namespace sgm::test {

/// Size and abilities of an agent. radius, height, climb: metres; slope: degrees.
struct Agent {
  float radius = 0.4f, height = 1.8f, climb = 0.4f, slope = 45;
};

/// The parts of a mesh's surface on which an agent can walk.
class Navmesh {
 public:
  /// cell: horizontal edge of Recast's voxels in metres; voxels are half as high.
  Navmesh(const WorldMesh& mesh, const Agent& agent, float cell) {
    std::vector<float> points;
    for (const std::array<double, 3>& p : mesh.positions)
      for (const double axis : p) points.push_back(static_cast<float>(axis));
    const std::vector<int> corners(mesh.indices.begin(), mesh.indices.end());
    const int count = static_cast<int>(mesh.positions.size()), triangles = static_cast<int>(corners.size() / 3);
    float low[3], high[3];
    rcCalcBounds(points.data(), count, low, high);
    int width = 0, depth = 0;
    rcCalcGridSize(low, high, cell, &width, &depth);
    const float rise = cell / 2;
    const int tall = static_cast<int>(std::ceil(agent.height / rise));
    const int climb = static_cast<int>(std::floor(agent.climb / rise));
    const int wide = static_cast<int>(std::ceil(agent.radius / cell));

    rcContext context(false);
    const std::unique_ptr<rcHeightfield, void (*)(rcHeightfield*)> field(rcAllocHeightfield(), rcFreeHeightField);
    REQUIRE(rcCreateHeightfield(&context, *field, width, depth, low, high, cell, rise));
    std::vector<unsigned char> areas(static_cast<size_t>(triangles));
    rcMarkWalkableTriangles(&context, agent.slope, points.data(), count, corners.data(), triangles, areas.data());
    REQUIRE(
        rcRasterizeTriangles(&context, points.data(), count, corners.data(), areas.data(), triangles, *field, climb));
    rcFilterLowHangingWalkableObstacles(&context, climb, *field);
    rcFilterLedgeSpans(&context, tall, climb, *field);
    rcFilterWalkableLowHeightSpans(&context, tall, *field);
    const std::unique_ptr<rcCompactHeightfield, void (*)(rcCompactHeightfield*)> open(rcAllocCompactHeightfield(),
                                                                                      rcFreeCompactHeightfield);
    REQUIRE(rcBuildCompactHeightfield(&context, tall, climb, *field, *open));
    REQUIRE(rcErodeWalkableArea(&context, wide, *open));
    REQUIRE(rcBuildRegionsMonotone(&context, *open, 0, 8, 20));
    const std::unique_ptr<rcContourSet, void (*)(rcContourSet*)> contours(rcAllocContourSet(), rcFreeContourSet);
    REQUIRE(rcBuildContours(&context, *open, 1.3f, 60, *contours));
    const std::unique_ptr<rcPolyMesh, void (*)(rcPolyMesh*)> polygons(rcAllocPolyMesh(), rcFreePolyMesh);
    REQUIRE(rcBuildPolyMesh(&context, *contours, 6, *polygons));
    for (int i = 0; i < polygons->npolys; ++i) polygons->flags[i] = 1;

    dtNavMeshCreateParams made{};
    made.verts = polygons->verts;
    made.vertCount = polygons->nverts;
    made.polys = polygons->polys;
    made.polyAreas = polygons->areas;
    made.polyFlags = polygons->flags;
    made.polyCount = polygons->npolys;
    made.nvp = polygons->nvp;
    made.walkableHeight = agent.height;
    made.walkableRadius = agent.radius;
    made.walkableClimb = agent.climb;
    for (int axis = 0; axis < 3; ++axis) {
      made.bmin[axis] = polygons->bmin[axis];
      made.bmax[axis] = polygons->bmax[axis];
    }
    made.cs = cell;
    made.ch = rise;
    made.buildBvTree = true;
    unsigned char* data = nullptr;
    int size = 0;
    REQUIRE(dtCreateNavMeshData(&made, &data, &size));
    REQUIRE(dtStatusSucceed(mesh_->init(data, size, DT_TILE_FREE_DATA)));
    REQUIRE(dtStatusSucceed(query_->init(mesh_.get(), 65535)));
    polygons_ = polygons->npolys;
  }

  int polygons() const { return polygons_; }

  /// Returns the corners of a path from any of the positions `from` to any of the positions `to`, in metres from the
  /// mesh's origin; empty if there is no path. Several positions are passed because one may lie above the floor or
  /// beside it, for example on a boulder that the agent cannot climb.
  std::vector<std::array<double, 3>> way(std::span<const std::array<double, 3>> from,
                                         std::span<const std::array<double, 3>> to) const {
    for (const std::array<double, 3>& start : from) {
      for (const std::array<double, 3>& end : to) {
        std::vector<std::array<double, 3>> found = way(start, end);
        if (!found.empty()) return found;
      }
    }
    return {};
  }

  /// Returns the position nearest to `to` that the agent can reach from `from`, to report where a path ends.
  std::array<double, 3> reached(const std::array<double, 3>& from, const std::array<double, 3>& to) const {
    constexpr int kMost = 4096;
    const dtQueryFilter all;
    const Ends ends(*query_, from, to);
    if (ends.first == 0 || ends.goal == 0) return from;
    std::vector<dtPolyRef> path(kMost);
    int steps = 0;
    query_->findPath(ends.first, ends.goal, ends.at.data(), ends.last.data(), &all, path.data(), &steps, kMost);
    if (steps == 0) return from;
    std::array<float, 3> place{};
    query_->closestPointOnPoly(path[static_cast<size_t>(steps) - 1], ends.last.data(), place.data(), nullptr);
    return {double{place[0]}, double{place[1]}, double{place[2]}};
  }

 private:
  /// The navigation polygons nearest to two positions.
  struct Ends {
    dtPolyRef first = 0, goal = 0;  ///< polygons nearest to the first and to the second position; 0: no floor is near
    std::array<float, 3> at{}, last{};

    Ends(const dtNavMeshQuery& query, const std::array<double, 3>& from, const std::array<double, 3>& to) {
      const dtQueryFilter all;
      const std::array<float, 3> around{1, 4, 1}, start = rounded(from), end = rounded(to);
      query.findNearestPoly(start.data(), around.data(), &all, &first, at.data());
      query.findNearestPoly(end.data(), around.data(), &all, &goal, last.data());
    }
  };

  std::vector<std::array<double, 3>> way(const std::array<double, 3>& from, const std::array<double, 3>& to) const {
    constexpr int kMost = 4096;
    const dtQueryFilter all;
    const auto [first, goal, at, last] = Ends(*query_, from, to);
    if (first == 0 || goal == 0) return {};
    std::vector<dtPolyRef> path(kMost);
    int steps = 0;
    const dtStatus found = query_->findPath(first, goal, at.data(), last.data(), &all, path.data(), &steps, kMost);
    if (dtStatusFailed(found) || steps == 0 || path[static_cast<size_t>(steps) - 1] != goal) return {};
    std::vector<float> corners(size_t{3} * kMost);
    int count = 0;
    query_->findStraightPath(at.data(), last.data(), path.data(), steps, corners.data(), nullptr, nullptr, &count,
                             kMost);
    std::vector<std::array<double, 3>> way;
    for (int i = 0; i < count; ++i) {
      const auto k = static_cast<size_t>(3 * i);
      way.push_back({double{corners[k]}, double{corners[k + 1]}, double{corners[k + 2]}});
    }
    return way;
  }

  static std::array<float, 3> rounded(const std::array<double, 3>& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
  }

  int polygons_ = 0;
  std::unique_ptr<dtNavMesh, void (*)(dtNavMesh*)> mesh_{dtAllocNavMesh(), dtFreeNavMesh};
  std::unique_ptr<dtNavMeshQuery, void (*)(dtNavMeshQuery*)> query_{dtAllocNavMeshQuery(), dtFreeNavMeshQuery};
};

}  // namespace sgm::test
