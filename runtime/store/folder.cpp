#include "store/folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

Error ioError(const fs::path& file, int code) {
  return {Code::io, "'" + file.string() + "': " + std::generic_category().message(code)};
}

std::string formatText() { return "sgm store " + std::to_string(kStoreVersion) + "\n"; }

std::string placeName(const TileKey& tile) {
  return std::to_string(tile.level) + "_" + std::to_string(tile.at.x) + "_" + std::to_string(tile.at.y) + "_" +
         std::to_string(tile.at.z);
}

}  // namespace

fs::path Folder::pack(const ContentId& name) const {
  const std::string digits = nameOf(name);
  return root_ / "packs" / digits.substr(0, 2) / (digits.substr(2) + ".sgmp");
}

Result<void> Folder::make() const {
  if (Result<void> made = makeFolder(root_); !made) return made;
  const fs::path format = root_ / "format";
  std::error_code error;
  if (!fs::exists(format, error)) {
    // Another worker may have just made it.
    if (!fs::is_empty(root_, error) && !error && !fs::exists(format, error))
      return Error{Code::bad_input, "'" + root_.string() + "' is not empty and no store: name another folder"};
    const std::string text = formatText();
    if (Result<void> written = writeFile(format, std::as_bytes(std::span(text)), nullptr); !written) return written;
  }
  return check();
}

Result<void> Folder::check() const {
  const fs::path format = root_ / "format";
  std::error_code error;
  if (!fs::exists(format, error))
    return Error{Code::bad_input, "'" + root_.string() + "' is no store of baked worlds: sgm bake --out makes one"};
  const Result<std::vector<std::byte>> read = readFile(format, 64);
  if (!read) return read.error();
  const std::string text(reinterpret_cast<const char*>(read->data()), read->size());
  if (text != formatText())
    return Error{Code::bad_input, "'" + root_.string() + "' is a store of another version ('" +
                                      text.substr(0, text.find('\n')) + "', and this is " + formatText().substr(4, 7) +
                                      "): bake it anew into another folder"};
  return {};
}

Result<StoreLock> StoreLock::take(const Folder& store) {
  const fs::path path = store.root() / "format";
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return ioError(path, errno);
  StoreLock lock(file);
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno != EWOULDBLOCK) return ioError(path, errno);
  return Error{Code::busy, "another process merges into '" + store.root().string() +
                               "', or cleans it: try again when it has ended"};
}

StoreLock::~StoreLock() {
  if (file_ >= 0) ::close(file_);
}

fs::path tileFile(const fs::path& baking, const TileKey& tile) { return baking / (placeName(tile) + ".tile"); }
fs::path packFile(const fs::path& baking, const TileKey& tile) { return baking / (placeName(tile) + ".pack"); }

Result<void> makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Error{Code::io, "'" + folder.string() + "' cannot be made: " + error.message()};
  return {};
}

OpenFile::OpenFile(const fs::path& path)
    : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)), error_(file_ < 0 ? errno : 0) {}

OpenFile::~OpenFile() {
  if (file_ >= 0) ::close(file_);
}

Result<std::vector<std::byte>> OpenFile::read(uint64_t offset, size_t bytes) const {
  if (file_ < 0) return ioError(path_, error_);
  std::vector<std::byte> content(bytes);
  for (size_t done = 0; done < bytes;) {
    const ssize_t got = ::pread(file_, content.data() + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return ioError(path_, errno);
    if (got == 0) return Error{Code::io, "'" + path_.string() + "' ends before byte " + std::to_string(offset + bytes)};
    done += static_cast<size_t>(got);
  }
  return content;
}

Result<uint64_t> OpenFile::size() const {
  struct stat status {};
  if (file_ < 0) return ioError(path_, error_);
  if (::fstat(file_, &status) != 0) return ioError(path_, errno);
  if (!S_ISREG(status.st_mode)) return Error{Code::io, "'" + path_.string() + "' is no regular file"};
  return static_cast<uint64_t>(status.st_size);
}

Result<std::vector<std::byte>> readFile(const fs::path& path, uint64_t most) {
  const OpenFile file(path);
  const Result<uint64_t> bytes = file.size();
  if (!bytes) return bytes.error();
  if (*bytes > most)
    return Error{Code::limit, "'" + path.string() + "' has more than " + std::to_string(most) + " bytes"};
  return file.read(0, static_cast<size_t>(*bytes));
}

Result<std::vector<std::byte>> readFile(const fs::path& path, uint64_t offset, size_t bytes) {
  return OpenFile(path).read(offset, bytes);
}

Result<void> writeFile(const fs::path& file, std::span<const std::byte> bytes, UnfinishedFiles* unfinished) {
  Result<FileWriter> writer = FileWriter::create(file, unfinished);
  if (!writer) return writer.error();
  writer->write(bytes.data(), bytes.size());
  return writer->commit();
}

}  // namespace sgm::store
