#include "base/file_reader.h"

#include <algorithm>
#include <cerrno>

#include "base/plain_text.h"
#include "base/platform/file.h"

namespace sgm {
namespace {

constexpr size_t kPiece = size_t{64} << 10;

Error readError(const std::string& name, const std::string& why) {
  return {Code::io, "cannot read " + name + ": " + why};
}

Error tooLarge(const std::string& name, uint64_t max_bytes) {
  return {Code::limit, name + " is larger than " + std::to_string(max_bytes) + " bytes"};
}

Result<platform::File> openForReading(const std::filesystem::path& path, Readable readable) {
  const auto failed = [&] {
    return readError(path.string(), errno == ENOENT || errno == ENOTDIR ? "no such file" : systemMessage(errno));
  };
  platform::FileStatus status;
  if (platform::statusAt(path, status, true) != 0) return failed();
  const bool regular_only = readable == Readable::regular_files;
  if (!regular_only && status.kind == platform::FileStatus::Kind::folder)
    return readError(path.string(), "it is a folder");
  if (regular_only && !status.isRegular()) return readError(path.string(), "it is not a regular file");
  platform::File file(platform::openFile(path, platform::kRead | (regular_only ? 0u : platform::kWait)));
  if (!file) return failed();
  return file;
}

/// Reads at most `bytes` bytes from the descriptor `file` and appends them to `content`. Returns false, with the reason
/// in errno, if reading fails.
bool append(int file, std::string& content, size_t bytes) {
  const size_t before = content.size();
  content.resize(before + bytes);
  size_t done = before;
  while (done < content.size()) {
    const ptrdiff_t got = platform::readNext(file, content.data() + done, content.size() - done);
    if (got < 0) return false;
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  content.resize(done);
  return true;
}

}  // namespace

Result<std::string> readOpenFile(int file, const std::string& name, uint64_t max_bytes) {
  platform::FileStatus status;
  if (platform::statusOf(file, status) != 0) return readError(name, systemMessage(errno));
  const uint64_t reported = status.isRegular() ? status.bytes : 0;
  if (reported > max_bytes) return tooLarge(name, max_bytes);
  std::string content;
  // Reads one byte more than the reported size. If this byte does not exist, the file has ended, and no second read is
  // needed.
  size_t next = std::max(static_cast<size_t>(reported) + 1, reported > 0 ? 0 : kPiece);
  for (;;) {
    const size_t before = content.size();
    if (!append(file, content, next)) return readError(name, systemMessage(errno));
    if (content.size() > max_bytes) return tooLarge(name, max_bytes);
    if (content.size() - before < next) return content;
    next = std::max(kPiece, content.size());
  }
}

Result<std::string> readFile(const std::filesystem::path& path, uint64_t max_bytes, Readable readable) {
  const Result<platform::File> file = openForReading(path, readable);
  if (!file) return file.error();
  return readOpenFile(file->number(), path.string(), max_bytes);
}

Result<std::string> readBeginning(const std::filesystem::path& path, size_t bytes) {
  const Result<platform::File> file = openForReading(path, Readable::regular_files);
  if (!file) return file.error();
  std::string content;
  if (!append(file->number(), content, bytes)) return readError(path.string(), systemMessage(errno));
  return content;
}

}  // namespace sgm
