#pragma once
// The thread that keeps a picture of a grammar up to date.

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tools/support/region.h"
#include "tools/support/region_picture.h"
#include "tools/support/render_options.h"

namespace sgm::preview {

/// A request for a picture. The grammar file is read again if `edition` differs from the previous request's.
struct DrawRequest {
  /// If the camera is empty, the painter chooses one; `out`, `frame`, `seeds`, `volume` are ignored.
  cli::RenderOptions options;
  uint64_t edition = 0;
};

/// The current result of a request.
struct Painted {
  uint64_t request = 0;  ///< the request's number, as Painter::wish() returned it
  /// The compiled grammar; while the text has errors, the last correct program.
  std::shared_ptr<const Program> program;
  std::vector<std::filesystem::path> files;  ///< files that the grammar consists of; empty if they were not read again
  bool text_is_wrong = false;
  std::string messages;  ///< messages for the user, one on each line; empty: no problems
  /// The meshed region in the picture; null: the previous picture stays valid.
  std::shared_ptr<const cli::Region> region;
  std::string box;  ///< region in the picture, as for --region, without the margin that a draft's coarse chunks add
  double cell = 0;  ///< edge of the picture's grid cells, metres; larger in a draft
  Image image;
  View view;
  Light light = Light::sun;
  bool draft = false;  ///< a better picture of the same request will follow
  double seconds = 0;  ///< since the painter began to work on the request
};

/// Paints the newest request: first a draft with coarse cells in plain colours, then the same picture as `sgm render`.
/// A newer request cancels the work on an older one. All functions must be called from one thread.
class Painter {
 public:
  /// Errors: those of Renderer::create; limit if no thread can be started.
  static Result<std::unique_ptr<Painter>> create();
  ~Painter();

  /// Requests a picture. Returns the request's number, counted from 1.
  uint64_t request(DrawRequest request);
  /// Returns the newest result that no call has returned yet; nullopt if there is none.
  std::optional<Painted> take();

 private:
  struct Worker;

  Painter() = default;
  void run();
  void publish(Painted painted);
  bool isNewest(uint64_t number) const { return requested_ == number && !ending_; }

  std::unique_ptr<Worker> worker_;  ///< state that only the painting thread uses
  std::mutex mutex_;                ///< protects request_ and result_
  std::condition_variable changed_;
  DrawRequest request_;
  std::optional<Painted> result_;
  std::atomic<uint64_t> requested_ = 0;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace sgm::preview
