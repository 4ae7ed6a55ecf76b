#pragma once
// Collects the diagnostics of all compiler stages. Also text functions that they share.

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/text/diagnostics.h"

namespace sgm {

/// Concatenates the parts.
std::string join(std::initializer_list<std::string_view> parts);
/// The shortest decimal number that reads back as the same double.
std::string numberText(double value);
/// A length for people: "214 m", "2.5 m", "unbounded" if it is not finite.
std::string metresText(double metres);

class DiagnosticSink {
 public:
  explicit DiagnosticSink(uint32_t error_limit) : error_limit_(error_limit) {}

  /// Names a file for spans; the index is Span::file.
  void addFile(std::string_view path) { files_.emplace_back(path); }

  Diagnostic& error(const Span& span, std::string_view code, std::string message, std::string hint = {});
  Diagnostic& warning(const Span& span, std::string_view code, std::string message, std::string hint = {});

  uint32_t errorCount() const { return errors_; }
  /// Whether the limit is exceeded: stages then stop early.
  bool full() const { return errors_ > error_limit_; }
  std::string place(const Span& span) const;
  /// Takes the diagnostics, sorted by file and place, without duplicates.
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

/// Finds the candidate nearest to a misspelt word; empty if none is near enough.
class Suggestion {
 public:
  explicit Suggestion(std::string_view word) : word_(word) {}
  void offer(std::string_view candidate);
  std::string_view best() const { return best_; }
  /// "did you mean `x`?" or empty.
  std::string hint() const;
  /// The same, or another hint if it is empty.
  std::string hintOr(std::string_view other) const { return best_.empty() ? std::string(other) : hint(); }

 private:
  std::string_view word_;
  std::string best_;
  size_t distance_ = 0;
};

}  // namespace sgm
