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

/// Receives messages about problems of a store, each file at most once. Called from any thread.
using Log = std::function<void(const std::string&)>;

/// A file that is open for reading, and whose content does not change. Thread-safe.
class StoredFile {
 public:
  virtual ~StoredFile() = default;
  virtual uint64_t size() const = 0;
  /// Reads a range of bytes. Errors: io, also if the file ends before the end of the range; errors of StoreFiles::open.
  /// Throws std::bad_alloc.
  virtual Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t bytes,
                                                   std::pmr::memory_resource* memory) const = 0;
};

/// The files of a store. Thread-safe.
class StoreFiles {
 public:
  virtual ~StoreFiles() = default;
  /// Returns the full path or URL of a file, for messages. file: path relative to the store, as in folder.h.
  virtual std::string nameOf(const std::string& file) const = 0;
  /// Opens a file; null if it does not exist. bytes: the size of the file if it is known; then a server is first
  /// accessed when the file is read. Errors: io; busy if the file is temporarily unavailable, so that a later call may
  /// succeed (this was already logged). Throws std::bad_alloc.
  virtual Result<std::shared_ptr<const StoredFile>> open(const std::string& file, std::optional<uint64_t> bytes) = 0;
  /// True if the files are on a server: then reading is slow, and the caller should cache their content.
  virtual bool isFar() const = 0;
  /// Ends all waits for the server: running and later calls return busy.
  virtual void stop() noexcept {}
};

/// True if a place is a URL of any scheme ("x://"), and not a path.
bool isAddress(const std::string& place);
/// Returns a URL without its user name and password, which must not be logged; returns a path unchanged.
std::string shownPlace(const std::string& place);

/// Error: invalid_argument if the place is a URL, although the caller needs a local folder.
Result<void> checkHere(const std::string& place);

/// Returns access to the files of a store in a folder, or at a URL (http_files.h). Neither is accessed yet. log and
/// memory must outlive the result, and memory must be thread-safe; they are used only for servers. Errors: bad_input if
/// the URL is invalid; unsupported if this build or machine cannot read from servers.
Result<std::unique_ptr<StoreFiles>> storeFiles(const std::string& place, const Log& log,
                                               std::pmr::memory_resource* memory);

}  // namespace sgm::store
