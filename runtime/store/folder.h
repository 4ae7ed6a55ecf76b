#pragma once
// The layout of a store's files.
//
//   STORE/format              "sgm store 1"
//   STORE/worlds/KEY.sgmi     the index of a world (index.h); KEY.json: the same information as text
//   STORE/packs/3f/NAME.sgmp  contents (tile_record.h); named by a hash of its bytes, and never changed
//   STORE/baking/JOB/         unfinished results of workers for a region: tiles L_X_Y_Z.tile with .pack, and the plan
//
// Each file appears completely or not at all (base/file_writer.h), and equal names mean equal bytes: several processes
// may work in one store at the same time, including readers.

#include <chrono>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/file_writer.h"
#include "store/store_files.h"
#include "store/tile_record.h"

namespace sgm::store {

inline constexpr int kStoreVersion = 1;
/// Names of files in a store, relative to the store, for StoreFiles::open().
inline constexpr const char* kFormatFile = "format";
std::string worldFileName(const ContentId& key);
std::string packFileName(const ContentId& name);
/// Returns access to the files of a store in the folder `root`. Does not access the folder yet.
std::unique_ptr<StoreFiles> folderFiles(const std::filesystem::path& root);
/// Checks that the files are those of a store of this version. Errors: io; bad_input if they are not; errors of
/// StoreFiles::open.
Result<void> checkFormat(StoreFiles& files);

/// A baking job's folder gets this suffix after its tiles were merged; then the folder is removed.
inline constexpr const char* kMergedEnding = ".merged";

class Folder {
 public:
  explicit Folder(std::filesystem::path root) : root_(std::move(root)) {}

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path world(const ContentId& key) const { return root_ / worldFileName(key); }
  std::filesystem::path manifest(const ContentId& key) const { return root_ / "worlds" / (nameOf(key) + ".json"); }
  std::filesystem::path pack(const ContentId& name) const { return root_ / packFileName(name); }
  std::filesystem::path baking(const ContentId& job) const { return root_ / "baking" / nameOf(job); }

  /// Creates the store if it is missing. Errors: io; bad_input if the folder contains other files, or a store of
  /// another version.
  Result<void> make() const;
  /// Checks the store's version. Errors: io; bad_input if the folder is not a store of this version.
  Result<void> check() const;

 private:
  std::filesystem::path root_;
};

/// A lock for processes that change the content of a store. Readers and baking workers do not need it.
class StoreLock {
 public:
  static constexpr std::chrono::minutes kPatience{10};

  /// Waits for the lock, at most for `patience`. Errors: busy if another process still holds the lock; io; unsupported
  /// if the file system has no locks.
  static Result<StoreLock> take(const Folder& store, std::chrono::milliseconds patience = kPatience);
  StoreLock(StoreLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  StoreLock& operator=(StoreLock&&) = delete;
  ~StoreLock();

 private:
  explicit StoreLock(int file) : file_(file) {}
  int file_;
};

std::filesystem::path tileFile(const std::filesystem::path& baking, const TileKey& tile);
std::filesystem::path packFile(const std::filesystem::path& baking, const TileKey& tile);

/// A regular file that is open for reading. If another file replaces it, this object still reads the old content.
/// Thread-safe.
class OpenFile final : public StoredFile {
 public:
  /// Error: io.
  static Result<std::shared_ptr<const OpenFile>> open(const std::filesystem::path& path);
  ~OpenFile() override;
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  uint64_t size() const override { return size_; }
  Result<std::pmr::vector<std::byte>> read(
      uint64_t offset, size_t bytes,
      std::pmr::memory_resource* memory = std::pmr::get_default_resource()) const override;

 private:
  OpenFile(std::filesystem::path path, int file, uint64_t size);
  std::filesystem::path path_;
  int file_;
  uint64_t size_;
};

/// Returns the hash (idOf) of the whole file, which is read piece by piece. Error: io.
Result<ContentId> idOfFile(const StoredFile& file);
/// True if the file at `path` has the size and the hash of the pack; false also if the file cannot be read.
bool isPack(const std::filesystem::path& path, const PackFile& pack);

/// Blocks until the folder's list of files is on disk (fsync). Error: io.
Result<void> syncFolder(const std::filesystem::path& folder);
/// Creates a folder and its missing parents. Error: io.
Result<void> makeFolder(const std::filesystem::path& folder);
/// Writes a file completely or not at all. unfinished: registry of unfinished files (FileWriter::create()); may be
/// null. Error: io.
Result<void> writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes,
                       UnfinishedFiles* unfinished);

}  // namespace sgm::store
