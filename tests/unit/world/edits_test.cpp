// Tests that worlds which exchange their edits agree in any order, that visible brushes are found by place, and that
// damage changes nothing.

#include "world/edits.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <ctime>
#include <iostream>
#include <set>
#include <thread>

#include "base/checksum.h"
#include "catch.h"
#include "edits_support.h"
#include "rounds.h"

using namespace sgm;

namespace {

const IntBox kPlaces{{-200'000, -200'000, -200'000}, {200'000, 200'000, 200'000}};

std::vector<std::byte> bytesOf(const Brush& brush) {
  EditOperation operation;
  operation.brush = brush;
  std::vector<std::byte> bytes;
  encodeEdit(operation, bytes);
  return bytes;
}

std::vector<std::vector<std::byte>> shown(const EditLog& log, const IntBox& box, int32_t cell = 1) {
  std::pmr::vector<Brush> brushes;
  log.snapshot()->query(box, cell, brushes);
  std::vector<std::vector<std::byte>> bytes;
  for (const Brush& b : brushes) bytes.push_back(bytesOf(b));
  return bytes;
}

// The visible brushes by definition: all brushes in order, except those that were undone and not redone since.
std::vector<std::vector<std::byte>> expected(const EditLog& log, const IntBox& box, int32_t cell = 1) {
  std::vector<EditOperation> operations(log.operations().begin(), log.operations().end());
  std::sort(operations.begin(), operations.end(),
            [](const EditOperation& a, const EditOperation& b) { return a.order < b.order; });
  std::set<EditId> hidden;
  for (const EditOperation& o : operations) {
    if (o.kind == EditOperation::Kind::undo) hidden.insert(o.target);
    if (o.kind == EditOperation::Kind::redo) hidden.erase(o.target);
  }
  std::vector<std::vector<std::byte>> bytes;
  for (const EditOperation& o : operations) {
    if (o.kind != EditOperation::Kind::brush || hidden.count(o.order.id) > 0) continue;
    if (brushBounds(o.brush).meets(box) && brushShows(o.brush, cell)) bytes.push_back(bytesOf(o.brush));
  }
  return bytes;
}

void edit(std::mt19937& random, EditLog& log) {
  if (random() % 3 != 0 || log.size() == 0) {
    REQUIRE(log.add(randomBrush(random, kPlaces, 20'000)));
    return;
  }
  const EditOperation o = log.operations()[random() % log.size()];
  const auto knows = [&](EditId brush) {
    const auto list = log.operations();
    return std::any_of(list.begin(), list.end(), [&](const EditOperation& other) { return other.order.id == brush; });
  };
  const bool can = o.kind == EditOperation::Kind::brush || knows(o.target);
  CHECK(static_cast<bool>(log.undo(o.order.id)) == can);
}

EditLog logOf(uint64_t author) { return EditLog(EditSettings{author}); }

Brush ball(Int3 at, int32_t radius, bool cut = false) {
  Brush b;
  b.from = at;
  b.radius = radius;
  b.cut = cut;
  return b;
}

}  // namespace

TEST_CASE("worlds that have exchanged their edits in any order are equal", "[edits]") {
  size_t hidden = 0;
  for (uint32_t seed = 1; seed <= rounds(30); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<EditLog> logs;
    for (uint64_t author = 1; author <= 4; ++author) logs.push_back(logOf(author));
    std::vector<std::vector<std::byte>> letters;
    for (int step = 0; step < 120; ++step) {
      EditLog& log = logs[random() % logs.size()];
      switch (random() % 4) {
        case 0:
          letters.push_back(log.exportBytes(random() % (log.size() + 1)));
          break;
        case 1:  // delivers the message later, or twice
          if (!letters.empty()) REQUIRE(log.import(letters[random() % letters.size()]));
          break;
        default:
          edit(random, log);
      }
    }
    // The operations arrive one by one, in any order, at a world without edits; an undo may arrive before its brush.
    std::vector<std::vector<std::byte>> all;
    for (const EditLog& log : logs) all.push_back(log.exportBytes());
    EditLog last = logOf(99);
    for (const std::vector<std::byte>& bytes : all) REQUIRE(last.import(bytes));
    std::vector<EditOperation> one_by_one(last.operations().begin(), last.operations().end());
    std::shuffle(one_by_one.begin(), one_by_one.end(), random);
    EditLog shuffled = logOf(98);
    for (const EditOperation& o : one_by_one) REQUIRE(shuffled.merge({&o, 1}));
    for (EditLog& log : logs) {
      std::shuffle(all.begin(), all.end(), random);
      for (const std::vector<std::byte>& bytes : all) REQUIRE(log.import(bytes));
    }
    logs.push_back(std::move(shuffled));
    for (const EditLog& log : logs) {
      CHECK(log.size() == last.size());
      CHECK(log.hash() == last.hash());
      CHECK(shown(log, IntBox::everything()) == expected(last, IntBox::everything()));
    }
    hidden += last.size() - last.snapshot()->brushes();
    REQUIRE(last.add(ball({}, 100)));
    CHECK(last.hash() != logs[0].hash());
  }
  CHECK(hidden > 5 * rounds(30));
}

TEST_CASE("a place's brushes are found, in order, at every level; old snapshots stay", "[edits]") {
  size_t found = 0, thin = 0;
  for (uint32_t seed = 1; seed <= rounds(8); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    EditLog log = logOf(5);
    const std::shared_ptr<const EditSnapshot> none = log.snapshot();
    for (int i = 0; i < 150; ++i) {
      edit(random, log);
      // Some brushes lie at the ends of the world, and some have the largest size.
      if (i % 50 == 0) REQUIRE(log.add(ball({INT32_MIN + 3000, INT32_MAX - 3000, 0}, 2000)));
      if (i % 70 == 0) REQUIRE(log.add(ball({5, 5, 5}, kMaxBrushSize, true)));
      const Int3 at = randomPlace(random, kPlaces);
      const IntBox box = i % 10 == 0 ? IntBox::everything() : IntBox{at, at}.grown(within(random, 0, 60'000));
      const int32_t cell = 1 << within(random, 0, 15);
      const auto expect = expected(log, box, cell);
      CHECK(shown(log, box, cell) == expect);
      found += expect.size();
      thin += expected(log, box).size() - expect.size();
    }
    CHECK(log.snapshot()->brushes() == expected(log, IntBox::everything()).size());
    CHECK(none->brushes() == 0);
    const std::shared_ptr<const EditSnapshot> before = log.snapshot();
    const size_t brushes = before->brushes();
    for (int i = 0; i < 50; ++i) edit(random, log);
    CHECK(before->brushes() == brushes);
  }
  CHECK(found > 100 * rounds(8));
  CHECK(thin > 10 * rounds(8));
}

TEST_CASE("an undo hides, an undo of it shows again, and each says what changed", "[edits]") {
  EditLog log = logOf(7);
  const Brush brush = ball({1000, 2000, 3000}, 500, true);
  const EditLog::Edited laid = *log.add(brush);
  CHECK(laid.box == brushBounds(brush));
  CHECK(laid.id == EditId{7, 1});
  const EditLog::Edited hidden = *log.undo(laid.id);
  CHECK(hidden.box == brushBounds(brush));
  CHECK(log.snapshot()->brushes() == 0);
  CHECK(log.undo(laid.id)->box.empty());  // the brush is hidden already
  const EditLog::Edited again = *log.undo(hidden.id);
  CHECK(again.box == brushBounds(brush));
  CHECK(log.snapshot()->brushes() == 1);
  CHECK(log.undo(again.id)->box == brushBounds(brush));
  CHECK(log.snapshot()->brushes() == 0);

  const Result<EditLog::Edited> unknown = log.undo({7, 77});
  REQUIRE_FALSE(unknown);
  CHECK(unknown.error().code == Code::invalid_argument);
  CHECK(unknown.error().message == "there is no edit 77 of author 7 to undo");

  // import() returns a box for each brush that appears or disappears, and none for known or hidden brushes.
  EditLog other = logOf(8);
  CHECK(other.import(log.exportBytes())->empty());
  CHECK(other.hash() == log.hash());
  REQUIRE(log.undo(hidden.id));
  const std::vector<IntBox> came = *other.import(log.exportBytes());
  REQUIRE(came.size() == 1);
  CHECK(came[0] == brushBounds(brush));
  CHECK(other.import(log.exportBytes())->empty());
  // New edits continue the numbers and times of the imported edits.
  EditLog reopened = logOf(7);
  REQUIRE(reopened.import(log.exportBytes()));
  CHECK(reopened.add(brush)->id == EditId{7, log.size() + 1});
  CHECK(reopened.operations().back().order.time == log.operations().back().order.time + 1);
}

TEST_CASE("what is essential shows the same brushes, also after what is still to come", "[edits]") {
  size_t left_out = 0;
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    EditLog log = logOf(1);
    for (int i = 0; i < 100; ++i) edit(random, log);
    const std::vector<EditOperation> kept = essentialEdits(log.operations());
    left_out += log.size() - kept.size();
    EditLog small = logOf(2);
    REQUIRE(small.merge(kept));
    CHECK(shown(small, IntBox::everything()) == shown(log, IntBox::everything()));
    // Importing the full log brings back the operations that were left out.
    REQUIRE(small.import(log.exportBytes()));
    CHECK(small.hash() == log.hash());
    CHECK(shown(small, IntBox::everything()) == shown(log, IntBox::everything()));
  }
  CHECK(left_out > 5 * rounds(20));
}

TEST_CASE("damaged and hostile bytes change nothing", "[edits]") {
  std::mt19937 random(4);
  EditLog log = logOf(1);
  for (int i = 0; i < 12; ++i) edit(random, log);
  const std::vector<std::byte> good = log.exportBytes();
  EditLog other = logOf(2);
  edit(random, other);
  const uint64_t hash = other.hash();
  const auto refused = [&](std::span<const std::byte> bytes) {
    const Result<std::vector<IntBox>> imported = other.import(bytes);
    return !imported && imported.error().code == Code::bad_input && !imported.error().message.empty() &&
           other.hash() == hash;
  };
  size_t accepted = 0;
  for (size_t cut = 0; cut < good.size(); ++cut) accepted += !refused(std::span(good).first(cut));
  for (size_t i = 0; i < good.size(); ++i) {
    for (const int bit : {0, 5, 7}) {
      std::vector<std::byte> bad = good;
      bad[i] ^= std::byte{1} << bit;
      accepted += !refused(bad);
    }
  }
  // Damages messages and recomputes their checksums, as an attacker would.
  for (uint32_t round = 0; round < rounds(3000); ++round) {
    std::vector<std::byte> bad(good.begin(), good.end() - 8);
    for (int32_t n = within(random, 1, 3); n > 0; --n) bad[8 + random() % (bad.size() - 8)] = std::byte(random() % 256);
    if (random() % 3 == 0) bad.resize(8 + random() % (bad.size() - 8));
    ByteWriter(bad).put(checksum(bad));
    EditLog victim = logOf(3);
    const Result<std::vector<IntBox>> imported = victim.import(bad);
    if (!imported) {
      CHECK(victim.size() == 0);
      CHECK(imported.error().code == Code::bad_input);
      continue;
    }
    for (const EditOperation& o : victim.operations())
      if (o.kind == EditOperation::Kind::brush) CHECK(checkBrush(o.brush));
    CHECK(victim.add(ball({}, 10)));
  }
  CHECK(accepted == 0);

  // If one operation of a message is invalid, none of the message's operations are imported.
  std::vector<EditOperation> list(log.operations().begin(), log.operations().end());
  list[0].brush.from.x += 1;
  EditLog knows = logOf(3);
  REQUIRE(knows.merge(log.operations().first(1)));
  const Result<std::vector<IntBox>> differs = knows.merge(list);
  REQUIRE_FALSE(differs);
  CHECK(differs.error().message == "edit 1 of author 1 already exists with other contents");
  CHECK(knows.size() == 1);

  for (const EditOrder order : {EditOrder{0, {1, 1}}, EditOrder{1, {1, 0}}, EditOrder{kMaxEditTime + 1, {1, 1}}}) {
    EditOperation none;
    none.order = order;
    none.brush = ball({}, 10);
    CHECK(knows.merge({&none, 1}).error().code == Code::bad_input);
  }

  EditLog narrow(EditSettings{4, 3, 2, 5});
  CHECK(narrow.merge(log.operations().first(5)));
  const Result<std::vector<IntBox>> full = narrow.import(good);
  REQUIRE_FALSE(full);
  CHECK(full.error().code == Code::limit);
  CHECK(narrow.size() == 5);
  CHECK(narrow.add(ball({}, 10)).error().code == Code::limit);
  Brush foreign = ball({}, 10);
  foreign.material = 4;
  EditLog few(EditSettings{4, 3, 2});
  CHECK(few.add(foreign).error().message == "a brush's material is 4, but the last one is 3");
}

TEST_CASE("snapshots are read while the world is edited", "[edits][threads]") {
  std::mt19937 random(3);
  EditLog log = logOf(1);
  for (int i = 0; i < 200; ++i) edit(random, log);
  std::vector<std::thread> readers;
  std::atomic<size_t> wrong{0};
  for (int i = 0; i < 30; ++i) {
    readers.emplace_back([snapshot = log.snapshot(), &wrong] {
      std::pmr::vector<Brush> brushes;
      snapshot->query(IntBox::everything(), 1, brushes);
      wrong += brushes.size() != snapshot->brushes();
    });
    for (int n = 0; n < 20; ++n) edit(random, log);
  }
  for (std::thread& reader : readers) reader.join();
  CHECK(wrong == 0);
}

TEST_CASE("the last time there is does not stop a world", "[edits]") {
  EditOperation last;
  last.order = {kMaxEditTime, {1, 1}};
  last.brush = ball({}, 100);
  EditLog log = logOf(2);
  REQUIRE(log.merge({&last, 1}));
  const EditLog::Edited laid = *log.add(ball({5, 5, 5}, 200));
  CHECK(log.snapshot()->brushes() == 2);
  CHECK_FALSE(log.undo(laid.id)->box.empty());
  CHECK(log.snapshot()->brushes() == 1);
}

TEST_CASE("brushes that cannot be are refused, with the reason", "[edits]") {
  const auto why = [](const Brush& b) {
    EditLog log = logOf(1);
    const Result<EditLog::Edited> added = log.add(b);
    CHECK(log.size() == (added ? 1u : 0u));
    return added ? std::string("none") : added.error().message;
  };
  CHECK(why(ball({}, 1)) == "none");
  CHECK(why(ball({}, 0)) == "a brush's radius is 0 units; it must be between 1 and 1048576 (1,024 m)");
  CHECK(why(ball({}, kMaxBrushSize + 1)) ==
        "a brush's radius is 1048577 units; it must be between 1 and 1048576 (1,024 m)");
  Brush b = ball({}, 10);
  b.smooth = -1;
  CHECK(why(b) == "a brush's smooth width is -1 units; it must be between 0 and 1048576 (1,024 m)");
  CHECK(why(ball({INT32_MAX - 10, 0, 0}, 10)) == "a brush leaves the world, which ends about 2,097 km from the origin");
  CHECK(why(ball({INT32_MAX - 11, 0, 0}, 10)) == "none");
  b = ball({INT32_MIN, 0, 0}, 10);
  b.shape = Brush::Shape::capsule;
  b.to = {INT32_MAX, 0, 0};
  CHECK(why(b) == "a brush's length along an axis is 4294967295 units; it must be between 0 and 1048576 (1,024 m)");
  b = {};
  b.shape = Brush::Shape::box;
  b.half = {5, 0, 5};
  CHECK(why(b) == "a brush's half extent is 0 units; it must be between 1 and 1048576 (1,024 m)");
  b.half = {5, 5, 5};
  CHECK(why(b) == "none");
  for (const float q : {0.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    b.turn = {0, 0, 0, q};
    CHECK(why(b) == "a brush's turn is not a rotation: its quaternion's length is 0 or not a number");
  }
  b.shape = static_cast<Brush::Shape>(3);
  CHECK(why(b) == "a brush is a sphere, a box or a capsule");
}

TEST_CASE("ten thousand brushes do not make the next one slow", "[edits]") {
  std::mt19937 random(1);
  EditLog log = logOf(1);
  for (int i = 0; i < 10'000; ++i) REQUIRE(log.add(randomBrush(random, kPlaces.grown(100'000), 3000)));
  // Measures processor time, since the machine may be busy.
  const auto microseconds = [](std::clock_t since) {
    return 1e6 * static_cast<double>(std::clock() - since) / CLOCKS_PER_SEC;
  };
  const auto start = std::clock();
  constexpr int kMore = 200;
  for (int i = 0; i < kMore; ++i) {
    const EditLog::Edited laid = *log.add(randomBrush(random, kPlaces, 3000));
    if (i % 2 == 0) REQUIRE(log.undo(laid.id));
    REQUIRE(log.snapshot());
  }
  const double each = microseconds(start) / kMore;
  std::pmr::vector<Brush> found;
  const auto asked = std::clock();
  log.snapshot()->query(IntBox{{}, {}}.grown(16 * 1024), 256, found);
  const double query = microseconds(asked);
  const std::vector<std::byte> all = log.exportBytes();
  const auto sent = std::clock();
  EditLog other = logOf(2);
  REQUIRE(other.import(all));
  const double import = microseconds(sent) / 1000;
  std::cout << "importing " << log.size() << " edits: " << import << " ms\n";
  std::cout << "an edit over 10,000 brushes: " << each << " us; a chunk's " << found.size() << " brushes: " << query
            << " us\n";
  CHECK(each < 5000);  // a generous limit, because of sanitizers; for 60 frames a second, a millisecond would suffice
}
