#pragma once
// Logs the omissions of derivation to the runtime's sink.

#include <mutex>
#include <set>
#include <string>
#include <tuple>

#include "api/runtime.h"
#include "derive/shape.h"

namespace sgm::api {

/// Logs each kind of note at each place of the grammar once, as a warning, up to a limit: an endless world would repeat
/// the same for every cell. Thread-safe.
class NoteLog {
 public:
  explicit NoteLog(const sgm_runtime& runtime) : runtime_(runtime) {}

  void tell(const GrammarChunk& cell);

 private:
  /// Whether to log the note; sets `last` at the first note beyond the limit.
  bool isNew(const DeriveNote& note, bool& last);

  const sgm_runtime& runtime_;
  std::mutex mutex_;
  std::set<std::tuple<int, int, std::string>> told_;
};

}  // namespace sgm::api
