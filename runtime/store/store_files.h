#pragma once
// Read access to the files of a store, which is a folder or a static file server.

#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::store {

/// Receives problems of a store as text, once for each file. Called from any thread.
using Log = std::function<void(const std::string&)>;

/// A readable file whose bytes do not change. Thread-safe.
class StoredFile {
 public:
  virtual ~StoredFile() = default;
  virtual uint64_t size() const = 0;
  /// Reads a range of bytes. Errors: io, also if the file ends earlier; others as StoreFiles::open. Throws
  /// std::bad_alloc.
  virtual Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t bytes,
                                                   std::pmr::memory_resource* memory) const = 0;
};

/// The files of a store. Thread-safe.
class StoreFiles {
 public:
  virtual ~StoreFiles() = default;
  /// Returns the full name, for messages, of a file that is named as in Folder (folder.h).
  virtual std::string nameOf(const std::string& file) const = 0;
  /// Opens a file; null if it does not exist. bytes: the size of the file if it is known; then the file may be accessed
  /// only when it is read. Errors: io; busy if the file is temporarily unavailable, which was reported (a later call
  /// may succeed). Throws std::bad_alloc.
  virtual Result<std::shared_ptr<const StoredFile>> open(const std::string& file, std::optional<uint64_t> bytes) = 0;
  /// True if the content of files should be cached after reading, because they are on a server.
  virtual bool isFar() const = 0;
  /// Ends all waits for files: from now on, all calls return busy.
  virtual void stop() noexcept {}
};

/// True if a place is an address of any scheme, "x://", and not a path.
bool isAddress(const std::string& place);
/// Returns an address without its user name and password, which must not be logged; returns other places unchanged.
std::string shownPlace(const std::string& place);

/// Error: invalid_argument if the place is an address, because the caller needs a folder.
Result<void> checkHere(const std::string& place);

/// Returns access to the files in a folder, or at the address of a folder on a server (http_files.h). Does not access
/// either yet. log and memory must outlive the result, and memory must be thread-safe; only servers use them. Errors:
/// bad_input if the address is invalid; unsupported if this build or machine cannot read from servers.
Result<std::unique_ptr<StoreFiles>> storeFiles(const std::string& place, const Log& log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
