#pragma once
// Strings of fixed capacity, for code that must not allocate memory, such as messages about running out of memory.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sgm {

/// Stores a string of fewer than N bytes; a longer string is truncated.
template <size_t N>
class ShortText {
 public:
  ShortText& add(std::string_view text) {
    const size_t size = std::min(text.size(), N - 1 - size_);
    std::copy_n(text.data(), size, text_.data() + size_);
    size_ += size;
    return *this;
  }
  ShortText& add(uint64_t number) {
    char digits[20];
    const auto end = std::to_chars(digits, digits + sizeof digits, number);
    return add(std::string_view(digits, static_cast<size_t>(end.ptr - digits)));
  }
  const char* c_str() const { return text_.data(); }

 private:
  std::array<char, N> text_{};  // ends with 0
  size_t size_ = 0;
};

}  // namespace sgm
