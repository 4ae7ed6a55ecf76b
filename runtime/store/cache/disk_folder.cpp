#include "store/cache/disk_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <ctime>
#include <string_view>

#include "store/cache/disk_entry.h"

namespace sgm {
namespace {

constexpr std::string_view kPart = ".part";
constexpr size_t kDigits = 32;
constexpr time_t kLeftAfterSeconds = 60;  // nobody takes so long over one entry

struct OpenFile {
  int number;
  explicit OpenFile(int n) : number(n) {}
  OpenFile(const OpenFile&) = delete;
  ~OpenFile() {
    if (number >= 0) ::close(number);
  }
};

bool isLeft(const struct stat& part) { return part.st_mtim.tv_sec + kLeftAfterSeconds < std::time(nullptr); }

int send(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(file, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return sent < 0 ? errno : EIO;
    bytes = bytes.subspan(static_cast<size_t>(sent));
  }
  return 0;
}

/// The key of an entry's name, its ending left out. Only what fileName() makes is a name: small letters, no sign.
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

std::string DiskFolder::shardName(size_t shard) const {
  std::array<char, 4> digits{};
  std::snprintf(digits.data(), digits.size(), "/%02x", static_cast<unsigned>(shard & (kShards - 1)));
  return folder_ + digits.data();
}

std::string DiskFolder::fileName(const DiskKey& key) const {
  std::array<char, kDigits + 2> digits{};
  std::snprintf(digits.data(), digits.size(), "/%016llx%016llx", static_cast<unsigned long long>(key.high),
                static_cast<unsigned long long>(key.low));
  return shardName(shardOf(key)) + digits.data();
}

int DiskFolder::read(const DiskKey& key, std::pmr::vector<std::byte>& file) const {
  // Without O_NONBLOCK a pipe would keep us.
  const OpenFile from(::open(fileName(key).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (from.number < 0) return errno == ELOOP ? kUntrusted : errno;
  struct stat there {};
  if (fstat(from.number, &there) != 0) return errno;
  if (!S_ISREG(there.st_mode) || there.st_size > static_cast<off_t>(kMaxDiskEntry)) return kUntrusted;
  file.resize(static_cast<size_t>(there.st_size));
  size_t done = 0;
  while (done < file.size()) {
    const ssize_t got = ::read(from.number, file.data() + done, file.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno;
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  file.resize(done);
  return 0;
}

int DiskFolder::write(const DiskKey& key, std::span<const std::byte> file) const {
  const std::string name = fileName(key), part = name + std::string(kPart);
  struct stat there {};
  const auto create = [&] { return ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); };
  int opened = create();
  if (opened < 0 && errno == ENOENT && (mkdir(shardName(shardOf(key)).c_str(), 0777) == 0 || errno == EEXIST)) {
    opened = create();
  }
  if (opened < 0 && errno == EEXIST) {
    // Somebody else is bringing it, and may be done by now.
    if (lstat(part.c_str(), &there) != 0 || !isLeft(there) || unlink(part.c_str()) != 0) return EEXIST;
    opened = create();
  }
  if (opened < 0) return errno;
  // Now nobody else brings it.
  int error = lstat(name.c_str(), &there) == 0 ? EEXIST : send(opened, file);
  // Some file systems only tell here that they are full.
  if (::close(opened) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(part.c_str(), name.c_str()) != 0) error = errno;
  if (error != 0) unlink(part.c_str());
  return error;
}

int DiskFolder::remove(const DiskKey& key) const { return unlink(fileName(key).c_str()) == 0 ? 0 : errno; }

int DiskFolder::touch(const DiskKey& key) const {
  return utimensat(AT_FDCWD, fileName(key).c_str(), nullptr, AT_SYMLINK_NOFOLLOW) == 0 ? 0 : errno;
}

int DiskFolder::list(size_t shard, std::pmr::vector<DiskFile>& files, uint64_t& unfinished) const {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(shardName(shard).c_str()), &closedir);
  if (folder == nullptr) return errno == ENOENT ? 0 : errno;
  const int at = dirfd(folder.get());
  for (;;) {
    errno = 0;
    const dirent* entry = readdir(folder.get());
    if (entry == nullptr) return errno;
    std::string_view name = entry->d_name;
    const bool part = name.ends_with(kPart);
    if (part) name.remove_suffix(kPart.size());
    const std::optional<DiskKey> key = keyOfName(name, shard);
    if (!key) continue;
    struct stat there {};
    if (fstatat(at, entry->d_name, &there, AT_SYMLINK_NOFOLLOW) != 0) continue;  // another has removed it
    const auto bytes = static_cast<uint64_t>(there.st_size);
    if (!part) {
      files.push_back({int64_t{there.st_mtim.tv_sec} * 1'000'000'000 + there.st_mtim.tv_nsec, *key, bytes});
    } else if (!isLeft(there) || unlinkat(at, entry->d_name, 0) != 0) {
      unfinished += bytes;
    }
  }
}

}  // namespace sgm
