#include "store/folder.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "base/plain_text.h"
#include "base/platform/file.h"

namespace sgm::store {
namespace fs = std::filesystem;
namespace {

Error ioError(const fs::path& file, int code) { return {Code::io, "'" + file.string() + "': " + systemMessage(code)}; }

Error lockError(const Folder& store, const fs::path& path, int number) {
  const std::string root = "'" + store.root().string() + "'";
  if (number == EWOULDBLOCK || number == EACCES)
    return {Code::busy,
            "another process is merging into " + root + " or cleaning it: try again when that process has ended"};
  if (number == ENOLCK || number == ENOSYS || number == EOPNOTSUPP || number == EBADF)
    return {Code::unsupported,
            "the file system of " + root + " has no locks, which merging needs: mount it with locks, or merge a copy"};
  return ioError(path, number);
}

constexpr uint64_t kMaxFormat = 64;  ///< maximum size of the format file, in bytes

std::string formatText() { return "sgm store " + std::to_string(kStoreVersion) + "\n"; }

std::string placeName(const TileKey& tile) {
  return std::to_string(tile.level) + "_" + std::to_string(tile.at.x) + "_" + std::to_string(tile.at.y) + "_" +
         std::to_string(tile.at.z);
}

/// Gives access to the files of a store in a local folder.
class FolderFiles final : public StoreFiles {
 public:
  explicit FolderFiles(fs::path root) : root_(std::move(root)) {}

  std::string nameOf(const std::string& file) const override {
    return file.empty() ? root_.string() : (root_ / file).string();
  }
  Result<std::shared_ptr<const StoredFile>> open(const std::string& file, std::optional<uint64_t>) override {
    const fs::path path = root_ / file;
    std::error_code error;
    if (!fs::exists(path, error) && !error) return std::shared_ptr<const StoredFile>();
    Result<std::shared_ptr<const OpenFile>> opened = OpenFile::open(path);
    if (!opened) return opened.error();
    return std::shared_ptr<const StoredFile>(std::move(*opened));
  }
  bool isFar() const override { return false; }

 private:
  const fs::path root_;
};

}  // namespace

std::string worldFileName(const ContentId& key) { return "worlds/" + nameOf(key) + ".sgmi"; }
std::string packFileName(const ContentId& name) {
  const std::string digits = nameOf(name);
  return "packs/" + digits.substr(0, 2) + "/" + digits.substr(2) + ".sgmp";
}

std::unique_ptr<StoreFiles> folderFiles(const fs::path& root) { return std::make_unique<FolderFiles>(root); }

Result<void> checkFormat(StoreFiles& files) {
  const std::string root = files.nameOf("");
  const auto none = [&] {
    return Error{Code::bad_input, "'" + root + "' is not a store of baked worlds (its file '" + kFormatFile +
                                      "' is missing or has other contents): create a store with sgm bake --out"};
  };
  const Result<std::shared_ptr<const StoredFile>> format = files.open(kFormatFile, std::nullopt);
  if (!format) return format.error();
  if (*format == nullptr || (*format)->size() > kMaxFormat) return none();
  const auto read = (*format)->read(0, static_cast<size_t>((*format)->size()), std::pmr::get_default_resource());
  if (!read) return read.error();
  const std::string text(reinterpret_cast<const char*>(read->data()), read->size());
  if (text == formatText()) return {};
  if (text.rfind("sgm store ", 0) != 0) return none();
  return Error{Code::bad_input, "'" + root + "' is a store of another version ('" + text.substr(0, text.find('\n')) +
                                    "', but this program uses " + formatText().substr(4, 7) +
                                    "): bake its worlds again into another folder"};
}

Result<void> Folder::make() const {
  if (Result<void> made = makeFolder(root_); !made) return made;
  const fs::path format = root_ / kFormatFile;
  std::error_code error;
  if (!fs::exists(format, error)) {
    // The format file is missing. A folder without other files is accepted: another process may be about to write the
    // format file, or may have been killed before it could.
    for (fs::directory_iterator entry(root_, error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name != kFormatFile && name.rfind("format.sgm-part", 0) != 0)
        return Error{Code::bad_input, "'" + root_.string() + "' is neither empty nor a store: pass another folder"};
    }
    if (error) return ioError(root_, error.value());
    const std::string text = formatText();
    if (Result<void> written = writeFile(format, std::as_bytes(std::span(text)), nullptr); !written) return written;
  }
  return check();
}

Result<void> Folder::check() const {
  FolderFiles files(root_);
  return checkFormat(files);
}

Result<StoreLock> StoreLock::take(const Folder& store, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kBetweenLooks{100};
  const auto until = std::chrono::steady_clock::now() + patience;
  const fs::path path = store.root() / kFormatFile;
  // Opened for writing, because network file systems can lock only such files.
  const int file = platform::openFile(path, platform::kRead | platform::kWrite);
  if (file < 0) return ioError(path, errno);
  StoreLock lock(file);
  // Does not wait for ever: the process that holds the lock may hang, perhaps on another machine.
  while (platform::lockFile(file) != 0) {
    if ((errno == EWOULDBLOCK || errno == EACCES) && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(kBetweenLooks);
      continue;
    }
    return lockError(store, path, errno);
  }
  return lock;
}

StoreLock::~StoreLock() {
  if (file_ >= 0) platform::closeFile(file_);
}

fs::path tileFile(const fs::path& baking, const TileKey& tile) { return baking / (placeName(tile) + ".tile"); }
fs::path packFile(const fs::path& baking, const TileKey& tile) { return baking / (placeName(tile) + ".pack"); }

Result<void> makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Error{Code::io, "'" + folder.string() + "' cannot be created: " + systemMessage(error)};
  return {};
}

OpenFile::OpenFile(fs::path path, int file, uint64_t size) : path_(std::move(path)), file_(file), size_(size) {}

OpenFile::~OpenFile() { platform::closeFile(file_); }

Result<std::shared_ptr<const OpenFile>> OpenFile::open(const fs::path& path) {
  platform::File file(platform::openFile(path, platform::kRead));
  platform::FileStatus status;
  if (!file || platform::statusOf(file.number(), status) != 0) return ioError(path, errno);
  if (!status.isRegular()) return Error{Code::io, "'" + path.string() + "' is not a regular file"};
  std::shared_ptr<const OpenFile> opened(new OpenFile(path, file.number(), status.bytes));
  file.release();
  return opened;
}

Result<std::pmr::vector<std::byte>> OpenFile::read(uint64_t offset, size_t bytes,
                                                   std::pmr::memory_resource* memory) const {
  const auto ends = [&] {
    return Error{Code::io, "'" + path_.string() + "' ends before byte " + std::to_string(offset + bytes)};
  };
  if (offset > size_ || bytes > size_ - offset) return ends();
  std::pmr::vector<std::byte> content(bytes, memory);
  for (size_t done = 0; done < bytes;) {
    const ptrdiff_t got = platform::readAt(file_, content.data() + done, bytes - done, offset + done);
    if (got < 0) return ioError(path_, errno);
    if (got == 0) return ends();
    done += static_cast<size_t>(got);
  }
  return content;
}

Result<ContentId> idOfFile(const StoredFile& file) {
  constexpr uint64_t kPiece = uint64_t{1} << 20;
  IdStream stream;
  for (uint64_t at = 0; at < file.size(); at += kPiece) {
    const auto piece = file.read(at, std::min(kPiece, file.size() - at), std::pmr::get_default_resource());
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
  if (platform::syncFolder(folder) != 0) return ioError(folder, errno);
  return {};
}

Result<void> writeFile(const fs::path& file, std::span<const std::byte> bytes, UnfinishedFiles* unfinished) {
  Result<FileWriter> writer = FileWriter::create(file, unfinished);
  if (!writer) return writer.error();
  writer->write(bytes.data(), bytes.size());
  return writer->commit();
}

}  // namespace sgm::store
