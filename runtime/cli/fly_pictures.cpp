#include "cli/fly_pictures.h"

#include "cli/flight_picture.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kFramesAPicture = 2;  // of the video

}  // namespace

Result<void> FlyPictures::begin() {
  if (options_.pictures > 0) {
    Result<FileWriter> sheet = FileWriter::create(options_.out, &unfinished_files);
    if (!sheet) return sheet.error();
    sheet_.emplace(std::move(*sheet));
  }
  if (!options_.video.empty()) {
    const PictureWish wish;
    const int rate = 60 / static_cast<int>(kFramesAPicture);
    Result<std::unique_ptr<VideoFile>> video =
        VideoFile::begin(options_.video, &unfinished_files, {wish.width, wish.height, rate});
    if (!video) return video.error();
    video_ = std::move(*video);
  }
  if (!sheet_ && !video_) return {};
  Result<Renderer> renderer = Renderer::create();
  if (!renderer) return renderer.error();
  renderer_.emplace(std::move(*renderer));
  return {};
}

bool FlyPictures::take(const sgm_grammar* grammar, uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn) {
  const uint64_t wanted = options_.pictures;
  const bool in_sheet = sheet_ && (frame + 1) * wanted / options_.frames != frame * wanted / options_.frames;
  const bool in_video = video_ != nullptr && frame % kFramesAPicture == 0;
  if (!in_sheet && !in_video) return true;
  Result<Image> image = draw(grammar, place, drawn);
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
  PictureWish wish;
  wish.camera = place;
  wish.levels = options_.levels;
  return drawChunks(*renderer_, grammar, chunks, wish);
}

Result<void> FlyPictures::finish() {
  if (error_) return *error_;
  if (video_) {
    if (Result<void> done = video_->commit(); !done) return done;
  }
  return sheet_ ? writePng(contactSheet(images_, images_.size() > 1 ? 2 : 1), *sheet_) : Result<void>{};
}

}  // namespace sgm::cli
