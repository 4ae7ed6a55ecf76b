#pragma once
// A thread that keeps a picture of a grammar up to date.

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

/// A request for a picture. The grammar file is read again if `edition` differs from that of the previous request.
struct DrawRequest {
  /// Options of the picture. If `camera` is empty, the painter chooses a camera; `out`, `frame`, `seeds`, `volume` are
  /// ignored.
  cli::RenderOptions options;
  uint64_t edition = 0;
};

/// A result for a request: a picture, or only messages.
struct Painted {
  uint64_t request = 0;  ///< number of the request, as Painter::request() returned it
  /// The compiled grammar. While the text has errors, this is the last correct program.
  std::shared_ptr<const Program> program;
  std::vector<std::filesystem::path> files;  ///< files of the grammar; empty if they were not read again
  bool text_is_wrong = false;
  std::string messages;  ///< messages for the user, one per line; empty: no problems
  /// The meshed region in the picture; null: there is no new picture, and the previous one stays valid.
  std::shared_ptr<const cli::Region> region;
  /// The region in the picture, as a value for the option --region. In a draft, the coarse chunks extend beyond this
  /// region.
  std::string box;
  double cell = 0;  ///< edge of a grid cell in the picture, metres; larger in a draft
  Image image;
  View view;
  Light light = Light::sun;
  bool draft = false;  ///< true if a better picture for the same request will follow
  double seconds = 0;  ///< seconds since the painter began to process the request
};

/// Processes the newest request: draws first a draft with coarse cells in plain colours, then the same picture as `sgm
/// render`. A newer request cancels the current one. All functions must be called from the same thread.
class Painter {
 public:
  /// Starts the painting thread. Errors: those of Renderer::create; limit if no thread can be started.
  static Result<std::unique_ptr<Painter>> create();
  ~Painter();

  /// Requests a picture, and returns the number of the request, counted from 1.
  uint64_t request(DrawRequest request);
  /// Returns the newest result; nullopt if an earlier call has already returned it, or if there is none.
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
