#include "tools/preview/file_watch.h"

#include <system_error>
#include <utility>

namespace sgm::preview {

void FileWatch::watch(std::vector<std::filesystem::path> files) {
  files_ = std::move(files);
  known_ = last_ = look();
}

bool FileWatch::changed() {
  std::vector<Stamp> now = look();
  const bool rests = now == last_;
  last_ = std::move(now);
  if (!rests || last_ == known_) return false;
  known_ = last_;
  return true;
}

std::vector<FileWatch::Stamp> FileWatch::look() const {
  std::vector<Stamp> stamps;
  for (const std::filesystem::path& file : files_) {
    Stamp stamp{};
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(file, missing);
    if (!missing) {
      const auto size = std::filesystem::file_size(file, missing);
      stamp = {static_cast<int64_t>(time.time_since_epoch().count()), missing ? 0 : static_cast<int64_t>(size) + 1};
    }
    stamps.push_back(stamp);
  }
  return stamps;
}

}  // namespace sgm::preview
