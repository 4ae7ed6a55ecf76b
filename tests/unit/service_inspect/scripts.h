#pragma once
// The output of programs that stand for `sgm inspect` in tests.

#include <cstdint>
#include <string>

#include "../programs.h"

namespace sgm {

/// The output of an inspecting process: the JSON and the preview, each preceded by its size.
inline std::string framed(const std::string& json, const std::string& preview = {}) {
  std::string bytes;
  for (const std::string& part : {json, preview}) {
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(uint64_t{part.size()} >> (8 * i));
    bytes += part;
  }
  return bytes;
}

/// The bytes of a preview with one triangle.
inline std::string smallPreview(uint32_t last_corner = 2) {
  std::string bytes = "SGMPREV1";
  const auto add = [&bytes](uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
  };
  for (const uint32_t value : {3u, 1u}) add(value);
  bytes.append(36, '\0');
  for (const uint32_t corner : {0u, 1u, last_corner}) add(corner);
  return bytes;
}

}  // namespace sgm
