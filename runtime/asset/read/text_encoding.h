#pragma once
// Converts the text of a file from any Unicode encoding.

#include <cstddef>
#include <span>
#include <string>

namespace sgm::asset {

/// The content of a text file in UTF-8. A byte order mark is dropped. UTF-16 and UTF-32 of either byte order are
/// converted; without a mark, they are recognised by the zero bytes in ASCII letters. Other bytes stay unchanged. The
/// text refers to `bytes` or to this object, which must outlive it.
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
