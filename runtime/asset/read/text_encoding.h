#pragma once
// The text of a file, whatever encoding it came in.

#include <cstddef>
#include <span>
#include <string>

namespace sgm::asset {

/// The bytes of a text file in UTF-8: a byte order mark is dropped, and UTF-16 and UTF-32 of either byte order are
/// translated, without a mark if the zero bytes of plain letters tell them. Other bytes stay as they are. Borrows from
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
