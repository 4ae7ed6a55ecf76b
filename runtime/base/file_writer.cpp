#include "base/file_writer.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/plain_text.h"
#include "base/platform/file.h"

namespace sgm {
namespace fs = std::filesystem;
namespace {

constexpr size_t kBufferBytes = size_t{1} << 20;
constexpr int kMaxLinks = 40;
constexpr int kMaxNames = 1000;

Error writeError(const fs::path& target, const std::string& reason) {
  return {Code::io, "cannot write '" + target.string() + "': " + reason};
}

Error writeError(const fs::path& target, int code) { return writeError(target, systemMessage(code)); }

/// Returns the path with symbolic links in its last component resolved. The file at the end of the links need not
/// exist.
Result<std::string> followed(const fs::path& target) {
  fs::path place = target;
  for (int links = 0; links < kMaxLinks; ++links) {
    std::error_code why;
    if (!fs::is_symlink(fs::symlink_status(place, why))) return place.string();
    const fs::path to = fs::read_symlink(place, why);
    if (why) return writeError(target, systemMessage(why));
    place = place.parent_path() / to;
  }
  return writeError(target, ELOOP);
}

std::string folderOf(const std::string& place) {
  const fs::path folder = fs::path(place).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Returns the path of temporary file `number` in the folder of the target. File systems limit a name to 255 bytes, so
/// the target's name is cut to 200.
std::string nameBeside(const std::string& place, int number) {
  const fs::path path(place);
  return (path.parent_path() / path.filename().string().substr(0, 200)).string() + ".sgm-part" + std::to_string(number);
}

bool isAt(int file, const std::string& name) {
  platform::FileStatus ours, there;
  return platform::statusOf(file, ours) == 0 && platform::statusAt(name, there, false) == 0 && ours.isSameFile(there);
}

/// Removes the temporary file if no process holds its lock. Only the holder of the lock may remove a temporary file:
/// this is the process that writes it or, after that process has ended, the first process that gets the lock.
void removeIfLeft(const std::string& name) {
  const platform::File file(platform::openFile(name, platform::kWrite | platform::kNoFollow));
  if (file && platform::lockFile(file.number()) == 0 && isAt(file.number(), name)) platform::removeFile(name);
}

void removeLeft(const std::string& place) {
  for (int number = 0; number < kMaxNames; ++number) {
    const std::string name = nameBeside(place, number);
    platform::FileStatus there;
    if (platform::statusAt(name, there, false) != 0) return;
    removeIfLeft(name);
  }
}

}  // namespace

int UnfinishedFiles::announce(const std::string& name) {
  for (size_t i = 0; i < slots_.size() && name.size() < slots_[i].name.size(); ++i) {
    Slot& slot = slots_[i];
    int expected = Slot::open;
    if (!slot.state.compare_exchange_strong(expected, Slot::filling)) continue;
    std::memcpy(slot.name.data(), name.c_str(), name.size() + 1);
    slot.state = Slot::whole;
    return static_cast<int>(i);
  }
  return -1;
}

void UnfinishedFiles::remove() const noexcept {
  for (const Slot& slot : slots_)
    if (slot.state == Slot::whole) platform::removeFileInHandler(slot.name.data());
}

Result<FileWriter> FileWriter::create(const fs::path& target, UnfinishedFiles* unfinished, Naming naming) {
  const Result<std::string> place = followed(target);
  if (!place) return place.error();
  platform::FileStatus there;
  const bool replaces = platform::statusAt(*place, there, true) == 0;
  if (!replaces && errno != ENOENT) return writeError(target, errno);
  if (replaces && there.kind == platform::FileStatus::Kind::folder) return writeError(target, "it is a folder");
  if (replaces && !there.isRegular()) return writeError(target, "it is not a regular file");
  // commit() renames over the target, which would succeed even if the target is write-protected; so check the
  // protection here.
  if (replaces && !platform::isWritable(*place)) return writeError(target, errno);

  removeLeft(*place);
  FileWriter writer(target, *place, naming == Naming::nameless ? platform::openNamelessFile(folderOf(*place)) : -1,
                    unfinished);
  if (writer.file_ < 0) {
    if (const int code = writer.openNamed(); code != 0) return writeError(target, code);
  } else {
    platform::lockFile(writer.file_);
  }
  if (replaces && platform::takeRights(writer.file_, *place) != 0) return writeError(target, errno);
  return writer;
}

FileWriter::FileWriter(fs::path target, std::string place, int file, UnfinishedFiles* unfinished)
    : target_(std::move(target)), place_(std::move(place)), file_(file), unfinished_(unfinished) {
  buffer_.reserve(kBufferBytes);
}

FileWriter::FileWriter(FileWriter&& other) noexcept
    : target_(std::move(other.target_)),
      place_(std::move(other.place_)),
      temporary_(std::exchange(other.temporary_, {})),
      file_(std::exchange(other.file_, -1)),
      unfinished_(other.unfinished_),
      slot_(std::exchange(other.slot_, -1)),
      buffer_(std::move(other.buffer_)),
      bytes_(other.bytes_),
      first_error_(other.first_error_),
      undo_(other.undo_) {}

FileWriter::~FileWriter() {
  if (!temporary_.empty()) platform::removeFile(temporary_);
  forgetName();
  close();
}

/// Creates a temporary file that has a name from the beginning. Returns 0, or errno if no file could be created.
int FileWriter::openNamed() {
  for (int number = 0; number < kMaxNames; ++number) {
    temporary_ = nameBeside(place_, number);
    file_ = platform::openFile(temporary_,
                               platform::kWrite | platform::kCreate | platform::kExclusive | platform::kNoFollow);
    if (file_ < 0 && errno == EEXIST) continue;
    if (file_ < 0) break;
    announce();
    // Until this process holds the lock, another process may take the new file for a leftover of a killed process and
    // remove it; so check that the file still exists.
    if (platform::lockFile(file_) == 0 ? isAt(file_, temporary_) : errno != EWOULDBLOCK) return 0;
    forgetName();
    close();
    errno = EEXIST;
  }
  temporary_.clear();
  return errno;
}

/// Gives the nameless temporary file a name in the target's folder. Returns 0, or errno on failure.
int FileWriter::nameNameless() {
  for (int number = 0; number < kMaxNames; ++number) {
    std::string name = nameBeside(place_, number);
    if (platform::nameFile(file_, name) == 0) {
      temporary_ = std::move(name);
      announce();
      return 0;
    }
    if (errno != EEXIST) break;
  }
  return errno;
}

void FileWriter::announce() {
  if (unfinished_ != nullptr) slot_ = unfinished_->announce(temporary_);
}

void FileWriter::forgetName() {
  if (slot_ >= 0) unfinished_->forget(slot_);
  slot_ = -1;
  temporary_.clear();
}

void FileWriter::close() {
  if (file_ >= 0 && platform::closeFile(std::exchange(file_, -1)) != 0 && first_error_ == 0) first_error_ = errno;
}

void FileWriter::write(const void* bytes, size_t count) {
  const char* from = static_cast<const char*>(bytes);
  bytes_ += count;
  if (buffer_.size() + count > kBufferBytes) flush();
  if (count > kBufferBytes) {
    send(from, count);
  } else {
    buffer_.insert(buffer_.end(), from, from + count);
  }
}

void FileWriter::flush() {
  send(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void FileWriter::send(const char* from, size_t count) {
  while (first_error_ == 0 && count > 0) {
    const ptrdiff_t sent = platform::writeNext(file_, from, count);
    if (sent <= 0) {
      first_error_ = sent < 0 ? errno : EIO;
      return;
    }
    from += sent;
    count -= static_cast<size_t>(sent);
  }
}

Error FileWriter::errorFrom(int code) const { return writeError(target_, code); }

Result<void> FileWriter::finish() {
  if (first_error_ == 0 && file_ >= 0) {
    flush();
    // Some file systems report a full disk only when the file is synchronised (fsync).
    if (first_error_ == 0 && platform::syncFile(file_) != 0 && errno != EINVAL) first_error_ = errno;
    if (first_error_ == 0 && temporary_.empty()) first_error_ = nameNameless();
  }
  if (first_error_ != 0) return errorFrom(first_error_);
  return {};
}

Result<void> FileWriter::commit() {
  if (Result<void> done = finish(); !done) return done;
  if (platform::replaceFile(temporary_, place_) != 0) return errorFrom(errno);
  forgetName();
  close();
  return {};
}

Result<void> FileWriter::commitReversibly() {
  if (Result<void> done = finish(); !done) return done;
  if (platform::exchangeFiles(temporary_, place_) == 0) {
    undo_ = Undo::exchange;  // after the exchange, temporary_ is the name of the previous target file
    return {};
  }
  platform::FileStatus there;
  if (platform::statusAt(place_, there, true) != 0) undo_ = Undo::remove;
  return commit();
}

void FileWriter::undo() {
  if (undo_ == Undo::exchange) platform::exchangeFiles(temporary_, place_);
  if (undo_ == Undo::remove) platform::removeFile(place_);
  undo_ = Undo::impossible;
}

}  // namespace sgm
