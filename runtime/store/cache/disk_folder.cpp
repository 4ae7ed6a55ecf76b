#include "store/cache/disk_folder.h"

#include <cerrno>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <string_view>

#include "base/plain_text.h"
#include "base/platform/file.h"
#include "store/cache/disk_entry.h"

namespace sgm {
namespace {

constexpr std::string_view kPart = ".part";
constexpr size_t kDigits = 32;
// A ".part" file that is older than this is abandoned: no process takes this long to write an entry.
constexpr time_t kLeftAfterSeconds = 60;

bool isLeft(const platform::FileStatus& part) {
  return part.changed_ns / 1'000'000'000 + kLeftAfterSeconds < std::time(nullptr);
}

int send(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ptrdiff_t sent = platform::writeNext(file, bytes.data(), bytes.size());
    if (sent <= 0) return sent < 0 ? errno : EIO;
    bytes = bytes.subspan(static_cast<size_t>(sent));
  }
  return 0;
}

/// Parses the file name of an entry without its suffix. nullopt if the name is not one that fileName() produces, for
/// example because of upper-case digits, or if it belongs to another shard.
std::optional<DiskKey> keyOfName(std::string_view name, size_t shard) {
  if (name.size() != kDigits || name.find_first_not_of("0123456789abcdef") != name.npos) return std::nullopt;
  DiskKey key;
  const char* digits = name.data();
  std::from_chars(digits, digits + kDigits / 2, key.high, 16);
  std::from_chars(digits + kDigits / 2, digits + kDigits, key.low, 16);
  if (DiskFolder::shardOf(key) != shard) return std::nullopt;
  return key;
}

}  // namespace

std::string DiskFolder::shardName(size_t shard) const { return folder_ + "/" + hexText(shard & (kShards - 1), 2); }

std::string DiskFolder::fileName(const DiskKey& key) const {
  return shardName(shardOf(key)) + "/" + hexText(key.high, kDigits / 2) + hexText(key.low, kDigits / 2);
}

int DiskFolder::read(const DiskKey& key, std::pmr::vector<std::byte>& file) const {
  const platform::File from(platform::openFile(fileName(key), platform::kRead | platform::kNoFollow));
  if (!from) return errno == ELOOP ? kUntrusted : errno;
  platform::FileStatus there;
  if (platform::statusOf(from.number(), there) != 0) return errno;
  if (!there.isRegular() || there.bytes > kMaxDiskEntry) return kUntrusted;
  file.resize(static_cast<size_t>(there.bytes));
  size_t done = 0;
  while (done < file.size()) {
    const ptrdiff_t got = platform::readNext(from.number(), file.data() + done, file.size() - done);
    if (got < 0) return errno;
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  file.resize(done);
  return 0;
}

int DiskFolder::write(const DiskKey& key, std::span<const std::byte> file) const {
  const std::string name = fileName(key), part = name + std::string(kPart);
  platform::FileStatus there;
  const auto create = [&] {
    return platform::openFile(part, platform::kWrite | platform::kCreate | platform::kExclusive);
  };
  int opened = create();
  if (opened < 0 && errno == ENOENT && (platform::makeFolder(shardName(shardOf(key))) == 0 || errno == EEXIST)) {
    opened = create();
  }
  if (opened < 0 && errno == EEXIST) {
    // The temporary file already exists: another process is writing the entry now, or was killed while it wrote the
    // entry. In the second case the file is old; it is removed and created anew.
    if (platform::statusAt(part, there, false) != 0 || !isLeft(there) || platform::removeFile(part) != 0) return EEXIST;
    opened = create();
  }
  if (opened < 0) return errno;
  // This process has created the temporary file, so no other process can write the entry now.
  int error = platform::statusAt(name, there, false) == 0 ? EEXIST : send(opened, file);
  // Some file systems report a full disk only when the file is closed.
  if (platform::closeFile(opened) != 0 && error == 0) error = errno;
  if (error == 0 && platform::replaceFile(part, name) != 0) error = errno;
  if (error != 0) platform::removeFile(part);
  return error;
}

int DiskFolder::remove(const DiskKey& key) const { return platform::removeFile(fileName(key)) == 0 ? 0 : errno; }

int DiskFolder::touch(const DiskKey& key) const { return platform::touchFile(fileName(key)) == 0 ? 0 : errno; }

int DiskFolder::list(size_t shard, std::pmr::vector<DiskFile>& files, uint64_t& unfinished) const {
  std::error_code why;
  std::filesystem::directory_iterator entry(shardName(shard), why);
  if (why) return why == std::errc::no_such_file_or_directory ? 0 : why.value();
  for (; entry != std::filesystem::directory_iterator(); entry.increment(why)) {
    const std::string file = entry->path().filename().string();
    std::string_view name = file;
    const bool part = name.ends_with(kPart);
    if (part) name.remove_suffix(kPart.size());
    const std::optional<DiskKey> key = keyOfName(name, shard);
    if (!key) continue;
    platform::FileStatus there;
    // skip the entry: another process has removed its file
    if (platform::statusAt(entry->path(), there, false) != 0) continue;
    if (!part) {
      files.push_back({there.changed_ns, *key, there.bytes});
    } else if (!isLeft(there) || platform::removeFile(entry->path()) != 0) {
      unfinished += there.bytes;
    }
  }
  return why.value();
}

}  // namespace sgm
