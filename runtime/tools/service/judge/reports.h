#pragma once
// What became of the uploads: the last ones, found again by their ids.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tools/service/judge/inspector.h"

namespace sgm::service {

enum class ReportState { waiting, running, done, failed, cancelled };

/// Any thread. Keeps the last 64 reports, of 128 MiB together; those that wait or run are kept in any case.
class Reports {
 public:
  Reports();
  ~Reports();

  /// A new report, waiting; its id, 16 hexadecimal digits that nobody can guess.
  std::string begin(const std::string& name, UploadKind kind, uint64_t bytes);
  void run(const std::string& id);
  /// Done (a status of 200), cancelled (503) or failed, which it also is where no memory is left for it. The report as
  /// JSON, as json() has it as long as it is kept; empty for an id that is not known, or without memory for the copy.
  /// Throws nothing.
  std::string finish(const std::string& id, Inspection inspection);

  /// One report as JSON (an object); nothing for an id that is not (or no longer) known.
  std::optional<std::string> json(const std::string& id) const;
  /// Nothing for an id that is not known, or has none.
  std::shared_ptr<const std::string> preview(const std::string& id) const;
  /// {"reports": [...]}, newest first, without their measures.
  std::string list() const;
  size_t size() const;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace sgm::service
