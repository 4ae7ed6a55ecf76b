#pragma once
// The contact sheet and the video of `sgm fly`.

#include <sgm/sgm.h>

#include <memory>
#include <optional>
#include <vector>

#include "tools/cli/fly/commands.h"
#include "tools/flight/daylight.h"
#include "tools/flight/flight.h"
#include "tools/render/renderer.h"
#include "tools/render/video_file.h"

namespace sgm::cli {

/// The grammar and the streamed world that the flight draws.
struct FlownScene {
  const sgm_grammar* grammar = nullptr;
  sgm_world* world = nullptr;
};

/// Numbers of pictures drawn with each kind of light.
struct PictureLights {
  uint64_t sun = 0, lamp = 0, none = 0;
};

/// Draws pictures of a flight: evenly spaced frames for the contact sheet, and every second frame for the video.
class FlyPictures {
 public:
  explicit FlyPictures(const FlyOptions& options) : options_(options) {}

  /// Opens the output files, the device and the video encoder, so that their errors appear before the long flight.
  Result<void> begin();
  /// Whether the sheet or the video contains this frame.
  bool wants(uint64_t frame) const { return inSheet(frame) || inVideo(frame); }
  /// Draws the frame if it is wanted; must be called for every frame. Returns false if the frame cannot be drawn or
  /// written; finish() then returns the error.
  bool take(const FlownScene& scene, uint64_t frame, const FlightPlace& place, const DrawnMeshes& drawn);
  Result<void> finish();
  const PictureLights& lights() const { return lights_; }

 private:
  bool inSheet(uint64_t frame) const;
  bool inVideo(uint64_t frame) const;
  Result<void> look(const FlownScene& scene, uint64_t frame, const FlightPlace& place);
  Result<Image> draw(const sgm_grammar* grammar, const FlightPlace& place, const DrawnMeshes& drawn) const;

  const FlyOptions& options_;
  std::optional<Renderer> renderer_;
  std::optional<FileWriter> sheet_;
  std::unique_ptr<VideoFile> video_;
  std::vector<Image> images_;
  Light light_ = Light::sun;  ///< light of the current picture
  SteadyLight steady_;
  /// Typical distance to visible surfaces, metres: at the last measurement, and smoothed over frames for drawing.
  double seen_depth_ = 1, depth_ = 1;
  std::optional<FlightPlace> last_;
  PictureLights lights_;
  std::optional<Error> error_;
};

}  // namespace sgm::cli
