// Tests searches for voids and paths from the caller's view: errors, progress, memory.

#include <atomic>
#include <limits>
#include <memory_resource>
#include <mutex>

#include "caves.h"
#include "rounds.h"

using namespace sgm;

namespace {

/// A memory resource that records the largest number of bytes that were allocated at any time.
class MostBytes : public std::pmr::memory_resource {
 public:
  size_t most() const { return most_; }

 private:
  void* do_allocate(size_t bytes, size_t alignment) override {
    const std::lock_guard lock(mutex_);
    now_ += bytes;
    most_ = std::max(most_, now_);
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* place, size_t bytes, size_t alignment) override {
    const std::lock_guard lock(mutex_);
    now_ -= bytes;
    std::pmr::new_delete_resource()->deallocate(place, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::mutex mutex_;
  size_t now_ = 0, most_ = 0;
};

/// Records the progress that a search reports: the counts of each pass over the chunks.
class Told {
 public:
  Progress counter() {
    return [this](uint64_t done, uint64_t total) {
      if (done == 1) runs_.push_back({0, total});
      REQUIRE_FALSE(runs_.empty());
      CHECK((done == runs_.back().first + 1 && total == runs_.back().second && done <= total));
      runs_.back().first = done;
      return true;
    };
  }
  /// Returns the `total` that the progress calls of each pass announced, in the order of the passes. Checks that each
  /// pass reached its total.
  std::vector<uint64_t> totals() const {
    std::vector<uint64_t> all;
    for (const auto& [done, total] : runs_) {
      CHECK(done == total);
      all.push_back(total);
    }
    return all;
  }

 private:
  std::vector<std::pair<uint64_t, uint64_t>> runs_;
};

}  // namespace

TEST_CASE("questions that have no answer are errors that say why") {
  Cave cave({1, 1, 1});
  digBall(cave, {16, 16, 16}, 6);
  const SignField field = cave.lattice.field(kCell);
  const auto jobs = *makeThreadPool(1);
  const VoidQuestion good = questionOf(cave, {16, 16, 16}, {16, 17, 16}, 1);
  const auto fails = [&](const auto& change) {
    VoidQuestion question = good;
    change(question);
    const Result<VoidAnswer> answer = findVoids(field, *jobs, question);
    REQUIRE_FALSE(answer);
    CHECK(answer.error().message.size() > 15);
    return answer.error().code;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
  for (const double radius : {-1.0, -kInfinite, kNan, kInfinite, 32.0 * kCell})
    CHECK(fails([&](VoidQuestion& q) { q.radius = radius; }) == Code::invalid_argument);
  for (const double x : {-1.0, 32.0 * kCell + 1, kNan, kInfinite, 1e300}) {
    CHECK(fails([&](VoidQuestion& q) { q.ends->from[1] = x; }) == Code::invalid_argument);
    CHECK(fails([&](VoidQuestion& q) { q.ends->to[2] = x; }) == Code::invalid_argument);
  }
  CHECK(fails([](VoidQuestion& q) { q.region = {}; }) == Code::invalid_argument);
  CHECK(fails([](VoidQuestion& q) { q.region.hi.y = q.region.lo.y; }) == Code::invalid_argument);
  CHECK(fails([](VoidQuestion& q) { q.region.hi.x = INT32_MAX; }) == Code::range);
  CHECK(fails([](VoidQuestion& q) { q.region.lo.x = INT32_MIN; }) == Code::range);
  CHECK(fails([](VoidQuestion& q) { q.region.hi = {100 * 16384, 100 * 16384, 100 * 16384}; }) == Code::limit);
  CHECK(fails([](VoidQuestion& q) { q.max_chunks = 0; }) == Code::limit);
  CHECK(fails([](VoidQuestion& q) {
          q.region = {{-1'000'000'000, -1'000'000'000, -1'000'000'000}, {1'000'000'000, 1'000'000'000, 1'000'000'000}};
          q.max_chunks = ~uint64_t{0};
        }) == Code::limit);
  SignField failing = field;
  failing.signs = [](Int3) -> Result<ChunkSigns> { return Error{Code::limit, "too many shapes"}; };
  const Result<VoidAnswer> failed = findVoids(failing, *jobs, good);
  REQUIRE_FALSE(failed);
  CHECK(failed.error().message == "too many shapes");
}

TEST_CASE("the error of an end outside of the region says which, where it is, and where the region is") {
  Cave cave({1, 1, 1});
  const SignField field = cave.lattice.field(kCell);
  const auto jobs = *makeThreadPool(1);
  VoidQuestion question = questionOf(cave, {1, 1, 1}, {2, 2, 2}, 0);
  question.ends->to = {512.5, -1024, 0};
  CHECK(findVoids(field, *jobs, question).error().message ==
        "the end `to` of the path lies outside of the region: it is at (512.5, -1024, 0), but the region goes from "
        "(0, 0, 0) to (16384, 16384, 16384), in units of 1/1024 m");
  question.ends->tell_metres = true;
  CHECK(
      findVoids(field, *jobs, question).error().message ==
      "the end `to` of the path lies outside of the region: it is at (0.50048828125, -1, 0), but the region goes from "
      "(0, 0, 0) to (16, 16, 16), in metres");
  question.ends->from[2] = 1e300;
  CHECK_THAT(findVoids(field, *jobs, question).error().message, Catch::StartsWith("the end `from` of the path lies"));
  question.ends->from[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK(findVoids(field, *jobs, question).error().message == "the end `from` of the path is not finite");
}

TEST_CASE("progress counts the chunks of each look and of the walk, and stops each of them") {
  // A duct that winds through a layer of 5 by 20 chunks, more than the 64 chunks that the search processes together.
  Cave cave({5, 20, 1});
  for (int column = 0; column < 5; ++column) {
    for (int y = 4; y <= 636; ++y) digBall(cave, {16 + 32 * column, y, 16}, 2);
    if (column == 4) break;
    for (int x = 0; x <= 32; ++x) digBall(cave, {16 + 32 * column + x, column % 2 == 0 ? 636 : 4, 16}, 2);
  }
  const SignField field = cave.lattice.field(kCell);
  const auto jobs = *makeThreadPool(2);
  VoidQuestion question = questionOf(cave, {16, 4, 16}, {144, 636, 16}, 1.5, true);
  Told told;
  const Result<VoidAnswer> answer = findVoids(field, *jobs, question, told.counter());
  REQUIRE(answer);
  CHECK(isWay(*answer->way, FloodedVoids(cave.lattice, cave.region(), 1.5), {16, 4, 16}, {144, 636, 16}, kCell));
  // The first pass visits each of the 100 chunks once. The second pass searches for the path. It visits the chunks in
  // groups of 64: all 100 chunks, and then, on the way back, the 64 chunks before the last group again.
  const std::vector<uint64_t> totals = told.totals();
  REQUIRE(totals.size() >= 2);
  CHECK((totals[0] == 100 && totals[1] == 164));
  CHECK(std::all_of(totals.begin() + 2, totals.end(), [](uint64_t total) { return total == 100; }));
  CHECK(totals.size() <= 4);

  uint64_t calls = 0;
  for (const uint64_t last : {1u, 40u, 101u, 180u, 200u, 265u}) {
    CAPTURE(last);
    calls = 0;
    const Result<VoidAnswer> stopped =
        findVoids(field, *jobs, question, [&](uint64_t, uint64_t) { return ++calls < last; });
    if (last == 265 && totals.size() == 2) continue;
    REQUIRE_FALSE(stopped);
    CHECK(stopped.error().code == Code::cancelled);
    CHECK(calls == last);
  }
}

TEST_CASE("the first progress comes long before a flat region is looked at, whichever way it is flat") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Int3 size{24, 24, 24};
    size[axis] = 1;
    VoidQuestion question;
    for (int i = 0; i < 3; ++i) question.region.hi[i] = size[i] * 32 * kCell;
    question.radius = kCell;
    std::atomic<uint64_t> sampled{0};
    uint64_t before_first = 0;
    SignField field;
    field.cell = kCell;
    field.signs = [&](Int3) -> Result<ChunkSigns> {
      ++sampled;
      return ChunkSigns{};
    };
    const auto jobs = *makeThreadPool(2);
    REQUIRE(findVoids(field, *jobs, question, [&](uint64_t done, uint64_t total) {
      CHECK(total == 576);
      if (done == 1) before_first = sampled;
      return true;
    }));
    // Every chunk of the region, and every chunk around it, is sampled only once: the search never needs a chunk again
    // that it has dropped.
    CHECK(sampled == 26 * 26 * 3);
    // The first group of 64 chunks fills two rows and a part of a third. The rows on both sides of these three are
    // sampled, too.
    CHECK(before_first <= 5 * 26 * 3);
  }
}

TEST_CASE("of a long region a search keeps little at one time", "[costly]") {
  // Tests regions of 3 by 3 by 300 chunks, in each of which all chunks contain a surface. The long side lies along each
  // axis in turn. With sanitizers, each region takes minutes.
  const int axes = std::min(3, static_cast<int>(rounds(5)));
  for (int axis = 3 - axes; axis < 3; ++axis) {
    CAPTURE(axis);
    VoidQuestion question;
    question.region.hi = {3 * 32 * kCell, 3 * 32 * kCell, 3 * 32 * kCell};
    question.region.hi[axis] = 300 * 32 * kCell;
    question.radius = 2 * kCell;
    question.ends = VoidQuestion::Ends{placeOf({40, 40, 40}), placeOf({40, 40, 40}), false};
    question.ends->to[static_cast<size_t>(axis)] = 9560.0 * kCell;
    MostBytes memory;
    SignField field;
    field.cell = kCell;
    field.memory = &memory;
    // Only the corners of the chunks are solid.
    field.signs = [&](Int3) -> Result<ChunkSigns> {
      ChunkSigns signs{std::pmr::vector<uint64_t>(33 * 33, 0, &memory), false};
      for (const size_t row : {0u, 32u, 32u * 33, 32u * 34}) signs.rows[row] = uint64_t{1} << 32 | 1;
      return signs;
    };
    const auto jobs = *makeThreadPool(1);
    const Result<VoidAnswer> answer = findVoids(field, *jobs, question);
    REQUIRE(answer);
    REQUIRE(answer->way->verdict == WayVerdict::found);
    CHECK(answer->way->length >= 9520.0 * kCell);
    // All 2,700 chunks have 23 MB of signs, and the 300 chunks of the path have 11 MB of step costs; the search must
    // keep less.
    CHECK(memory.most() < 10u << 20);
  }
}
