// Tests that a journal of edits loses nothing that was flushed, if it is truncated or damaged, the process is killed,
// or the disk is full.

#include "stream/edits/edit_journal.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

#include "catch.h"
#include "rounds.h"
#include "world/edits_support.h"

using namespace sgm;
namespace fs = std::filesystem;

namespace {

constexpr WorldIdentity kWorld{0x1234567890, 77, 256};
constexpr size_t kHead = 40, kMaxRecord = 87;

struct JournalFolder {
  fs::path path;
  JournalFolder() {
    // The journals are in shared memory if possible, because opening a thousand journals on a disk would be slow.
    const fs::path memory = "/dev/shm";
    const bool there = access(memory.c_str(), W_OK) == 0;
    std::string name = ((there ? memory : fs::temp_directory_path()) / "sgm_journal_XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~JournalFolder() { fs::remove_all(path); }
  fs::path file() const { return path / "edits"; }
  size_t files() const { return static_cast<size_t>(std::distance(fs::directory_iterator(path), {})); }
};

std::string bytesIn(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void putBytes(const fs::path& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  REQUIRE(out.good());
}

// Random edits: `count` operations of author 1, every fourth of which undoes the previous one.
std::vector<EditOperation> someEdits(uint32_t seed, int count) {
  std::mt19937 random(seed);
  EditLog log({1});
  EditId last;
  for (int i = 0; i < count; ++i) {
    const Brush brush = randomBrush(random, IntBox{{}, {}}.grown(100'000), 5000);
    const Result<EditLog::Edited> made = i % 4 == 3 ? log.undo(last) : log.add(brush);
    REQUIRE(made);
    last = made->id;
  }
  return {log.operations().begin(), log.operations().end()};
}

std::vector<std::byte> bytesOfAll(std::span<const EditOperation> operations) {
  std::vector<std::byte> bytes;
  for (const EditOperation& o : operations) encodeEdit(o, bytes);
  return bytes;
}

bool beginsWith(std::span<const EditOperation> all, std::span<const EditOperation> first) {
  return first.size() <= all.size() && bytesOfAll(all.first(first.size())) == bytesOfAll(first);
}

OpenedJournal opened(const fs::path& path) {
  Result<OpenedJournal> journal = EditJournal::open(path, kWorld);
  INFO((journal ? "" : journal.error().message));
  REQUIRE(journal);
  return std::move(*journal);
}

// Number of complete records in the first `size` bytes of a journal of these operations.
size_t wholeIn(std::span<const EditOperation> operations, size_t size) {
  size_t whole = 0;
  for (size_t end = kHead; whole < operations.size(); ++whole) {
    end += 12 + bytesOfAll(operations.subspan(whole, 1)).size();
    if (end > size) break;
  }
  return whole;
}

std::string written(const fs::path& path, std::span<const EditOperation> operations) {
  fs::remove(path);
  const OpenedJournal journal = opened(path);
  CHECK(journal.message.empty());
  journal.journal->append(operations);
  REQUIRE(journal.journal->flush());
  return bytesIn(path);
}

}  // namespace

TEST_CASE("a journal gives back what was appended, again and again", "[edits][files]") {
  const JournalFolder folder;
  const std::vector<EditOperation> all = someEdits(1, 40);
  for (size_t from = 0; from < all.size(); from += 8) {
    const OpenedJournal journal = opened(folder.file());
    CHECK(journal.operations.size() == from);
    CHECK(beginsWith(all, journal.operations));
    CHECK((journal.message.empty() && journal.cut_bytes == 0 && journal.damaged.empty() && journal.left_out == 0));
    journal.journal->append(std::span(all).subspan(from, 5));
    if (from % 16 == 0) REQUIRE(journal.journal->flush());
    // These last three operations are written when the journal is closed.
    journal.journal->append(std::span(all).subspan(from + 5, 3));
  }
  const OpenedJournal journal = opened(folder.file());
  CHECK(bytesOfAll(journal.operations) == bytesOfAll(all));
  EditLog log({2});
  REQUIRE(log.merge(journal.operations));
  EditLog expected({3});
  REQUIRE(expected.merge(all));
  CHECK(log.hash() == expected.hash());
  CHECK(folder.files() == 1);
}

TEST_CASE("a journal cut at any byte gives back every whole operation, and goes on", "[edits][files]") {
  const JournalFolder folder;
  const std::vector<EditOperation> all = someEdits(2, 9);
  const std::string bytes = written(folder.file(), std::span(all).first(8));
  for (size_t size = 0; size < bytes.size(); ++size) {
    CAPTURE(size);
    putBytes(folder.file(), bytes.substr(0, size));
    const size_t whole = wholeIn(std::span(all).first(8), size);
    {
      const OpenedJournal journal = opened(folder.file());
      CHECK(journal.operations.size() == whole);
      CHECK(beginsWith(all, journal.operations));
      CHECK(journal.message.empty() == (journal.cut_bytes == 0));
      if (size >= kHead) CHECK(journal.cut_bytes == size - fs::file_size(folder.file()));
      journal.journal->append(std::span(all).subspan(whole, 1));
    }
    const OpenedJournal again = opened(folder.file());
    CHECK(again.operations.size() == whole + 1);
    CHECK(beginsWith(all, again.operations));
    CHECK(again.message.empty());
  }
  CHECK(folder.files() == 1);
}

TEST_CASE("a journal with any byte flipped keeps what stood before it, and the damaged file", "[edits][files]") {
  const JournalFolder folder;
  const std::vector<EditOperation> all = someEdits(3, 7);
  const std::string bytes = written(folder.file(), all);
  size_t aside = 0, cut = 0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    CAPTURE(i);
    std::string bad = bytes;
    bad[i] = static_cast<char>(bad[i] ^ (1 << i % 8));
    putBytes(folder.file(), bad);
    if (i < kHead) {
      const Result<OpenedJournal> refused = EditJournal::open(folder.file(), kWorld);
      REQUIRE_FALSE(refused);
      CHECK(refused.error().code == Code::bad_input);
      CHECK(bytesIn(folder.file()) == bad);
      continue;
    }
    const size_t whole = wholeIn(all, i);
    {
      const OpenedJournal journal = opened(folder.file());
      CHECK(journal.operations.size() == whole);
      CHECK(beginsWith(all, journal.operations));
      CHECK_FALSE(journal.message.empty());
      if (whole + 1 < all.size()) {
        // Operations after the damage must be saved in a file of their own.
        REQUIRE_FALSE(journal.damaged.empty());
        CHECK(bytesIn(journal.damaged) == bad);
        CHECK(journal.damaged.filename() == "edits.damaged-" + std::to_string(++aside % 3 == 0 ? 3 : aside % 3));
        CHECK(journal.message.find("is damaged after " + std::to_string(whole) + " operations") != std::string::npos);
      } else {
        CHECK(journal.cut_bytes > 0);
        ++cut;
      }
      journal.journal->append(std::span(all).subspan(whole));
    }
    CHECK(bytesOfAll(opened(folder.file()).operations) == bytesOfAll(all));
    // Three files of damaged operations may exist together, and none is overwritten.
    if (aside % 3 == 0 && aside > 0) {
      for (int n = 1; n <= 3; ++n) fs::remove(folder.path / ("edits.damaged-" + std::to_string(n)));
    }
  }
  CHECK(aside > 300);
  CHECK(cut > 20);
}

TEST_CASE("a journal of another world, version or kind is refused and left alone", "[edits][files]") {
  const JournalFolder folder;
  const std::string bytes = written(folder.file(), someEdits(4, 3));
  const auto refused = [&](const WorldIdentity& world, const std::string& why) {
    const std::string before = bytesIn(folder.file());
    const Result<OpenedJournal> journal = EditJournal::open(folder.file(), world);
    REQUIRE_FALSE(journal);
    CHECK(journal.error().code == Code::bad_input);
    CHECK(journal.error().message == "journal '" + fs::canonical(folder.file()).string() + "': " + why);
    CHECK(bytesIn(folder.file()) == before);
  };
  refused({1, kWorld.seed, kWorld.cell},
          "it belongs to another world, with another grammar, other parameters or other host fields");
  refused({kWorld.grammar, 1, kWorld.cell}, "it belongs to another world, with another seed");
  // The grammar's hash includes the seed and the cell size: if one of these differs, the message names it.
  refused({1, 1, kWorld.cell}, "it belongs to another world, with another seed");
  refused({kWorld.grammar, kWorld.seed, 1}, "it belongs to another world, with another finest cell");
  std::string other = bytes;
  other[8] = 2;
  putBytes(folder.file(), other);
  refused(kWorld, "it has version 2; this program supports version 1");
  putBytes(folder.file(), "grammar or picture, but no journal: some other file that somebody needs");
  refused(kWorld, "it is not an edit journal");
  putBytes(folder.file(), "short");
  refused(kWorld, "it is not an edit journal");
  CHECK(EditJournal::open(folder.path, kWorld).error().code == Code::io);
  CHECK(EditJournal::open(folder.path / "missing" / "edits", kWorld).error().code == Code::io);
  CHECK(EditJournal::open("/dev/null", kWorld).error().message == "journal '/dev/null': it is not a regular file");
}

TEST_CASE("a journal is open once", "[edits][files]") {
  const JournalFolder folder;
  {
    const OpenedJournal first = opened(folder.file());
    fs::create_symlink("edits", folder.path / "link");
    for (const fs::path& path : {folder.file(), folder.path / "link"}) {
      const Result<OpenedJournal> second = EditJournal::open(path, kWorld);
      REQUIRE_FALSE(second);
      CHECK(second.error().code == Code::limit);
      CHECK(second.error().message.find("another world or program has it open") != std::string::npos);
    }
    first.journal->append(someEdits(5, 4));
  }
  CHECK(opened(folder.path / "link").operations.size() == 4);
}

TEST_CASE("a journal of mostly undone edits is written anew, and shows the same", "[edits][files]") {
  const JournalFolder folder;
  EditLog log({1});
  std::mt19937 random(6);
  for (int i = 0; i < 200; ++i) {
    const EditLog::Edited made = *log.add(randomBrush(random, IntBox{{}, {}}.grown(100'000), 5000));
    if (i % 5 == 0) continue;
    const EditLog::Edited undone = *log.undo(made.id);
    if (i % 3 == 0) REQUIRE(log.undo(log.undo(undone.id)->id));
  }
  written(folder.file(), log.operations());
  const auto size = fs::file_size(folder.file());
  for (int round = 0; round < 2; ++round) {
    const OpenedJournal journal = opened(folder.file());
    CHECK((journal.left_out > 200) == (round == 0));
    CHECK(fs::file_size(folder.file()) * 2 < size);
    CHECK(journal.damaged.empty());
    EditLog again({1});
    REQUIRE(again.merge(journal.operations));
    CHECK(again.snapshot()->brushes() == log.snapshot()->brushes());
    CHECK(again.add(randomBrush(random, {{}, {}}, 50))->id.number == log.size() + 1);  // numbers are not reused
    // The journal is locked under its new name, too.
    CHECK(EditJournal::open(folder.file(), kWorld).error().code == Code::limit);
  }
  CHECK(folder.files() == 1);
}

TEST_CASE("a full disk loses nothing that was appended", "[edits][files]") {
  // A limit on the file size makes the write fail as a full disk does.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const std::vector<EditOperation> all = someEdits(7, 12);
  for (const rlim_t limit : {rlim_t{0}, rlim_t{kHead}, rlim_t{kHead + 150}, rlim_t{kHead + 520}}) {
    CAPTURE(limit);
    const JournalFolder folder;
    {
      const OpenedJournal journal = opened(folder.file());
      journal.journal->append(std::span(all).first(6));
      rlimit small = before;
      small.rlim_cur = limit;
      REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
      const Result<void> first = journal.journal->flush();
      journal.journal->append(std::span(all).subspan(6, 5));
      const Result<void> second = journal.journal->flush();
      Result<OpenedJournal> none = EditJournal::open(folder.path / "new", kWorld);
      REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
      CHECK(static_cast<bool>(first) == (limit == kHead + 520));
      REQUIRE_FALSE(second);
      CHECK(second.error().code == Code::io);
      // A copy of the file, as if the process were killed now, contains all edits except those that were reported as
      // not written.
      fs::copy_file(folder.file(), folder.path / "killed");
      const std::vector<EditOperation> kept = opened(folder.path / "killed").operations;
      CHECK(beginsWith(all, kept));
      const size_t missing = 11 - kept.size();
      CHECK(second.error().message == "journal '" + fs::canonical(folder.file()).string() + "': File too large; " +
                                          std::to_string(missing) +
                                          (missing == 1 ? " edit is not saved" : " edits are not saved"));
      CHECK(static_cast<bool>(none) == (limit >= kHead));
      journal.journal->append(std::span(all).subspan(11, 1));
      REQUIRE(journal.journal->flush());
    }
    CHECK(bytesOfAll(opened(folder.file()).operations) == bytesOfAll(all));
  }
  std::signal(SIGXFSZ, old_handler);
}

TEST_CASE("a process killed at any moment leaves all that it flushed", "[edits][files]") {
  const std::vector<EditOperation> all = someEdits(8, 4000);
  size_t kept = 0;
  for (uint32_t round = 0; round < rounds(12); ++round) {
    CAPTURE(round);
    const JournalFolder folder;
    int told[2];
    REQUIRE(pipe(told) == 0);
    const pid_t child = fork();
    if (child == 0) {
      Result<OpenedJournal> journal = EditJournal::open(folder.file(), kWorld);
      uint32_t flushed = 0;
      for (uint32_t i = 0; journal && i + 3 <= all.size(); i += 3) {
        journal->journal->append(std::span(all).subspan(i, 3));
        if (journal->journal->flush()) flushed = i + 3;
        if (write(told[1], &flushed, sizeof flushed) != sizeof flushed) break;
      }
      for (;;) pause();
    }
    close(told[1]);
    std::mt19937 random(round);
    const uint32_t wanted = 1 + static_cast<uint32_t>(random() % 60);
    uint32_t flushed = 0;
    for (uint32_t i = 0; i < wanted; ++i) REQUIRE(read(told[0], &flushed, sizeof flushed) == sizeof flushed);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 2000));
    REQUIRE(kill(child, SIGKILL) == 0);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    for (uint32_t later = 0; read(told[0], &later, sizeof later) == sizeof later;) flushed = later;
    close(told[0]);
    const OpenedJournal journal = opened(folder.file());
    CHECK(flushed >= 3 * wanted);
    CHECK(journal.operations.size() >= flushed);
    CHECK(beginsWith(all, journal.operations));
    CHECK(journal.damaged.empty());
    CHECK(journal.cut_bytes <= kMaxRecord);
    kept += journal.operations.size();
  }
  CHECK(kept > 0);
}

TEST_CASE("one thread appends while another flushes", "[edits][files][threads]") {
  const JournalFolder folder;
  const std::vector<EditOperation> all = someEdits(9, 600);
  {
    const OpenedJournal journal = opened(folder.file());
    std::thread flusher([&] {
      for (int i = 0; i < 20; ++i) CHECK(journal.journal->flush());
    });
    for (size_t i = 0; i < all.size(); i += 2) journal.journal->append(std::span(all).subspan(i, 2));
    flusher.join();
  }
  EditLog log({2}), expected({3});
  REQUIRE(log.merge(opened(folder.file()).operations));
  REQUIRE(expected.merge(all));
  CHECK(log.snapshot()->brushes() == expected.snapshot()->brushes());
}
