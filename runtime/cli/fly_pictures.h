#pragma once
// The sheet and the video of `sgm fly`.

#include <sgm/sgm.h>

#include <memory>
#include <optional>
#include <vector>

#include "cli/commands.h"
#include "cli/flight.h"
#include "cli/video_file.h"
#include "render/renderer.h"

namespace sgm::cli {

/// Draws evenly spaced frames for the sheet, and every second frame for the video.
class FlyPictures {
 public:
  explicit FlyPictures(const FlyOptions& options) : options_(options) {}

  /// Opens the files, the device and the encoder that are asked for: a flight may take long, and be for nothing.
  Result<void> begin();
  /// False where that cannot be drawn or written; finish() says why.
  bool take(const sgm_grammar* grammar, uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn);
  Result<void> finish();

 private:
  Result<Image> draw(const sgm_grammar* grammar, const FlightPlace& place, const DrawnMeshes& drawn) const;

  const FlyOptions& options_;
  std::optional<Renderer> renderer_;
  std::optional<FileWriter> sheet_;
  std::unique_ptr<VideoFile> video_;
  std::vector<Image> images_;
  std::optional<Error> error_;
};

}  // namespace sgm::cli
