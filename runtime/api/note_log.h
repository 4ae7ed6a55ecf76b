#pragma once
// What derivation leaves out, told to the runtime's log sink.

#include <mutex>
#include <set>
#include <string>
#include <tuple>

#include "api/runtime.h"
#include "derive/shape.h"

namespace sgm::api {

/// Each kind of note at each place in the grammar once, as a warning, up to a number of them: an endless world would
/// say the same of every cell. Thread-safe.
class NoteLog {
 public:
  explicit NoteLog(const sgm_runtime& runtime) : runtime_(runtime) {}

  void tell(const GrammarChunk& cell);

 private:
  /// Whether the note is to be told; `last` where it is the first one too many.
  bool isNew(const DeriveNote& note, bool& last);

  const sgm_runtime& runtime_;
  std::mutex mutex_;
  std::set<std::tuple<int, int, std::string>> told_;
};

}  // namespace sgm::api
