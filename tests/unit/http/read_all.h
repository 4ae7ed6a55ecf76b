#pragma once
// Everything that a RequestReader says of some bytes.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/service/http/request_reader.h"

namespace sgm::service::http {

/// One request as it was read, or what stood in its way.
struct Told {
  Request request;
  std::string body;
  bool has_head = false, go_on = false, ended = false;
  bool keep_alive = false;
  int refused = 0;  ///< status of a refusal; 0: none
  std::string code;

  /// All of it, to compare and to print.
  std::string text() const {
    std::string out = request.method + " " + request.path;
    for (const auto& [name, value] : request.query) out += "\n?" + name + "=" + value;
    for (const Field& field : request.fields) out += "\n" + field.name + ": " + field.value;
    out += "\nbody " + body + "\nhead " + std::to_string(has_head) + " go on " + std::to_string(go_on) + " end " +
           std::to_string(ended) + " keep alive " + std::to_string(keep_alive);
    return out + "\nrefused " + std::to_string(refused) + " " + code + "\n";
  }
};

/// Gives the reader the bytes in pieces, each of a size that `size` returns for what is left (at least 1), and stops
/// where it refuses. The last one told is not whole, but where it is refused.
inline std::vector<Told> readAll(std::string_view bytes, uint64_t most_bytes, const ReaderLimits& limits,
                                 const std::function<size_t(size_t)>& size) {
  using Event = RequestReader::Event;
  RequestReader reader(limits);
  std::vector<Told> told(1);
  while (!bytes.empty()) {
    // A copy with nothing behind it: a reader that looks beyond its bytes is seen by AddressSanitizer.
    const std::vector<char> copy(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size(bytes.size())));
    bytes.remove_prefix(copy.size());
    std::string_view piece(copy.data(), copy.size());
    for (Event event = Event::starved; (event = reader.next(piece)) != Event::starved;) {
      Told& now = told.back();
      switch (event) {
        case Event::head:
          now.has_head = true;
          now.request = reader.request();
          now.keep_alive = reader.keepAlive();
          reader.allow(most_bytes);
          break;
        case Event::go_on:
          now.go_on = true;
          break;
        case Event::piece:
          now.body += reader.piece();
          break;
        case Event::end:
          now.ended = true;
          told.emplace_back();
          break;
        case Event::refused:
          now.refused = reader.refusal().status;
          now.code = reader.refusal().code;
          return told;
        case Event::starved:
          break;
      }
    }
  }
  return told;
}

inline std::vector<Told> readAll(std::string_view bytes, uint64_t most_bytes = 1000, const ReaderLimits& limits = {}) {
  return readAll(bytes, most_bytes, limits, [](size_t left) { return left; });
}

inline std::string textOf(const std::vector<Told>& told) {
  std::string out;
  for (const Told& one : told) out += one.text();
  return out;
}

}  // namespace sgm::service::http
