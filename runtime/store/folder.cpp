#include "store/folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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
    // Another worker may be about to make it, or have been killed while it was.
    for (fs::directory_iterator entry(root_, error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name != "format" && name.rfind("format.sgm-part", 0) != 0)
        return Error{Code::bad_input, "'" + root_.string() + "' is not empty and no store: name another folder"};
    }
    if (error) return ioError(root_, error.value());
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
  // Network file systems lock only what is open for writing.
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return ioError(path, errno);
  StoreLock lock(file);
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno == EWOULDBLOCK || errno == EACCES)
    return Error{Code::busy, "another process merges into '" + store.root().string() +
                                 "', or cleans it: try again when it has ended"};
  if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP || errno == EBADF)
    return Error{Code::unsupported, "the file system of '" + store.root().string() +
                                        "' has no locks, which merging needs: mount it with locks, or merge a copy"};
  return ioError(path, errno);
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

OpenFile::OpenFile(fs::path path, int file, uint64_t size) : path_(std::move(path)), file_(file), size_(size) {}

OpenFile::~OpenFile() { ::close(file_); }

Result<std::shared_ptr<const OpenFile>> OpenFile::open(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return ioError(path, errno);
  struct stat status {};
  const int error = ::fstat(file, &status) == 0 ? 0 : errno;
  if (error != 0 || !S_ISREG(status.st_mode)) {
    ::close(file);
    if (error != 0) return ioError(path, error);
    return Error{Code::io, "'" + path.string() + "' is no regular file"};
  }
  return std::shared_ptr<const OpenFile>(new OpenFile(path, file, static_cast<uint64_t>(status.st_size)));
}

Result<std::vector<std::byte>> OpenFile::read(uint64_t offset, size_t bytes) const {
  const auto ends = [&] {
    return Error{Code::io, "'" + path_.string() + "' ends before byte " + std::to_string(offset + bytes)};
  };
  if (offset > size_ || bytes > size_ - offset) return ends();
  std::vector<std::byte> content(bytes);
  for (size_t done = 0; done < bytes;) {
    const ssize_t got = ::pread(file_, content.data() + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return ioError(path_, errno);
    if (got == 0) return ends();
    done += static_cast<size_t>(got);
  }
  return content;
}

Result<ContentId> idOfFile(const OpenFile& file) {
  constexpr uint64_t kPiece = uint64_t{1} << 20;
  IdStream stream;
  for (uint64_t at = 0; at < file.size(); at += kPiece) {
    const Result<std::vector<std::byte>> piece = file.read(at, std::min(kPiece, file.size() - at));
    if (!piece) return piece.error();
    stream.add(*piece);
  }
  return stream.id();
}

bool isPack(const fs::path& path, const PackFile& pack) {
  const Result<std::shared_ptr<const OpenFile>> file = OpenFile::open(path);
  if (!file || (*file)->size() != pack.bytes) return false;
  const Result<ContentId> id = idOfFile(**file);
  return id && *id == pack.name;
}

Result<void> syncFolder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return ioError(folder, errno);
  // Some file systems have nothing to do, and say so.
  const int error = ::fsync(file) == 0 || errno == EINVAL ? 0 : errno;
  ::close(file);
  if (error != 0) return ioError(folder, error);
  return {};
}

Result<std::vector<std::byte>> readFile(const fs::path& path, uint64_t most) {
  const Result<std::shared_ptr<const OpenFile>> file = OpenFile::open(path);
  if (!file) return file.error();
  if ((*file)->size() > most)
    return Error{Code::limit, "'" + path.string() + "' has more than " + std::to_string(most) + " bytes"};
  return (*file)->read(0, static_cast<size_t>((*file)->size()));
}

Result<void> writeFile(const fs::path& file, std::span<const std::byte> bytes, UnfinishedFiles* unfinished) {
  Result<FileWriter> writer = FileWriter::create(file, unfinished);
  if (!writer) return writer.error();
  writer->write(bytes.data(), bytes.size());
  return writer->commit();
}

}  // namespace sgm::store
