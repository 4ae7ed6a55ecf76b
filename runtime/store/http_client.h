#pragma once
// Downloads parts of files from a static file server, through libcurl.

#include <atomic>
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <vector>

#include "store/curl_library.h"

namespace sgm::store {

struct HttpPart {
  uint64_t file_bytes = 0;            ///< size of the whole file
  std::pmr::vector<std::byte> bytes;  ///< requested bytes; fewer if the file ends earlier
};

/// An HTTP client that reuses connections. Thread-safe; a request blocks the calling thread until the response.
class HttpClient {
 public:
  /// Loads libcurl and creates a client. Errors: unsupported (libcurl is missing or too old), out_of_memory.
  static Result<std::unique_ptr<HttpClient>> create();
  /// Precondition: no request is in progress.
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Downloads `count` (1 or more) bytes of the file at `address`, starting at byte `first`. nullopt if the server has
  /// no such file. Error messages are worded to follow the name of the server or file. Errors: busy if the server does
  /// not answer, is too slow, or has failed, or if stop() was called; io for any other answer, where repeating the
  /// request would not help. Throws std::bad_alloc.
  Result<std::optional<HttpPart>> get(const std::string& address, uint64_t first, size_t count,
                                      std::pmr::memory_resource* memory);
  /// Aborts requests in progress within about a second; later requests fail immediately.
  void stop() noexcept { stopped_ = true; }
  bool isStopped() const { return stopped_; }

 private:
  explicit HttpClient(const CurlTable& curl) : curl_(curl) {}
  static int progress(void* client, curl_off_t, curl_off_t, curl_off_t, curl_off_t);
  /// Returns an idle libcurl handle, or creates one. Throws std::bad_alloc.
  CURL* take();
  /// Owns a libcurl handle during a request; the destructor adds the handle to the idle ones.
  struct Connection {
    HttpClient& client;
    CURL* handle;
    ~Connection();
  };

  const CurlTable curl_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  size_t handles_ = 0;       ///< total number of libcurl handles, idle or in use
  std::vector<CURL*> idle_;  ///< idle libcurl handles; their connections stay open for reuse
};

}  // namespace sgm::store
