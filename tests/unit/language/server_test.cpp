// Tests the language server with valid and invalid messages of every kind: each request has one answer, and no message
// ends the server.

#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "catch.h"
#include "rounds.h"
#include "seed.h"
#include "tools/language/lsp_server.h"

using namespace sgm::cli;
using Json = nlohmann::json;

namespace {

std::vector<std::string> sampleTexts() {
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SGM_SAMPLE_GRAMMARS)) {
    if (entry.path().extension() != ".sgm") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    texts.push_back(text.str());
  }
  return texts;
}

Json request(int id, const std::string& method, Json params = Json::object()) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}};
}

/// A random JSON value.
Json anything(std::mt19937& random, int depth = 0) {
  switch (random() % (depth < 3 ? 7u : 5u)) {
    case 0:
      return nullptr;
    case 1:
      return static_cast<int>(random() % 2000) - 1000;
    case 2:
      return random() % 2 == 0;
    case 3:
      return "file:///tmp/a.sgm";
    case 4:
      return 0.5;
    case 5:
      return Json::array({anything(random, depth + 1)});
    default:
      return {
          {std::array{"textDocument", "position", "uri", "line", "character", "contentChanges", "text"}[random() % 7],
           anything(random, depth + 1)}};
  }
}

constexpr std::array kMethods = {"textDocument/completion",     "textDocument/hover",      "textDocument/definition",
                                 "textDocument/documentSymbol", "textDocument/formatting", "sgm/standardText"};

}  // namespace

TEST_CASE("each request has one answer, and diagnostics lie in their text, whatever is sent") {
  const unsigned seed = sgm::testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const std::vector<std::string> texts = sampleTexts();
  LanguageServer server;
  REQUIRE(server.handle(request(0, "initialize")).size() == 1);
  const std::string uri = "file:///tmp/a.sgm";
  int id = 0;
  size_t answered = 0, refused = 0;
  for (unsigned round = 0; round < sgm::rounds(60); ++round) {
    std::string text = texts[random() % texts.size()];
    for (unsigned edits = static_cast<unsigned>(random() % 3); edits > 0; --edits)
      text.insert(random() % text.size(), 1, "{}()\";/.\n\xC3x"[random() % 11]);
    if (random() % 3 == 0) text.resize(random() % text.size());
    const DocumentText document(text);
    const std::string method = round == 0 ? "textDocument/didOpen" : "textDocument/didChange";
    const auto published = server.handle(
        {{"jsonrpc", "2.0"},
         {"method", method},
         {"params",
          {{"textDocument", {{"uri", uri}, {"text", text}}}, {"contentChanges", Json::array({{{"text", text}}})}}}});
    REQUIRE_FALSE(published.empty());
    for (const Json& message : published) {
      if (message["params"]["uri"] != uri) continue;
      for (const Json& diagnostic : message["params"]["diagnostics"])
        for (const char* end : {"start", "end"}) {
          const TextPosition place{diagnostic["range"][end]["line"], diagnostic["range"][end]["character"]};
          const TextPosition back = document.position(document.offset(place));
          CHECK((back.line == place.line && back.character == place.character));
        }
    }
    for (int k = 0; k < 20; ++k) {
      Json params{{"textDocument", {{"uri", uri}}},
                  {"position", {{"line", random() % 60}, {"character", random() % 120}}},
                  {"uri", "sgm-std:/rock.sgm"}};
      if (random() % 4 == 0) params = anything(random);
      const auto answers = server.handle(request(++id, kMethods[random() % kMethods.size()], params));
      REQUIRE(answers.size() == 1);
      CHECK(answers[0]["id"] == id);
      CHECK(answers[0].contains("result") != answers[0].contains("error"));
      (answers[0].contains("result") ? answered : refused) += 1;
    }
    CHECK(server.handle(anything(random)).size() <= 1);
  }
  CHECK(answered > 0);
  CHECK(refused > 0);
  CHECK_FALSE(server.ended());
}

TEST_CASE("a change with a range takes its place, and leaves the rest as it is") {
  LanguageServer server;
  server.handle(request(0, "initialize"));
  const std::string uri = "file:///tmp/ranges.sgm";
  const auto sent = [&](const std::string& method, Json extra) {
    Json params{{"textDocument", {{"uri", uri}}}};
    for (const auto& [key, value] : extra.items()) params[key] = value;
    return server.handle({{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
  };
  const auto place = [](int line, int character) { return Json{{"line", line}, {"character", character}}; };
  const auto change = [&](Json start, Json end, const std::string& text) {
    return Json{{"range", {{"start", start}, {"end", end}}}, {"rangeLength", 0}, {"text", text}};
  };
  const auto errors = [](const std::vector<Json>& published) {
    REQUIRE(published.size() == 1);
    return published[0]["params"]["diagnostics"].size();
  };
  server.handle(
      {{"jsonrpc", "2.0"},
       {"method", "textDocument/didOpen"},
       {"params",
        {{"textDocument",
          {{"uri", uri}, {"text", "sgm 1;\nstart A; // \xF0\x9F\x98\x80 here\nrule A { sphere(1m); }\n"}}}}}});
  // Changes apply one after the other, each to the text that the previous ones produced; positions count UTF-16 units.
  CHECK(errors(sent("textDocument/didChange",
                    {{"contentChanges", Json::array({change(place(2, 9), place(2, 15), "box"),
                                                     change(place(2, 13), place(2, 15), "1")})}})) == 1);
  CHECK(errors(sent("textDocument/didChange",
                    {{"contentChanges", Json::array({change(place(2, 14), place(2, 14), "m")})}})) == 0);
  CHECK(errors(sent("textDocument/didChange",
                    {{"contentChanges", Json::array({change(place(1, 12), place(1, 14), "ball"),
                                                     change(place(0, 0), place(0, 0), "// first\n")})}})) == 0);
  const auto formatted = server.handle(request(9, "textDocument/hover"));
  REQUIRE(formatted.size() == 1);
  // A change that violates the protocol is ignored, together with all other changes of the same message.
  CHECK(
      sent("textDocument/didChange",
           {{"contentChanges", Json::array({change(place(0, 0), place(9, 0), ""), Json{{"range", 3}, {"text", "x"}}})}})
          .empty());
  // A change without a range replaces the whole text.
  CHECK(errors(sent("textDocument/didChange", {{"contentChanges", Json::array({change(place(0, 0), place(0, 2), ""),
                                                                               Json{{"text", "sgm 1;"}}})}})) == 0);
}

TEST_CASE("places of a text go to lines and UTF-16 units and back") {
  const DocumentText text("a\xC3\xA4\xF0\x9F\x98\x80z\n\nend");
  CHECK(text.position(0).character == 0);
  CHECK(text.position(3).character == 2);
  CHECK(text.position(7).character == 4);
  CHECK(text.offset({0, 4}) == 7);
  CHECK(text.offset({0, 99}) == 8);
  CHECK(text.offset({1, 5}) == 9);
  CHECK(text.offset({2, 1}) == 11);
  CHECK(text.offset({9, 0}) == text.text().size());
  CHECK(text.offsetOf(3, 2) == 11);
  for (uint32_t offset : {0u, 1u, 3u, 7u, 8u, 9u, 10u, 12u}) CHECK(text.offset(text.position(offset)) == offset);
}

TEST_CASE("places in a long line are those that a walk along it finds") {
  std::string line = "\n";
  for (int i = 0; line.size() < 3000; ++i) line += i % 7 == 0 ? "\xF0\x9F\x98\x80" : i % 3 == 0 ? "\xC3\xA4" : "z";
  const DocumentText text(line + "\r\nend");
  for (uint32_t at = 1, character = 0; at < line.size();) {
    CHECK(text.position(at).line == 1);
    CHECK(text.position(at).character == character);
    const uint32_t bytes = line[at] == 'z' ? 1 : line[at] == '\xC3' ? 2 : 4;
    character += bytes == 4 ? 2 : 1;
    at += bytes;
  }
}

TEST_CASE("the symbols of a line that is all of a large text do not take its length each") {
  std::string text = "sgm 1; start R0;";
  for (int i = 0; i < 40000; ++i) text += " rule R" + std::to_string(i) + " { }";
  LanguageServer server;
  REQUIRE(server.handle(request(0, "initialize")).size() == 1);
  server.handle({{"jsonrpc", "2.0"},
                 {"method", "textDocument/didOpen"},
                 {"params", {{"textDocument", {{"uri", "file:///tmp/a.sgm"}, {"text", text}}}}}});
  const auto answers =
      server.handle(request(1, "textDocument/documentSymbol", {{"textDocument", {{"uri", "file:///tmp/a.sgm"}}}}));
  REQUIRE(answers.size() == 1);
  const Json& symbols = answers[0]["result"];
  REQUIRE(symbols.size() == 40000);
  CHECK(symbols.back()["selectionRange"]["end"]["character"] == text.size() - 4);
}

TEST_CASE("a request without what it needs is told what that is, in the protocol's words alone") {
  LanguageServer server;
  REQUIRE(server.handle(request(0, "initialize")).size() == 1);
  for (const char* method : {"textDocument/hover", "textDocument/completion", "textDocument/documentSymbol"}) {
    const Json error = server.handle({{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}}).at(0)["error"];
    CHECK(error["code"] == -32602);
    CHECK(error["message"] == "params: key 'textDocument' not found");
  }
  const Json error = server.handle(request(2, "textDocument/hover", "what")).at(0)["error"];
  CHECK(error["code"] == -32602);
  CHECK(error["message"].get<std::string>().find("json.exception") == std::string::npos);
}

TEST_CASE("lines end with either of their ends, or with both") {
  const DocumentText text("a\rbc\r\nd\n\re\r");
  CHECK(text.position(2).line == 1);
  CHECK(text.position(6).line == 2);
  CHECK(text.position(8).line == 3);
  CHECK(text.position(9).line == 4);
  CHECK(text.position(11).line == 5);
  CHECK(text.offset({0, 9}) == 1);
  CHECK(text.offset({1, 9}) == 4);
  CHECK(text.offset({4, 1}) == 10);
  // For the compiler, only the character \n ends a line.
  CHECK(text.offsetOf(1, 4) == 3);
  CHECK(text.offsetOf(2, 1) == 6);
  CHECK(text.offsetOf(3, 2) == 9);
}

TEST_CASE("what is opened or closed counts for those that import it") {
  LanguageServer server;
  server.handle(request(0, "initialize"));
  const std::string importer = "file:///tmp/importer.sgm", imported = "file:///tmp/sgm-no-such.sgm";
  /// Sends a message about the document `uri`, and returns the last diagnostics that the server then publishes about
  /// the importing document.
  const auto verdict = [&](const std::string& method, const std::string& uri, const std::string& text) {
    Json about;
    for (const Json& message : server.handle(
             {{"jsonrpc", "2.0"}, {"method", method}, {"params", {{"textDocument", {{"uri", uri}, {"text", text}}}}}}))
      if (message["params"]["uri"] == importer) about = message["params"]["diagnostics"];
    return about;
  };
  const std::string open = "textDocument/didOpen";
  CHECK(verdict(open, importer, "sgm 1; import \"sgm-no-such.sgm\" as b; start A; rule A { b.B; }").size() == 1);
  const Json right = verdict(open, imported, "sgm 1; rule B { sphere(1m); }");
  CHECK(right.is_array());
  CHECK(right.empty());
  CHECK(verdict("textDocument/didClose", imported, "").size() == 1);
}

TEST_CASE("paths go to URIs and back") {
  for (const char* path : {"/a/b.sgm", "/a b/\xC3\xA4#?%.sgm", "/"}) CHECK(pathOfUri(uriOfPath(path)) == path);
  CHECK(uriOfPath("/a b.sgm") == "file:///a%20b.sgm");
  CHECK(pathOfUri("file://localhost/a%2Fb") == "/a/b");
  CHECK(pathOfUri("untitled:1").empty());
}
