#include "tools/service/judge/inspector_json.h"
#include "seed.h"

#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "../catch.h"
#include "../rounds.h"

using namespace sgm::service;
using OrderedJson = nlohmann::ordered_json;

namespace {

OrderedJson randomValue(std::mt19937& random, int depth) {
  static const std::vector<std::string> kTexts{"", "a", "\"", "\\", "}", "],", "\\\"{", "\n", ":", "\u00E9", " , "};
  const auto text = [&] { return kTexts[random() % kTexts.size()]; };
  switch (depth > 0 ? random() % 6 : random() % 4) {
    case 0:
      return nullptr;
    case 1:
      return static_cast<int>(random() % 1000) - 500;
    case 2:
      return text() + text();
    case 3:
      return random() % 2 == 0;
    case 4: {
      OrderedJson array = OrderedJson::array();
      for (auto i = random() % 4; i > 0; --i) array.push_back(randomValue(random, depth - 1));
      return array;
    }
    default: {
      OrderedJson object = OrderedJson::object();
      for (auto i = random() % 4; i > 0; --i) object[text() + text()] = randomValue(random, depth - 1);
      return object;
    }
  }
}

}  // namespace

TEST_CASE("members are found as a parser finds them") {
  const unsigned seed = sgm::testSeed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 2000; ++round) {
    OrderedJson object = OrderedJson::object();
    for (auto i = random() % 6; i > 0; --i) object["m" + std::to_string(random() % 20)] = randomValue(random, 4);
    const std::string text = object.dump(random() % 2 == 0 ? -1 : 2);
    INFO(text);
    REQUIRE(isSoundObject(text));
    const std::vector<JsonMember> members = membersOf(text);
    REQUIRE(members.size() == object.size());
    size_t at = 0;
    for (const auto& [name, value] : object.items()) {
      CHECK(members[at].name == name);
      CHECK(OrderedJson::parse(members[at].value) == value);
      ++at;
    }
    // Tests damaged JSON, too: names and values must lie within the text.
    std::string damaged = text;
    damaged[random() % damaged.size()] = "{}[]\",:\\ "[random() % 9];
    damaged.resize(random() % (damaged.size() + 1));
    for (const auto& [name, value] : membersOf(damaged)) {
      CHECK((name.empty() || (name.data() >= damaged.data() && &name.back() <= &damaged.back())));
      CHECK((value.empty() || (value.data() >= damaged.data() && &value.back() <= &damaged.back())));
    }
    if (isSoundObject(damaged)) CHECK(OrderedJson::accept(damaged));
  }
}

TEST_CASE("what is no sound object is told") {
  for (const std::string sound : {"{}", " { } ", R"({"a":{"\u0069d":1,"x":{},"x":[]},"b":[{"a":1}]})"}) {
    INFO(sound);
    CHECK(isSoundObject(sound));
  }
  const auto nested = [](size_t depth) { return "{\"a\":" + std::string(depth, '[') + std::string(depth, ']') + "}"; };
  const auto members = [](int count) {
    std::string text = "{\"first\":0";
    for (int i = 1; i < count; ++i) text += ",\"" + std::to_string(i) + "\":0";
    return text + "}";
  };
  CHECK(isSoundObject(nested(15)));
  CHECK(isSoundObject(members(64)));
  for (const std::string& odd :
       {std::string(), std::string("[]"), std::string("1"), std::string("\"a\""), std::string("{"), std::string("{}x"),
        std::string("{\"a\":1,}"), std::string(R"({"\u0069d":1})"), std::string(R"({"a":1,"a":2})"),
        std::string("{\"a\":\"\xFF\"}"), std::string("{\"a\":1e999}"), nested(16), members(65)}) {
    INFO(odd);
    CHECK_FALSE(isSoundObject(odd));
  }
}
