#pragma once
// The reference histograms of the service, read and written by the inspector.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// The result: Inspection's status and JSON, shared by all receivers.
struct MastersAnswer {
  int status = 503;
  std::shared_ptr<const std::string> json;  ///< null: out of memory
};

/// Caches the reference histograms: concurrent requests share one process that reads them, and its result is used for
/// some seconds. Thread-safe.
class Masters {
 public:
  using Told = std::function<void(const MastersAnswer&)>;

  /// inspector must outlive it, but be stopped first: `told` functions are called from its threads.
  explicit Masters(Inspector& inspector) : inspector_(inspector) {}

  void read(Told told);
  /// Replaces them by this JSON, completely or not at all.
  void write(std::string json, Told told);

  /// The last result of reading; a status of 0 before the first one.
  MastersAnswer last() const;

 private:
  /// Informs all waiting callers, also when out of memory.
  void tell(MastersAnswer said);
  void keep(const MastersAnswer& said);

  Inspector& inspector_;
  mutable std::mutex mutex_;
  MastersAnswer last_{0, nullptr};
  std::chrono::steady_clock::time_point when_;
  std::vector<Told> waiting_;  ///< for the reading process
};

}  // namespace sgm::service
