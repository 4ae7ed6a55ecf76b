#pragma once
// Measures and classifies uploads in a sandboxed process, `sgm inspect`, so that a crafted file cannot crash the
// service.

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
  std::string program;                  ///< path of the program `sgm`; empty: uploads are not inspected
  std::string masters;                  ///< file of reference histograms; empty: the built-in ones
  unsigned jobs = 2;                    ///< number of concurrent processes, 1 to 64
  unsigned waiting = 16;                ///< maximum number of waiting uploads, at most 4096
  uint64_t memory = uint64_t{2} << 30;  ///< limit of a process's address space, bytes
  std::chrono::seconds time{60};        ///< limit of a process's wall time, and of its processor time
};

/// The result of inspecting one upload.
struct Inspection {
  /// HTTP status: 200 for success, 422 for a bad upload, 500 for a failure, 503 if it was not inspected
  int status = 200;
  /// A valid JSON object: the members of a report ("valid", "measures", ...) if status is 200, otherwise a problem;
  /// empty if there was no memory for it.
  std::string json;
  std::string preview;  ///< the simplified mesh for the page's preview; empty: none
  bool valid = false;   ///< value of the report's member "valid"
};

struct InspectorCounts {
  unsigned running = 0, waiting = 0;  ///< current numbers of uploads
  /// Numbers since creation; refused: status 422, failed: status 500.
  uint64_t valid = 0, invalid = 0, refused = 0, failed = 0;
  /// Cumulative counts of inspections that took at most 2^(i - 8) s, from 4 ms to 128 s; longer ones are in no bucket.
  /// seconds_sum includes all inspections counted above.
  std::array<uint64_t, 16> seconds{};
  double seconds_sum = 0;
};

/// Queues and inspects uploads. Thread-safe.
class Inspector {
 public:
  /// Errors: io if no thread can be started; invalid_argument for numbers out of range.
  static Result<std::unique_ptr<Inspector>> create(const InspectorSettings& settings);
  /// Ends the running processes; waiting uploads get the status 503.
  virtual ~Inspector() = default;

  /// Checks whether an upload would be accepted now. Errors: unsupported if there is no executable program; limit if
  /// the queue is full.
  virtual Result<void> wouldTake() const = 0;
  /// Queues an upload. `began` and `done` are called in a thread of the inspector, once each, in that order; if the
  /// inspector ends first, only `done` is called. Exceptions that they throw are ignored. Errors: as wouldTake(), and
  /// limit if there is no memory left; then neither is called.
  virtual Result<void> inspect(Upload upload, std::function<void()> began, std::function<void(Inspection)> done) = 0;
  /// Read or replace the reference histograms in a process (GET and PUT /api/v1/masters). `done` receives status and
  /// json as in Inspection; the status is 409 if no writable file is configured. These requests do not wait in the
  /// queue of uploads; they are processed one at a time, in a thread of the inspector. If too many wait, `done`
  /// receives a status of 503 immediately.
  virtual void readMasters(std::function<void(Inspection)> done) = 0;
  virtual void writeMasters(std::string json, std::function<void(Inspection)> done) = 0;
  virtual InspectorCounts counts() const = 0;
};

}  // namespace sgm::service
