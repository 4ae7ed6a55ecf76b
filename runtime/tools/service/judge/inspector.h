#pragma once
// Whether an upload is a mesh, and how good it is, found out in a limited process of its own: `sgm inspect`. Whatever a
// crafted file does there, the service lives.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "tools/service/judge/upload.h"

namespace sgm::service {

struct InspectorSettings {
  std::string program;                  ///< path of the command `sgm`; empty: nothing can be inspected
  std::string masters;                  ///< a base of masters; empty: those that are built in
  unsigned jobs = 2;                    ///< processes at one time, 1 to 64
  unsigned waiting = 16;                ///< uploads that may wait beside them, at most 4096
  uint64_t memory = uint64_t{2} << 30;  ///< bytes of address space a process
  std::chrono::seconds time{60};        ///< of the clock, and of processor time, a process
};

/// What a process has said.
struct Inspection {
  int status = 200;     ///< 200: it was read; else what an HTTP answer has: 422, 500; 503 where it was not tried
  std::string json;     ///< a sound object: of 200 a report's members ("valid", "measures", ...), else a problem;
                        ///< empty where no memory was left for that
  std::string preview;  ///< the mesh for the page's view; empty: none
  bool valid = false;   ///< what the report's "valid" says
};

struct InspectorCounts {
  unsigned running = 0, waiting = 0;                         ///< now
  uint64_t valid = 0, invalid = 0, refused = 0, failed = 0;  ///< since creation: refused 422, failed 500
  /// How many took up to 2^(i - 8) s, that is 4 ms to 128 s: each is in all bounds that it kept within, and longer ones
  /// are nowhere. All that are counted above are counted or summed here.
  std::array<uint64_t, 16> seconds{};
  double seconds_sum = 0;
};

/// Any thread.
class Inspector {
 public:
  /// Errors: io where no thread can be started; invalid_argument for numbers out of range.
  static Result<std::unique_ptr<Inspector>> create(const InspectorSettings& settings);
  /// Ends the processes that run; those who wait are told a status of 503.
  virtual ~Inspector() = default;

  /// Whether an upload would be taken now. Errors: unsupported where there is no program that runs; limit where the
  /// queue is full.
  virtual Result<void> wouldTake() const = 0;
  /// Queues it. began and done are called on a thread of the inspector's, once each, in that order; of an upload that
  /// still waits when the inspector ends, done alone; what they throw is passed over. Errors: as wouldTake(), and limit
  /// where no memory is left; then neither is called.
  virtual Result<void> inspect(Upload upload, std::function<void()> began, std::function<void(Inspection)> done) = 0;
  /// The masters as JSON (GET /api/v1/masters), or after they were replaced by this JSON (PUT), by a process too;
  /// status and json as Inspection has them (409 where there is no base to write). Beside the queue, one at a time, on
  /// a thread of the inspector's; but a status of 503 comes at once where too many wait.
  virtual void readMasters(std::function<void(Inspection)> done) = 0;
  virtual void writeMasters(std::string json, std::function<void(Inspection)> done) = 0;
  virtual InspectorCounts counts() const = 0;
};

}  // namespace sgm::service
