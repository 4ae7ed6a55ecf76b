#pragma once
// Cache of the reference histograms, which the inspector's processes read and write.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// The answer to a request for the reference histograms: status and JSON as in Inspection. All callers share the JSON.
struct MastersAnswer {
  int status = 503;
  std::shared_ptr<const std::string> json;  ///< JSON as in Inspection; null if memory has run out
};

/// Caches the reference histograms for some seconds. Concurrent requests share one process that reads them.
/// Thread-safe.
class Masters {
 public:
  using Told = std::function<void(const MastersAnswer&)>;

  /// Contract: the inspector has ended its threads before this object is destroyed, since they call back into it.
  explicit Masters(Inspector& inspector) : inspector_(inspector) {}

  void read(Told told);
  /// Replaces the reference histograms by those in `json`: either all of them or, after an error, none.
  void write(std::string json, Told told);

  /// The most recent result of reading, or of a successful write(); its status is 0 before the first result.
  MastersAnswer last() const;

 private:
  /// Passes an answer to all waiting callers. Works even if memory has run out.
  void tell(MastersAnswer said);
  void keep(const MastersAnswer& said);

  Inspector& inspector_;
  mutable std::mutex mutex_;
  MastersAnswer last_{0, nullptr};
  std::chrono::steady_clock::time_point when_;
  std::vector<Told> waiting_;  ///< callbacks of callers that wait for the process that reads the histograms
};

}  // namespace sgm::service
