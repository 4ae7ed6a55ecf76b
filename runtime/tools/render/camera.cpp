#include "tools/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tools/render/ray_caster.h"

namespace sgm {
namespace {

constexpr int kSurroundings = 48;    // number of rays that measure the free space around a point
constexpr size_t kCandidates = 240;  // maximum number of candidate camera positions
constexpr size_t kFinalists = 16;    // maximum number of camera positions whose views are compared at low resolution
constexpr size_t kStudied = 3;       // maximum number of camera positions whose views are compared in detail
constexpr float kEyeHeight = 1.7f;   // height of the camera above the floor, in metres
// Maximum distance of a lamp from the camera, in multiples of the typical distance to surfaces.
constexpr float kFarthestLamp = 3;
constexpr float kGoldenAngle = 2.39996323f;

// Direction i of `count` evenly spread directions (Fibonacci sphere).
glm::vec3 directionOf(int i, int count) {
  const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
  const float r = std::sqrt(std::max(0.0f, 1 - y * y)), a = kGoldenAngle * static_cast<float>(i);
  return {r * std::cos(a), y, r * std::sin(a)};
}

struct Space {
  float openness = 0;  // mean of the logarithms of the distances to walls
  float clearance = 0;
  float walls = 0;   // share of the rays that hit the front of a wall
  float behind = 0;  // share of the rays that hit the back of a triangle; such rays start inside the solid
};

Space spaceAround(const RayCaster& mesh, glm::vec3 p, float far) {
  Space space;
  space.clearance = far;
  for (int i = 0; i < kSurroundings; ++i) {
    const auto hit = mesh.cast(p, directionOf(i, kSurroundings), far);
    const float distance = hit ? hit->distance : far;
    space.openness += std::log(std::max(distance, 0.05f)) / kSurroundings;
    space.clearance = std::min(space.clearance, distance);
    if (hit && hit->front) space.walls += 1.0f / kSurroundings;
    if (hit && !hit->front) space.behind += 1.0f / kSurroundings;
  }
  return space;
}

bool inVoid(const Space& space) { return space.walls > 0.7f && space.behind < 0.05f && space.clearance > 0.15f; }

struct Place {
  glm::vec3 position{0};
  float score = 0;
};

// Moves p vertically to eye height above the floor: kEyeHeight, or 30 % of the room's height if that is more, but at
// most 60 % of the room's height. Returns p unchanged if a vertical ray finds no floor or no roof.
glm::vec3 standing(const RayCaster& mesh, glm::vec3 p, float far) {
  const auto floor = mesh.cast(p, {0, -1, 0}, far);
  const auto roof = mesh.cast(p, {0, 1, 0}, far);
  if (!floor || !roof) return p;
  const float height = floor->distance + roof->distance;
  const float eye = std::min(std::max(kEyeHeight, 0.30f * height), 0.6f * height);
  return p + glm::vec3(0, eye - floor->distance, 0);
}

std::vector<Place> placesInVoid(const RayCaster& mesh, float far) {
  std::vector<Place> places;
  const size_t count = std::min(kCandidates, mesh.triangleCount());
  for (size_t i = 0; i < count; ++i) {
    const auto triangle = static_cast<uint32_t>(i * mesh.triangleCount() / count);
    const glm::vec3 facing = mesh.facing(triangle);
    if (!(glm::dot(facing, facing) > 0)) continue;
    const glm::vec3 n = glm::normalize(facing);
    const glm::vec3 centre = (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3.0f;
    const glm::vec3 start = centre + n * 0.02f;
    const auto across = mesh.cast(start, n, far);
    if (!across || !across->front) continue;
    const glm::vec3 p = standing(mesh, start + n * (0.5f * across->distance), far);
    const Space space = spaceAround(mesh, p, far);
    if (!inVoid(space)) continue;
    // The border of the meshed region cuts holes into the mesh. The score prefers places from which few rays escape
    // through these holes.
    places.push_back({p, space.openness + 2 * space.walls + 0.3f * std::log(space.clearance)});
  }
  std::ranges::stable_sort(places, std::greater{}, &Place::score);
  return places;
}

// Grid of rays over the picture: number of columns and rows. The coarse kGlance compares many views; the fine kStudy
// examines the best of them.
struct Grid {
  int columns, rows;
};
constexpr Grid kGlance{7, 4}, kStudy{15, 9};

struct Fan {
  std::vector<glm::vec3> directions;
  std::vector<float> distances;
  float median = 0;
  // Typical distance: mean of the median and the upper quartile of `distances`. The upper quartile makes the background
  // count, not only the near walls that frame the view.
  float typical = 0;
  float score = 0;
};

Fan lookAlong(const RayCaster& mesh, glm::vec3 from, glm::vec3 forward, const CameraRequest& request, Grid grid,
              float far) {
  const glm::vec3 level = glm::cross(forward, glm::vec3(0, 1, 0));
  const glm::vec3 right = glm::dot(level, level) > 1e-6f ? glm::normalize(level) : glm::vec3(1, 0, 0);
  const glm::vec3 up = glm::cross(right, forward);
  const float half_height = std::tan(glm::radians(request.fov_degrees) / 2);
  const float half_width = half_height * static_cast<float>(request.width) / static_cast<float>(request.height);
  Fan fan;
  float sum = 0, squares = 0, escaped = 0;
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      const float u = 2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(grid.columns) - 1;
      const float v = 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(grid.rows) - 1;
      const glm::vec3 d = glm::normalize(forward + right * (u * half_width) + up * (v * half_height));
      const auto hit = mesh.cast(from, d, far);
      const float distance = hit ? hit->distance : far;
      fan.directions.push_back(d);
      fan.distances.push_back(distance);
      const float depth = std::log(std::max(distance, 0.05f));
      sum += depth;
      squares += depth * depth;
      escaped += hit && hit->front ? 0.0f : 1.0f;
    }
  }
  const float n = static_cast<float>(fan.distances.size());
  const float mean = sum / n, spread = std::sqrt(std::max(0.0f, squares / n - mean * mean));
  std::vector<float> sorted = fan.distances;
  std::ranges::sort(sorted);
  fan.median = sorted[sorted.size() / 2];
  fan.typical = 0.5f * (fan.median + sorted[sorted.size() * 3 / 4]);
  const float deep = std::log(std::max(sorted[sorted.size() * 9 / 10], 0.05f));
  const float nose = std::max(1.2f, 0.15f * fan.median);
  const auto close = std::ranges::count_if(sorted, [&](float distance) { return distance < nose; });
  // The score prefers deep, varied and level views. Rays that escape through holes or hit a wall right before the
  // camera lower it.
  fan.score = 0.5f * mean + 0.7f * deep + 1.0f * spread - 4.0f * escaped / n - 2.5f * static_cast<float>(close) / n -
              0.8f * forward.y * forward.y;
  return fan;
}

struct Observation {
  glm::vec3 position{0}, forward{0, 0, -1};
  Fan fan;
};

// The horizontal view from `place` with the highest score, out of kHeadings directions.
Observation glanceAround(const RayCaster& mesh, glm::vec3 place, const CameraRequest& request, float far) {
  Observation best;
  best.fan.score = -1e30f;
  constexpr int kHeadings = 12;
  for (int heading = 0; heading < kHeadings; ++heading) {
    const float a = 6.2831853f * static_cast<float>(heading) / kHeadings;
    const glm::vec3 forward{std::cos(a), 0, std::sin(a)};
    Fan fan = lookAlong(mesh, place, forward, request, kGlance, far);
    if (fan.score > best.fan.score) best = {place, forward, std::move(fan)};
  }
  return best;
}

// The view from `place` with the highest score. The camera may also stand further back, as far as the void allows.
Observation bestObservation(const RayCaster& mesh, glm::vec3 place, const CameraRequest& request, float far) {
  Observation best;
  best.fan.score = -1e30f;
  constexpr int kHeadings = 24;
  for (int heading = 0; heading < kHeadings; ++heading) {
    const float a = 6.2831853f * static_cast<float>(heading) / kHeadings;
    for (const float pitch : {-0.14f, 0.06f}) {
      const glm::vec3 forward = glm::normalize(glm::vec3(std::cos(a), pitch, std::sin(a)));
      const auto wall = mesh.cast(place, -forward, far);
      const float room = wall && wall->front ? wall->distance : 0.0f;
      for (const float back : {0.0f, 0.5f, 0.75f}) {
        if (back > 0 && room < 2.0f) break;
        const glm::vec3 from = place - forward * (back * room);
        Fan fan = lookAlong(mesh, from, forward, request, kGlance, far);
        if (fan.score <= best.fan.score) continue;
        if (back > 0 && spaceAround(mesh, from, far).clearance < 0.6f) continue;
        best = {from, forward, std::move(fan)};
      }
    }
  }
  best.fan = lookAlong(mesh, best.position, best.forward, request, kStudy, far);
  return best;
}

// Places one lamp at the side, whose slanting light shows relief, and up to three lamps where the view is deepest,
// beyond the headlamp's reach. All lamps are in the void, at a distance from each other.
std::vector<RenderLamp> lampsAlong(const RayCaster& mesh, glm::vec3 from, glm::vec3 forward, const Fan& fan,
                                   float far) {
  std::vector<RenderLamp> lamps;
  const auto hang = [&](glm::vec3 p, glm::vec3 colour, float reach, float apart) {
    const bool crowded =
        std::ranges::any_of(lamps, [&](const RenderLamp& lamp) { return glm::distance(lamp.position, p) < apart; });
    if (crowded) return false;
    const Space space = spaceAround(mesh, p, far);
    if (space.clearance < 0.35f || space.behind > 0.05f || space.walls < 0.5f) return false;
    // The lamp's reach is the typical distance to the walls around it, but at least 1 m and at most `reach`.
    lamps.push_back({p, colour, std::clamp(std::exp(space.openness), 1.0f, reach)});
    return true;
  };
  const glm::vec3 level = glm::cross(forward, glm::vec3(0, 1, 0));
  const glm::vec3 right = glm::dot(level, level) > 1e-6f ? glm::normalize(level) : glm::vec3(1, 0, 0);
  for (const float side : {-1.0f, 1.0f}) {
    const glm::vec3 d = glm::normalize(0.75f * forward + side * right + glm::vec3(0, 0.30f, 0));
    const auto wall = mesh.cast(from, d, far);
    const float room = 0.75f * std::min(wall ? wall->distance : far, 0.8f * fan.median);
    if (room > 1.0f && hang(from + d * room, {1.0f, 0.80f, 0.56f}, 0.36f * fan.median, 0)) break;
  }
  std::vector<size_t> by_depth(fan.distances.size());
  for (size_t i = 0; i < by_depth.size(); ++i) by_depth[i] = i;
  std::ranges::stable_sort(by_depth, std::greater{}, [&](size_t i) { return fan.distances[i]; });
  constexpr std::array kColours{glm::vec3(1.0f, 0.70f, 0.40f), glm::vec3(0.95f, 0.93f, 0.88f),
                                glm::vec3(1.0f, 0.82f, 0.60f)};
  size_t deep = 0;
  for (size_t i : by_depth) {
    const float depth = fan.distances[i];
    if (deep == kColours.size() || depth < 1.15f * fan.median) break;
    if (depth >= far) continue;
    // Limit the lamp's distance, to keep the lamp near the parts of the view that the other lamps light. A bright spot
    // alone in the dark would look like a ball.
    const float away = std::min(0.80f * depth, kFarthestLamp * fan.typical);
    const float reach = std::clamp(0.30f * away, 1.5f, 14.0f);
    if (hang(from + fan.directions[i] * away, kColours[deep], reach, 0.5f * away)) ++deep;
  }
  return lamps;
}

// True if most rays from far away hit the front of a surface. False for a cave in endless rock, where such rays hit the
// backs of the cave's walls.
bool seenFromOutside(const RayCaster& mesh, glm::vec3 centre, float radius) {
  int front = 0, back = 0;
  constexpr int kRays = 192;
  for (int i = 0; i < kRays; ++i) {
    const glm::vec3 from = centre + directionOf(i, kRays) * (2 * radius);
    const glm::vec3 to = centre + directionOf((i * 7 + 3) % kRays, kRays) * (0.5f * radius);
    const auto hit = mesh.cast(from, glm::normalize(to - from), 4 * radius);
    if (hit) ++(hit->front ? front : back);
  }
  return front > back;
}

// A view of the shape from outside, obliquely from above (from below if the shape floats). The distance is such that
// the shape fills the picture.
View outsideView(std::span<const RenderVertex> vertices, glm::vec3 centre, const CameraRequest& request) {
  View view;
  view.camera.width = request.width;
  view.camera.height = request.height;
  view.camera.fov_degrees = std::min(request.fov_degrees, 40.0f);
  const glm::vec3 away = glm::normalize(glm::vec3(0.62f, request.airborne ? -0.22f : 0.34f, 0.78f));
  const glm::vec3 right = glm::normalize(glm::cross(-away, glm::vec3(0, 1, 0))), up = glm::cross(right, -away);
  const float half_height = std::tan(glm::radians(view.camera.fov_degrees) / 2);
  const float half_width = half_height * static_cast<float>(request.width) / static_cast<float>(request.height);
  for (const RenderVertex& vertex : vertices) {
    const glm::vec3 p = vertex.position - centre;
    const float across = std::max(std::abs(glm::dot(p, right)) / half_width, std::abs(glm::dot(p, up)) / half_height);
    view.depth = std::max(view.depth, glm::dot(p, away) + 1.12f * across);
  }
  view.camera.position = centre + away * view.depth;
  view.camera.target = centre;
  return view;
}

View insideView(const RayCaster& mesh, const Observation& sight, const CameraRequest& request, float far) {
  View view;
  view.enclosed = true;
  view.camera = {sight.position, sight.position + sight.forward, request.fov_degrees, request.width, request.height};
  view.depth = sight.fan.typical;
  view.lamps = lampsAlong(mesh, sight.position, sight.forward, sight.fan, far);
  return view;
}

}  // namespace

Result<View> chooseCamera(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                          const CameraRequest& request) {
  if (indices.empty()) return Error{Code::invalid_argument, "there is nothing to look at: the mesh has no triangles"};
  const Result<RayCaster> tree = RayCaster::over(vertices, indices);
  if (!tree) return tree.error();
  const RayCaster& mesh = *tree;
  const glm::vec3 centre = 0.5f * (mesh.lo() + mesh.hi());
  const float radius = std::max(0.5f * glm::distance(mesh.lo(), mesh.hi()), 1e-3f), far = 2 * radius;
  std::vector<Place> places;
  for (const glm::vec3 anchor : request.anchors) {
    const glm::vec3 p = standing(mesh, anchor, far);
    if (inVoid(spaceAround(mesh, p, far))) places.push_back({p, 0});
    if (places.size() == kFinalists) break;
  }
  const bool at_anchor = !places.empty();
  if (places.empty()) {
    if (seenFromOutside(mesh, centre, radius)) return outsideView(vertices, centre, request);
    places = placesInVoid(mesh, far);
  }
  if (places.empty()) return outsideView(vertices, centre, request);
  std::vector<Observation> glances;
  for (size_t i = 0; i < std::min(kFinalists, places.size()); ++i) {
    glances.push_back(glanceAround(mesh, places[i].position, request, far));
  }
  std::ranges::stable_sort(glances, std::greater{}, [](const Observation& sight) { return sight.fan.score; });
  Observation best;
  best.fan.score = -1e30f;
  for (size_t i = 0; i < std::min(kStudied, glances.size()); ++i) {
    Observation sight = bestObservation(mesh, glances[i].position, request, far);
    if (sight.fan.score > best.fan.score) best = std::move(sight);
  }
  View view = insideView(mesh, best, request, far);
  view.at_anchor = at_anchor;
  return view;
}

Result<View> viewFrom(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                      const RenderCamera& camera) {
  View view;
  view.camera = camera;
  if (indices.empty()) return view;
  const Result<RayCaster> tree = RayCaster::over(vertices, indices);
  if (!tree) return tree.error();
  const RayCaster& mesh = *tree;
  const float far = glm::distance(mesh.lo(), mesh.hi()) + glm::distance(camera.position, mesh.lo());
  const CameraRequest request{camera.width, camera.height, camera.fov_degrees, {}, false};
  const glm::vec3 forward = glm::normalize(camera.target - camera.position);
  const Fan fan = lookAlong(mesh, camera.position, forward, request, kStudy, far);
  view.enclosed = spaceAround(mesh, camera.position, far).walls > 0.5f;
  view.depth = fan.typical;
  view.lamps = lampsAlong(mesh, camera.position, forward, fan, far);
  return view;
}

void lightScene(const View& view, Light light, RenderScene& scene) {
  scene.camera = view.camera;
  scene.background = light == Light::sun ? Background::sky : Background::cave;
  switch (light) {
    case Light::sun:
      // Between walls, little air scatters light from the sky, so the haze is thinner and the fog distance larger.
      scene.fog_distance = (view.enclosed ? 120.0f : 25.0f) * view.depth;
      return;
    case Light::lamp:
      scene.lamps = view.lamps;
      // Without other lamps, the headlamp must light the whole view. With other lamps, it lights only near places.
      scene.headlamp.reach = std::clamp((view.lamps.empty() ? 0.90f : 0.30f) * view.depth, 1.2f, 30.0f);
      scene.fog_distance = std::max(4 * view.depth, 10.0f);
      return;
    case Light::none:
      scene.headlamp.colour = glm::vec3(0);
      scene.ambient = 0.8f;
      scene.fog_distance = 1e6f;
      return;
  }
}

}  // namespace sgm
