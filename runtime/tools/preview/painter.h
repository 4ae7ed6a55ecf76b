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

/// A window's request. The file is read again if `edition` differs from the previous wish's.
struct Wish {
  cli::RenderOptions options;  ///< an empty camera: one is chosen; `out`, `frame`, `seeds`, `volume` are ignored
  uint64_t edition = 0;
};

/// The current result of a wish.
struct Painted {
  uint64_t wish = 0;                         ///< its number from Painter::wish()
  std::shared_ptr<const Program> program;    ///< of the grammar; while the text is wrong, the last correct one
  std::vector<std::filesystem::path> files;  ///< of the grammar; empty if it was not read again
  bool text_is_wrong = false;
  std::string messages;                       ///< lines of text; empty: no problems
  std::shared_ptr<const cli::Region> region;  ///< shown in the picture; null: the previous picture stays
  std::string box;                            ///< of the picture, as for --region, without the draft's coarse chunks
  double cell = 0;                            ///< of the picture, metres; a draft's are larger
  Image image;
  View view;
  Light light = Light::sun;
  bool draft = false;  ///< a better picture of the same wish will follow
  double seconds = 0;  ///< since the start of work on the wish
};

/// Paints the newest wish: first a draft with coarse cells in plain colours, then the picture as in `sgm render`. A
/// newer wish cancels the work on an older one. All functions must be called from one thread.
class Painter {
 public:
  /// Errors: those of Renderer::create; limit if no thread can be started.
  static Result<std::unique_ptr<Painter>> create();
  ~Painter();

  /// Returns the wish's number, from 1.
  uint64_t wish(Wish wish);
  /// The newest result that has not been taken.
  std::optional<Painted> take();

 private:
  struct Worker;

  Painter() = default;
  void run();
  void publish(Painted painted);
  bool isNewest(uint64_t number) const { return wished_ == number && !ending_; }

  std::unique_ptr<Worker> worker_;  ///< the thread's own
  std::mutex mutex_;                ///< guards wish_ and result_
  std::condition_variable changed_;
  Wish wish_;
  std::optional<Painted> result_;
  std::atomic<uint64_t> wished_ = 0;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace sgm::preview
