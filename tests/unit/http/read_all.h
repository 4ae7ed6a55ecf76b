#pragma once
// Reads bytes with a RequestReader, and collects all results.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/service/http/request_reader.h"

namespace sgm::service::http {

/// One request as it was read, or the reason why it was rejected.
struct Told {
  Request request;
  std::string body;
  bool has_head = false, go_on = false, ended = false;
  bool keep_alive = false;
  int refused = 0;  ///< HTTP status with which the request was rejected; 0 if it was accepted
  std::string code;

  /// The whole result as text, for comparing and printing.
  std::string text() const {
    std::string out = request.method + " " + request.path;
    for (const auto& [name, value] : request.query) out += "\n?" + name + "=" + value;
    for (const Field& field : request.fields) out += "\n" + field.name + ": " + field.value;
    out += "\nbody " + body + "\nhead " + std::to_string(has_head) + " go on " + std::to_string(go_on) + " end " +
           std::to_string(ended) + " keep alive " + std::to_string(keep_alive);
    return out + "\nrefused " + std::to_string(refused) + " " + code + "\n";
  }
};

/// Passes the bytes to the reader in pieces: the callback size(bytes left) returns the size of the next piece (at least
/// 1). Stops when the reader rejects a request. The last element is an incomplete request, or the rejected one.
inline std::vector<Told> readAll(std::string_view bytes, uint64_t max_bytes, const ReaderLimits& limits,
                                 const std::function<size_t(size_t)>& size) {
  using Event = RequestReader::Event;
  RequestReader reader(limits);
  std::vector<Told> told(1);
  while (!bytes.empty()) {
    // Each piece is copied to memory of its exact size, so that AddressSanitizer detects a reader that reads beyond it.
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
          reader.allow(max_bytes);
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

inline std::vector<Told> readAll(std::string_view bytes, uint64_t max_bytes = 1000, const ReaderLimits& limits = {}) {
  return readAll(bytes, max_bytes, limits, [](size_t left) { return left; });
}

inline std::string textOf(const std::vector<Told>& told) {
  std::string out;
  for (const Told& one : told) out += one.text();
  return out;
}

}  // namespace sgm::service::http
