#pragma once
// Programs for tests to start: scripts of the shell.

#include <sys/stat.h>

#include <fstream>
#include <string>

#include "temporary_folder.h"

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

/// Whether a process runs: what has ended may still stand in the table.
inline bool runs(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return static_cast<bool>(stat >> number >> name >> state) && state != "Z" && state != "X";
}

}  // namespace sgm
