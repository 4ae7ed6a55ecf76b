#include "grammar/text/sink.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "grammar/text/codes.h"

namespace sgm {

std::string join(std::initializer_list<std::string_view> parts) {
  size_t size = 0;
  for (std::string_view part : parts) size += part.size();
  std::string text;
  text.reserve(size);
  for (std::string_view part : parts) text += part;
  return text;
}

std::string numberText(double value) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

std::string metresText(double metres) {
  if (!std::isfinite(metres)) return "without bound";
  // A length in a message is rounded away from zero to one decimal, so that the author can use it as a bound.
  const double rounded = std::copysign(std::ceil(std::fabs(metres) * 10 - 1e-9) / 10, metres);
  return numberText(rounded) + " m";
}

Diagnostic& DiagnosticSink::add(Severity severity, const Span& span, std::string_view code, std::string message,
                                std::string hint) {
  if (severity == Severity::error) {
    if (errors_ > error_limit_) return surplus_ = {};
    if (++errors_ > error_limit_) {
      code = codes::kTooManyErrors;
      message = join({"there are more than ", std::to_string(error_limit_), " errors; the rest are left out"});
      hint.clear();
    }
  } else if (entries_.size() > size_t{4} * error_limit_) {
    return surplus_ = {};
  }
  Entry entry;
  entry.file = span.file;
  entry.order = entries_.size();
  Diagnostic& d = entry.diagnostic;
  d.severity = severity;
  d.code = code;
  d.message = std::move(message);
  d.hint = std::move(hint);
  if (span.file < files_.size()) d.file = files_[span.file];
  d.line = span.line;
  d.column = span.column;
  d.end_column = span.end_line == span.line ? std::max(span.end_column, span.column + 1) : span.column + 1;
  entries_.push_back(std::move(entry));
  return entries_.back().diagnostic;
}

Diagnostic& DiagnosticSink::error(const Span& span, std::string_view code, std::string message, std::string hint) {
  return add(Severity::error, span, code, std::move(message), std::move(hint));
}

Diagnostic& DiagnosticSink::warning(const Span& span, std::string_view code, std::string message, std::string hint) {
  return add(Severity::warning, span, code, std::move(message), std::move(hint));
}

std::string DiagnosticSink::place(const Span& span) const {
  const std::string_view file = span.file < files_.size() ? std::string_view(files_[span.file]) : "";
  return join({file, ":", std::to_string(span.line), ":", std::to_string(span.column)});
}

std::vector<Diagnostic> DiagnosticSink::take() {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    // The message that there are too many errors is sorted to the end.
    const bool a_last = a.diagnostic.code == codes::kTooManyErrors, b_last = b.diagnostic.code == codes::kTooManyErrors;
    return std::tie(a_last, a.file, a.diagnostic.line, a.diagnostic.column, a.order) <
           std::tie(b_last, b.file, b.diagnostic.line, b.diagnostic.column, b.order);
  });
  std::vector<Diagnostic> out;
  for (Entry& entry : entries_) {
    Diagnostic& d = entry.diagnostic;
    const bool repeated = !out.empty() && out.back().file == d.file && out.back().line == d.line &&
                          out.back().column == d.column && out.back().code == d.code && out.back().message == d.message;
    if (!repeated) out.push_back(std::move(d));
  }
  entries_.clear();
  return out;
}

namespace {

/// Returns the optimal string alignment distance (restricted Damerau-Levenshtein): swapping two neighbours is one edit.
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(previous);
    previous.swap(row);
  }
  return previous[b.size()];
}

std::string lowered(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace

void Suggestion::offer(std::string_view candidate) {
  // Long words are skipped, so that the cost stays bounded for untrusted text.
  constexpr size_t kLongest = 40;
  if (candidate.empty() || candidate.size() > kLongest || word_.size() > kLongest) return;
  const size_t far = word_.size() <= 2 ? 1 : word_.size() <= 5 ? 2 : 3;
  const size_t difference = std::max(candidate.size(), word_.size()) - std::min(candidate.size(), word_.size());
  if (difference > far) return;
  const size_t distance = editDistance(lowered(word_), lowered(candidate));
  if (distance > far || distance >= word_.size()) return;
  if (best_.empty() || distance < distance_ || (distance == distance_ && candidate < best_)) {
    best_ = candidate;
    distance_ = distance;
  }
}

std::string Suggestion::hint() const { return best_.empty() ? "" : join({"did you mean `", best_, "`?"}); }

}  // namespace sgm
