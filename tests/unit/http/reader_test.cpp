// Tests RequestReader: the result must not depend on how the bytes are split, and each request has one result.

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "catch.h"
#include "read_all.h"
#include "rounds.h"
#include "tools/service/http/target.h"

using namespace sgm;
using namespace sgm::service::http;

namespace {

using Random = std::mt19937_64;

size_t upTo(Random& random, size_t most) { return std::uniform_int_distribution<size_t>(0, most)(random); }

std::string letters(Random& random, std::string_view of, size_t least, size_t most) {
  std::string out(least + upTo(random, most - least), ' ');
  for (char& c : out) c = of[upTo(random, of.size() - 1)];
  return out;
}

/// Percent-encodes the characters that require it, and others at random.
std::string encoded(Random& random, const std::string& text) {
  constexpr std::string_view kHex = "0123456789ABCDEFabcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x80 && std::isalnum(byte) != 0 && upTo(random, 3) != 0) || c == '-') {
      out += c;
      continue;
    }
    const size_t low = byte & 15;
    ((out += '%') += kHex[byte >> 4]) += kHex[low >= 10 && upTo(random, 1) == 0 ? low + 6 : low];
  }
  return out;
}

/// A request, and its bytes as a client sends them.
struct Said {
  Told told;
  std::string bytes;
};

Said randomRequest(Random& random) {
  constexpr std::string_view kLetters = "abcXYZ059-";
  const std::vector<std::string> texts = {"a", "b c", "\xC3\xA9", "%", "=&?#", "\xF0\x9F\x8C\x8D", "z-9", "+"};
  const auto text = [&] {
    std::string out;
    for (size_t i = upTo(random, 2) + 1; i > 0; --i) out += texts[upTo(random, texts.size() - 1)];
    return out;
  };
  Said said;
  Told& told = said.told;
  Request& request = told.request;
  told.has_head = told.ended = true;
  const std::vector<std::string> methods = {"GET", "HEAD", "POST", "PUT", "DELETE", "X-Y"};
  request.method = methods[upTo(random, methods.size() - 1)];
  std::string target;
  for (size_t i = upTo(random, 3) + 1; i > 0; --i) {
    const std::string segment = text();
    request.path += "/" + segment;
    target += "/" + encoded(random, segment);
  }
  for (size_t i = upTo(random, 2); i > 0; --i) {
    const std::string name = text(), value = text();
    request.query.emplace_back(name, value);
    target +=
        (target.find('?') == std::string::npos ? "?" : "&") + encoded(random, name) + "=" + encoded(random, value);
  }
  const bool http11 = upTo(random, 3) != 0;
  if (upTo(random, 4) == 0) target = "http://h:1" + target;
  said.bytes = (upTo(random, 4) == 0 ? "\r\n" : "") + request.method + " " + target +
               (http11 ? " HTTP/1.1" : " HTTP/1.0") + "\r\n";
  const auto field = [&](const std::string& name, const std::string& value) {
    request.fields.push_back({name, value});
    said.bytes += name + ":" + std::string(upTo(random, 2), ' ') + value + std::string(upTo(random, 2), '\t') + "\r\n";
  };
  field("hOsT", "H:1");
  for (size_t i = upTo(random, 4); i > 0; --i)
    field("X" + std::to_string(i) + letters(random, kLetters, 0, 8), letters(random, "ab c\t\"\xE9:,;", 0, 30) + "e");
  for (Field& f : request.fields) f.value.erase(0, f.value.find_first_not_of(" \t"));
  const size_t connection = upTo(random, 3);
  if (connection == 1) field("Connection", "close");
  if (connection == 2) field("Connection", "foo, Keep-Alive");
  told.keep_alive = connection == 2 || (http11 && connection != 1);

  const bool must = request.method == "POST" || request.method == "PUT";
  const size_t framing = upTo(random, must ? 1 : 2);
  if (framing < 2) told.body = letters(random, std::string_view("ab\r\n0 \0\xFF", 8), 0, 200);
  const bool waits = http11 && framing < 2 && upTo(random, 3) == 0;
  if (waits) field("Expect", "100-Continue");
  if (framing == 0 || (framing == 1 && !http11)) {
    field("Content-Length", std::to_string(told.body.size()));
    told.go_on = waits && !told.body.empty();
    said.bytes += "\r\n" + told.body;
  } else if (framing == 1) {
    field("Transfer-Encoding", "Chunked");
    told.go_on = waits;
    said.bytes += "\r\n";
    for (size_t at = 0; at < told.body.size();) {
      const size_t size = std::min(1 + upTo(random, 40), told.body.size() - at);
      char digits[20];
      std::snprintf(digits, sizeof digits, upTo(random, 1) ? "%zx" : "%03zX", size);
      said.bytes += digits + std::string(upTo(random, 3) == 0 ? " ;a=\"b\";c" : "") + "\r\n" +
                    told.body.substr(at, size) + "\r\n";
      at += size;
    }
    said.bytes += std::string("0") + (upTo(random, 3) == 0 ? ";last" : "") + "\r\n" +
                  (upTo(random, 3) == 0 ? "Trailer: x\r\nB: c\r\n" : "") + "\r\n";
  } else {
    said.bytes += "\r\n";
  }
  return said;
}

std::function<size_t(size_t)> cutBy(Random& random, size_t most) {
  return [&random, most](size_t left) { return 1 + upTo(random, std::min(left, most) - 1); };
}

}  // namespace

TEST_CASE("Random requests are read as they were meant, however they are cut") {
  for (unsigned seed = 0; seed < rounds(3000); ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::string bytes, meant;
    for (size_t i = upTo(random, 3) + 1; i > 0; --i) {
      const Said said = randomRequest(random);
      bytes += said.bytes;
      meant += said.told.text();
    }
    meant += Told().text();
    CAPTURE(bytes);
    REQUIRE(textOf(readAll(bytes)) == meant);
    REQUIRE(textOf(readAll(bytes, 1000, {}, [](size_t) { return size_t{1}; })) == meant);
    REQUIRE(textOf(readAll(bytes, 1000, {}, cutBy(random, 50))) == meant);
  }
}

TEST_CASE("Requests that were damaged mean the same however they are cut, and are answered once") {
  constexpr std::string_view kWords[] = {"\r\n",
                                         "\n",
                                         "\r",
                                         ":",
                                         " ",
                                         "0\r\n\r\n",
                                         "Content-Length: 5\r\n",
                                         "%",
                                         "/../",
                                         "HTTP/",
                                         "\t",
                                         "Transfer-Encoding: chunked\r\n",
                                         "\0",
                                         "ffffffffffffffff\r\n"};
  const ReaderLimits limits{.line_bytes = 200, .head_bytes = 500, .fields = 8};
  size_t refused = 0, read = 0;
  for (unsigned seed = 0; seed < rounds(5000); ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::string bytes = randomRequest(random).bytes + randomRequest(random).bytes;
    for (size_t i = upTo(random, 2) + 1; i > 0; --i) {
      const size_t at = upTo(random, bytes.size() - 1);
      switch (upTo(random, 3)) {
        case 0:
          bytes[at] = static_cast<char>(upTo(random, 255));
          break;
        case 1:
          bytes.erase(at, 1 + upTo(random, 5));
          break;
        case 2:
          bytes.insert(at, kWords[upTo(random, std::size(kWords) - 1)]);
          break;
        default:
          bytes.insert(at, bytes.substr(upTo(random, bytes.size() - 1), 20));
          break;
      }
      if (bytes.empty()) bytes = "x";
    }
    CAPTURE(bytes);
    const std::vector<Told> whole = readAll(bytes, 100, limits);
    REQUIRE(textOf(readAll(bytes, 100, limits, [](size_t) { return size_t{1}; })) == textOf(whole));
    REQUIRE(textOf(readAll(bytes, 100, limits, cutBy(random, 40))) == textOf(whole));
    for (const Told& told : whole) {
      REQUIRE_FALSE((told.ended && told.refused != 0));
      REQUIRE(told.body.size() <= 100);
      ++(told.refused != 0 ? refused : read);
    }
  }
  CHECK(refused > 100);
  CHECK(read > 100);
}

TEST_CASE("A refusal is the last thing that a reader says") {
  RequestReader reader((ReaderLimits()));
  std::string_view bytes = "nonsense\r\n\r\nGET / HTTP/1.1\r\nHost: h\r\n\r\n";
  REQUIRE(reader.next(bytes) == RequestReader::Event::refused);
  const std::string_view left = bytes;
  for (int i = 0; i < 3; ++i) CHECK(reader.next(bytes) == RequestReader::Event::refused);
  CHECK(bytes == left);
}

TEST_CASE("A request that is answered at its head gives way to the next") {
  RequestReader reader((ReaderLimits()));
  std::string_view bytes = "POST /a HTTP/1.1\r\nHost: h\r\n\r\nGET /b HTTP/1.1\r\nHost: h\r\n\r\n";
  CHECK(reader.between());
  REQUIRE(reader.next(bytes) == RequestReader::Event::head);
  CHECK_FALSE(reader.hasBody());
  reader.finish();
  REQUIRE(reader.next(bytes) == RequestReader::Event::head);
  CHECK(reader.request().path == "/b");
  REQUIRE(reader.next(bytes) == RequestReader::Event::end);
  REQUIRE(reader.next(bytes) == RequestReader::Event::starved);
  CHECK(reader.between());
  bytes = "\r\n";
  REQUIRE(reader.next(bytes) == RequestReader::Event::starved);
  CHECK_FALSE(reader.between());
}

TEST_CASE("Each bad request has its status, and what looks like one but is not is read") {
  struct Case {
    int status;  ///< 200 if the request is read; otherwise the status of the rejection
    std::string bytes;
  };
  const std::string host = "Host: h\r\n", end = "\r\n";
  const auto line = [&](const std::string& request_line) { return request_line + end + host + end; };
  const auto target = [&](const std::string& of) { return line("GET " + of + " HTTP/1.1"); };
  const auto field = [&](const std::string& of) { return "GET / HTTP/1.1\r\n" + host + of + "\r\n\r\n"; };
  const auto posted = [&](const std::string& fields, const std::string& body) {
    return "POST / HTTP/1.1\r\n" + host + fields + end + body;
  };
  const auto chunks = [&](const std::string& body) { return posted("Transfer-Encoding: chunked\r\n", body); };
  const std::vector<Case> cases = {
      // Cases of the request line.
      {200, line("GET / HTTP/1.1")},
      {200, "\r\n" + line("GET / HTTP/1.1")},
      {400, "\r\n\r\n" + line("GET / HTTP/1.1")},
      {200, "GET / HTTP/1.0\r\n\r\n"},
      {200, line("get / HTTP/1.1")},
      {200, line("M-SEARCH / HTTP/1.1")},
      {400, line("GET / HTTP/1.1 ")},
      {400, line(" GET / HTTP/1.1")},
      {400, line("GET  / HTTP/1.1")},
      {400, line("GET\t/ HTTP/1.1")},
      {400, line("GET /")},
      {400, line("GET / http/1.1")},
      {400, line("GET / HTTP/1.x")},
      {400, line("GET / HTTP/11")},
      {400, line("GET /a b HTTP/1.1")},
      {400, line("G(T / HTTP/1.1")},
      {400, line("GET /\xC3\xA9 HTTP/1.1")},
      {505, line("GET / HTTP/1.2")},
      {505, line("GET / HTTP/0.9")},
      {505, "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"},
      {400, "\x16\x03\x01\x02"},
      {414, "GET /" + std::string(8192, 'a')},
      {200, target("/" + std::string(8192 - 14, 'a'))},
      {414, target("/" + std::string(8192 - 13, 'a'))},
      // The target.
      {400, target("*")},
      {400, line("OPTIONS * HTTP/1.1")},
      {400, line("CONNECT h:80 HTTP/1.1")},
      {400, line("CONNECT / HTTP/1.1")},
      {400, target("a")},
      {400, target("//")},
      {400, target("//h/a")},
      {400, target("/a//b")},
      {200, target("/a/")},
      {400, target("/.")},
      {400, target("/a/../b")},
      {400, target("/a/%2e%2E/b")},
      {400, target("/%2e")},
      {200, target("/...")},
      {200, target("/.a")},
      {400, target("/%2F")},
      {400, target("/%5c")},
      {400, target("/\\")},
      {400, target("/%")},
      {400, target("/%4")},
      {400, target("/%4g")},
      {400, target("/%00")},
      {400, target("/%0a")},
      {400, target("/%7f")},
      {400, target("/%c2%85")},
      {400, target("/%ff")},
      {400, target("/%c0%af")},
      {200, target("/%C3%A9")},
      {400, target("/#a")},
      {400, target("/?a=%zz")},
      {400, target("/?a=%00")},
      {200, target("/?")},
      {200, target("/?&&a&=b&c=d=e")},
      {200, target("http://h/a?b")},
      {200, target("HTTP://H")},
      {200, target("http://h?a")},
      {400, target("http://g/a")},
      {400, target("http://h:80/a")},
      {400, target("http://u@h/a")},
      {400, target("http:///a")},
      {400, target("https://h/a")},
      {400, "GET http://h/a HTTP/1.0\r\n\r\n"},
      // Host.
      {400, "GET / HTTP/1.1\r\n\r\n"},
      {400, field("Host: h")},
      {400, "GET / HTTP/1.0\r\n" + host + host + end},
      {400, "GET / HTTP/1.1\r\nHost: a b\r\n\r\n"},
      {400, "GET / HTTP/1.1\r\nHost: a,b\r\n\r\n"},
      {400, "GET / HTTP/1.1\r\nHost: a/b\r\n\r\n"},
      {200, "GET / HTTP/1.1\r\nHost: [::1]:80\r\n\r\n"},
      // Fields.
      {200, field("A:")},
      {200, field("A: \t b \t ")},
      {200, field("A: \xE9")},
      {400, field("A : b")},
      {400, field(" A: b")},
      {400, field("A: b\r\n c")},
      {400, field("A: b\r\n\tc")},
      {400, field(": b")},
      {400, field("A")},
      {400, field("A\xC3: b")},
      {400, field(std::string("A: b\0c", 6))},
      {400, field("A: b\x7F")},
      {400, field("A: b\x1b")},
      {400, field("A: b\nB: c")},
      {400, field("A: b\rB: c")},
      {400, "GET / HTTP/1.1\nHost: h\n\n"},
      {400, field("A: b\n")},
      {400, field("Connection: ;;")},
      {431, field("A: " + std::string(8190, 'b'))},
      {200, field("A: " + std::string(8189, 'b'))},
      {431, "GET / HTTP/1.1\r\nA: " + std::string(8192, 'b')},
      // Lengths.
      {200, posted("Content-Length: 3\r\n", "abc")},
      {200, posted("Content-Length: 0\r\n", "")},
      {200, posted("Content-Length: 003\r\n", "abc")},
      {411, posted("", "")},
      {411, "PUT / HTTP/1.1\r\n" + host + end},
      {200, "DELETE / HTTP/1.1\r\n" + host + end},
      {413, posted("Content-Length: 1001\r\n", "")},
      {200, posted("Content-Length: 1000\r\n", std::string(1000, 'x'))},
      {400, posted("Content-Length: 18446744073709551616\r\n", "")},
      {413, posted("Content-Length: 18446744073709551615\r\n", "")},
      {400, posted("Content-Length: -1\r\n", "")},
      {400, posted("Content-Length: +1\r\n", "")},
      {400, posted("Content-Length: 0x1\r\n", "")},
      {400, posted("Content-Length: 1 1\r\n", "")},
      {400, posted("Content-Length:\r\n", "")},
      {400, posted("Content-Length: 3, 3\r\n", "abc")},
      {400, posted("Content-Length: 3\r\nContent-Length: 3\r\n", "abc")},
      {400, posted("Content-Length: 3\r\nContent-Length: 4\r\n", "abc")},
      {400, posted("Content-Length: 3\r\nTransfer-Encoding: chunked\r\n", "0\r\n\r\n")},
      {400, posted("Transfer-Encoding: chunked\r\nContent-Length: 3\r\n", "0\r\n\r\n")},
      {400, posted("Content-Length: 3\r\nTransfer-Encoding: gzip\r\n", "abc")},
      {400, posted("Content-Length : 3\r\n", "abc")},
      {400, "POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"},
      {400, posted("Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n", "0\r\n\r\n")},
      {501, posted("Transfer-Encoding: gzip\r\n", "")},
      {501, posted("Transfer-Encoding: gzip, chunked\r\n", "0\r\n\r\n")},
      {501, posted("Transfer-Encoding: chunked, identity\r\n", "0\r\n\r\n")},
      {501, posted("Transfer-Encoding: xchunked\r\n", "0\r\n\r\n")},
      {501, posted("Transfer-Encoding: \"chunked\"\r\n", "0\r\n\r\n")},
      {400, posted("Transfer-Encoding: \x0b"
                   "chunked\r\n",
                   "0\r\n\r\n")},
      {501, posted("Transfer-Encoding:\r\n", "")},
      // Cases of Expect, and of transfer encodings.
      {417, posted("Content-Length: 1\r\nExpect: 200-ok\r\n", "a")},
      {417, posted("Content-Length: 1\r\nExpect: 100-continue\r\nExpect: 100-continue\r\n", "a")},
      {200, posted("Content-Length: 1\r\nExpect: 100-CONTINUE\r\n", "a")},
      {415, posted("Content-Length: 1\r\nContent-Encoding: gzip\r\n", "a")},
      {200, posted("Content-Length: 1\r\nContent-Encoding: Identity\r\n", "a")},
      // Chunks.
      {200, chunks("3\r\nabc\r\n0\r\n\r\n")},
      {200, chunks("3 ; a=b\r\nabc\r\n00\r\nA: b\r\n\r\n")},
      {200, chunks("3e8\r\n" + std::string(1000, 'x') + "\r\n0\r\n\r\n")},
      {413, chunks("3e9\r\n")},
      {413, chunks("3e8\r\n" + std::string(1000, 'x') + "\r\n1\r\n")},
      {413, chunks("ffffffffffffffff\r\n")},
      {400, chunks("0ffffffffffffffff\r\n")},
      {400, chunks("x\r\n")},
      {400, chunks("\r\n")},
      {400, chunks("-1\r\n")},
      {400, chunks("0x1\r\n")},
      {400, chunks("1 1\r\n")},
      {400, chunks("1 \r\na\r\n0\r\n\r\n")},
      {400, chunks("1\t\r\na\r\n0\r\n\r\n")},
      {400, chunks("1\r\na\r\n0 \r\n\r\n")},
      {400, chunks("1\na")},
      {400, chunks("1\r\r\n")},
      {400, chunks("1;a\nb\r\na\r\n")},
      {400, chunks("1\r\naa\r\n")},
      {400, chunks("1\r\na\n0\r\n\r\n")},
      {400, chunks("0\r\nA: b\n\r\n")},
      {400, chunks("0\r\n\n")},
      {431, chunks("1;" + std::string(5000, 'a') + "\r\na\r\n0\r\n\r\n")},
      {431, chunks("0\r\nA: " + std::string(5000, 'a') + "\r\n\r\n")},
  };
  for (const Case& one : cases) {
    CAPTURE(one.bytes.substr(0, 300));
    const std::vector<Told> told = readAll(one.bytes);
    const Told& first = told.front();
    CHECK(first.refused == (one.status == 200 ? 0 : one.status));
    CHECK(first.ended == (one.status == 200));
    CHECK(textOf(readAll(one.bytes, 1000, {}, [](size_t) { return size_t{1}; })) == textOf(told));
  }
}

TEST_CASE("The limits of a head are met to the byte") {
  const ReaderLimits limits{.line_bytes = 40, .head_bytes = 100, .fields = 3};
  const auto statusOf = [&](const std::string& bytes) { return readAll(bytes, 0, limits).front().refused; };
  const std::string line = "GET / HTTP/1.1\r\nHost: h\r\n";  // 25 bytes
  CHECK(statusOf(line + "A: b\r\nB: c\r\n\r\n") == 0);
  CHECK(statusOf(line + "A: b\r\nB: c\r\nC: d\r\n\r\n") == 431);
  CHECK(statusOf(line + "A: " + std::string(31, 'a') + "\r\nB: " + std::string(33, 'b') + "\r\n\r\n") == 431);
  CHECK(statusOf(line + "A: " + std::string(31, 'a') + "\r\nB: " + std::string(32, 'b') + "\r\n\r\n") == 0);
  CHECK(statusOf("GET /" + std::string(26, 'a') + " HTTP/1.1\r\nHost: h\r\n\r\n") == 0);
  CHECK(statusOf("GET /" + std::string(27, 'a') + " HTTP/1.1\r\nHost: h\r\n\r\n") == 414);
  // Input that never ends is rejected at a limit.
  CHECK(statusOf(std::string(101, 'a')) == 414);
  std::string parameters;
  for (size_t i = 0; i < kMaxParameters; ++i) parameters += "&a";
  const auto query = [](const std::string& text) { return "GET /?" + text + " HTTP/1.1\r\nHost: h\r\n\r\n"; };
  CHECK(readAll(query(parameters)).front().refused == 0);
  CHECK(readAll(query(parameters + "&a")).front().refused == 400);
}

TEST_CASE("A query is decoded, and asked for by name") {
  const Request request =
      readAll("GET /a%20b?x=1+2%2B3&set=k=v&x=9&empty&=n HTTP/1.1\r\nHost: h\r\nA: 1\r\na: 2\r\n\r\n").front().request;
  CHECK(request.path == "/a b");
  CHECK(request.query.size() == 5);
  CHECK(request.parameter("x") == "1 2+3");
  CHECK(request.parameter("set") == "k=v");
  CHECK(request.parameter("empty") == "");
  CHECK(request.parameter("") == "n");
  CHECK_FALSE(request.parameter("none"));
  CHECK(request.field("A") == "1");
  CHECK(request.field("HOST") == "h");
  CHECK_FALSE(request.field("B"));
}
