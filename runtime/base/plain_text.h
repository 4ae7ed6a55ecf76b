#pragma once
// Formats numbers and system errors independently of the host program's locale, unlike the C library's functions.

#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>

namespace sgm {

/// Returns the English message for an errno value.
inline std::string systemMessage(int code) {
#if defined(__GLIBC__) && defined(_GNU_SOURCE) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 32)
  if (const char* text = strerrordesc_np(code)) return text;
#endif
  return std::strerror(code);
}

/// Returns the message of a <system_error> code: in English for the system and generic categories, otherwise the
/// category's own message.
inline std::string systemMessage(const std::error_code& code) {
  const bool system = code.category() == std::system_category() || code.category() == std::generic_category();
  return system ? systemMessage(code.value()) : code.message();
}

/// Formats a number with the given number of significant digits as printf's "%g" does, always with a decimal point,
/// never a comma.
inline std::string generalText(double value, int digits = 6) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return std::string(text, end.ptr);
}

/// Formats a number with the given number of digits after the decimal point. Precondition: |value| < 1e300.
inline std::string fixedText(double value, int digits) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  return std::string(text, end.ptr);
}

/// Formats a number in lower-case hexadecimal, padded with leading zeros to at least `digits` digits.
inline std::string hexText(uint64_t value, size_t digits) {
  char text[16];
  const auto end = std::to_chars(text, text + sizeof text, value, 16);
  std::string hex(text, end.ptr);
  if (hex.size() < digits) hex.insert(0, digits - hex.size(), '0');
  return hex;
}

}  // namespace sgm
