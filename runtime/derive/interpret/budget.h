#pragma once
// The limits of a derivation, and its messages.

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

/// Counts one more level of recursion during its lifetime.
class [[nodiscard]] Nested {
 public:
  explicit Nested(uint32_t& depth) : depth_(depth) { ++depth_; }
  ~Nested() { --depth_; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  uint32_t& depth_;
};

/// The part of its limits that the cell has used up so far, the error that ended it, and the notes on parts left out.
/// Messages name the span in the grammar and the path of the activation.
class Budget {
 public:
  Budget(const CellInputs& in, const Activations& activations, const Draft& draft)
      : in_(in), limits_(in.limits), activations_(activations), draft_(draft) {}

  /// Counts steps of work. Returns false if the cell has failed, or fails because of them.
  bool step(uint64_t count, const Span& span, uint32_t activation) {
    if (failed()) return false;
    steps_ += std::min(count, limits_.steps + 1);
    if (steps_ <= limits_.steps) return true;
    failBySteps(span, activation);
    return false;
  }
  /// Meaningless if the cell has failed.
  uint64_t stepsLeft() const { return limits_.steps - steps_; }

  /// Counts memory of the cell outside of its draft and its activations.
  void hold(size_t bytes) { held_bytes_ += bytes; }
  /// Returns false, and fails, if the cell takes too much memory.
  bool withinBytes(const Span& span, uint32_t activation);

  /// Counts one more statement or expression around the next ones during the lifetime of the result.
  Nested nest() { return Nested(nesting_); }
  /// Returns false, and fails, if statements and expressions are nested too deep.
  bool withinNesting(const Span& span, uint32_t activation) {
    if (nesting_ <= limits_.nesting) return true;
    failByNesting(span, activation);
    return false;
  }

  /// Ends the derivation with an error; only the first counts.
  void fail(const std::string& what, const Span& span, uint32_t activation);
  bool failed() const { return error_.has_value(); }
  /// Precondition: failed().
  const Error& error() const { return *error_; }

  /// Keeps a note, or only counts it if there are too many.
  void note(const std::string& message, const Span& span, uint32_t activation);
  bool isFullOfNotes() const { return notes_.size() >= limits_.notes; }
  void dropNote() { ++dropped_notes_; }
  /// Moves the notes to the end of `out`, with one more that counts the dropped ones.
  void moveNotes(std::pmr::vector<DeriveNote>& out);

 private:
  void failBySteps(const Span& span, uint32_t activation);
  void failByNesting(const Span& span, uint32_t activation);
  /// Names the file of a span to the message if it is not the root.
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
