#pragma once
// Runs `sgm preview` from opening the window until it is closed.

#include <future>
#include <optional>
#include <string>

#include "tools/preview/controls.h"
#include "tools/preview/file_watch.h"
#include "tools/preview/free_camera.h"
#include "tools/preview/painter.h"
#include "tools/preview/pointed_place.h"
#include "tools/preview/window.h"
#include "tools/support/render_options.h"

namespace sgm::preview {

/// Connects file watch, controls, camera, painter and window. Prints the results that the user requests by key or
/// click; with --json, also prints a line for each picture and message, so that other programs can follow.
class Session {
 public:
  Session(const cli::RenderOptions& options, Painter& painter, Window& window);

  /// Runs the event loop; returns when the window is closed. Errors: those of the window.
  Result<void> run();

 private:
  using Clock = std::chrono::steady_clock;
  using Pointed = Result<std::optional<PointedPlace>>;

  cli::RenderOptions requestedOptions() const;
  void ask();
  Result<void> takeResult();
  void steer();
  void point();
  void drawPlace();
  void say(const PointedPlace& place) const;
  void sayCommand() const;
  void sayPicture(const Painted& painted) const;

  const cli::RenderOptions options_;
  Painter& painter_;
  Window& window_;
  Controls controls_;
  FileWatch files_;
  uint64_t edition_ = 1;
  uint64_t requested_ = 0;
  /// The camera that the user moves; nullopt while the picture shows the initial view.
  std::optional<FreeCamera> camera_;
  Painted last_;  ///< the painter's result that is shown at present
  bool at_work_ = false;
  Clock::time_point frame_at_ = Clock::now();

  std::future<Pointed> pointing_;  ///< pending query for the place under the pointer
  std::optional<PointedPlace> place_;
  std::string place_error_;
  bool place_is_known_ = false, clicked_ = false;
  Clock::time_point pointer_rests_ = Clock::now();
};

}  // namespace sgm::preview
