#pragma once
// Measures and classifies uploads in a sandboxed process, `sgm inspect`: a crafted file cannot crash the service.

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
  std::string program;                  ///< path of the command `sgm`; empty: no inspection
  std::string masters;                  ///< a base; empty: the built-in reference histograms
  unsigned jobs = 2;                    ///< concurrent processes, 1 to 64
  unsigned waiting = 16;                ///< maximum of waiting uploads, at most 4096
  uint64_t memory = uint64_t{2} << 30;  ///< bytes of address space of a process
  std::chrono::seconds time{60};        ///< wall time, and processor time, of a process
};

/// The result of a process.
struct Inspection {
  int status = 200;     ///< 200: success; otherwise a status for HTTP: 422, 500, or 503 if it was not tried
  std::string json;     ///< a valid object: for 200 a report's members ("valid", "measures", ...), otherwise a problem;
                        ///< empty if there was no memory for it
  std::string preview;  ///< the mesh for the page's preview; empty: none
  bool valid = false;   ///< the report's "valid"
};

struct InspectorCounts {
  unsigned running = 0, waiting = 0;                         ///< currently
  uint64_t valid = 0, invalid = 0, refused = 0, failed = 0;  ///< since creation: refused 422, failed 500
  /// Cumulative counts of times up to 2^(i - 8) s, from 4 ms to 128 s; longer ones are in no bucket.
  /// The sum includes all uploads counted above.
  std::array<uint64_t, 16> seconds{};
  double seconds_sum = 0;
};

/// Thread-safe.
class Inspector {
 public:
  /// Errors: io if no thread can be started; invalid_argument for numbers out of range.
  static Result<std::unique_ptr<Inspector>> create(const InspectorSettings& settings);
  /// Ends the running processes; waiting uploads get a status of 503.
  virtual ~Inspector() = default;

  /// Whether an upload would be accepted now. Errors: unsupported if there is no executable program; limit if the queue
  /// is full.
  virtual Result<void> wouldTake() const = 0;
  /// Queues an upload. began and done are called in a thread of the inspector, once each, in that order; if the
  /// inspector ends first, only done is called. Their exceptions are ignored. Errors: as wouldTake(), and limit if
  /// there is no memory left; then neither is called.
  virtual Result<void> inspect(Upload upload, std::function<void()> began, std::function<void(Inspection)> done) = 0;
  /// The reference histograms as JSON (GET /api/v1/masters), or after replacing them by this JSON (PUT), also in a
  /// process; status and json as in Inspection (409 if there is no base to write). Processed beside the queue, one at a
  /// time, in a thread of the inspector; but if too many wait, a status of 503 comes immediately.
  virtual void readMasters(std::function<void(Inspection)> done) = 0;
  virtual void writeMasters(std::string json, std::function<void(Inspection)> done) = 0;
  virtual InspectorCounts counts() const = 0;
};

}  // namespace sgm::service
