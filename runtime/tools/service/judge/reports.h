#pragma once
// Stores the reports on recent uploads under their ids.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

enum class ReportState { waiting, running, done, failed, cancelled };

/// Stores the last 64 reports, up to 128 MiB in total. Reports that are not finished are always kept. Thread-safe.
class Reports {
 public:
  Reports();
  ~Reports();

  /// Adds a report in the state "waiting". Returns its id: 16 unguessable hexadecimal digits.
  std::string begin(const std::string& name, UploadKind kind, uint64_t bytes);
  void run(const std::string& id);
  /// Finishes a report. The status of `inspection` sets its state: 200 done, 503 cancelled, other values failed; also
  /// failed if memory runs out. Returns the report as json() would; empty if the id is unknown or there is no memory
  /// for the copy. Does not throw.
  std::string finish(const std::string& id, Inspection inspection);

  /// A report as a JSON object; nullopt if the id is unknown or the report has been removed.
  std::optional<std::string> json(const std::string& id) const;
  /// The preview mesh of a report; null if the id is unknown or the report has no preview.
  std::shared_ptr<const std::string> preview(const std::string& id) const;
  /// JSON {"reports": [...]} with all reports, newest first, without their measures.
  std::string list() const;
  size_t size() const;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace sgm::service
