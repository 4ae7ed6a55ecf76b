#pragma once
// The text of a file in any encoding.

#include <cstddef>
#include <span>
#include <string>

namespace sgm::asset {

/// The bytes of a text file in UTF-8: a byte order mark is dropped, and UTF-16 and UTF-32 of either byte order are
/// converted, without a mark if the zero bytes of ASCII letters reveal them. Other bytes stay unchanged. Borrows from
/// `bytes` or from itself.
class DecodedText {
 public:
  explicit DecodedText(std::span<const std::byte> bytes);
  DecodedText(const DecodedText&) = delete;
  DecodedText& operator=(const DecodedText&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::string translated_;
  std::span<const std::byte> bytes_;
};

}  // namespace sgm::asset
