#pragma once
// Texts that are the same whatever locale the host program has chosen: the C library's own are not.

#include <charconv>
#include <cstring>
#include <string>
#include <system_error>

namespace sgm {

/// Why a system call failed, by its errno, in English.
inline std::string systemMessage(int code) {
#if defined(__GLIBC__) && defined(_GNU_SOURCE) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 32)
  if (const char* text = strerrordesc_np(code)) return text;
#endif
  return std::strerror(code);
}

/// The same of a code of <system_error>; of codes that are not the system's, what their category says.
inline std::string systemMessage(const std::error_code& code) {
  const bool system = code.category() == std::system_category() || code.category() == std::generic_category();
  return system ? systemMessage(code.value()) : code.message();
}

/// A number with so many significant digits, as "%g" has it with a point.
inline std::string generalText(double value, int digits = 6) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return std::string(text, end.ptr);
}

/// A number with so many digits behind the point. Precondition: less than 1e300.
inline std::string fixedText(double value, int digits) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  return std::string(text, end.ptr);
}

}  // namespace sgm
