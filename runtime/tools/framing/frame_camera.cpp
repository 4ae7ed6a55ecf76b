#include "tools/framing/frame_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tools/render/ray_caster.h"

namespace sgm::cli {
namespace {

constexpr size_t kMaxSpots = 40;  // maximum number of points on a target's surface that are tested for visibility
constexpr int kHeadings = 20;
// Elevation angles of the camera as seen from the target, in degrees.
constexpr std::array kPitches{-20.0f, 3.0f, 14.0f, 30.0f, 55.0f};
constexpr std::array kNearer{1.0f, 0.84f, 0.7f,
                             // Distances to try, as multiples of the distance at which the box fills the picture.
                             0.5f, 0.3f, 0.2f};
constexpr float kLeastSeen = 0.35f;  // minimum of FramedView::seen

struct Spot {
  glm::vec3 position{0}, normal{0};
};

/// The centres of up to kMaxSpots triangles of the target, which are selected at even intervals.
std::vector<Spot> spotsOf(const RayCaster& mesh, const FrameTarget& target) {
  std::vector<Spot> spots;
  const size_t count = target.triangles.size(), taken = std::min(count, kMaxSpots);
  for (size_t i = 0; i < taken; ++i) {
    const uint32_t triangle = target.triangles[i * count / taken];
    const glm::vec3 facing = mesh.facing(triangle);
    if (!(glm::dot(facing, facing) > 0)) continue;
    const glm::vec3 middle = (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3.0f;
    spots.push_back({middle, glm::normalize(facing)});
  }
  return spots;
}

/// The distance of the camera from the centre of the target's box, in the direction `away`, at which the box fills the
/// share `fill` of the picture.
float distanceFor(const FrameTarget& target, glm::vec3 away, const RenderCamera& request, float fill) {
  const glm::vec3 right = glm::normalize(glm::cross(-away, glm::vec3(0, 1, 0))), up = glm::cross(right, -away);
  const float high = fill * std::tan(glm::radians(request.fov_degrees) / 2);
  const float wide = high * static_cast<float>(request.width) / static_cast<float>(request.height);
  const glm::vec3 half = 0.5f * (target.hi - target.lo);
  float distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p = half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const float across = std::max(std::abs(glm::dot(p, right)) / wide, std::abs(glm::dot(p, up)) / high);
    distance = std::max(distance, glm::dot(p, away) + across);
  }
  return distance;
}

/// A possible view. Its camera position may still lie in a solid: that is tested later.
struct Candidate {
  FramedView view;
  float score = 0;
};

class Framer {
 public:
  Framer(const RayCaster& mesh, const RenderCamera& request) : mesh_(mesh), request_(request) {}

  void tryAll(const FrameTarget& target, size_t index) {
    const std::vector<Spot> spots = spotsOf(mesh_, target);
    if (spots.empty()) return;
    const glm::vec3 middle = 0.5f * (target.lo + target.hi);
    for (const float pitch : kPitches) {
      for (int heading = 0; heading < kHeadings; ++heading) {
        const float turn = 6.2831853f * (static_cast<float>(heading) + 0.5f) / kHeadings, rise = glm::radians(pitch);
        const glm::vec3 away{std::cos(rise) * std::cos(turn), std::sin(rise), std::cos(rise) * std::sin(turn)};
        const float distance = distanceFor(target, away, request_, kFrameFill);
        for (const float nearer : kNearer) {
          const glm::vec3 from = middle + away * (nearer * distance);
          Candidate candidate;
          candidate.view = {request_, index, 0, std::min(1.0f, kFrameFill / nearer)};
          candidate.view.camera.position = from;
          candidate.view.camera.target = middle;
          if (!judge(spots, from, nearer * distance, candidate)) continue;
          candidate.score -= 1.6f * (1 - nearer) + 0.5f * std::abs(std::sin(rise) - 0.15f);
          candidates.push_back(candidate);
          break;
        }
      }
    }
  }

  std::vector<Candidate> candidates;

 private:
  /// Scores a view by the visible share of the target. Returns false if the share is too small, or a wall is close to
  /// the camera.
  bool judge(const std::vector<Spot>& spots, glm::vec3 from, float distance, Candidate& candidate) const {
    size_t facing = 0, seen = 0;
    for (const Spot& spot : spots) {
      const glm::vec3 way = spot.position - from;
      if (glm::dot(spot.normal, way) >= 0) continue;
      ++facing;
      const auto hit = mesh_.cast(from, way, 1.01f);
      seen += hit && hit->front && hit->distance > 0.985f;
    }
    if (facing == 0) return false;
    candidate.view.seen = static_cast<float>(seen) / static_cast<float>(facing);
    if (candidate.view.seen < kLeastSeen) return false;
    for (const glm::vec3 side : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                 glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
      if (mesh_.cast(from, side, 0.06f * distance)) return false;
    candidate.score = 2 * candidate.view.seen + static_cast<float>(seen) / static_cast<float>(spots.size());
    return true;
  }

  const RayCaster& mesh_;
  const RenderCamera& request_;
};

}  // namespace

Result<std::optional<FramedView>> frameTargets(std::span<const RenderVertex> vertices,
                                               std::span<const uint32_t> indices, std::span<const FrameTarget> targets,
                                               const RenderCamera& request,
                                               const std::function<bool(glm::vec3)>& isOpen) {
  const Result<RayCaster> caster = RayCaster::over(vertices, indices);
  if (!caster) return caster.error();
  const RayCaster& mesh = *caster;
  const glm::vec3 centre = 0.5f * (mesh.lo() + mesh.hi());
  const float size = std::max(glm::distance(mesh.lo(), mesh.hi()), 1e-3f);
  Framer framer(mesh, request);
  for (size_t index = 0; index < targets.size(); ++index) {
    const size_t first = framer.candidates.size();
    framer.tryAll(targets[index], index);
    // Prefer targets near the scene's centre, because objects at the border of the scene may be cut off.
    const float off = glm::distance(0.5f * (targets[index].lo + targets[index].hi), centre);
    for (size_t i = first; i < framer.candidates.size(); ++i) framer.candidates[i].score -= off / size;
  }
  std::ranges::stable_sort(framer.candidates, std::greater{}, &Candidate::score);
  for (const Candidate& candidate : framer.candidates)
    if (isOpen(candidate.view.camera.position)) return std::optional(candidate.view);
  return std::optional<FramedView>();
}

}  // namespace sgm::cli
