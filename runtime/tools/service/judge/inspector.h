#pragma once
// Measures and classifies uploads in sandboxed processes (`sgm inspect`), so that a malicious file cannot crash the
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
  std::string program;                  ///< path of the program `sgm`; if empty, uploads are not inspected
  std::string masters;                  ///< path of the file with reference histograms; if empty, the built-in
                                        ///< histograms are used
  unsigned jobs = 2;                    ///< maximum number of concurrent processes, 1 to 64
  unsigned waiting = 16;                ///< maximum number of uploads in the queue, at most 4096
  uint64_t memory = uint64_t{2} << 30;  ///< limit of each process's address space in bytes
  std::chrono::seconds time{60};        ///< limit of each process's wall-clock time and of its CPU time
};

/// The result of inspecting one upload.
struct Inspection {
  /// HTTP status: 200 for success, 422 for an invalid upload, 500 for a failure, 503 if it was not inspected
  int status = 200;
  /// A JSON object: for status 200 the members of a report ("valid", "measures", ...), otherwise a problem (RFC 9457).
  /// Empty if there was no memory for it.
  std::string json;
  std::string preview;  ///< simplified mesh for the web page's preview; empty if there is none
  bool valid = false;   ///< value of the report's member "valid"
};

struct InspectorCounts {
  unsigned running = 0, waiting = 0;  ///< current numbers of running inspections and of uploads in the queue
  /// Numbers of inspections since creation. valid, invalid: status 200; refused: status 422; failed: status 500.
  uint64_t valid = 0, invalid = 0, refused = 0, failed = 0;
  /// Cumulative histogram: seconds[i] is the number of inspections that took at most 2^(i - 8) s, from 4 ms to 128 s.
  /// Longer inspections are in no bucket. seconds_sum is the total time of all inspections.
  std::array<uint64_t, 16> seconds{};
  double seconds_sum = 0;
};

/// Queues and inspects uploads. All functions are thread-safe.
class Inspector {
 public:
  /// Errors: io if no thread can be started; invalid_argument if a number is out of range.
  static Result<std::unique_ptr<Inspector>> create(const InspectorSettings& settings);
  /// Ends the running processes. Uploads in the queue get the status 503.
  virtual ~Inspector() = default;

  /// Whether inspect() would accept an upload now. Errors: unsupported if the program is missing or not executable;
  /// limit if the queue is full.
  virtual Result<void> wouldTake() const = 0;
  /// Queues an upload. A thread of the inspector first calls `began`, when the inspection starts, and then `done`, each
  /// once. If the inspector ends before the inspection starts, only `done` is called. Exceptions that they throw are
  /// ignored. Errors: those of wouldTake(), and limit if memory has run out; after an error, neither function is
  /// called.
  virtual Result<void> inspect(Upload upload, std::function<void()> began, std::function<void(Inspection)> done) = 0;
  /// Reads or replaces the reference histograms in a process (GET and PUT /api/v1/masters). `done` receives a status
  /// and JSON as in Inspection; the status is 409 if no writable file is configured. These requests have a queue of
  /// their own, from which one thread processes one at a time. If that queue is full, `done` receives a 503
  /// immediately.
  virtual void readMasters(std::function<void(Inspection)> done) = 0;
  virtual void writeMasters(std::string json, std::function<void(Inspection)> done) = 0;
  virtual InspectorCounts counts() const = 0;
};

}  // namespace sgm::service
