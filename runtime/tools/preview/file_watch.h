#pragma once
// Tells whether files have been saved.

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sgm::preview {

/// The files of one grammar, in the state of the last read. One thread.
class FileWatch {
 public:
  /// Also watches files that do not exist yet.
  void watch(std::vector<std::filesystem::path> files);

  /// Whether a file differs from its state at watch() or at the last true result, and has not changed since the
  /// previous call. So it waits for editors that write in several steps.
  bool changed();

 private:
  /// Of one file: the time of its last change, and its size plus one; zeros if the file does not exist.
  using Stamp = std::array<int64_t, 2>;

  std::vector<Stamp> look() const;

  std::vector<std::filesystem::path> files_;
  std::vector<Stamp> known_, last_;
};

}  // namespace sgm::preview
