#include "tools/cli/fly/fly_pictures.h"

#include <glm/geometric.hpp>

#include "tools/flight/flight_engine.h"
#include "tools/flight/flight_picture.h"
#include "tools/support/ending_signals.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kFramesAPicture = 2;  // number of flight frames per video picture
constexpr uint64_t kFramesALook = 60;    // number of frames between two measurements of the light
// In metres. A longer movement between two frames counts as a teleport, because it never occurs in regular flight.
constexpr double kLeap = 20;

/// The world with its edits and animated parameters, in the form in which daylight is measured.
LitWorld litWorld(const FlownScene& scene) {
  sgm_domain_info domain = SGM_DOMAIN_INFO_INIT;
  sgm_grammar_domain(scene.grammar, &domain);
  LitWorld lit = LitWorld::of(domain.solid != 0, domain.infinite != 0 && domain.cut[1] != 0);
  for (uint32_t i = 0; i < sgm_grammar_material_count(scene.grammar); ++i)
    lit.translucent.push_back(domain.density != 0 || isTranslucent(sgm_grammar_material(scene.grammar, i)));
  lit.clearance_metres = 0.125;
  lit.cast = [world = scene.world](const Metres3& from, const Metres3& direction,
                                   double length) -> Result<std::optional<RayEnd>> {
    sgm_ray_desc ray = SGM_RAY_DESC_INIT;
    for (int axis = 0; axis < 3; ++axis) {
      ray.from[axis] = from[axis] * SGM_UNITS_PER_METRE;
      ray.direction[axis] = direction[axis];
    }
    ray.length = length;
    sgm_surface_point hit = SGM_SURFACE_POINT_INIT;
    sgm_error error = SGM_ERROR_INIT;
    if (sgm_world_ray_cast(world, &ray, &hit, &error) != SGM_OK) return errorOf(error);
    if (hit.found == 0) return std::optional<RayEnd>();
    return std::optional(
        RayEnd{hit.distance, {hit.normal[0], hit.normal[1], hit.normal[2]}, hit.material, hit.inside != 0});
  };
  return lit;
}

}  // namespace

bool FlyPictures::inSheet(uint64_t frame) const {
  const uint64_t wanted = options_.pictures;
  return sheet_ && (frame + 1) * wanted / options_.frames != frame * wanted / options_.frames;
}

bool FlyPictures::inVideo(uint64_t frame) const { return video_ != nullptr && frame % kFramesAPicture == 0; }

/// Measures the light at fixed frame numbers, so that a sheet and a video of the same flight have the same light.
Result<void> FlyPictures::look(const FlownScene& scene, uint64_t frame, const FlightPlace& place) {
  const bool leapt = last_ && glm::distance(last_->position, place.position) > kLeap;
  last_ = place;
  // Smooth the depth between measurements, so that the reach of the lamp and the haze change gradually.
  depth_ += (seen_depth_ - depth_) / static_cast<double>(kFramesALook);
  if (frame % kFramesALook != 0 && !leapt) return {};
  CameraPlace camera;
  camera.position = place.position;
  camera.direction = place.direction;
  const PictureRequest request;
  camera.fov_degrees = request.fov_degrees;
  camera.aspect = static_cast<double>(request.width) / request.height;
  LitWorld world = litWorld(scene);
  const std::optional<Light> wanted = lightNamed(options_.light);
  // Daylight need not be measured if an option fixes the light, or if the picture shows levels, which are drawn in even
  // light. If `roofless` is false, lookOut() does not measure it.
  if (wanted || options_.levels) world.roofless = false;
  const Result<Outlook> outlook = lookOut(world, camera);
  if (!outlook) return outlook.error();
  // Keep the previous light while the camera is inside rock.
  if (outlook->buried && frame > 0) return {};
  seen_depth_ = outlook->depth;
  if (leapt || frame == 0) depth_ = seen_depth_;
  light_ = wanted ? *wanted : steady_.next(outlook->daylight, leapt);
  return {};
}

Result<void> FlyPictures::begin() {
  if (options_.pictures > 0) {
    Result<FileWriter> sheet = FileWriter::create(options_.out, &unfinished_files);
    if (!sheet) return sheet.error();
    sheet_.emplace(std::move(*sheet));
  }
  if (!options_.video.empty()) {
    const PictureRequest request;
    const int rate = 60 / static_cast<int>(kFramesAPicture);
    Result<std::unique_ptr<VideoFile>> video =
        VideoFile::begin(options_.video, &unfinished_files, {request.width, request.height, rate});
    if (!video) return video.error();
    video_ = std::move(*video);
  }
  if (!sheet_ && !video_) return {};
  Result<Renderer> renderer = Renderer::create();
  if (!renderer) return renderer.error();
  renderer_.emplace(std::move(*renderer));
  return {};
}

bool FlyPictures::take(const FlownScene& scene, uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn) {
  if (!renderer_) return true;
  if (Result<void> looked = look(scene, frame, place); !looked) {
    error_ = looked.error();
    return false;
  }
  const bool in_sheet = inSheet(frame), in_video = inVideo(frame);
  if (!in_sheet && !in_video) return true;
  if (!options_.levels) ++(light_ == Light::sun ? lights_.sun : light_ == Light::lamp ? lights_.lamp : lights_.none);
  Result<Image> image = draw(scene.grammar, place, drawn);
  if (!image) {
    error_ = image.error();
    return false;
  }
  if (in_video) {
    if (Result<void> added = video_->add(*image); !added) {
      error_ = added.error();
      return false;
    }
  }
  if (in_sheet) images_.push_back(std::move(*image));
  return true;
}

Result<Image> FlyPictures::draw(const sgm_grammar* grammar, const FlightPlace& place, const DrawnMeshes& drawn) const {
  std::vector<PicturedChunk> chunks;
  for (const auto& [key, chunk] : drawn) {
    PicturedChunk& pictured = chunks.emplace_back();
    sgm_mesh_get_view(chunk.mesh.get(), &pictured.mesh, nullptr);
    pictured.seams = chunk.seams;
  }
  PictureRequest request;
  request.camera = place;
  request.light = light_;
  request.depth = depth_;
  request.levels = options_.levels;
  return drawChunks(*renderer_, grammar, chunks, request);
}

Result<void> FlyPictures::finish() {
  if (error_) return *error_;
  if (video_) {
    if (Result<void> done = video_->commit(); !done) return done;
  }
  return sheet_ ? writePng(contactSheet(images_, images_.size() > 1 ? 2 : 1), *sheet_) : Result<void>{};
}

}  // namespace sgm::cli
