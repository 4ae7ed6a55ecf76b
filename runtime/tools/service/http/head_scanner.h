#pragma once
// Finds the end of a request's head in the bytes that arrive. Rejects the head before any parsing: at its first invalid
// byte, or at the first byte beyond a limit. The result does not depend on how the bytes are split on arrival.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tools/service/http/message.h"

namespace sgm::service::http {

struct ReaderLimits {
  size_t line_bytes = 8192;   ///< limit of the request line and of each header, without line ends
  size_t head_bytes = 32768;  ///< limit of the whole head
  size_t fields = 64;
};

class HeadScanner {
 public:
  explicit HeadScanner(const ReaderLimits& limits) : limits_(limits) {}

  /// Consumes bytes up to the end of the head and removes them from `bytes`. Must not be called again after it has
  /// returned a problem.
  std::optional<Problem> scan(std::string_view& bytes);
  bool whole() const { return whole_; }
  /// Whether any byte has been consumed since reset(). The bytes of an empty line before the head count, too.
  bool begun() const { return begun_; }
  /// The head so far, from the first letter of the request line up to and including the final empty line.
  const std::string& text() const { return text_; }
  /// Prepares the scanner for the next request, and frees the memory of the head.
  void reset() {
    HeadScanner fresh(limits_);
    std::swap(*this, fresh);  // swapped, since an assignment would keep the capacity of text_
  }

 private:
  std::optional<Problem> take(char c);
  std::optional<Problem> endLine();

  ReaderLimits limits_;
  std::string text_;
  size_t line_bytes_ = 0;
  size_t lines_ = 0;
  bool begun_ = false;
  bool skipped_line_ = false;
  bool after_return_ = false;
  bool whole_ = false;
};

}  // namespace sgm::service::http
