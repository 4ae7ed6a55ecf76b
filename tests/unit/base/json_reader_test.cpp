// Tests reading valid and invalid JSON.

#include "base/json_reader.h"
#include "catch.h"

using namespace sgm;

TEST_CASE("JSON is read as it is written", "[asset][json]") {
  const auto value = readJson(
      R"({"a": [1, -2.5e2, true, false, null], "b": {"c": "\u00e9\n\ud83d\ude00\/"}, "a2": 9007199254740992, "d": 0.5})");
  REQUIRE(value);
  REQUIRE(value->list("a").size() == 5);
  CHECK(value->list("a")[1].number == -250);
  CHECK(value->list("a")[2].number == 1);
  CHECK(value->find("b")->find("c")->text == "\xC3\xA9\n\xF0\x9F\x98\x80/");
  CHECK(value->count("a2") == size_t{9007199254740992});
  CHECK_FALSE(value->count("d"));
  CHECK_FALSE(value->count("b"));
  CHECK(value->find("none") == nullptr);
  CHECK(value->list("b").empty());
  CHECK(readJson(R"({"a":1,"a":2})")->count("a") == size_t{2});
}

TEST_CASE("what is no JSON is refused with its place", "[asset][json]") {
  const std::pair<const char*, const char*> cases[] = {
      {"", "a value is missing at byte 0 of its JSON"},
      {"{\"a\" 1}", "`:` is missing at byte 5 of its JSON"},
      {"{\"a\":1", "`}` is missing at byte 6 of its JSON"},
      {"[1 2]", "`]` is missing at byte 3 of its JSON"},
      {"{a:1}", "a quoted name is missing at byte 1 of its JSON"},
      {"01", "a value is missing at byte 0 of its JSON"},
      {"-", "a value is missing at byte 0 of its JSON"},
      {"1.", "a number without digits at byte 0 of its JSON"},
      {"1e", "a number without digits at byte 0 of its JSON"},
      {"1e999", "a number out of range at byte 0 of its JSON"},
      {"\"\\x\"", "an invalid escape sequence at byte 3 of its JSON"},
      {"\"\\ud800\"", "an invalid escape sequence at byte 7 of its JSON"},
      {"\"\xFF\"", "an invalid character at byte 1 of its JSON"},
      {"\"a", "an unterminated string at byte 2 of its JSON"},
      {"1 2", "text after the value at byte 2 of its JSON"},
  };
  for (const auto& [text, message] : cases) {
    INFO(text);
    const auto value = readJson(text);
    REQUIRE_FALSE(value);
    CHECK(value.error().message == message);
  }
  CHECK(readJson(std::string(100, '[')).error().message == "values nested too deeply at byte 65 of its JSON");
}
