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
  uint64_t file_bytes = 0;            ///< of the whole file
  std::pmr::vector<std::byte> bytes;  ///< shorter than requested if the file ends before
};

/// Keeps connections for the next request. Thread-safe; the calling thread waits.
class HttpClient {
 public:
  /// unsupported, out_of_memory.
  static Result<std::unique_ptr<HttpClient>> create();
  /// No request may be running.
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Downloads the file's bytes from `first` on; nullopt if the server has no such file. count: 1 or more. Error
  /// messages continue a sentence that begins with the server's or the file's name. busy: the server does not answer,
  /// is too slow, or has failed, or stop() was called; io: any other answer; it would be the same again. Throws
  /// std::bad_alloc.
  Result<std::optional<HttpPart>> get(const std::string& address, uint64_t first, size_t count,
                                      std::pmr::memory_resource* memory);
  /// Ends running requests within about a second, and later ones at once.
  void stop() noexcept { stopped_ = true; }
  bool isStopped() const { return stopped_; }

 private:
  explicit HttpClient(const CurlTable& curl) : curl_(curl) {}
  static int progress(void* client, curl_off_t, curl_off_t, curl_off_t, curl_off_t);
  /// Returns an idle handle or a new one. Throws std::bad_alloc.
  CURL* take();
  /// Returns the handle to the pool.
  struct Connection {
    HttpClient& client;
    CURL* handle;
    ~Connection();
  };

  const CurlTable curl_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  size_t handles_ = 0;       ///< idle or not
  std::vector<CURL*> idle_;  ///< with their connections
};

}  // namespace sgm::store
