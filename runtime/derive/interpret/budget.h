#pragma once
// Enforces the limits of a derivation, and collects its messages.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "derive/draft.h"
#include "derive/interpret/activations.h"
#include "derive/interpret/cell_inputs.h"

namespace sgm::interpret {

/// Counts one more level of recursion while the object exists.
class [[nodiscard]] Nested {
 public:
  explicit Nested(uint32_t& depth) : depth_(depth) { ++depth_; }
  ~Nested() { --depth_; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  uint32_t& depth_;
};

/// The work and memory that the derivation of one cell has used, the error that ended it, and its notes on shapes left
/// out. Each message contains a place in the grammar (span) and the derivation path of the activation.
class Budget {
 public:
  Budget(const CellInputs& in, const Activations& activations, const Draft& draft)
      : in_(in), limits_(in.limits), activations_(activations), draft_(draft) {}

  /// Counts steps of work. Returns false if the cell has failed, or fails now because the limit is exceeded.
  bool step(uint64_t count, const Span& span, uint32_t activation) {
    if (failed()) return false;
    steps_ += std::min(count, limits_.steps + 1);
    if (steps_ <= limits_.steps) return true;
    failBySteps(span, activation);
    return false;
  }
  /// Number of steps that the cell may still take. Undefined if the cell has failed.
  uint64_t stepsLeft() const { return limits_.steps - steps_; }

  /// Counts memory of the cell that belongs neither to the draft nor to the activations.
  void hold(size_t bytes) { held_bytes_ += bytes; }
  /// Fails the cell and returns false if it uses too much memory.
  bool withinBytes(const Span& span, uint32_t activation);

  /// Counts one level of nested statements or expressions, while the returned object exists.
  Nested nest() { return Nested(nesting_); }
  /// Fails the cell and returns false if statements and expressions are nested too deep.
  bool withinNesting(const Span& span, uint32_t activation) {
    if (nesting_ <= limits_.nesting) return true;
    failByNesting(span, activation);
    return false;
  }

  /// Ends the derivation with an error. Only the first error is stored.
  void fail(const std::string& what, const Span& span, uint32_t activation);
  bool failed() const { return error_.has_value(); }
  /// Precondition: failed().
  const Error& error() const { return *error_; }

  /// Stores a note; if there are already too many notes, only counts it.
  void note(const std::string& message, const Span& span, uint32_t activation);
  bool isFullOfNotes() const { return notes_.size() >= limits_.notes; }
  void dropNote() { ++dropped_notes_; }
  /// Moves the notes to the end of `out`, followed by a note with the number of dropped notes, if any.
  void moveNotes(std::pmr::vector<DeriveNote>& out);

 private:
  void failBySteps(const Span& span, uint32_t activation);
  void failByNesting(const Span& span, uint32_t activation);
  /// Appends the file name of a span to the message, unless the file is the grammar's root file.
  void addFile(const Span& span, std::string& message) const;

  const CellInputs& in_;
  const DeriveLimits& limits_;
  const Activations& activations_;
  const Draft& draft_;
  uint64_t steps_ = 0;
  size_t held_bytes_ = 0;
  uint32_t nesting_ = 0;
  std::optional<Error> error_;
  std::vector<DeriveNote> notes_;
  uint64_t dropped_notes_ = 0;
};

}  // namespace sgm::interpret
