// Tests numbers as text, which must not depend on the locale.

#include "base/plain_text.h"

#include <cinttypes>
#include <cstdio>
#include <random>

#include "../rounds.h"
#include "../seed.h"
#include "base/short_text.h"
#include "catch.h"

using namespace sgm;

TEST_CASE("hexadecimal numbers have the digits that were asked for", "[base][text]") {
  CHECK(hexText(0, 0) == "0");
  CHECK(hexText(0, 2) == "00");
  CHECK(hexText(0xABC, 2) == "abc");
  CHECK(hexText(UINT64_MAX, 16) == "ffffffffffffffff");
  CHECK(hexText(1, 20) == "00000000000000000001");
  std::mt19937_64 random(testSeed());
  for (unsigned round = 0; round < rounds(1000); ++round) {
    const uint64_t number = random() >> (random() % 64);
    char expected[32];
    std::snprintf(expected, sizeof expected, "%08" PRIx64, number);
    CHECK(hexText(number, 8) == expected);
  }
}

TEST_CASE("a short text is cut off where its memory ends", "[base][text]") {
  ShortText<8> text;
  CHECK(std::string(text.c_str()).empty());
  text.add("ab").add(uint64_t{12});
  CHECK(std::string(text.c_str()) == "ab12");
  text.add("cdef");
  CHECK(std::string(text.c_str()) == "ab12cde");
  text.add(UINT64_MAX).add("");
  CHECK(std::string(text.c_str()) == "ab12cde");
  ShortText<32> whole;
  CHECK(std::string(whole.add(UINT64_MAX).c_str()) == "18446744073709551615");
}
