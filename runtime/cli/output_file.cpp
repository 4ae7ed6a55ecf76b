#include "cli/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace sgm::cli {
namespace fs = std::filesystem;
namespace {

Error cannotWrite(const fs::path& path, const std::string& why) {
  return {Code::io, "cannot write " + path.string() + ": " + why, 0, 0};
}

}  // namespace

Result<OutputFile> OutputFile::open(const fs::path& path) {
  std::error_code why;
  const fs::file_status status = fs::status(path, why);
  if (fs::is_directory(status)) return cannotWrite(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return cannotWrite(path, std::strerror(errno));
    return OutputFile(path, {}, descriptor);
  }
  // Through a link, the file that it leads to is replaced, not the link.
  fs::path target = fs::exists(status) ? fs::canonical(path, why) : path;
  if (why) return cannotWrite(path, why.message());
  const fs::path part = target.string() + ".part-" + std::to_string(::getpid());
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return cannotWrite(path, std::strerror(errno));
  return OutputFile(std::move(target), part, descriptor);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), part_(std::move(other.part_)), descriptor_(std::exchange(other.descriptor_, -1)) {
  other.part_.clear();
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!part_.empty()) ::unlink(part_.c_str());
}

Error OutputFile::failure(int number) const { return cannotWrite(path_, std::strerror(number)); }

Result<void> OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failure(errno);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return {};
}

Result<void> OutputFile::commit() {
  // A full disk may show only when the bytes reach it; devices and pipes know no sync.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) return failure(errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure(errno);
  if (part_.empty()) return {};
  if (::rename(part_.c_str(), path_.c_str()) != 0) return failure(errno);
  part_.clear();
  return {};
}

}  // namespace sgm::cli
