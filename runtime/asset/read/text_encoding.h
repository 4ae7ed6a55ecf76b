#pragma once
// Converts the text of a file from any Unicode encoding to UTF-8.

#include <cstddef>
#include <span>
#include <string>

namespace sgm::asset {

/// The content of a text file in UTF-8, without byte order mark. UTF-16 and UTF-32 of either byte order are converted;
/// without a byte order mark, they are recognised by the zero bytes of ASCII characters. Other bytes stay unchanged.
/// The text refers to `bytes` or to this object; both must outlive it.
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
