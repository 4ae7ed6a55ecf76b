// Tests the database of reference histograms: data are read as they were written, and all damage is detected.

#include "tools/classify/base.h"

#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "../catch.h"
#include "../rounds.h"
#include "../temporary_folder.h"

namespace sgm::masters {
namespace {

using measure::HistogramMode;

MasterSet smallSet(uint32_t models) {
  MasterSet set;
  const measure::MasterKey curvature{5, HistogramMode::curvature, 0.7, 0, 1},
      printed{9, HistogramMode::printed, 0, 2, 1};
  set.limits = {{curvature, 0.001, 0.04}, {printed, 0.25, 0.5}};
  for (const measure::MasterKey& key : {curvature, printed}) {
    for (const char* name : {"cave", "cloud", "building; \"x\" '%"}) {
      std::vector<double> shares(measure::binsOf(key.settings()));
      shares.front() = 1.0 / 3;
      shares.back() = 1 - 1.0 / 3;
      set.masters.push_back({name, std::string(name) + " 1", key, models, shares});
    }
  }
  return set;
}

bool same(const MasterSet& a, const MasterSet& b) {
  if (a.limits.size() != b.limits.size() || a.masters.size() != b.masters.size()) return false;
  for (size_t i = 0; i < a.limits.size(); ++i) {
    if (a.limits[i].key != b.limits[i].key || a.limits[i].mse != b.limits[i].mse || a.limits[i].emd != b.limits[i].emd)
      return false;
  }
  for (size_t i = 0; i < a.masters.size(); ++i) {
    const measure::Master &x = a.masters[i], &y = b.masters[i];
    if (x.class_name != y.class_name || x.name != y.name || x.key != y.key || x.models != y.models ||
        x.shares != y.shares)
      return false;
  }
  return true;
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
}

void run(const std::filesystem::path& file, const char* text) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  CHECK(sqlite3_exec(database, text, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

size_t filesIn(const std::filesystem::path& folder) {
  return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

TEST_CASE("a base holds what was written to it, and what is written over it", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "a?b#c%20" / "masters.db";
  REQUIRE(writeBase(file, smallSet(3)));
  ReadBase read = readBase(file);
  REQUIRE(read.set);
  CHECK(same(*read.set, smallSet(3)));
  REQUIRE(writeBase(file, smallSet(4)));
  CHECK(same(*readBase(file).set, smallSet(4)));
  REQUIRE(writeBase(file, MasterSet{}));
  CHECK(readBase(file).set->masters.empty());
  CHECK(filesIn(file.parent_path()) == 1);
}

TEST_CASE("what is built in has masters of every class for each key", "[masters]") {
  const MasterSet set = builtInMasters();
  REQUIRE_FALSE(set.limits.empty());
  for (const measure::MasterLimits& limits : set.limits) {
    for (const char* name : {"cave", "cloud", "building", "terrain", "tree", measure::kNoise}) {
      CAPTURE(measure::nameOf(limits.key.mode), limits.key.density, name);
      CHECK(std::ranges::count(set.of(limits.key), name, &measure::Master::class_name) >= 1);
    }
  }
  const TemporaryFolder folder;
  REQUIRE(writeBase(folder.path / "built_in.db", set));
  CHECK(same(*readBase(folder.path / "built_in.db").set, set));
}

TEST_CASE("a base that is cut off anywhere is damaged", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  REQUIRE(writeBase(file, smallSet(3)));
  const std::string whole = contentOf(file);
  for (size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
    CAPTURE(size);
    writeBytes(file, whole.substr(0, size));
    const ReadBase read = readBase(file);
    CHECK_FALSE(read.set);
    CHECK(read.damage == Damage::damaged);
    CHECK_FALSE(read.what.empty());
  }
}

TEST_CASE("a flipped bit is found, or was in nothing that is read", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  const MasterSet set = smallSet(3);
  REQUIRE(writeBase(file, set));
  const std::string whole = contentOf(file);
  size_t found = 0, unread = 0;
  std::mt19937 random(7);
  for (unsigned i = 0; i < 20 * rounds(50); ++i) {
    std::string bytes = whole;
    const size_t bit = random() % (8 * bytes.size());
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    writeBytes(file, bytes);
    const ReadBase read = readBase(file);
    CAPTURE(bit);
    if (read.set) {
      ++unread;
      CHECK(same(*read.set, set));
    } else {
      ++found;
    }
    for (const char* log : {"masters.db-wal", "masters.db-shm"}) std::filesystem::remove(folder.path / log);
  }
  CHECK(found > 0);
  CHECK(unread > 0);
}

TEST_CASE("what is no base of ours is said to be none", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  const auto damageAfter = [&](const char* text) {
    std::filesystem::remove(file);
    REQUIRE(writeBase(file, smallSet(3)));
    run(file, text);
    const ReadBase read = readBase(file);
    CHECK_FALSE(read.set);
    return read.damage;
  };
  CHECK(damageAfter("DROP TABLE seal") == Damage::damaged);
  CHECK(damageAfter("DELETE FROM seal") == Damage::damaged);
  CHECK(damageAfter("DELETE FROM masters WHERE id = 2") == Damage::damaged);
  CHECK(damageAfter("UPDATE masters SET class = 'cloud' WHERE class = 'cave'") == Damage::damaged);
  CHECK(damageAfter("UPDATE masters SET shares = zeroblob(40)") == Damage::damaged);
  CHECK(damageAfter("UPDATE keys SET limit_mse = 1") == Damage::damaged);
  CHECK(damageAfter("UPDATE keys SET mode = 'other'") == Damage::damaged);
  CHECK(damageAfter("UPDATE keys SET bins = 1000000000000") == Damage::damaged);
  CHECK(damageAfter("CREATE TABLE more(x)") == Damage::damaged);
  CHECK(damageAfter("CREATE TRIGGER t AFTER DELETE ON masters BEGIN DELETE FROM keys; END") == Damage::damaged);
  CHECK(damageAfter("ALTER TABLE masters RENAME COLUMN models TO many") == Damage::damaged);
  CHECK(damageAfter("PRAGMA application_id = 1") == Damage::damaged);
  CHECK(damageAfter("PRAGMA user_version = 2") == Damage::newer);
  std::filesystem::remove(file);
  run(file, "CREATE TABLE other(x); INSERT INTO other VALUES(1)");
  CHECK(readBase(file).damage == Damage::damaged);
  writeBytes(file, std::string(5000, 'x'));
  CHECK(readBase(file).damage == Damage::damaged);
  CHECK(readBase(folder.path / "none.db").damage == Damage::io);
  CHECK(readBase(folder.path).damage == Damage::io);
}

TEST_CASE("what is there and no sound base is not written over", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "letter.txt";
  writeBytes(file, "Dear reader,\n");
  const Result<void> written = writeBase(file, smallSet(3));
  REQUIRE_FALSE(written);
  CHECK(written.error().code == Code::bad_input);
  CHECK(contentOf(file) == "Dear reader,\n");
  CHECK(writeBase(folder.path, smallSet(3)).error().code == Code::io);
}

TEST_CASE("a damaged base at its own place is moved aside, and never lost", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  CHECK(openBase(file)->from == "built in");
  CHECK(filesIn(folder.path) == 0);
  for (const char* aside : {"masters.db.damaged-1", "masters.db.damaged-2"}) {
    writeBytes(file, aside);
    const Result<OpenedBase> opened = openBase(file);
    REQUIRE(opened);
    CHECK(opened->notice.find(aside) != std::string::npos);
    CHECK(opened->from == file.string());
    CHECK(same(opened->set, builtInMasters()));
    CHECK(contentOf(folder.path / aside) == aside);
    CHECK(same(*readBase(file).set, builtInMasters()));
    CHECK(openBase(file)->notice.empty());
  }
  run(file, "PRAGMA user_version = 2");
  CHECK(openBase(file).error().code == Code::unsupported);
  CHECK(std::filesystem::exists(file));
}

TEST_CASE("a log of a damaged base is not played into the next", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  REQUIRE(writeBase(file, smallSet(3)));
  writeBytes(file, "no database any more");
  writeBytes(folder.path / "masters.db-wal", "some log");
  REQUIRE(openBase(file));
  // SQLite may itself have deleted the write-ahead log, because the log was invalid.
  const auto aside = folder.path / "masters.db.damaged-1-wal";
  CHECK((!std::filesystem::exists(aside) || contentOf(aside) == "some log"));
  CHECK(same(*readBase(file).set, builtInMasters()));
}

TEST_CASE("a full disk leaves no file, and one that is there as it was", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  MasterSet large = smallSet(1);
  for (int i = 0; i < 2000; ++i) large.masters.push_back(smallSet(2).masters.front());
  const auto writeLarge = [&] {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit few{40000, 40000};
      setrlimit(RLIMIT_FSIZE, &few);
      const Result<void> written = writeBase(file, large);
      _exit(written ? 0 : written.error().code == Code::io ? 4 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  CHECK(writeLarge() == 4);
  CHECK(filesIn(folder.path) == 0);
  REQUIRE(writeBase(file, smallSet(1)));
  CHECK(writeLarge() == 4);
  const ReadBase read = readBase(file);
  CAPTURE(read.what);
  REQUIRE(read.set);
  CHECK(same(*read.set, smallSet(1)));
}

TEST_CASE("a writer that is killed leaves one set or the other", "[masters]") {
  const TemporaryFolder folder;
  const auto file = folder.path / "masters.db";
  REQUIRE(writeBase(file, smallSet(1)));
  std::mt19937 random(3);
  for (unsigned i = 0; i < rounds(20); ++i) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      for (uint32_t models = 1;; ++models) (void)writeBase(file, smallSet(models));
    }
    usleep(static_cast<useconds_t>(random() % 20000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const ReadBase read = readBase(file);
    CAPTURE(i, read.what);
    REQUIRE(read.set);
    CHECK(same(*read.set, smallSet(read.set->masters.front().models)));
  }
}

}  // namespace sgm::masters
