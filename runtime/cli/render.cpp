// sgm render: a picture of a region of a grammar's world.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/commands.h"
#include "cli/json.h"
#include "cli/materials.h"
#include "cli/region_density.h"
#include "cli/surroundings.h"
#include "grammar/sink.h"
#include "mesh/vertex.h"
#include "render/camera.h"
#include "render/renderer.h"

namespace sgm::cli {
namespace {

/// Drawable vertices. The renderer counts from the mesh's origin, as the mesh does.
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

/// A mesh as it is drawn: where charts or pairs of materials meet a vertex comes several times.
struct Drawable {
  std::vector<RenderVertex> vertices;
  std::span<const uint32_t> indices;
};

Drawable drawable(const Region& region, bool uv) {
  const std::vector<RenderVertex> vertices = drawable(region.meshed.mesh);
  Drawable drawn{{}, region.texture->unwrapped.corners};
  for (const Wedge& wedge : region.texture->unwrapped.wedges) {
    RenderVertex& vertex = drawn.vertices.emplace_back(vertices[wedge.vertex]);
    vertex.material = wedge.materials[0];
    vertex.second = wedge.materials[1];
    vertex.share = static_cast<float>(wedge.share) / 255.0f;
    if (uv) vertex.texture = {wedge.u, wedge.v};
  }
  return drawn;
}

glm::vec3 fromOrigin(const WorldMesh& mesh, const std::array<double, 3>& world) {
  glm::vec3 point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] =
        static_cast<float>(world[static_cast<size_t>(axis)] - static_cast<double>(mesh.origin[axis]) / kUnitsPerMetre);
  return point;
}

/// Whether a place stands where the region's border hides what is around it.
bool isByBorder(const IntBox& extent, Int3 place) {
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t margin = (int64_t{extent.hi[axis]} - extent.lo[axis]) / 8;
    if (place[axis] < extent.lo[axis] + margin || place[axis] > extent.hi[axis] - margin) return true;
  }
  return false;
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

/// What to say where the region has no such anchor.
std::string noAnchor(const Region& region, const std::string& wanted) {
  const Program& program = *region.program;
  Suggestion suggestion(wanted);
  std::set<std::string> known;
  for (const Anchor& anchor : region.anchors)
    for (const auto& name : {program.names[anchor.name], program.names[anchor.kind], program.tags[anchor.tag]})
      if (!name.empty()) known.emplace(name);
  for (const std::string& name : known) suggestion.offer(name);
  const std::string hint = known.empty()               ? "it has no anchor at all"
                           : suggestion.best().empty() ? fmt::format("it has {}", fmt::join(known, ", "))
                                                       : fmt::format("did you mean '{}'?", suggestion.best());
  return fmt::format("--at: the region has no anchor of the name, kind or tag '{}'; {}", wanted, hint);
}

/// The view that the options ask for, or the one that finds itself.
Result<View> viewOf(const RenderOptions& options, const Region& region, const Drawable& drawn) {
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
      return Error{Code::invalid_argument, "--camera looks from a point to the same point"};
    return viewFrom(drawn.vertices, drawn.indices, camera);
  }
  const std::vector<glm::vec3> anchors = anchorsAt(region, options.at);
  CameraWish wish;
  wish.width = size.width;
  wish.height = size.height;
  wish.fov_degrees = static_cast<float>(options.fov);
  wish.anchors = anchors;
  wish.airborne = region.program->domain.density;
  return chooseCamera(drawn.vertices, drawn.indices, wish);
}

/// In metres of the world.
std::array<double, 3> worldPoint(const WorldMesh& mesh, const glm::vec3& point) {
  std::array<double, 3> world{};
  for (int axis = 0; axis < 3; ++axis)
    world[static_cast<size_t>(axis)] =
        static_cast<double>(point[axis]) + static_cast<double>(mesh.origin[axis]) / kUnitsPerMetre;
  return world;
}

Result<Image> drawMesh(const Renderer& renderer, const Drawable& drawn, const Region& region, const View& view) {
  const std::vector<RenderMaterial> materials = renderMaterials(*region.program);
  RenderScene scene;
  scene.vertices = drawn.vertices;
  scene.indices = drawn.indices;
  scene.materials = materials;
  scene.origin = region.meshed.mesh.origin;
  lightScene(view, scene);
  return renderer.render(scene);
}

Result<Image> drawVolume(const Renderer& renderer, const RegionDensity& density, const Region& region,
                         const View& view) {
  // A third of the light gets through an edge on the shortest way: whatever its size, it looks soft.
  constexpr double kEdgeDepth = 1.1;
  const DensityGrid& grid = density.grid;
  VolumeScene scene;
  scene.density = density.values;
  for (int axis = 0; axis < 3; ++axis) {
    scene.size[axis] = grid.size[static_cast<size_t>(axis)];
    scene.corner[axis] = static_cast<float>(metres(grid.origin[axis]) - metres(region.meshed.mesh.origin[axis]));
  }
  scene.spacing = static_cast<float>(metres(grid.spacing));
  // Over its edge density adds up to half the edge's width.
  scene.medium.extinction = static_cast<float>(2 * kEdgeDepth / (grid.edge / kUnitsPerMetre));
  scene.camera = view.camera;
  const std::array<RenderMaterial, 1> vapour{materialByName("cloud")};
  RenderScene lit;
  lit.materials = vapour;
  lightScene(view, lit);
  scene.fog_distance = lit.fog_distance;
  Result<VolumePicture> picture = renderer.render(scene);
  if (!picture) return picture.error();
  return std::move(picture->image);
}

}  // namespace

Exit render(const RenderOptions& options) {
  // The device and the file first: meshing may take long, and be for nothing.
  const Result<Renderer> renderer = Renderer::create();
  if (!renderer) return complain(renderer.error());
  Result<FileWriter> file = FileWriter::create(options.out, &unfinished_files);
  if (!file) return complain(file.error());
  RegionPlan plan;
  plan.texture = true;
  plan.choose = [&](const WorldField& world) -> Result<IntBox> {
    if (!options.camera.empty()) return surroundingsOf((*readCamera(options.camera))[0]);
    return surroundings(world, options.at);
  };
  std::optional<RegionDensity> density;
  if (options.volume) {
    plan.check = checkDensity;
    plan.after = [&](const WorldField& world, Backend&, JobSystem& jobs, const Region& region) -> Result<void> {
      Result<RegionDensity> sampled = sampleRegion(world, jobs, region, options.level);
      if (!sampled) return sampled.error();
      density = std::move(*sampled);
      return {};
    };
  }
  const RegionResult made = meshRegion(options, plan);
  if (!made.region) return made.status;
  const Region& region = *made.region;
  if (!options.at.empty() && anchorsAt(region, options.at).empty())
    return complain(Exit::input, noAnchor(region, options.at));
  if (region.meshed.mesh.indices.empty())
    return complain(Exit::input, "there is no surface to draw: " + region.empty_because);

  const Stopwatch watch;
  const Drawable drawn = drawable(region, options.uv);
  const Result<View> view = viewOf(options, region, drawn);
  if (!view) return complain(view.error());
  const Result<Image> image =
      density ? drawVolume(*renderer, *density, region, *view) : drawMesh(*renderer, drawn, region, *view);
  if (!image) return complain(image.error());
  if (Result<void> ok = writePng(*image, *file); !ok) return complain(ok.error());

  const RenderCamera& camera = view->camera;
  const std::array<double, 3> position = worldPoint(region.meshed.mesh, camera.position),
                              target = worldPoint(region.meshed.mesh, camera.target);
  if (options.json) {
    Json json{{"out", options.out}, {"width", image->width}, {"height", image->height}};
    json.update(toJson(options, region));
    if (density) json["volume"] = toJson(*density);
    json.update({{"draw_seconds", watch.seconds()},
                 {"device", renderer->info().name},
                 {"camera",
                  {{"position", {position[0], position[1], position[2]}},
                   {"target", {target[0], target[1], target[2]}},
                   {"fov", camera.fov_degrees},
                   {"enclosed", view->enclosed}}}});
    fmt::print("{}\n", json.text());
  } else {
    fmt::print("{}: {}x{} pixels, {} triangles meshed in {:.2f} s, drawn in {:.2f} s on {}\n", options.out,
               image->width, image->height, region.meshed.mesh.indices.size() / 3, region.seconds, watch.seconds(),
               renderer->info().name);
    if (density)
      fmt::print("  density  at {} points in {:.2f} s, {} of {} bricks proven to be clear or full\n",
                 density->values.size(), density->seconds, density->figures.uniform, density->figures.bricks);
    if (isCut(region)) fmt::print("  border   cuts the surface, which goes on: --region takes more of it, or less\n");
    fmt::print("  camera   at {:.1f},{:.1f},{:.1f} m{}\n", position[0], position[1], position[2],
               view->enclosed ? ", inside" : "");
  }
  return Exit::done;
}

}  // namespace sgm::cli
