#pragma once
// The results of the last uploads, by their ids.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

enum class ReportState { waiting, running, done, failed, cancelled };

/// Thread-safe. Keeps the last 64 reports, up to 128 MiB; waiting and running ones are always kept.
class Reports {
 public:
  Reports();
  ~Reports();

  /// Adds a waiting report; returns its id, 16 unguessable hexadecimal digits.
  std::string begin(const std::string& name, UploadKind kind, uint64_t bytes);
  void run(const std::string& id);
  /// Finishes a report: done (a status of 200), cancelled (503) or failed, also if there is no memory for it. Returns
  /// the report as json() would; empty for an unknown id, or without memory for the copy. Throws nothing.
  std::string finish(const std::string& id, Inspection inspection);

  /// A report as a JSON object; nullopt for an id that is unknown or no longer kept.
  std::optional<std::string> json(const std::string& id) const;
  /// Null for an unknown id, or a report without a preview.
  std::shared_ptr<const std::string> preview(const std::string& id) const;
  /// {"reports": [...]}, newest first, without their measures.
  std::string list() const;
  size_t size() const;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace sgm::service
