#include "stream/edits/edit_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/checksum.h"
#include "base/file_writer.h"
#include "world/edits.h"

namespace sgm {
namespace fs = std::filesystem;

namespace {

constexpr uint64_t kJournalMagic = 0x53544944454D4753;  // "SGMEDITS"
constexpr uint32_t kJournalVersion = 1;
constexpr size_t kHeadBytes = 40;
constexpr size_t kRecordHead = 12;  // u32 length, u64 checksum of what follows
constexpr size_t kMostRecordBytes = kRecordHead + kMostEditBytes;
constexpr uint64_t kMostJournalBytes = uint64_t{1} << 30;
constexpr size_t kLeastCompacted = 256;  // operations: fewer are not worth a new file
constexpr int kMostTries = 100;

using Bytes = std::vector<std::byte>;

Error journalError(Code code, const fs::path& path, const std::string& why) {
  return {code, "journal '" + path.string() + "': " + why};
}
Error ioError(const fs::path& path, int code) {
  return journalError(Code::io, path, std::generic_category().message(code));
}

/// A file descriptor.
class File {
 public:
  explicit File(int file) : file_(file) {}
  File(File&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  ~File() {
    if (file_ >= 0) ::close(file_);
  }
  int get() const { return file_; }
  int release() { return std::exchange(file_, -1); }

 private:
  int file_;
};

Bytes headOf(const WorldIdentity& world) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(kJournalMagic);
  out.put(kJournalVersion);
  out.put(world.cell);
  out.put(world.grammar);
  out.put(world.seed);
  out.put(checksum(bytes));
  return bytes;
}

/// Whose journal these bytes begin. Precondition: there are kHeadBytes.
Result<void> checkHead(const fs::path& path, std::span<const std::byte> bytes, const WorldIdentity& world) {
  ByteReader in(bytes);
  const auto bad = [&](const std::string& why) { return journalError(Code::bad_input, path, why); };
  if (in.get<uint64_t>() != kJournalMagic) return bad("it is no journal of edits");
  if (const auto version = in.get<uint32_t>(); version != kJournalVersion) {
    return bad("it has version " + std::to_string(version) + "; this program knows version " +
               std::to_string(kJournalVersion));
  }
  const WorldIdentity of{0, 0, in.get<int32_t>()};
  const auto grammar = in.get<uint64_t>(), seed = in.get<uint64_t>();
  if (in.get<uint64_t>() != checksum(bytes.first(kHeadBytes - 8))) return bad("its head is damaged");
  // The first of them holds the others too.
  const char* differs = seed != world.seed         ? "seed"
                        : of.cell != world.cell    ? "finest cell"
                        : grammar != world.grammar ? "grammar, parameters of it, or fields of the host's"
                                                   : nullptr;
  if (differs) return bad("it belongs to another world, with another " + std::string(differs));
  return {};
}

void putRecord(const EditOperation& operation, Bytes& bytes) {
  Bytes payload;
  encodeEdit(operation, payload);
  ByteWriter out(bytes);
  out.put(static_cast<uint32_t>(payload.size()));
  out.put(checksum(payload));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
}

/// The operation that these bytes begin with, and how many of them are its.
std::optional<std::pair<EditOperation, size_t>> getRecord(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  const auto length = in.get<uint32_t>();
  const auto sum = in.get<uint64_t>();
  if (in.failed() || length > in.left()) return std::nullopt;
  const auto payload = bytes.subspan(kRecordHead, length);
  if (checksum(payload) != sum) return std::nullopt;
  ByteReader body(payload);
  Result<EditOperation> operation = decodeEdit(body);
  if (!operation || body.left() > 0) return std::nullopt;
  return std::pair(*operation, kRecordHead + length);
}

/// The file, locked, while it has that name: another may be about to put a new one in its place.
Result<File> openLocked(const fs::path& path) {
  for (int i = 0; i < kMostTries; ++i) {
    File file(::open(path.c_str(), O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0666));
    struct stat ours {
    }, there{};
    if (file.get() < 0 || fstat(file.get(), &ours) != 0) return ioError(path, errno);
    if (!S_ISREG(ours.st_mode)) return journalError(Code::io, path, "it is no regular file");
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) return journalError(Code::limit, path, "another world or program has it open");
      return ioError(path, errno);
    }
    if (stat(path.c_str(), &there) == 0 && ours.st_ino == there.st_ino && ours.st_dev == there.st_dev) return file;
  }
  return journalError(Code::limit, path, "others keep on replacing it");
}

Result<Bytes> readAll(const fs::path& path, int file) {
  struct stat there {};
  if (fstat(file, &there) != 0) return ioError(path, errno);
  const auto size = static_cast<uint64_t>(there.st_size);
  if (size > kMostJournalBytes) return journalError(Code::limit, path, "it is larger than a gigabyte");
  Bytes bytes(static_cast<size_t>(size));
  for (size_t at = 0; at < bytes.size();) {
    const ssize_t got = pread(file, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return ioError(path, errno);
    if (got == 0) bytes.resize(at);
    at += static_cast<size_t>(got);
  }
  return bytes;
}

struct Written {
  size_t bytes = 0;  ///< that the disk has
  int error = 0;     ///< errno where that is not all
};

/// Returns when the disk has the bytes, or as many of them as it takes.
Written writeAt(int file, std::span<const std::byte> bytes, uint64_t at) {
  Written done;
  while (done.bytes < bytes.size() && done.error == 0) {
    const auto rest = bytes.subspan(done.bytes);
    const ssize_t sent = pwrite(file, rest.data(), rest.size(), static_cast<off_t>(at + done.bytes));
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) done.error = sent < 0 ? errno : EIO;
    if (sent > 0) done.bytes += static_cast<size_t>(sent);
  }
  if (fdatasync(file) == 0) return done;
  return {0, done.error != 0 ? done.error : errno};
}

/// The records that these bytes begin with, and the bytes that they take.
struct WholeRecords {
  size_t count = 0, bytes = 0;
};

/// Precondition: records stand in the bytes, of which the last may be cut off.
WholeRecords wholeRecords(std::span<const std::byte> bytes) {
  WholeRecords whole;
  while (bytes.size() - whole.bytes >= kRecordHead) {
    const size_t size = kRecordHead + ByteReader(bytes.subspan(whole.bytes)).get<uint32_t>();
    if (size > bytes.size() - whole.bytes) break;
    whole.bytes += size;
    ++whole.count;
  }
  return whole;
}

/// A file's new name is on the disk only when its folder is. Some file systems cannot, and need not.
void syncFolder(const fs::path& path) {
  const fs::path folder = path.parent_path();
  const File file(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.get() >= 0) fsync(file.get());
}

Result<void> writeWhole(const fs::path& path, std::span<const std::byte> bytes) {
  Result<FileWriter> writer = FileWriter::create(path);
  if (!writer) return writer.error();
  writer->write(bytes.data(), bytes.size());
  if (Result<void> done = writer->commit(); !done) return done;
  syncFolder(path);
  return {};
}

/// Copies what is damaged to a name of its own. Only who has the journal locked does this.
Result<fs::path> setAside(const fs::path& path, std::span<const std::byte> bytes) {
  for (int i = 1; i <= kMostTries; ++i) {
    fs::path aside = path;
    aside += ".damaged-" + std::to_string(i);
    std::error_code why;
    if (fs::exists(fs::symlink_status(aside, why))) continue;
    if (Result<void> kept = writeWhole(aside, bytes); !kept) return kept.error();
    return aside;
  }
  return journalError(Code::limit, path, "it is damaged, and so were " + std::to_string(kMostTries) + " before it");
}

}  // namespace

Result<OpenedJournal> EditJournal::open(const fs::path& given, const WorldIdentity& world) {
  std::error_code why;
  const fs::path followed = fs::weakly_canonical(given, why), path = why ? given : followed;
  Result<File> file = openLocked(path);
  if (!file) return file.error();
  Result<Bytes> bytes = readAll(path, file->get());
  if (!bytes) return bytes.error();

  OpenedJournal opened;
  const Bytes head = headOf(world);
  if (bytes->size() < kHeadBytes && std::equal(bytes->begin(), bytes->end(), head.begin())) {
    // New, or killed while it was.
    if (const Written written = writeAt(file->get(), head, 0); written.error != 0) return ioError(path, written.error);
    syncFolder(path);
    *bytes = head;
  }
  if (bytes->size() < kHeadBytes) return journalError(Code::bad_input, path, "it is no journal of edits");
  if (Result<void> ours = checkHead(path, *bytes, world); !ours) return ours.error();

  size_t whole = kHeadBytes;
  const std::span<const std::byte> all(*bytes);
  while (auto record = getRecord(all.subspan(whole))) {
    opened.operations.push_back(record->first);
    whole += record->second;
  }
  const size_t rest = all.size() - whole;
  const bool damaged = rest > kMostRecordBytes;  // more than one operation that was not written to its end
  if (damaged) {
    Result<fs::path> aside = setAside(path, all);
    if (!aside) return aside.error();
    opened.damaged = *aside;
    opened.message = "journal '" + path.string() + "' is damaged after " + std::to_string(opened.operations.size()) +
                     " operations, which are kept; the rest stands in '" + aside->string() + "'";
  } else if (rest > 0) {
    opened.cut_bytes = rest;
    opened.message = "journal '" + path.string() + "': its last operation was not written to its end; " +
                     std::to_string(rest) + " bytes are cut off";
  }

  std::vector<EditOperation> essential = essentialEdits(opened.operations);
  const bool compact = opened.operations.size() >= kLeastCompacted && 2 * essential.size() < opened.operations.size();
  if (compact) {
    opened.left_out = opened.operations.size() - essential.size();
    opened.operations = std::move(essential);
  }
  if (damaged || compact) {
    Bytes anew = head;
    for (const EditOperation& operation : opened.operations) putRecord(operation, anew);
    if (Result<void> written = writeWhole(path, anew); !written) return written.error();
    Result<File> replaced = openLocked(path);
    if (!replaced) return replaced.error();
    *file = std::move(*replaced);
    whole = anew.size();
  } else if (rest > 0 && ftruncate(file->get(), static_cast<off_t>(whole)) != 0) {
    return ioError(path, errno);
  }
  opened.journal.reset(new EditJournal(path, file->get(), whole));
  file->release();
  return opened;
}

EditJournal::~EditJournal() {
  try {
    (void)flush();
  } catch (const std::bad_alloc&) {
    // What was flushed before is safe.
  }
  ::close(file_);
}

void EditJournal::append(std::span<const EditOperation> operations) {
  const std::lock_guard lock(appending_);
  const size_t before = waiting_.size();
  try {
    for (const EditOperation& operation : operations) putRecord(operation, waiting_);
  } catch (const std::bad_alloc&) {
    waiting_.resize(before);  // half a record would be damage to all that follows
    throw;
  }
}

Result<void> EditJournal::flush() {
  const std::lock_guard writing(writing_);
  {
    const std::lock_guard appending(appending_);
    unwritten_.insert(unwritten_.end(), waiting_.begin(), waiting_.end());
    waiting_.clear();
  }
  if (unwritten_.empty()) return {};
  const Written written = writeAt(file_, unwritten_, size_);
  // The rest of a record that was cut off stands where the next try writes.
  const size_t kept = wholeRecords(std::span(unwritten_).first(written.bytes)).bytes;
  size_ += kept;
  unwritten_.erase(unwritten_.begin(), unwritten_.begin() + static_cast<std::ptrdiff_t>(kept));
  if (unwritten_.empty()) return {};
  Error error = ioError(path_, written.error);
  const size_t lost = wholeRecords(unwritten_).count;
  error.message += "; " + std::to_string(lost) + (lost == 1 ? " edit is not kept" : " edits are not kept");
  return error;
}

}  // namespace sgm
