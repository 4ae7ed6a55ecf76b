#pragma once
// Logs warnings about shapes that derivation of a grammar has left out, through the runtime's log function.

#include <mutex>
#include <set>
#include <string>
#include <tuple>

#include "api/runtime.h"
#include "derive/shape.h"

namespace sgm::api {

/// Logs each kind of warning only once per position in the grammar, up to a maximum number, because an endless world
/// would repeat the same warnings in every cell. Thread-safe.
class NoteLog {
 public:
  explicit NoteLog(const sgm_runtime& runtime) : runtime_(runtime) {}

  void tell(const GrammarChunk& cell);

 private:
  /// Returns true if the note must be reported, because it is the first of its kind. Sets `last` to true if the maximum
  /// number of kinds has been reached before: then only this fact is logged instead of the note.
  bool isNew(const DeriveNote& note, bool& last);

  const sgm_runtime& runtime_;
  std::mutex mutex_;
  std::set<std::tuple<int, int, std::string>> told_;
};

}  // namespace sgm::api
