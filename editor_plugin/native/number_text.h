#pragma once
// Formats numbers for messages with a decimal point, independently of the locale that the editor has chosen.

#include <charconv>
#include <string>

namespace sgm_godot {

inline std::string numberText(double value, int digits = 6) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return std::string(text, end.ptr);
}

}  // namespace sgm_godot
