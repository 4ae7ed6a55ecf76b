#include "store/http_files.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

#include "store/block_cache.h"
#include "store/folder.h"
#include "store/http_client.h"
#include "store/outage.h"

namespace sgm::store {
namespace {

using Clock = Outage::Clock;

/// At most kMaxRequests requests to a server run concurrently. A further request waits up to kLongestWait for a free
/// slot, then fails.
constexpr int kMaxRequests = 4;
constexpr std::chrono::seconds kLongestWait{2};
/// For this time, a file that could not be read is not requested again.
constexpr std::chrono::seconds kFailedFor{60};

/// The state of one server, shared by all files that are open there. A file may outlive the StoreFiles object that
/// opened it.
class Server {
 public:
  Server(std::unique_ptr<HttpClient> client, std::string address, std::string shown, Log log,
         std::pmr::memory_resource* memory)
      : client_(std::move(client)),
        address_(std::move(address)),
        shown_(std::move(shown)),
        log_(std::move(log)),
        memory_(memory),
        blocks_(memory) {}

  std::string nameOf(const std::string& file) const { return file.empty() ? shown_ : shown_ + "/" + file; }

  Result<std::optional<HttpPart>> get(const std::string& file, uint64_t first, size_t count) {
    if (!isThere()) return away();
    return ask(file, first, count);
  }

  Result<std::pmr::vector<std::byte>> read(const std::string& file, uint64_t file_bytes, uint64_t offset, size_t bytes,
                                           std::pmr::memory_resource* memory) {
    const std::optional<uint64_t> number = numberOf(file, file_bytes);
    if (!number) return Error{Code::io, "'" + nameOf(file) + "' could not be read recently"};
    const auto fetch = [&](uint64_t first, size_t count) -> Result<std::pmr::vector<std::byte>> {
      Result<std::optional<HttpPart>> part = ask(file, first, count);
      if (!part) return part.error();
      if (!*part) return Error{Code::io, "'" + nameOf(file) + "' does not exist"};
      if ((*part)->file_bytes == file_bytes) return std::move((*part)->bytes);
      return Error{Code::io, "'" + nameOf(file) + "' has " + std::to_string((*part)->file_bytes) +
                                 " bytes instead of " + std::to_string(file_bytes)};
    };
    // Check this before using the block cache: there, this thread might wait for a block that another thread fetches
    // from an unavailable server.
    if (!isThere()) return away();
    auto read = blocks_.read(*number, file_bytes, offset, bytes, fetch, memory);
    if (!read && read.error().code == Code::io) {
      const std::lock_guard lock(mutex_);
      files_[{file, file_bytes}].failed_until = Clock::now() + kFailedFor;
    }
    return read;
  }

  void stop() noexcept { client_->stop(); }

 private:
  struct FileState {
    uint64_t number = 0;  ///< number of the file in the block cache; kept when the file is reopened, so that its cached
                          ///< blocks stay valid
    Clock::time_point failed_until{};
  };

  Error away() const { return {Code::busy, "'" + shown_ + "' does not answer"}; }

  /// Returns the number of a file in the block cache; nullopt if reading the file has failed in the last minute.
  std::optional<uint64_t> numberOf(const std::string& file, uint64_t file_bytes) {
    const std::lock_guard lock(mutex_);
    const auto [at, is_new] = files_.try_emplace({file, file_bytes});
    if (is_new) at->second.number = files_.size();
    if (Clock::now() < at->second.failed_until) return std::nullopt;
    return at->second.number;
  }

  /// True if the server is available. While the server counts as away, some calls send it a test request
  /// (Outage::look()), and others return false at once.
  bool isThere() {
    const Outage::Look look = outage_.look(Clock::now());
    if (look != Outage::Look::find_out) return look == Outage::Look::there;
    const Result<std::optional<HttpPart>> part = ask(kFormatFile, 0, 1);
    return part || part.error().code != Code::busy;
  }

  Result<std::optional<HttpPart>> ask(const std::string& file, uint64_t first, size_t count) {
    const Slot slot(*this);
    if (!slot.is_free) {
      outage_.gaveUp();
      return away();
    }
    const Clock::time_point begun = Clock::now();
    Result<std::optional<HttpPart>> part = askNow(file, first, count);
    const bool answers = part || part.error().code != Code::busy;
    if (!answers && client_->isStopped()) {
      outage_.gaveUp();
    } else if (!answers && outage_.failed(begun, Clock::now())) {
      tell("'" + shown_ + "' cannot be read (" + part.error().message +
           "): chunks are derived instead; the server is asked again from time to time");
    } else if (answers && outage_.answered(begun, Clock::now())) {
      tell("'" + shown_ + "' answers again");
    }
    if (part || part.error().code == Code::busy) return part;
    return Error{part.error().code, "'" + nameOf(file) + "': " + part.error().message};
  }

  Result<std::optional<HttpPart>> askNow(const std::string& file, uint64_t first, size_t count) try {
    return client_->get(address_ + "/" + file, first, count, memory_);
  } catch (const std::bad_alloc&) {
    outage_.gaveUp();
    throw;
  }

  /// Permission to send one of the concurrent requests. is_free is false if no slot became free in time.
  struct Slot {
    Server& server;
    bool is_free;
    explicit Slot(Server& of) : server(of) {
      std::unique_lock lock(server.mutex_);
      is_free = server.ended_.wait_for(lock, kLongestWait, [this] { return server.running_ < kMaxRequests; });
      server.running_ += is_free;
    }
    ~Slot() {
      if (!is_free) return;
      {
        const std::lock_guard lock(server.mutex_);
        --server.running_;
      }
      server.ended_.notify_one();
    }
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
  };

  void tell(const std::string& message) const {
    if (log_) log_(message);
  }

  const std::unique_ptr<HttpClient> client_;
  const std::string address_, shown_;
  const Log log_;
  std::pmr::memory_resource* const memory_;
  Outage outage_;
  BlockCache blocks_;
  std::mutex mutex_;  ///< guards the members below
  std::condition_variable ended_;
  int running_ = 0;
  std::map<std::pair<std::string, uint64_t>, FileState> files_;
};

class HttpFile final : public StoredFile {
 public:
  HttpFile(std::shared_ptr<Server> server, std::string file, uint64_t bytes)
      : server_(std::move(server)), file_(std::move(file)), bytes_(bytes) {}

  uint64_t size() const override { return bytes_; }
  Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t bytes,
                                           std::pmr::memory_resource* memory) const override {
    if (offset > bytes_ || bytes > bytes_ - offset)
      return Error{Code::io, "'" + server_->nameOf(file_) + "' ends before byte " + std::to_string(offset + bytes)};
    return server_->read(file_, bytes_, offset, bytes, memory);
  }

 private:
  const std::shared_ptr<Server> server_;
  const std::string file_;
  const uint64_t bytes_;
};

class HttpFiles final : public StoreFiles {
 public:
  explicit HttpFiles(std::shared_ptr<Server> server) : server_(std::move(server)) {}

  std::string nameOf(const std::string& file) const override { return server_->nameOf(file); }

  Result<std::shared_ptr<const StoredFile>> open(const std::string& file, std::optional<uint64_t> bytes) override {
    if (!bytes) {
      const Result<std::optional<HttpPart>> part = server_->get(file, 0, 1);
      if (!part) return part.error();
      if (!*part) return std::shared_ptr<const StoredFile>();
      bytes = (*part)->file_bytes;
    }
    return std::shared_ptr<const StoredFile>(std::make_shared<HttpFile>(server_, file, *bytes));
  }
  bool isFar() const override { return true; }
  void stop() noexcept override { server_->stop(); }

 private:
  const std::shared_ptr<Server> server_;
};

}  // namespace

Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory) {
  std::string own = address;
  while (own.size() > 1 && own.back() == '/') own.pop_back();
  const std::string shown = shownPlace(own);
  std::string scheme = own.substr(0, own.find(':'));
  std::transform(scheme.begin(), scheme.end(), scheme.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const size_t host = scheme.size() + 3;
  const bool has_host = (scheme == "http" || scheme == "https") && host < own.size() && own[host] != '/';
  const bool is_plain =
      std::all_of(own.begin(), own.end(), [](char c) { return c > ' ' && c < 0x7F && c != '?' && c != '#'; });
  if (!has_host || !is_plain)
    return Error{Code::bad_input,
                 "'" + shown +
                     "' is not an address of a store: use http:// or https://, a host and a path, without "
                     "'?' and '#', and escape special characters as in %20"};
  Result<std::unique_ptr<HttpClient>> client = HttpClient::create();
  if (!client) return client.error();
  return std::unique_ptr<StoreFiles>(
      std::make_unique<HttpFiles>(std::make_shared<Server>(std::move(*client), std::move(own), shown, log, memory)));
}

}  // namespace sgm::store
