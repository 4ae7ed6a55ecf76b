#pragma once
// Programs for tests to start: scripts of the shell.

#include <sys/stat.h>

#include <cstdint>
#include <fstream>
#include <string>

#include "../temporary_folder.h"

namespace sgm {

/// In the folder, to be run; its path.
inline std::string makeScript(const TemporaryFolder& folder, const std::string& name, const std::string& lines) {
  const std::string path = (folder.path / name).string();
  std::ofstream(path) << "#!/bin/sh\n" << lines << "\n";
  REQUIRE(chmod(path.c_str(), 0755) == 0);
  return path;
}

inline std::string makeFile(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  const std::string path = (folder.path / name).string();
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// What a process that inspects says: both parts behind their sizes.
inline std::string framed(const std::string& json, const std::string& preview = {}) {
  std::string bytes;
  for (const std::string& part : {json, preview}) {
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(uint64_t{part.size()} >> (8 * i));
    bytes += part;
  }
  return bytes;
}

/// One triangle.
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

/// Whether a process runs: what has ended may still stand in the table.
inline bool runs(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return static_cast<bool>(stat >> number >> name >> state) && state != "Z" && state != "X";
}

}  // namespace sgm
