#include "stream/edits/edit_journal.h"

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
#include "base/plain_text.h"
#include "base/platform/file.h"
#include "world/edits.h"

namespace sgm {
namespace fs = std::filesystem;

namespace {

constexpr uint64_t kJournalMagic = 0x53544944454D4753;  // "SGMEDITS"
constexpr uint32_t kJournalVersion = 1;
constexpr size_t kHeadBytes = 40;
constexpr size_t kRecordHead = 12;  // size of a record's header in bytes: length of the content (u32), checksum of the
                                    // content (u64)
constexpr size_t kMaxRecordBytes = kRecordHead + kMaxEditBytes;
constexpr uint64_t kMaxJournalBytes = uint64_t{1} << 30;
constexpr size_t kLeastCompacted = 256;  // minimum number of operations at which a journal file is compacted
constexpr int kMaxTries = 100;

using Bytes = std::vector<std::byte>;

Error journalError(Code code, const fs::path& path, const std::string& why) {
  return {code, "journal '" + path.string() + "': " + why};
}
Error ioError(const fs::path& path, int code) { return journalError(Code::io, path, systemMessage(code)); }

using platform::File;

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

/// Checks that the bytes start with the header of this world's journal. Precondition: there are at least kHeadBytes
/// bytes.
Result<void> checkHead(const fs::path& path, std::span<const std::byte> bytes, const WorldIdentity& world,
                       const FormerGrammar& former) {
  ByteReader in(bytes);
  const auto bad = [&](const std::string& why) { return journalError(Code::bad_input, path, why); };
  if (in.get<uint64_t>() != kJournalMagic) return bad("it is not an edit journal");
  if (const auto version = in.get<uint32_t>(); version != kJournalVersion) {
    return bad("it has version " + std::to_string(version) + "; this program supports version " +
               std::to_string(kJournalVersion));
  }
  const WorldIdentity of{0, 0, in.get<int32_t>()};
  const auto grammar = in.get<uint64_t>(), seed = in.get<uint64_t>();
  if (in.get<uint64_t>() != checksum(bytes.first(kHeadBytes - 8))) return bad("its header is damaged");
  const auto isOtherGrammar = [&] { return grammar != world.grammar && (!former || grammar != former()); };
  // The grammar's hash also depends on the seed and the cell size. So these two are compared first, to name them in the
  // message if one of them is the difference.
  const char* differs = seed != world.seed      ? "seed"
                        : of.cell != world.cell ? "finest cell"
                        : isOtherGrammar()      ? "grammar, other parameters or other host fields"
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

/// Decodes the first operation of these bytes, and returns it with its size in bytes. nullopt if the operation is
/// incomplete or damaged.
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

/// Opens and locks the file at this path. Another process may replace the file between opening and locking, so this is
/// repeated until the locked file is the one at the path.
Result<File> openLocked(const fs::path& path) {
  for (int i = 0; i < kMaxTries; ++i) {
    File file(platform::openFile(path, platform::kRead | platform::kWrite | platform::kCreate));
    platform::FileStatus ours, there;
    if (!file || platform::statusOf(file.number(), ours) != 0) return ioError(path, errno);
    if (!ours.isRegular()) return journalError(Code::io, path, "it is not a regular file");
    if (platform::lockFile(file.number()) != 0) {
      if (errno == EWOULDBLOCK) return journalError(Code::limit, path, "another world or program has it open");
      return ioError(path, errno);
    }
    if (platform::statusAt(path, there, true) == 0 && ours.isSameFile(there)) return file;
  }
  return journalError(Code::limit, path, "another process keeps replacing it");
}

Result<Bytes> readAll(const fs::path& path, int file) {
  platform::FileStatus there;
  if (platform::statusOf(file, there) != 0) return ioError(path, errno);
  if (there.bytes > kMaxJournalBytes) return journalError(Code::limit, path, "it is larger than a gigabyte");
  Bytes bytes(static_cast<size_t>(there.bytes));
  for (size_t at = 0; at < bytes.size();) {
    const ptrdiff_t got = platform::readAt(file, bytes.data() + at, bytes.size() - at, at);
    if (got < 0) return ioError(path, errno);
    if (got == 0) bytes.resize(at);
    at += static_cast<size_t>(got);
  }
  return bytes;
}

struct Written {
  size_t bytes = 0;  ///< number of bytes that are on disk
  int error = 0;     ///< errno if writing failed, otherwise 0
};

/// Writes the bytes at offset `at`, and blocks until they are on disk. After an error, Written::bytes is the number of
/// bytes that are on disk nevertheless.
Written writeDurably(int file, std::span<const std::byte> bytes, uint64_t at) {
  Written done;
  while (done.bytes < bytes.size() && done.error == 0) {
    const auto rest = bytes.subspan(done.bytes);
    const ptrdiff_t sent = platform::writeAt(file, rest.data(), rest.size(), at + done.bytes);
    if (sent <= 0) done.error = sent < 0 ? errno : EIO;
    if (sent > 0) done.bytes += static_cast<size_t>(sent);
  }
  if (platform::syncContent(file) == 0) return done;
  return {0, done.error != 0 ? done.error : errno};
}

/// The complete records at the start of a byte range: their number and total size.
struct WholeRecords {
  size_t count = 0, bytes = 0;
};

/// Counts the complete records at the start of these bytes. Precondition: the bytes are a series of valid records, of
/// which only the last one may be incomplete.
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

Result<void> writeWhole(const fs::path& path, std::span<const std::byte> bytes) {
  Result<FileWriter> writer = FileWriter::create(path);
  if (!writer) return writer.error();
  writer->write(bytes.data(), bytes.size());
  if (Result<void> done = writer->commit(); !done) return done;
  platform::syncFolder(path.parent_path());  // without this, the file's new name may be lost in a power failure
  return {};
}

/// Copies the content of a damaged journal to a file with a new name, and returns the path of this file. Precondition:
/// this process holds the journal's lock.
Result<fs::path> setAside(const fs::path& path, std::span<const std::byte> bytes) {
  for (int i = 1; i <= kMaxTries; ++i) {
    fs::path aside = path;
    aside += ".damaged-" + std::to_string(i);
    std::error_code why;
    if (fs::exists(fs::symlink_status(aside, why))) continue;
    if (Result<void> kept = writeWhole(aside, bytes); !kept) return kept.error();
    return aside;
  }
  return journalError(
      Code::limit, path,
      "it is damaged, and " + std::to_string(kMaxTries) + " damaged copies are already beside it: remove them");
}

}  // namespace

Result<OpenedJournal> EditJournal::open(const fs::path& given, const WorldIdentity& world,
                                        const FormerGrammar& former) {
  std::error_code why;
  const fs::path followed = fs::weakly_canonical(given, why), path = why ? given : followed;
  Result<File> file = openLocked(path);
  if (!file) return file.error();
  Result<Bytes> bytes = readAll(path, file->number());
  if (!bytes) return bytes.error();

  OpenedJournal opened;
  const Bytes head = headOf(world);
  if (bytes->size() < kHeadBytes && std::equal(bytes->begin(), bytes->end(), head.begin())) {
    // The file is new, or a process was killed before it had written the whole header. So the header is written now.
    if (const Written written = writeDurably(file->number(), head, 0); written.error != 0)
      return ioError(path, written.error);
    platform::syncFolder(path.parent_path());  // without this, the file's new name may be lost in a power failure
    *bytes = head;
  }
  if (bytes->size() < kHeadBytes) return journalError(Code::bad_input, path, "it is not an edit journal");
  if (Result<void> ours = checkHead(path, *bytes, world, former); !ours) return ours.error();

  size_t whole = kHeadBytes;
  const std::span<const std::byte> all(*bytes);
  while (auto record = getRecord(all.subspan(whole))) {
    opened.operations.push_back(record->first);
    whole += record->second;
  }
  const size_t rest = all.size() - whole;
  // a last record that was not completely written is shorter than kMaxRecordBytes, so a longer rest means damage
  const bool damaged = rest > kMaxRecordBytes;
  if (damaged) {
    Result<fs::path> aside = setAside(path, all);
    if (!aside) return aside.error();
    opened.damaged = *aside;
    opened.message = "journal '" + path.string() + "' is damaged after " + std::to_string(opened.operations.size()) +
                     " operations, which are kept; the rest is in '" + aside->string() + "'";
  } else if (rest > 0) {
    opened.cut_bytes = rest;
    opened.message = "journal '" + path.string() + "': its last operation is incomplete; " + std::to_string(rest) +
                     " bytes are cut off";
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
  } else if (rest > 0 && platform::cutFile(file->number(), whole) != 0) {
    return ioError(path, errno);
  }
  opened.journal.reset(new EditJournal(path, file->number(), whole));
  file->release();
  return opened;
}

EditJournal::~EditJournal() {
  try {
    (void)flush();
  } catch (const std::bad_alloc&) {
    // A destructor cannot report the error. Only edits that were not flushed before are lost.
  }
  platform::closeFile(file_);
}

void EditJournal::append(std::span<const EditOperation> operations) {
  const std::lock_guard lock(appending_);
  const size_t before = waiting_.size();
  try {
    for (const EditOperation& operation : operations) putRecord(operation, waiting_);
  } catch (const std::bad_alloc&) {
    waiting_.resize(before);  // removes an incomplete record, which would make all following records unreadable
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
  const Written written = writeDurably(file_, unwritten_, size_);
  // Only complete records count as written, so that the next attempt overwrites an incomplete record.
  const size_t kept = wholeRecords(std::span(unwritten_).first(written.bytes)).bytes;
  size_ += kept;
  unwritten_.erase(unwritten_.begin(), unwritten_.begin() + static_cast<std::ptrdiff_t>(kept));
  if (unwritten_.empty()) return {};
  Error error = ioError(path_, written.error);
  const size_t lost = wholeRecords(unwritten_).count;
  error.message += "; " + std::to_string(lost) + (lost == 1 ? " edit is not saved" : " edits are not saved");
  return error;
}

}  // namespace sgm
