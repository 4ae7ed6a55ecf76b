#include "asset/read/text_encoding.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "base/utf8.h"

namespace sgm::asset {

namespace {

/// The Unicode encoding of a text: the size of a code unit in bytes, its byte order, and the size of the byte order
/// mark. For code units of 1 byte, the text after the mark stays unchanged.
struct Encoding {
  size_t width = 1, mark = 0;
  bool big_endian = false;
};

/// Recognises UTF-16 and UTF-32 without a byte order mark: the zero bytes of ASCII characters are always at the same
/// positions within a code unit.
Encoding encodingWithoutMark(std::string_view text) {
  constexpr size_t kLooked = 64, kLeast = 8;
  const std::string_view start = text.substr(0, std::min(text.size() / 4 * 4, kLooked));
  if (start.size() < kLeast) return {};
  const auto is = [&](size_t width, size_t place) {
    for (size_t i = 0; i < start.size(); ++i) {
      const auto c = static_cast<unsigned char>(start[i]);
      const bool plain = (c >= 0x20 && c < 0x7F) || c == '\t' || c == '\n' || c == '\r';
      if (i % width == place ? !plain : c != 0) return false;
    }
    return true;
  };
  for (const size_t width : {size_t{2}, size_t{4}}) {
    if (is(width, 0)) return {width, 0, false};
    if (is(width, width - 1)) return {width, 0, true};
  }
  return {};
}

Encoding encodingOf(std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xEF\xBB\xBF")) return {1, 3, false};
  if (text.starts_with("\xFF\xFE\0\0"sv)) return {4, 4, false};
  if (text.starts_with("\0\0\xFE\xFF"sv)) return {4, 4, true};
  if (text.starts_with("\xFF\xFE")) return {2, 2, false};
  if (text.starts_with("\xFE\xFF")) return {2, 2, true};
  return encodingWithoutMark(text);
}

}  // namespace

DecodedText::DecodedText(std::span<const std::byte> bytes) : bytes_(bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Encoding encoding = encodingOf(text);
  if (encoding.width == 1) {
    bytes_ = bytes.subspan(encoding.mark);
    return;
  }
  const size_t units = (text.size() - encoding.mark) / encoding.width;
  const auto unit = [&](size_t i) {
    uint32_t value = 0;
    for (size_t k = 0; k < encoding.width; ++k) {
      const size_t at = encoding.mark + i * encoding.width + (encoding.big_endian ? k : encoding.width - 1 - k);
      value = value << 8 | static_cast<unsigned char>(text[at]);
    }
    return value;
  };
  translated_.reserve(units);
  for (size_t i = 0; i < units; ++i) {
    uint32_t code = unit(i);
    if (encoding.width == 2 && code >= 0xD800 && code < 0xDC00 && i + 1 < units) {
      const uint32_t low = unit(i + 1);
      if (low >= 0xDC00 && low < 0xE000) {
        code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        ++i;
      }
    }
    constexpr uint32_t kReplacement = 0xFFFD;
    appendUtf8(translated_, code > 0x10FFFF || (code >= 0xD800 && code < 0xE000) ? kReplacement : code);
  }
  bytes_ = std::as_bytes(std::span(translated_));
}

}  // namespace sgm::asset
