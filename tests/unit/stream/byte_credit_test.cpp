// Tests the byte budgets of updates: any sequence of updates delivers at most the sum of its budgets and one item more,
// and all items are delivered in the end.

#include <limits>
#include <random>
#include <vector>

#include "catch.h"
#include "rounds.h"
#include "stream/byte_credit.h"

using namespace sgm;

TEST_CASE("any updates in a row hand over at most their budgets and one item, and everything comes") {
  for (uint32_t seed = 1; seed <= rounds(300); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const uint64_t largest = 1 + random() % (uint64_t{1} << (1 + random() % 24));
    std::vector<uint64_t> items(1 + random() % 60);
    uint64_t all = 0;
    for (uint64_t& item : items) all += item = random() % (largest + 1);
    const uint64_t budget = 1 + random() % (uint64_t{1} << (1 + random() % 20));
    const bool varies = random() % 2 == 0;
    ByteCredit credit;
    std::vector<uint64_t> given{0}, budgets{0};  // sums of all bytes and of all budgets up to each update
    size_t next = 0;
    // Each update spends its budget unless no item is waiting, which bounds the number of updates.
    const uint64_t max_updates = all / std::max<uint64_t>(1, varies ? budget / 2 : budget) + 2 * items.size() + 2;
    for (uint64_t updates = 0; next < items.size(); ++updates) {
      if (updates > 4000) break;  // stop: many more updates with tiny budgets would take time, and test nothing new
      REQUIRE(updates <= 8 * max_updates);
      const uint64_t now = varies ? 1 + random() % budget : budget;
      credit.begin(now);
      uint64_t bytes = 0;
      for (; next < items.size() && credit.admits(items[next]); ++next) {
        credit.take(items[next]);
        bytes += items[next];
      }
      given.push_back(given.back() + bytes);
      budgets.push_back(budgets.back() + now);
    }
    // Finds the sequence of successive updates that exceeds its budgets most: the one over which `given` - `budgets`
    // rises most.
    int64_t lowest = 0, worst = 0;
    for (size_t i = 0; i < given.size(); ++i) {
      const int64_t beyond = static_cast<int64_t>(given[i]) - static_cast<int64_t>(budgets[i]);
      worst = std::max(worst, beyond - lowest);
      lowest = std::min(lowest, beyond);
    }
    CHECK(worst <= static_cast<int64_t>(largest));
  }
}

TEST_CASE("a budget without end admits everything, and pays what is owed") {
  ByteCredit credit;
  credit.begin(1);
  REQUIRE(credit.admits(1'000'000));
  credit.take(1'000'000);
  CHECK_FALSE(credit.admits(1));
  credit.begin(1000);
  CHECK_FALSE(credit.admits(1));
  credit.begin(std::numeric_limits<size_t>::max());
  for (int i = 0; i < 100; ++i) {
    REQUIRE(credit.admits(size_t{1} << 40));
    credit.take(size_t{1} << 40);
  }
  credit.begin(1000);
  CHECK(credit.admits(1000));
  credit.take(1000);
  CHECK_FALSE(credit.admits(1));
}
