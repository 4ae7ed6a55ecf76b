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

/// A head that was read whole and is well formed.
struct Request {
  std::string method;  ///< as it was sent: "GET"
  std::string path;    ///< decoded, begins with '/'; valid UTF-8 without control characters and segments "." and ".."
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded, in the order in which they were sent
  std::vector<Field> fields;
  /// True once nobody waits for the answer: the client has gone, or was told that it took too long, or the server has
  /// stopped. A client that has only ended its own saying still waits, and one that has closed looks the same until
  /// its system resets the connection: within some two minutes. Null in a request that no server made. From any
  /// thread; outlives the request where it is copied.
  std::shared_ptr<const std::atomic<bool>> gone;

  /// Of a field by its name, in letters of any case; the first one. Nothing where it was not sent.
  std::optional<std::string_view> field(std::string_view name) const;
  /// The first value of a parameter of the query. Nothing where it was not sent.
  std::optional<std::string_view> parameter(std::string_view name) const;
};

struct Response {
  int status = 200;
  std::string type;           ///< of the content; empty: there is none
  std::vector<Field> fields;  ///< beside those that the server writes: Content-Length, Content-Type, Date
  std::shared_ptr<const std::string>
      body;            ///< null: empty. Shared, so that a page's file is not copied for each client
  bool close = false;  ///< the connection ends with this answer
};

Response makeResponse(int status, std::string type, std::string body);

/// RFC 9457: what was wrong, as JSON.
struct Problem {
  int status = 400;
  std::string code;     ///< for programs: "too_large"
  std::string detail;   ///< for people: one sentence that says what to do
  std::string pointer;  ///< into the JSON that is wrong (RFC 6901); empty: none
};
Response makeResponse(const Problem& problem);

/// "Not Found"; "Unknown" for a status that has no name here.
std::string_view reasonOf(int status);

}  // namespace sgm::service::http
