#pragma once
// Detects that files have been saved.

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sgm::preview {

/// Watches the files of one grammar for changes since they were last read. Must be used by one thread.
class FileWatch {
 public:
  /// Starts to watch these files, which need not exist yet.
  void watch(std::vector<std::filesystem::path> files);

  /// Whether a file differs from its state at watch() or at the last call that returned true, and has not changed since
  /// the previous call. The second condition waits for editors that write a file in several steps.
  bool changed();

 private:
  /// The state of one file: the time of its last change, and its size plus one; zeros if the file does not exist.
  using Stamp = std::array<int64_t, 2>;

  std::vector<Stamp> look() const;

  std::vector<std::filesystem::path> files_;
  std::vector<Stamp> known_, last_;
};

}  // namespace sgm::preview
