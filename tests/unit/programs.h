#pragma once
// Makes programs for tests to start: shell scripts.

#include <sys/stat.h>

#include <fstream>
#include <string>

#include "temporary_folder.h"

namespace sgm {

/// Writes an executable shell script into the folder, and returns its path.
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

/// Whether a process runs. A process that has ended may still be in the process table, as a zombie.
inline bool runs(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return static_cast<bool>(stat >> number >> name >> state) && state != "Z" && state != "X";
}

}  // namespace sgm
