#pragma once
// The head of an HTTP request, and an answer, as handlers use them.

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

/// The complete, well-formed head of an HTTP request.
struct Request {
  std::string method;  ///< method as the client sent it, such as "GET"
  std::string path;    ///< decoded path, begins with '/'; valid UTF-8 without control characters and without segments
                       ///< "." and ".."
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded names and values of the query parameters, in the
                                                           ///< order of the request
  std::vector<Field> fields;
  /// Becomes true when the answer is no longer needed: the client has disconnected, the request has exceeded its time
  /// limit, or the server has stopped. A client that has only shut down its sending direction still waits for the
  /// answer. A client that has closed its socket looks the same at first, until its system resets the connection,
  /// within about two minutes. Null if the request does not come from a server. Thread-safe; a copy may outlive the
  /// request.
  std::shared_ptr<const std::atomic<bool>> gone;

  /// Returns the value of the first header with this name, regardless of case; nullopt if there is none.
  std::optional<std::string_view> field(std::string_view name) const;
  /// The first value of the query parameter with this name; nullopt if there is none.
  std::optional<std::string_view> parameter(std::string_view name) const;
};

struct Response {
  int status = 200;
  std::string type;           ///< media type of the body; empty if the answer has no body
  std::vector<Field> fields;  ///< further headers; the server sets Content-Length, Content-Type and Date itself
  std::shared_ptr<const std::string> body;  ///< null: empty body. Shared, so that a file is not copied for each client
  bool close = false;                       ///< whether the connection closes after this answer
};

Response makeResponse(int status, std::string type, std::string body);

/// An error that is sent to the client as JSON (RFC 9457, "Problem Details").
struct Problem {
  int status = 400;
  std::string code;     ///< identifier of the problem for programs, such as "too_large"
  std::string detail;   ///< explanation for users, in one sentence with the remedy
  std::string pointer;  ///< JSON pointer (RFC 6901) to the invalid value in the request; empty if there is none
};
Response makeResponse(const Problem& problem);

/// The reason phrase of a status, such as "Not Found"; "Unknown" for an unknown status.
std::string_view reasonOf(int status);

}  // namespace sgm::service::http
