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

/// What a window asks for. The file is read again where `edition` differs from that of the wish before.
struct Wish {
  cli::RenderOptions options;  ///< an empty camera: one is found; `out`, `frame`, `seeds`, `volume` are not looked at
  uint64_t edition = 0;
};

/// What has become of a wish, so far.
struct Painted {
  uint64_t wish = 0;                         ///< as Painter::wish() counts them
  std::shared_ptr<const Program> program;    ///< of the grammar; the last one that was right where the text is wrong
  std::vector<std::filesystem::path> files;  ///< that the grammar is made of; empty where it was not read anew
  bool text_is_wrong = false;
  std::string messages;                       ///< lines for people; empty: all is well
  std::shared_ptr<const cli::Region> region;  ///< that the picture shows; null: the picture before stays
  std::string box;                            ///< of the picture, as --region takes it, not of a draft's coarse chunks
  double cell = 0;                            ///< of the picture, metres; a draft has larger ones
  Image image;
  View view;
  Light light = Light::sun;
  bool draft = false;  ///< a better picture of the same wish follows
  double seconds = 0;  ///< since work on the wish began
};

/// Takes wishes and paints the newest: first a draft of coarse cells in plain colours, then the picture as `sgm render`
/// draws it. A newer wish stops the work on an older one. All functions may be called from one thread.
class Painter {
 public:
  /// Errors: those of Renderer::create; limit, if no thread can be started.
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
