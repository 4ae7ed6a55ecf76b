// Parses arbitrary bytes as an HTTP request, in pieces whose sizes the first four bytes determine. The result must be a
// request or a rejection with a status, and the same whether the bytes arrive at once, in these pieces, or one by one.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/utf8.h"
#include "read_all.h"

using namespace sgm;
using namespace sgm::service::http;

namespace {

constexpr ReaderLimits kLimits{.line_bytes = 256, .head_bytes = 1024, .fields = 8};
constexpr uint64_t kMaxBytes = 500;

void check(bool holds) {
  if (!holds) std::abort();
}

void checkText(std::string_view text) {
  while (!text.empty()) {
    check(utf8Size(text) > 0 && static_cast<unsigned char>(text[0]) >= 0x20 && text[0] != 0x7F);
    text.remove_prefix(utf8Size(text));
  }
}

void checkRequest(const Request& request) {
  check(!request.method.empty() && request.path.front() == '/');
  checkText(request.path);
  for (const char* wrong : {"/./", "/../", "//"})
    check((request.path + (request.path.back() == '/' ? "" : "/")).find(wrong) == std::string::npos);
  size_t bytes = request.method.size() + request.path.size();
  for (const auto& [name, value] : request.query) {
    checkText(name);
    checkText(value);
    bytes += name.size() + value.size();
  }
  check(request.fields.size() <= kLimits.fields);
  for (const Field& field : request.fields) {
    check(!field.name.empty() && field.name.size() + field.value.size() <= kLimits.line_bytes);
    for (const char c : field.value) check(c != '\r' && c != '\n' && c != '\0');
    bytes += field.name.size() + field.value.size();
  }
  check(bytes <= kLimits.head_bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 4) return 0;
  const auto* text = static_cast<const char*>(static_cast<const void*>(data));
  const std::string_view bytes(text + 4, size - 4);
  const std::vector<Told> whole = readAll(bytes, kMaxBytes, kLimits);
  size_t turn = 0;
  const auto cut = [&](size_t left) { return std::min<size_t>(left, size_t{data[turn++ % 4]} + 1); };
  check(textOf(readAll(bytes, kMaxBytes, kLimits, cut)) == textOf(whole));
  check(textOf(readAll(bytes, kMaxBytes, kLimits, [](size_t) { return size_t{1}; })) == textOf(whole));
  for (const Told& told : whole) {
    check(&told == &whole.back() || (told.ended && told.refused == 0));
    check(!told.ended || (told.has_head && told.refused == 0));
    check(told.refused == 0 || (told.refused >= 400 && told.refused < 600 && !told.code.empty()));
    check(told.body.size() <= kMaxBytes);
    if (told.has_head) checkRequest(told.request);
  }
  return 0;
}
