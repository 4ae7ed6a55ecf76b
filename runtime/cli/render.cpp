// sgm render: a picture of a region of a grammar's world.

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/materials.h"
#include "cli/region.h"
#include "mesh/vertex.h"
#include "render/camera.h"
#include "render/renderer.h"

namespace sgm::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int64_t kAroundUnits = int64_t{48} * kUnitsPerMetre;

struct RenderOptions : WorldOptions {
  std::string out;
  std::string camera;
  std::string at;
  std::string size = "1280x720";
  double fov = 68;
};

struct Size {
  int width = 0, height = 0;
};

std::optional<Size> readSize(std::string_view text) {
  Size size;
  const char* end = text.data() + text.size();
  const auto [x, bad_width] = std::from_chars(text.data(), end, size.width);
  if (bad_width != std::errc() || x == end || *x != 'x') return std::nullopt;
  const auto [rest, bad_height] = std::from_chars(x + 1, end, size.height);
  if (bad_height != std::errc() || rest != end) return std::nullopt;
  const auto fits = [](int pixels) { return pixels >= 1 && pixels <= kMaxPicture; };
  if (!fits(size.width) || !fits(size.height)) return std::nullopt;
  return size;
}

std::string checkSize(const std::string& text) {
  if (readSize(text)) return {};
  return fmt::format("'{}' is not WIDTHxHEIGHT with 1 to {} pixels each", text, kMaxPicture);
}

/// From where and to where, in metres; nothing where the text is no such pair.
using Gaze = std::array<std::array<double, 3>, 2>;
std::optional<Gaze> readCamera(std::string_view text) {
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::optional<std::array<double, 3>> from = readPoint(text.substr(0, colon)),
                                             to = readPoint(text.substr(colon + 1));
  if (!from || !to) return std::nullopt;
  for (const double x : {(*from)[0], (*from)[1], (*from)[2], (*to)[0], (*to)[1], (*to)[2]})
    if (!(std::fabs(x) < 2.2e6)) return std::nullopt;
  return Gaze{*from, *to};
}

std::string checkCamera(const std::string& text) {
  if (readCamera(text)) return {};
  return fmt::format("'{}' is not x,y,z:x,y,z in metres (from where, and to where)", text);
}

std::string checkPng(const std::string& out) {
  const std::string extension = std::filesystem::path(out).extension().string();
  return CLI::detail::to_lower(extension) == ".png" ? std::string() : "pictures are .png files";
}

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

glm::vec3 fromOrigin(const WorldMesh& mesh, const std::array<double, 3>& world) {
  glm::vec3 point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] =
        static_cast<float>(world[static_cast<size_t>(axis)] - static_cast<double>(mesh.origin[axis]) / kUnitsPerMetre);
  return point;
}

/// Whether an anchor's name, kind or tag is the one asked for; none asked for is any.
bool isWanted(const Program& program, const Anchor& anchor, std::string_view wanted) {
  const std::string_view name = program.names[anchor.name], kind = program.names[anchor.kind];
  const std::string_view tag = program.tags[anchor.tag];
  return wanted.empty() || name == wanted || kind == wanted || tag == wanted;
}

std::vector<glm::vec3> anchorsAt(const Region& region, std::string_view wanted) {
  std::vector<glm::vec3> places;
  for (const Anchor& anchor : region.anchors) {
    if (!isWanted(*region.program, anchor, wanted)) continue;
    std::array<double, 3> world{};
    for (int axis = 0; axis < 3; ++axis)
      world[static_cast<size_t>(axis)] = static_cast<double>(anchor.frame.origin[axis]) / kUnitsPerMetre;
    places.push_back(fromOrigin(region.meshed.mesh, world));
  }
  return places;
}

/// The view that the options ask for, or the one that finds itself.
Result<View> viewOf(const RenderOptions& options, const Region& region, std::span<const RenderVertex> vertices) {
  const Size size = *readSize(options.size);
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
    return viewFrom(vertices, region.meshed.mesh.indices, camera);
  }
  const std::vector<glm::vec3> anchors = anchorsAt(region, options.at);
  if (!options.at.empty() && anchors.empty())
    return Error{Code::invalid_argument,
                 fmt::format("--at: the region has no anchor of the name, kind or tag '{}'", options.at)};
  CameraWish wish;
  wish.width = size.width;
  wish.height = size.height;
  wish.fov_degrees = static_cast<float>(options.fov);
  wish.anchors = anchors;
  wish.airborne = region.program->domain.density;
  return chooseCamera(vertices, region.meshed.mesh.indices, wish);
}

Json metres(const WorldMesh& mesh, const glm::vec3& point) {
  Json json = Json::array();
  for (int axis = 0; axis < 3; ++axis)
    json.push_back(static_cast<double>(point[axis]) + static_cast<double>(mesh.origin[axis]) / kUnitsPerMetre);
  return json;
}

IntBox around(const std::array<int64_t, 3>& centre) {
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = saturate(centre[static_cast<size_t>(axis)] - kAroundUnits);
    box.hi[axis] = saturate(centre[static_cast<size_t>(axis)] + kAroundUnits);
  }
  return box;
}

/// What is drawn of an endless world without --region: what lies around the camera, else around the anchor asked for
/// (any, where none is) that is nearest to the world's origin, else around the origin.
Result<IntBox> surroundings(const RenderOptions& options, const WorldField& world) {
  std::array<int64_t, 3> centre{};
  if (!options.camera.empty()) {
    const std::array<double, 3> from = (*readCamera(options.camera))[0];
    for (size_t axis = 0; axis < 3; ++axis) centre[axis] = static_cast<int64_t>(from[axis] * kUnitsPerMetre);
    return around(centre);
  }
  for (const int32_t metres : {128, 256, 512}) {
    const int32_t units = metres * kUnitsPerMetre;
    const Result<std::vector<Anchor>> anchors = world.anchors({{-units, -units, -units}, {units, units, units}});
    if (!anchors) return anchors.error();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Anchor& anchor : *anchors) {
      if (!isWanted(*world.settings().program, anchor, options.at)) continue;
      const Int3 p = anchor.frame.origin;
      const double distance = 1.0 * p.x * p.x + 1.0 * p.y * p.y + 1.0 * p.z * p.z;
      if (distance >= nearest) continue;
      nearest = distance;
      centre = {p.x, p.y, p.z};
    }
    if (std::isfinite(nearest)) break;
  }
  return around(centre);
}

Exit render(const RenderOptions& options) {
  // The device first: meshing may take long, and be for nothing.
  const Result<Renderer> renderer = Renderer::create();
  if (!renderer) return complain(renderer.error());
  const RegionResult made = meshRegion(options, [&](const WorldField& world) { return surroundings(options, world); });
  if (!made.region) return made.status;
  const Region& region = *made.region;
  if (region.meshed.mesh.indices.empty()) return complain(Exit::input, "there is no surface in the region to draw");

  const Stopwatch watch;
  const std::vector<RenderVertex> vertices = drawable(region.meshed.mesh);
  const Result<View> view = viewOf(options, region, vertices);
  if (!view) return complain(view.error());
  const std::vector<RenderMaterial> materials = renderMaterials(*region.program);
  RenderScene scene;
  scene.vertices = vertices;
  scene.indices = region.meshed.mesh.indices;
  scene.materials = materials;
  scene.origin = region.meshed.mesh.origin;
  lightScene(*view, scene);
  const Result<Image> image = renderer->render(scene);
  if (!image) return complain(image.error());
  if (Result<void> ok = writePng(options.out, *image); !ok) return complain(ok.error());

  const RenderCamera& camera = view->camera;
  const size_t triangles = region.meshed.mesh.indices.size() / 3;
  if (options.json) {
    const Json json{{"out", options.out},
                    {"width", image->width},
                    {"height", image->height},
                    {"triangles", triangles},
                    {"seconds", region.seconds},
                    {"draw_seconds", watch.seconds()},
                    {"hash", fmt::format("{:016x}", region.meshed.hash.value())},
                    {"device", renderer->info().name},
                    {"camera",
                     {{"position", metres(region.meshed.mesh, camera.position)},
                      {"target", metres(region.meshed.mesh, camera.target)},
                      {"fov", camera.fov_degrees},
                      {"enclosed", view->enclosed}}}};
    fmt::print("{}\n", json.dump(2));
  } else {
    const Json position = metres(region.meshed.mesh, camera.position);
    fmt::print("{}: {}x{} pixels, {} triangles meshed in {:.2f} s, drawn in {:.2f} s on {}\n", options.out,
               image->width, image->height, triangles, region.seconds, watch.seconds(), renderer->info().name);
    fmt::print("  camera   at {:.1f},{:.1f},{:.1f} m{}\n", position[0].get<double>(), position[1].get<double>(),
               position[2].get<double>(), view->enclosed ? ", inside" : "");
  }
  return Exit::done;
}

}  // namespace

Command addRender(CLI::App& root) {
  CLI::App* app = root.add_subcommand("render", "Draw a picture of a region, off-screen");
  const auto options = std::make_shared<RenderOptions>();
  addWorldOptions(*app, *options);
  addRegionOptions(*app, *options);
  app->add_option("--out", options->out, "Picture to write, a .png file")->required()->check(checkPng);
  CLI::Option* camera =
      app->add_option("--camera", options->camera,
                      "From where to where to look in metres, x,y,z:x,y,z; without it, a view is chosen")
          ->type_name("VIEW")
          ->check(checkCamera);
  app->add_option("--at", options->at, "Look from an anchor of this name, kind or tag")
      ->type_name("ANCHOR")
      ->excludes(camera);
  app->add_option("--size", options->size, "Pixels, WIDTHxHEIGHT")->check(checkSize)->capture_default_str();
  app->add_option("--fov", options->fov, "Angle across the picture's height, in degrees")
      ->check(CLI::Range(1.0, 150.0))
      ->capture_default_str();
  app->footer("Example:\n  sgm render samples/grammars/cave.sgm --out cave.png --at spawn --seed 7");
  return [options] { return render(*options); };
}

}  // namespace sgm::cli
