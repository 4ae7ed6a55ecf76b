#pragma once
// The reference histograms of the service. The inspector's processes read and write them.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// The answer to a request: status and JSON as in Inspection, shared by all callers.
struct MastersAnswer {
  int status = 503;
  std::shared_ptr<const std::string> json;  ///< null: the process is out of memory
};

/// Caches the reference histograms: concurrent requests share one process that reads them, and the cached result stays
/// valid for some seconds. Thread-safe.
class Masters {
 public:
  using Told = std::function<void(const MastersAnswer&)>;

  /// Inspector must outlive this object, but must have ended its threads before, since these call the `told` functions.
  explicit Masters(Inspector& inspector) : inspector_(inspector) {}

  void read(Told told);
  /// Replaces the reference histograms by this JSON, completely or not at all.
  void write(std::string json, Told told);

  /// The last result of reading; its status is 0 before the first one.
  MastersAnswer last() const;

 private:
  /// Passes an answer to all waiting callers, even if memory has run out.
  void tell(MastersAnswer said);
  void keep(const MastersAnswer& said);

  Inspector& inspector_;
  mutable std::mutex mutex_;
  MastersAnswer last_{0, nullptr};
  std::chrono::steady_clock::time_point when_;
  std::vector<Told> waiting_;  ///< callers that wait for the process that is reading
};

}  // namespace sgm::service
