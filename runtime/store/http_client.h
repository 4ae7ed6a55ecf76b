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
  std::pmr::vector<std::byte> bytes;  ///< shorter than requested if the file ends earlier
};

/// Reuses connections for later requests. Thread-safe; the calling thread waits for the response.
class HttpClient {
 public:
  /// Errors: unsupported, out_of_memory.
  static Result<std::unique_ptr<HttpClient>> create();
  /// Precondition: no request is running.
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Downloads `count` (1 or more) bytes of the file from offset `first`; nullopt if the server has no such file. Error
  /// messages continue a sentence that begins with the name of the server or file. Errors: busy if the server does not
  /// answer, is too slow, or has failed, or if stop() was called; io for any other answer, which repeating the request
  /// would not change. Throws std::bad_alloc.
  Result<std::optional<HttpPart>> get(const std::string& address, uint64_t first, size_t count,
                                      std::pmr::memory_resource* memory);
  /// Ends running requests within about a second; later requests fail at once.
  void stop() noexcept { stopped_ = true; }
  bool isStopped() const { return stopped_; }

 private:
  explicit HttpClient(const CurlTable& curl) : curl_(curl) {}
  static int progress(void* client, curl_off_t, curl_off_t, curl_off_t, curl_off_t);
  /// Returns an idle connection handle, or a new one. Throws std::bad_alloc.
  CURL* take();
  /// Returns the handle to the idle ones.
  struct Connection {
    HttpClient& client;
    CURL* handle;
    ~Connection();
  };

  const CurlTable curl_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  size_t handles_ = 0;       ///< number of handles, idle or in use
  std::vector<CURL*> idle_;  ///< idle handles, which still have their connections
};

}  // namespace sgm::store
