#pragma once
// The files of a store, for who reads them: in a folder, or on a server of plain files.

#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::store {

/// Told of what is wrong with a store, once for each file. Any thread.
using Log = std::function<void(const std::string&)>;

/// One that can be read, and whose bytes stay as they are. Any thread.
class StoredFile {
 public:
  virtual ~StoredFile() = default;
  virtual uint64_t size() const = 0;
  /// io, also where it ends before; as StoreFiles::open. Throws std::bad_alloc.
  virtual Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t bytes,
                                                   std::pmr::memory_resource* memory) const = 0;
};

/// All of a store's. Any thread.
class StoreFiles {
 public:
  virtual ~StoreFiles() = default;
  /// Of a file that Folder names (folder.h): what people know it as.
  virtual std::string nameOf(const std::string& file) const = 0;
  /// Null where there is none. bytes: its size where that is known; then it may be looked for only when it is read.
  /// io. busy: it cannot be had now, which has been told; whoever asks again later may get it. Throws std::bad_alloc.
  virtual Result<std::shared_ptr<const StoredFile>> open(const std::string& file, std::optional<uint64_t> bytes) = 0;
  /// Whether they are worth keeping, once they are read.
  virtual bool isFar() const = 0;
  /// Lets go of whoever waits for a file: all that follows is busy.
  virtual void stop() noexcept {}
};

/// Whether a place is meant as an address, of whatever kind: "x://".
bool isAddress(const std::string& place);
/// An address without the name and password that it may have, which belong into no log; others as they are.
std::string shownPlace(const std::string& place);

/// invalid_argument: the place is an address, and the caller works in folders.
Result<void> checkHere(const std::string& place);

/// Of a folder's path, or of the address of a folder on a server (http_files.h); neither is looked at. log, memory
/// (thread-safe): must outlive them; only servers use them. bad_input: the address is none; unsupported: this build, or
/// machine, reads from no server.
Result<std::unique_ptr<StoreFiles>> storeFiles(const std::string& place, const Log& log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
