#include "tools/support/region_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "mesh/vertex.h"
#include "query/queries.h"
#include "tools/support/materials.h"
#include "tools/support/render_options.h"
#include "tools/support/surroundings.h"

namespace sgm::cli {
namespace {

/// Converts a mesh's vertices for the renderer, with positions relative to the mesh's origin.
std::vector<RenderVertex> drawable(const WorldMesh& mesh) {
  std::vector<RenderVertex> vertices(mesh.positions.size());
  for (size_t i = 0; i < vertices.size(); ++i) {
    const std::array<double, 3>& p = mesh.positions[i];
    const VertexAttributes& attributes = mesh.attributes[i];
    const std::array<double, 3> n = unpackNormal(attributes.normal_x, attributes.normal_y);
    vertices[i] = {{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])},
                   {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])},
                   attributes.material};
  }
  return vertices;
}

/// Adds the mesh to the scene. Vertices at borders between texture charts or pairs of materials are duplicated.
void addMesh(const Region& region, bool uv, RegionScene& drawn) {
  const std::vector<RenderVertex> vertices = drawable(region.meshed.mesh);
  const Unwrapped& seen = region.texture ? region.texture->unwrapped : *region.blends;
  drawn.indices.assign(seen.corners.begin(), seen.corners.end());
  drawn.vertices.reserve(seen.wedges.size());
  for (const Wedge& wedge : seen.wedges) {
    RenderVertex& vertex = drawn.vertices.emplace_back(vertices[wedge.vertex]);
    vertex.material = wedge.materials[0];
    vertex.second = wedge.materials[1];
    vertex.share = static_cast<float>(wedge.share) / 255.0f;
    if (uv) vertex.texture = {wedge.u, wedge.v};
  }
}

glm::vec3 fromOrigin(const WorldMesh& mesh, const std::array<double, 3>& world) {
  glm::vec3 point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] =
        static_cast<float>(world[static_cast<size_t>(axis)] - static_cast<double>(mesh.origin[axis]) / kUnitsPerMetre);
  return point;
}

/// Whether a place is so near the region's border that a picture from there would show the border.
bool isByBorder(const IntBox& extent, Int3 place) {
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t margin = (int64_t{extent.hi[axis]} - extent.lo[axis]) / 8;
    if (place[axis] < extent.lo[axis] + margin || place[axis] > extent.hi[axis] - margin) return true;
  }
  return false;
}

/// The view from the camera that the options give, or from an automatically chosen one.
Result<View> viewOf(const RenderOptions& options, const Region& region, const RegionScene& drawn) {
  const PictureSize size = *readSize(options.size);
  if (!options.camera.empty()) {
    const Gaze gaze = *readCamera(options.camera);
    RenderCamera camera;
    camera.position = fromOrigin(region.meshed.mesh, gaze[0]);
    camera.target = fromOrigin(region.meshed.mesh, gaze[1]);
    camera.fov_degrees = static_cast<float>(options.fov);
    camera.width = size.width;
    camera.height = size.height;
    if (camera.position == camera.target)
      return Error{Code::invalid_argument, "--camera: the position and the target are the same point"};
    return viewFrom(drawn.vertices, drawn.indices, camera);
  }
  const std::vector<glm::vec3> anchors = anchorsAt(region, options.at);
  CameraRequest request;
  request.width = size.width;
  request.height = size.height;
  request.fov_degrees = static_cast<float>(options.fov);
  request.anchors = anchors;
  request.airborne = region.program->domain.density;
  return chooseCamera(drawn.vertices, drawn.indices, request);
}

/// Lamps at the region's anchors of kind `light`: the nearest to the camera, but none far behind it.
std::vector<RenderLamp> builtLamps(const Region& region, const RenderCamera& camera) {
  constexpr float kReach = 1.5f;    // metres, RenderLamp::reach of a lamp
  constexpr float kBehind = -3.0f;  // metres; a lamp is used if it is in front of the camera or at most this far behind
  const glm::vec3 colour(1.0f, 0.76f, 0.50f), forward = glm::normalize(camera.target - camera.position);
  std::vector<RenderLamp> lamps;
  for (const Anchor& anchor : region.anchors) {
    if (region.program->names[anchor.kind] != "light") continue;
    const Int3 at = anchor.frame.origin;
    const glm::vec3 place = fromOrigin(region.meshed.mesh, {metres(at.x), metres(at.y), metres(at.z)});
    if (glm::dot(place - camera.position, forward) > kBehind) lamps.push_back({place, colour, kReach});
  }
  std::ranges::stable_sort(lamps, {},
                           [&](const RenderLamp& lamp) { return glm::distance(lamp.position, camera.position); });
  if (lamps.size() > kMaxLamps) lamps.resize(kMaxLamps);
  return lamps;
}

/// Materials for --wires. The surface has no pattern, because a pattern would hide the edges.
constexpr RenderMaterial kUnderWires{SurfacePattern::plain, {0.55f, 0.55f, 0.52f}, 0.9f, 0.0f};
constexpr RenderMaterial kWire{SurfacePattern::plain, {0.01f, 0.02f, 0.05f}, 1.0f, 0.0f};

/// Adds the mesh's edges as ribbons that face the camera and have a constant width in pixels.
void addWires(const Region& region, const RenderCamera& camera, RegionScene& drawn) {
  constexpr float kWide = 0.55f, kLifted = 1.5f;  // pixels: half of a ribbon's width, and its offset towards the camera
  // Maximum half width of a ribbon as a share of the edge's visible length, so that ribbons do not cover small
  // triangles.
  constexpr float kShare = 0.035f;
  const WorldMesh& mesh = region.meshed.mesh;
  std::vector<std::array<uint32_t, 2>> edges;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t from = mesh.indices[i], to = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
    edges.push_back({std::min(from, to), std::max(from, to)});
  }
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());

  const float pixel = 2 * std::tan(glm::radians(camera.fov_degrees) / 2) / static_cast<float>(camera.height);
  RenderVertex vertex;
  vertex.material = vertex.second = static_cast<uint32_t>(renderMaterials(*region.program).size());
  const auto place = [&](uint32_t index) {
    const std::array<double, 3>& p = mesh.positions[index];
    return glm::vec3(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  };
  for (const auto& [a, b] : edges) {
    const glm::vec3 ends[] = {place(a), place(b)};
    const glm::vec3 side = glm::cross(ends[1] - ends[0], camera.position - ends[0]);
    if (glm::length(side) == 0) continue;  // the camera looks along the edge, so the edge is not visible
    const float seen = glm::length(side) / glm::distance(camera.position, ends[0]);
    const auto first = static_cast<uint32_t>(drawn.vertices.size());
    for (const glm::vec3& end : ends) {
      const float one = pixel * glm::distance(camera.position, end);
      const float wide = std::min(kWide * one, kShare * seen);
      vertex.normal = glm::normalize(camera.position - end);
      for (const float to : {-wide, wide}) {
        vertex.position = end + to * glm::normalize(side) + kLifted * one * vertex.normal;
        drawn.vertices.push_back(vertex);
      }
    }
    for (const uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) drawn.indices.push_back(first + corner);
  }
}

/// The world for measuring daylight. It includes parts beyond the region's border.
LitWorld litWorld(const Region& region) {
  const Program& program = *region.program;
  LitWorld world = LitWorld::of(program.domain.solid, program.domain.infinite && program.domain.axes[1]);
  for (const auto& material : program.materials)
    world.translucent.push_back(program.domain.density || isTranslucent(material));
  world.clearance_metres = metres(region.cell) / 4;
  world.cast = [field = queryField(*region.world)](const Metres3& from, const Metres3& direction,
                                                   double length) -> Result<std::optional<RayEnd>> {
    const Metres3 start = from * static_cast<double>(kUnitsPerMetre);
    const Result<std::optional<SurfacePoint>> hit =
        rayCast(field, {start.x, start.y, start.z}, {direction.x, direction.y, direction.z}, length * kUnitsPerMetre);
    if (!hit) return hit.error();
    if (!*hit) return std::optional<RayEnd>();
    const SurfacePoint& end = **hit;
    return std::optional(
        RayEnd{end.distance / kUnitsPerMetre, {end.normal[0], end.normal[1], end.normal[2]}, end.material, end.inside});
  };
  return world;
}

Result<Outlook> lookOutFor(const Region& region, const View& view) {
  const RenderCamera& camera = view.camera;
  const Int3 origin = region.meshed.mesh.origin;
  CameraPlace place;
  place.position = Metres3(camera.position) + Metres3(metres(origin.x), metres(origin.y), metres(origin.z));
  place.direction = Metres3(camera.target - camera.position);
  place.fov_degrees = camera.fov_degrees;
  place.aspect = static_cast<double>(camera.width) / camera.height;
  return lookOut(litWorld(region), place);
}

Result<Image> drawVolume(const Renderer& renderer, const RegionDensity& density, const Region& region,
                         const View& view) {
  // Optical depth along the shortest path across an edge of the fog. It lets a third of the light pass, so that edges
  // of all sizes look soft.
  constexpr double kEdgeDepth = 1.1;
  const DensityGrid& grid = density.grid;
  VolumeScene scene;
  scene.density = density.values;
  for (int axis = 0; axis < 3; ++axis) {
    scene.size[axis] = grid.size[static_cast<size_t>(axis)];
    scene.corner[axis] = static_cast<float>(metres(grid.origin[axis]) - metres(region.meshed.mesh.origin[axis]));
  }
  scene.spacing = static_cast<float>(metres(grid.spacing));
  // Across an edge of the fog, the density rises from 0 to 1: its integral is half of the edge's width.
  scene.medium.extinction = static_cast<float>(2 * kEdgeDepth / (grid.edge / kUnitsPerMetre));
  scene.camera = view.camera;
  RenderScene lit;
  lightScene(view, Light::sun, lit);
  scene.fog_distance = lit.fog_distance;
  Result<VolumePicture> picture = renderer.render(scene);
  if (!picture) return picture.error();
  return std::move(picture->image);
}

}  // namespace

Gaze worldGaze(const RenderCamera& camera, Int3 origin) {
  Gaze gaze{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    gaze[0][i] = double{camera.position[axis]} + metres(origin[axis]);
    gaze[1][i] = double{camera.target[axis]} + metres(origin[axis]);
  }
  return gaze;
}

std::string gazeText(const Gaze& gaze) {
  const auto& [from, to] = gaze;
  return fmt::format("{:.4f},{:.4f},{:.4f}:{:.4f},{:.4f},{:.4f}", from[0], from[1], from[2], to[0], to[1], to[2]);
}

std::vector<glm::vec3> anchorsAt(const Region& region, std::string_view wanted) {
  std::vector<Int3> origins;
  for (const Anchor& anchor : region.anchors)
    if (isWanted(*region.program, anchor, wanted)) origins.push_back(anchor.frame.origin);
  const auto by_border = [&](Int3 at) { return isByBorder(region.meshed.extent, at); };
  if (!std::ranges::all_of(origins, by_border)) std::erase_if(origins, by_border);
  std::vector<glm::vec3> places;
  for (const Int3 at : origins)
    places.push_back(fromOrigin(region.meshed.mesh, {metres(at.x), metres(at.y), metres(at.z)}));
  return places;
}

PictureView pictureView(const RenderOptions& options) {
  const PictureSize size = *readSize(options.size);
  const auto [from, to] = *readCamera(options.camera);
  const double up = std::tan(glm::radians(options.fov) / 2), across = up * size.width / size.height;
  PictureView view;
  for (size_t axis = 0; axis < 3; ++axis) {
    view.position[axis] = from[axis] * kUnitsPerMetre;
    view.direction[axis] = to[axis] - from[axis];
  }
  view.half_angle = std::atan(std::hypot(up, across));
  view.cell_angle = *options.pixels * 2 * up / size.height;
  return view;
}

RegionPlan picturePlan(const RenderOptions& options, std::optional<RegionDensity>& density) {
  RegionPlan plan;
  if (options.pixels && !options.camera.empty()) plan.view = pictureView(options);
  plan.texture = options.uv;
  plan.blends = !options.uv;
  plan.keep_world = true;
  if (!options.frame.empty()) {
    planFrame(options, plan);
    return plan;
  }
  plan.choose = [&options](const WorldField& world) -> Result<IntBox> {
    if (!options.camera.empty()) return surroundingsOf((*readCamera(options.camera))[0]);
    return surroundings(world, options.at);
  };
  if (options.volume) {
    plan.check = checkDensity;
    plan.after = [&](const WorldField& world, Backend&, JobSystem& jobs, const Region& region) -> Result<void> {
      Result<RegionDensity> sampled = sampleRegion(world, jobs, region, region.level);
      if (!sampled) return sampled.error();
      density = std::move(*sampled);
      return {};
    };
  }
  return plan;
}

Result<RegionScene> sceneOf(const RenderOptions& options, const Region& region) {
  RegionScene drawn;
  addMesh(region, options.uv, drawn);
  Result<View> view = options.frame.empty() ? viewOf(options, region, drawn)
                                            : frameUse(options, region, drawn.vertices, drawn.indices, drawn.framed);
  if (!view) return view.error();
  drawn.view = std::move(*view);
  drawn.materials = renderMaterials(*region.program);
  if (options.wires) {
    addWires(region, drawn.view.camera, drawn);
    drawn.materials.assign(drawn.materials.size(), kUnderWires);
    drawn.materials.push_back(kWire);
  }
  if (!options.volume) {
    const std::optional<Light> wanted = lightNamed(options.light);
    if (!wanted) {
      const Result<Outlook> outlook = lookOutFor(region, drawn.view);
      if (!outlook) return outlook.error();
      if (!outlook->buried) drawn.daylight = outlook->daylight;
    }
    // For a camera inside solid rock, no daylight is measured: use the sun, which lights the mesh from outside.
    drawn.light = wanted ? *wanted : drawn.daylight ? lightAt(*drawn.daylight) : Light::sun;
  }
  drawn.scene.vertices = drawn.vertices;
  drawn.scene.indices = drawn.indices;
  drawn.scene.materials = drawn.materials;
  drawn.scene.origin = region.meshed.mesh.origin;
  // Lamps of the grammar replace the automatically placed lamps, and the headlamp becomes weaker.
  std::vector<RenderLamp> lamps = builtLamps(region, drawn.view.camera);
  const bool lit = !lamps.empty();
  if (lit) drawn.view.lamps = std::move(lamps);
  lightScene(drawn.view, drawn.light, drawn.scene);
  if (lit) drawn.scene.headlamp.reach *= 0.5f;
  return drawn;
}

Result<RegionPicture> drawRegion(const Renderer& renderer, const RenderOptions& options, const Region& region,
                                 const std::optional<RegionDensity>& density) {
  Result<RegionScene> drawn = sceneOf(options, region);
  if (!drawn) return drawn.error();
  Result<Image> image = density ? drawVolume(renderer, *density, region, drawn->view) : renderer.render(drawn->scene);
  if (!image) return image.error();
  return RegionPicture{std::move(*image), std::move(drawn->view), drawn->light, drawn->daylight,
                       std::move(drawn->framed)};
}

}  // namespace sgm::cli
