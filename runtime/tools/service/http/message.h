#pragma once
// A request's head and an answer, as handlers see them.

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sgm::service::http {

struct Field {
  std::string name, value;
};

/// A complete and well-formed head.
struct Request {
  std::string method;  ///< as sent: "GET"
  std::string path;    ///< decoded, begins with '/'; valid UTF-8 without control characters and segments "." and ".."
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded, in the order of the request
  std::vector<Field> fields;
  /// True once the answer is no longer needed: the client is gone, or had a timeout, or the server has stopped. A
  /// client that has only shut down its sending direction still waits; a closed one looks the same until its system
  /// resets the connection, within about two minutes. Null in a request that no server made. Thread-safe; a copy may
  /// outlive the request.
  std::shared_ptr<const std::atomic<bool>> gone;

  /// The first field of that name, in any case. nullopt if it was not sent.
  std::optional<std::string_view> field(std::string_view name) const;
  /// The first value of a query parameter. nullopt if it was not sent.
  std::optional<std::string_view> parameter(std::string_view name) const;
};

struct Response {
  int status = 200;
  std::string type;                         ///< of the content; empty: no content
  std::vector<Field> fields;                ///< besides those of the server: Content-Length, Content-Type, Date
  std::shared_ptr<const std::string> body;  ///< null: empty. Shared, so that a file is not copied for each client
  bool close = false;                       ///< the connection ends with this answer
};

Response makeResponse(int status, std::string type, std::string body);

/// A problem, as JSON (RFC 9457).
struct Problem {
  int status = 400;
  std::string code;     ///< for programs: "too_large"
  std::string detail;   ///< for users: one sentence with the remedy
  std::string pointer;  ///< to the wrong JSON value (RFC 6901); empty: none
};
Response makeResponse(const Problem& problem);

/// "Not Found"; "Unknown" for other statuses.
std::string_view reasonOf(int status);

}  // namespace sgm::service::http
