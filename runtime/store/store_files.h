#pragma once
// Read access to the files of a store, in a folder or on a static file server.

#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::store {

/// Receives problems of a store, once for each file. Called from any thread.
using Log = std::function<void(const std::string&)>;

/// A readable file whose bytes do not change. Thread-safe.
class StoredFile {
 public:
  virtual ~StoredFile() = default;
  virtual uint64_t size() const = 0;
  /// io, also if the file ends before; other errors as StoreFiles::open. Throws std::bad_alloc.
  virtual Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t bytes,
                                                   std::pmr::memory_resource* memory) const = 0;
};

/// The files of a store. Thread-safe.
class StoreFiles {
 public:
  virtual ~StoreFiles() = default;
  /// The full name of one of Folder's files (folder.h), for messages.
  virtual std::string nameOf(const std::string& file) const = 0;
  /// Opens a file; null if there is none. bytes: its size if known; then it may be accessed only when it is read. io.
  /// busy: it is temporarily unavailable, which was reported; a later call may succeed. Throws std::bad_alloc.
  virtual Result<std::shared_ptr<const StoredFile>> open(const std::string& file, std::optional<uint64_t> bytes) = 0;
  /// Whether the files are worth caching once they are read.
  virtual bool isFar() const = 0;
  /// Ends all waits for files: from now on all calls return busy.
  virtual void stop() noexcept {}
};

/// Whether a place is an address of any scheme: "x://".
bool isAddress(const std::string& place);
/// An address without its name and password, which must not be logged; other places unchanged.
std::string shownPlace(const std::string& place);

/// invalid_argument: the place is an address, but the caller works in folders.
Result<void> checkHere(const std::string& place);

/// The files at a folder's path, or at the address of a folder on a server (http_files.h); accesses neither. log and
/// memory (thread-safe) must outlive them; only servers use them. bad_input: invalid address; unsupported: this build
/// or machine cannot read from servers.
Result<std::unique_ptr<StoreFiles>> storeFiles(const std::string& place, const Log& log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
