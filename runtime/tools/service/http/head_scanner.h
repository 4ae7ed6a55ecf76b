#pragma once
// Finds where a request's head ends, and refuses it at the first byte that no head may have there, or that is too many:
// before anything parses it, and wherever the bytes were cut on their way.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tools/service/http/message.h"

namespace sgm::service::http {

struct ReaderLimits {
  size_t line_bytes = 8192;   ///< of the request line, and of each field, without their ends
  size_t head_bytes = 32768;  ///< of the whole head
  size_t fields = 64;
};

class HeadScanner {
 public:
  explicit HeadScanner(const ReaderLimits& limits) : limits_(limits) {}

  /// Takes bytes up to the end of the head; `bytes` loses what was taken. A refusal is the last thing it says.
  std::optional<Problem> scan(std::string_view& bytes);
  bool whole() const { return whole_; }
  /// Has a byte been taken, of an empty line before the head too?
  bool begun() const { return begun_; }
  /// From the first letter of the request line to the empty line's end.
  const std::string& text() const { return text_; }
  /// For the next request, without its memory.
  void reset() {
    HeadScanner fresh(limits_);
    std::swap(*this, fresh);  // an assignment would keep the text's memory
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
