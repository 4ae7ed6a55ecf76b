#include "api/note_log.h"

#include <algorithm>

namespace sgm::api {
namespace {

constexpr size_t kMaxReported = 64;

/// Removes the digits of a message, so that messages which differ only in numbers count as one kind; for example, the
/// amount by which a shape is too large differs from cell to cell.
std::string kindOf(std::string message) {
  message.erase(std::remove_if(message.begin(), message.end(), [](char c) { return c >= '0' && c <= '9'; }),
                message.end());
  return message;
}

}  // namespace

bool NoteLog::isNew(const DeriveNote& note, bool& last) {
  const std::lock_guard lock(mutex_);
  last = told_.size() == kMaxReported;
  return told_.size() <= kMaxReported && told_.insert({note.line, note.column, kindOf(note.message)}).second;
}

void NoteLog::tell(const GrammarChunk& cell) {
  for (const DeriveNote& note : cell.notes) {
    bool last = false;
    // A note without a line only tells how many further notes of the cell were discarded.
    if (note.line == 0 || !isNew(note, last)) continue;
    if (last) {
      runtime_.log(SGM_LOG_WARNING, "notes at further places in the grammar are not logged");
      continue;
    }
    runtime_.log(SGM_LOG_WARNING, std::to_string(note.line) + ":" + std::to_string(note.column) + ": " + note.message +
                                      " (first in " + note.path + ")");
  }
}

}  // namespace sgm::api
