#pragma once
// Whether files have been saved since somebody looked.

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sgm::preview {

/// The files of one grammar, as they were when they were read last. One thread.
class FileWatch {
 public:
  /// Files that do not exist are watched too: they may come.
  void watch(std::vector<std::filesystem::path> files);

  /// Whether a file differs from what it was at watch(), or at the last true answer, and has not changed since the
  /// call before: an editor that writes in pieces is waited for.
  bool changed();

 private:
  /// Of one file: the time of its last change, and one more than its size; zeros where the file does not exist.
  using Stamp = std::array<int64_t, 2>;

  std::vector<Stamp> look() const;

  std::vector<std::filesystem::path> files_;
  std::vector<Stamp> known_, last_;
};

}  // namespace sgm::preview
