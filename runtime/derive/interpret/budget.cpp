#include "derive/interpret/budget.h"

#include <string_view>
#include <utility>

namespace sgm::interpret {

void Budget::failBySteps(const Span& span, uint32_t activation) {
  fail("deriving one cell takes more than " + std::to_string(limits_.steps) +
           " steps (derive less, or make the cells smaller)",
       span, activation);
}

void Budget::failByNesting(const Span& span, uint32_t activation) {
  fail("expressions and statements are nested too deep (let fewer rules call each other)", span, activation);
}

bool Budget::withinBytes(const Span& span, uint32_t activation) {
  if (draft_.bytes() + activations_.bytes() + held_bytes_ <= limits_.bytes) return true;
  fail("one cell takes more than " + std::to_string(limits_.bytes >> 20) +
           " MiB (derive less, or make the cells smaller)",
       span, activation);
  return false;
}

void Budget::fail(const std::string& what, const Span& span, uint32_t activation) {
  if (failed()) return;
  const std::string path = activations_.pathText(activation);
  Error error{Code::limit, what, span.line, span.column};
  if (!path.empty()) error.message.append(", in ").append(path);
  addFile(span, error.message);
  error_ = std::move(error);
}

void Budget::note(const std::string& message, const Span& span, uint32_t activation) {
  if (isFullOfNotes()) return dropNote();
  DeriveNote note{message, activations_.pathText(activation), span.line, span.column};
  addFile(span, note.message);
  notes_.push_back(std::move(note));
}

void Budget::addFile(const Span& span, std::string& message) const {
  if (span.file == 0 || span.file >= in_.program.modules.size()) return;
  message.append(" (").append(in_.program.modules[span.file].path).append(")");
}

void Budget::moveNotes(std::pmr::vector<DeriveNote>& out) {
  if (dropped_notes_ > 0) {
    // The number of dropped notes refers to no single place in the grammar, so it is reported at the layer's start.
    const Span& span = in_.program.expr(in_.layer.start).span;
    const std::string_view what =
        dropped_notes_ == 1 ? " more note on this cell is left out" : " more notes on this cell are left out";
    notes_.push_back({std::to_string(dropped_notes_).append(what), activations_.pathText(0), span.line, span.column});
  }
  for (DeriveNote& n : notes_) out.push_back(std::move(n));
}

}  // namespace sgm::interpret
