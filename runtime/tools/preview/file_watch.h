#pragma once
// Detects when files have been saved.

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sgm::preview {

/// Watches the files of one grammar for changes since they were last read. Not thread-safe.
class FileWatch {
 public:
  /// Starts to watch these files instead of the previous files. They need not exist yet.
  void watch(std::vector<std::filesystem::path> files);

  /// Returns true if a file has changed since watch() or since the last call that returned true, and has not changed
  /// further since the previous call. The second condition is for editors that write a file in several steps.
  bool changed();

 private:
  /// The state of one file: time of its last change, and size plus one; both 0 if the file does not exist.
  using Stamp = std::array<int64_t, 2>;

  std::vector<Stamp> look() const;

  std::vector<std::filesystem::path> files_;
  std::vector<Stamp> known_, last_;
};

}  // namespace sgm::preview
