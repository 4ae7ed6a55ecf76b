#pragma once
// Collects the diagnostics of all compiler stages. Also text functions that the stages share.

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/text/diagnostics.h"

namespace sgm {

/// Concatenates texts.
std::string join(std::initializer_list<std::string_view> parts);
/// Returns the shortest decimal number that reads back as the same double.
std::string numberText(double value);
/// Formats a length for messages: "214 m", "2.5 m"; "without bound" if it is not finite.
std::string metresText(double metres);

class DiagnosticSink {
 public:
  explicit DiagnosticSink(uint32_t error_limit) : error_limit_(error_limit) {}

  /// Adds the next file, whose spans have Span::file equal to the number of files added before.
  void addFile(std::string_view path) { files_.emplace_back(path); }

  Diagnostic& error(const Span& span, std::string_view code, std::string message, std::string hint = {});
  Diagnostic& warning(const Span& span, std::string_view code, std::string message, std::string hint = {});

  uint32_t errorCount() const { return errors_; }
  /// Whether the number of errors exceeds the limit; compiler stages then stop early.
  bool full() const { return errors_ > error_limit_; }
  std::string place(const Span& span) const;
  /// Removes and returns the diagnostics, sorted by file and position, without duplicates.
  std::vector<Diagnostic> take();

 private:
  Diagnostic& add(Severity severity, const Span& span, std::string_view code, std::string message, std::string hint);

  struct Entry {
    Diagnostic diagnostic;
    uint32_t file = 0;
    size_t order = 0;
  };
  uint32_t error_limit_;
  uint32_t errors_ = 0;
  std::vector<std::string> files_;
  std::vector<Entry> entries_;
  Diagnostic surplus_;
};

/// Finds, among the offered candidates, the one most similar to a misspelt word; empty if none is similar enough.
class Suggestion {
 public:
  explicit Suggestion(std::string_view word) : word_(word) {}
  void offer(std::string_view candidate);
  std::string_view best() const { return best_; }
  /// Returns "did you mean `x`?", or an empty text if there is no similar candidate.
  std::string hint() const;
  /// Like hint(), but returns `other` instead of an empty text.
  std::string hintOr(std::string_view other) const { return best_.empty() ? std::string(other) : hint(); }

 private:
  std::string_view word_;
  std::string best_;
  size_t distance_ = 0;
};

}  // namespace sgm
