#include "store/http_files.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>

#include "store/block_cache.h"
#include "store/http_client.h"

namespace sgm::store {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kFirstRest{1}, kLongestRest{60};

/// Whether a server that did not answer is to be left alone. Any thread.
class Outage {
 public:
  /// Whether the caller may ask it. Of those that ask while it is away one may, now and then.
  bool mayAsk() {
    const std::lock_guard lock(mutex_);
    if (rest_.count() == 0) return true;
    if (is_asked_ || Clock::now() < until_) return false;
    is_asked_ = true;
    return true;
  }
  /// It did not; whether that is new.
  bool begins() {
    const std::lock_guard lock(mutex_);
    const bool is_new = rest_.count() == 0;
    // Others may have asked at the same time: that is one outage.
    if (is_new || is_asked_) rest_ = is_new ? kFirstRest : std::min(2 * rest_, kLongestRest);
    is_asked_ = false;
    until_ = Clock::now() + rest_;
    return is_new;
  }
  /// Who might have asked has not.
  void isUnknown() {
    const std::lock_guard lock(mutex_);
    is_asked_ = false;
  }
  /// It has answered; whether that is new.
  bool ends() {
    const std::lock_guard lock(mutex_);
    const bool was_away = rest_.count() != 0;
    rest_ = std::chrono::seconds(0);
    is_asked_ = false;
    return was_away;
  }

 private:
  std::mutex mutex_;
  std::chrono::seconds rest_{0};  ///< 0: it answers
  Clock::time_point until_;
  bool is_asked_ = false;
};

/// What files of one server share; they may outlive who opened them.
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
    if (!outage_.mayAsk()) return Error{Code::busy, "'" + shown_ + "' does not answer"};
    Result<std::optional<HttpPart>> part = ask(file, first, count);
    if (part || part.error().code != Code::busy) {
      if (outage_.ends()) tell("'" + shown_ + "' answers again");
    } else if (!client_->isStopped() && outage_.begins()) {
      tell("'" + shown_ + "' cannot be read from (" + part.error().message +
           "): chunks are derived until it can; it is asked again from time to time");
    }
    if (part || part.error().code == Code::busy) return part;
    return Error{part.error().code, "'" + nameOf(file) + "': " + part.error().message};
  }

  Result<std::pmr::vector<std::byte>> read(const std::string& file, uint64_t number, uint64_t file_bytes,
                                           uint64_t offset, size_t bytes, std::pmr::memory_resource* memory) {
    const auto fetch = [&](uint64_t first, size_t count) -> Result<std::pmr::vector<std::byte>> {
      Result<std::optional<HttpPart>> part = get(file, first, count);
      if (!part) return part.error();
      if (!*part) return Error{Code::io, "'" + nameOf(file) + "' is not there"};
      if ((*part)->file_bytes != file_bytes)
        return Error{Code::io, "'" + nameOf(file) + "' has " + std::to_string((*part)->file_bytes) +
                                   " bytes instead of " + std::to_string(file_bytes)};
      return std::move((*part)->bytes);
    };
    return blocks_.read(number, file_bytes, offset, bytes, fetch, memory);
  }

  /// Files that are opened again have the number that they had, and so their blocks.
  uint64_t numberOf(const std::string& file) {
    const std::lock_guard lock(mutex_);
    return numbers_.try_emplace(file, numbers_.size()).first->second;
  }

  void stop() noexcept { client_->stop(); }

 private:
  Result<std::optional<HttpPart>> ask(const std::string& file, uint64_t first, size_t count) try {
    return client_->get(address_ + "/" + file, first, count, memory_);
  } catch (const std::bad_alloc&) {
    outage_.isUnknown();
    throw;
  }

  void tell(const std::string& message) const {
    if (log_) log_(message);
  }

  const std::unique_ptr<HttpClient> client_;
  const std::string address_, shown_;
  const Log log_;
  std::pmr::memory_resource* const memory_;
  Outage outage_;
  BlockCache blocks_;
  std::mutex mutex_;
  std::map<std::string, uint64_t> numbers_;
};

class HttpFile final : public StoredFile {
 public:
  HttpFile(std::shared_ptr<Server> server, std::string file, uint64_t bytes)
      : server_(std::move(server)), file_(std::move(file)), number_(server_->numberOf(file_)), bytes_(bytes) {}

  uint64_t size() const override { return bytes_; }
  Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t bytes,
                                           std::pmr::memory_resource* memory) const override {
    if (offset > bytes_ || bytes > bytes_ - offset)
      return Error{Code::io, "'" + server_->nameOf(file_) + "' ends before byte " + std::to_string(offset + bytes)};
    return server_->read(file_, number_, bytes_, offset, bytes, memory);
  }

 private:
  const std::shared_ptr<Server> server_;
  const std::string file_;
  const uint64_t number_, bytes_;
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

/// Without the name and password that it may have, which belong into no log.
std::string shownAs(const std::string& address) {
  const size_t host = address.find("//") + 2, path = address.find('/', host);
  const size_t at = address.substr(0, path).rfind('@');
  if (at == std::string::npos || at < host) return address;
  return address.substr(0, host) + address.substr(at + 1);
}

}  // namespace

Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string& address, const Log& log,
                                              std::pmr::memory_resource* memory) {
  std::string own = address;
  while (own.size() > 1 && own.back() == '/') own.pop_back();
  const std::string shown = shownAs(own);
  const size_t host = own.find("//") + 2;
  const bool has_host = own.find("//") != std::string::npos && host < own.size() && own[host] != '/';
  const bool is_plain =
      std::all_of(own.begin(), own.end(), [](char c) { return c > ' ' && c < 0x7F && c != '?' && c != '#'; });
  if (!has_host || !is_plain)
    return Error{Code::bad_input,
                 "'" + shown +
                     "' is no address of a store: http:// or https://, a host and a path, with neither "
                     "'?' nor '#', and other letters as %20"};
  Result<std::unique_ptr<HttpClient>> client = HttpClient::create();
  if (!client) return client.error();
  return std::unique_ptr<StoreFiles>(
      std::make_unique<HttpFiles>(std::make_shared<Server>(std::move(*client), std::move(own), shown, log, memory)));
}

}  // namespace sgm::store
