#pragma once
// Logs what derivation has left out, to the runtime's log function.

#include <mutex>
#include <set>
#include <string>
#include <tuple>

#include "api/runtime.h"
#include "derive/shape.h"

namespace sgm::api {

/// Logs each kind of note at each place of the grammar once, as a warning, up to a maximum number: an endless world
/// would repeat the same notes for every cell. Thread-safe.
class NoteLog {
 public:
  explicit NoteLog(const sgm_runtime& runtime) : runtime_(runtime) {}

  void tell(const GrammarChunk& cell);

 private:
  /// Returns true if the note must be logged. Sets `last` to true at the first note beyond the maximum.
  bool isNew(const DeriveNote& note, bool& last);

  const sgm_runtime& runtime_;
  std::mutex mutex_;
  std::set<std::tuple<int, int, std::string>> told_;
};

}  // namespace sgm::api
