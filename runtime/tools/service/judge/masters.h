#pragma once
// The masters that histograms are compared with, as the inspector reads and writes them.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

/// What was said of them: Inspection's status and JSON, shared by all who are told.
struct MastersAnswer {
  int status = 503;
  std::shared_ptr<const std::string> json;  ///< null: there was no memory for it
};

/// Any thread. A process reads them for all who ask within a few seconds.
class Masters {
 public:
  using Told = std::function<void(const MastersAnswer&)>;

  /// inspector must outlive it, and end before it: told functions are called from its threads.
  explicit Masters(Inspector& inspector) : inspector_(inspector) {}

  void read(Told told);
  /// Replaces them by this JSON, whole or not at all.
  void write(std::string json, Told told);

  /// What was said when they were read last; a status of 0 where that has not been yet.
  MastersAnswer last() const;

 private:
  /// Tells all who wait, whatever becomes of the memory.
  void tell(MastersAnswer said);
  void keep(const MastersAnswer& said);

  Inspector& inspector_;
  mutable std::mutex mutex_;
  MastersAnswer last_{0, nullptr};
  std::chrono::steady_clock::time_point when_;
  std::vector<Told> waiting_;  ///< for a process that reads
};

}  // namespace sgm::service
