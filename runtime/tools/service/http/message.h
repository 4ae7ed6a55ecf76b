#pragma once
// The head of a request, and an answer, as handlers use them.

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

/// The complete, well-formed head of a request.
struct Request {
  std::string method;  ///< as the client sent it: "GET"
  std::string path;    ///< decoded, begins with '/'; valid UTF-8 without control characters and segments "." and ".."
  std::vector<std::pair<std::string, std::string>> query;  ///< names and values, decoded, in the order of the request
  std::vector<Field> fields;
  /// Becomes true when the answer is no longer needed: the client has disconnected, the request has exceeded its time
  /// limit, or the server has stopped. A client that has only shut down its sending direction still waits for the
  /// answer; a client that has closed its socket looks the same, until its system resets the connection within about
  /// two minutes. Null if no server has made this request. Thread-safe; a copy may outlive the request.
  std::shared_ptr<const std::atomic<bool>> gone;

  /// The first field with that name, whose letters may have any case. nullopt if the client did not send it.
  std::optional<std::string_view> field(std::string_view name) const;
  /// The first value of a query parameter. nullopt if the client did not send it.
  std::optional<std::string_view> parameter(std::string_view name) const;
};

struct Response {
  int status = 200;
  std::string type;           ///< media type of the content; empty: the answer has no content
  std::vector<Field> fields;  ///< further fields; the server itself sets Content-Length, Content-Type and Date
  std::shared_ptr<const std::string> body;  ///< null: empty. Shared, so that a file is not copied for each client
  bool close = false;                       ///< the connection closes after this answer
};

Response makeResponse(int status, std::string type, std::string body);

/// A problem, sent as JSON (RFC 9457).
struct Problem {
  int status = 400;
  std::string code;     ///< identifies the problem for programs: "too_large"
  std::string detail;   ///< explains the problem to users, in one sentence with the remedy
  std::string pointer;  ///< JSON pointer to the wrong value (RFC 6901); empty: none
};
Response makeResponse(const Problem& problem);

/// The reason phrase of a status, such as "Not Found"; "Unknown" for statuses without one.
std::string_view reasonOf(int status);

}  // namespace sgm::service::http
