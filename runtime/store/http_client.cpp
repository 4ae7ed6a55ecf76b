#include "store/http_client.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <new>
#include <string>
#include <string_view>

namespace sgm::store {
namespace {

// Timeouts. A transfer fails if the server does not accept the connection within 3 s, is slower than 1,000 bytes/s for
// 4 s, or takes 10 s in total. Longer waits are not worthwhile: deriving the chunk on this machine takes milliseconds.
constexpr long kConnectMilliseconds = 3000, kMilliseconds = 10000;
constexpr long kLeastBytesPerSecond = 1000, kSlowSeconds = 4;

/// Blocks the signal SIGPIPE for the current thread as long as the object exists, and finally discards the signals that
/// were raised in this time. Writing to a connection that the server has closed raises SIGPIPE, which by default ends
/// the program. libcurl must not handle it, because a signal handler would affect the whole process.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    constexpr timespec kNow{};
    if (!was_pending_) {
      while (sigtimedwait(&pipe_, nullptr, &kNow) == SIGPIPE) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_;
};

/// A response that is being received.
struct Transfer {
  const CurlTable& curl;
  CURL* handle;
  uint64_t first;
  size_t count;
  std::pmr::vector<std::byte> bytes;
  std::optional<uint64_t> file_bytes, range_first;
  bool too_long = false, out_of_memory = false;

  long status() const {
    long code = 0;
    curl.easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &code);
    return code;
  }
};

std::optional<uint64_t> numberAt(std::string_view& text) {
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return number;
}

bool beginsAs(std::string_view line, std::string_view lower_case) {
  if (line.size() < lower_case.size()) return false;
  for (size_t i = 0; i < lower_case.size(); ++i) {
    const char letter = line[i] >= 'A' && line[i] <= 'Z' ? static_cast<char>(line[i] - 'A' + 'a') : line[i];
    if (letter != lower_case[i]) return false;
  }
  return true;
}

/// Parses a header line such as "Content-Range: bytes 0-99/1234". Called by libcurl.
size_t takeHeader(const char* data, size_t size, size_t count, void* to) {
  Transfer& transfer = *static_cast<Transfer*>(to);
  std::string_view line(data, size * count);
  // A status line begins another response, for example after a redirection. The header fields of the previous response
  // do not apply to it.
  if (beginsAs(line, "http/")) transfer.file_bytes = transfer.range_first = std::nullopt;
  constexpr std::string_view kName = "content-range:";
  if (!beginsAs(line, kName)) return size * count;
  line.remove_prefix(kName.size());
  while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
  if (!beginsAs(line, "bytes ")) return size * count;
  line.remove_prefix(6);
  const std::optional<uint64_t> first = numberAt(line);
  const size_t slash = line.find('/');
  if (!first || slash == std::string_view::npos) return size * count;
  line.remove_prefix(slash + 1);
  transfer.range_first = first;
  transfer.file_bytes = numberAt(line);
  return size * count;
}

size_t takeBody(const char* data, size_t size, size_t count, void* to) {
  Transfer& transfer = *static_cast<Transfer*>(to);
  const size_t bytes = size * count;
  const long status = transfer.status();
  constexpr size_t kMaxErrorPage = size_t{1} << 20;  // maximum number of bytes read of a server's error page
  const bool wanted = status == 200 || status == 206;
  if (bytes > (wanted ? transfer.count : kMaxErrorPage) - transfer.bytes.size()) {
    transfer.too_long = true;
    return 0;
  }
  const auto* const first = reinterpret_cast<const std::byte*>(data);
  try {
    transfer.bytes.insert(transfer.bytes.end(), first, first + bytes);
  } catch (const std::bad_alloc&) {
    transfer.out_of_memory = true;
    return 0;
  }
  return bytes;
}

/// Converts the server's response to a part of the file, or to an error.
Result<std::optional<HttpPart>> partOf(Transfer& transfer) {
  const auto answers = [](const std::string& what) { return Error{Code::io, "the server " + what}; };
  const long status = transfer.status();
  if (status == 404 || status == 410) return std::optional<HttpPart>();
  const bool from_start = status == 200 && transfer.first == 0 && !transfer.too_long;
  if (from_start) return std::optional(HttpPart{transfer.bytes.size(), std::move(transfer.bytes)});
  if (status == 200)
    return answers("ignores range requests and sends the whole file: use another server, such as nginx or Apache");
  // These statuses mean that the server is unavailable. Other 5xx statuses concern only this file.
  if (status == 408 || status == 429 || status == 502 || status == 503 || status == 504)
    return Error{Code::busy, "the server answers with status " + std::to_string(status)};
  if (status == 401)
    return answers(
        "answers with status 401: the address needs a user name and the right password, as in "
        "http://name:password@...");
  if (status != 206) return answers("answers with status " + std::to_string(status));
  if (transfer.range_first != transfer.first || transfer.file_bytes.value_or(0) <= transfer.first ||
      transfer.too_long ||
      transfer.bytes.size() != std::min<uint64_t>(transfer.count, *transfer.file_bytes - transfer.first))
    return answers("answers with another part of the file than the requested one");
  return std::optional(HttpPart{*transfer.file_bytes, std::move(transfer.bytes)});
}

}  // namespace

Result<std::unique_ptr<HttpClient>> HttpClient::create() {
  const Result<CurlTable> curl = loadCurl();
  if (!curl) return curl.error();
  // curl_global_init is called once per process, and curl_global_cleanup never, because before version 7.84 of libcurl
  // neither function is thread-safe.
  static const CURLcode started = curl->global_init(CURL_GLOBAL_DEFAULT);
  CURL* const handle = started == CURLE_OK ? curl->easy_init() : nullptr;
  if (handle == nullptr) return Error{Code::out_of_memory, "libcurl cannot be started: there is too little memory"};
  const bool is_new_enough = curl->easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https") == CURLE_OK;
  curl->easy_cleanup(handle);
  if (!is_new_enough)
    return Error{Code::unsupported,
                 "libcurl is older than 7.85: to read stores from servers, update the package libcurl4"};
  return std::unique_ptr<HttpClient>(new HttpClient(*curl));
}

HttpClient::~HttpClient() {
  const NoPipeSignal no_signal;
  for (CURL* handle : idle_) curl_.easy_cleanup(handle);
}

int HttpClient::progress(void* client, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return static_cast<HttpClient*>(client)->stopped_ ? 1 : 0;
}

HttpClient::Connection::~Connection() {
  const std::lock_guard lock(client.mutex_);
  // push_back cannot throw here: take() reserved the capacity when it created the handle.
  client.idle_.push_back(handle);
}

CURL* HttpClient::take() {
  const std::lock_guard lock(mutex_);
  if (!idle_.empty()) {
    CURL* const handle = idle_.back();
    idle_.pop_back();
    return handle;
  }
  idle_.reserve(handles_ + 1);
  CURL* const handle = curl_.easy_init();
  if (handle == nullptr) throw std::bad_alloc();
  ++handles_;
  const auto set = [&](CURLoption option, auto value) { curl_.easy_setopt(handle, option, value); };
  set(CURLOPT_NOSIGNAL, 1L);
  // Without this option, a request waits for the system's name resolver, which ignores the timeouts and stop().
  set(CURLOPT_QUICK_EXIT, 1L);
  set(CURLOPT_PROTOCOLS_STR, "http,https");
  set(CURLOPT_REDIR_PROTOCOLS_STR, "http,https");
  set(CURLOPT_FOLLOWLOCATION, 1L);
  set(CURLOPT_MAXREDIRS, 5L);
  set(CURLOPT_CONNECTTIMEOUT_MS, kConnectMilliseconds);
  set(CURLOPT_TIMEOUT_MS, kMilliseconds);
  set(CURLOPT_LOW_SPEED_LIMIT, kLeastBytesPerSecond);
  set(CURLOPT_LOW_SPEED_TIME, kSlowSeconds);
  set(CURLOPT_USERAGENT, "sgm");
  set(CURLOPT_NOPROGRESS, 0L);
  set(CURLOPT_XFERINFOFUNCTION, &HttpClient::progress);
  set(CURLOPT_XFERINFODATA, this);
  set(CURLOPT_HEADERFUNCTION, &takeHeader);
  set(CURLOPT_WRITEFUNCTION, &takeBody);
  return handle;
}

Result<std::optional<HttpPart>> HttpClient::get(const std::string& address, uint64_t first, size_t count,
                                                std::pmr::memory_resource* memory) {
  if (stopped_) return Error{Code::busy, "reading was stopped"};
  const std::string range = std::to_string(first) + "-" + std::to_string(first + count - 1);
  const Connection connection{*this, take()};
  Transfer transfer{curl_, connection.handle, first, count, std::pmr::vector<std::byte>(memory), {}, {}};
  std::array<char, CURL_ERROR_SIZE> words{};
  const auto set = [&](CURLoption option, auto value) { return curl_.easy_setopt(connection.handle, option, value); };
  CURLcode code = set(CURLOPT_URL, address.c_str());
  if (code == CURLE_OK) code = set(CURLOPT_RANGE, range.c_str());
  set(CURLOPT_ERRORBUFFER, words.data());
  set(CURLOPT_HEADERDATA, &transfer);
  set(CURLOPT_WRITEDATA, &transfer);
  if (code == CURLE_OK) {
    const NoPipeSignal no_signal;
    code = curl_.easy_perform(connection.handle);
  }
  set(CURLOPT_ERRORBUFFER, static_cast<char*>(nullptr));
  if (transfer.out_of_memory || code == CURLE_OUT_OF_MEMORY) throw std::bad_alloc();
  if (code == CURLE_OK || (code == CURLE_WRITE_ERROR && transfer.too_long)) return partOf(transfer);
  std::string why = words[0] != 0 ? words.data() : curl_.easy_strerror(code);
  // With OpenSSL, "wrong version number" means that the server does not use TLS.
  if (why.find("wrong version number") != std::string::npos) why += "; is it http:// instead of https://?";
  return Error{Code::busy, std::move(why)};
}

}  // namespace sgm::store
