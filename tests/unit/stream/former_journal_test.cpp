// Tests that journals of version 0.2 still open, and get the current identity of their grammar when they are rewritten.

#include "base/bytes.h"
#include "base/checksum.h"
#include "streaming_support.h"
#include "temporary_folder.h"
#include "world/edits_support.h"
#include "world/version_0_2.h"

using namespace sgm;

namespace {

constexpr size_t kEdits = 16;

/// The grammar's hash in the head of a journal.
uint64_t grammarIn(const std::filesystem::path& journal) {
  const std::string bytes = contentOf(journal);
  REQUIRE(bytes.size() > 40);
  return ByteReader(std::as_bytes(std::span(bytes)).subspan(16, 8)).get<uint64_t>();
}

struct FormerJournal {
  TemporaryFolder folder;
  std::filesystem::path path = folder.path / "journal";
  WorldField field{formerWorld(), std::pmr::get_default_resource()};
  WorldIdentity now{checksum(*field.identity()), 5, kUnitsPerMetre};
  uint64_t of_then = checksum(*field.formerIdentity());

  FormerJournal() { std::filesystem::copy_file(formerFile("edits.journal"), path); }
};

}  // namespace

TEST_CASE("a world opens its journal of version 0.2, and another world does not", "[edits][files]") {
  const FormerJournal journal;
  const auto jobs = *makeThreadPool(1);
  const auto backend = *makeBackend({}, *jobs, std::pmr::get_default_resource());
  WorldSettings settings;
  settings.journal = journal.path;
  settings.lod.top = 3;
  settings.lod.finest_cell = kUnitsPerMetre;
  settings.lod.view_distance = 120.0 * kUnitsPerMetre;
  const auto open = [&](const WorldField& field) {
    return World::create(external(field), *backend, *jobs, settings, std::pmr::get_default_resource());
  };
  EditLog edits({1});
  {
    const Result<OpenedJournal> opened = EditJournal::open(journal.path, journal.now, [&] { return journal.of_then; });
    REQUIRE(opened);
    CHECK(opened->operations.size() == kEdits);
    REQUIRE(edits.merge(opened->operations));
  }
  const std::string before = contentOf(journal.path);
  for (int round = 0; round < 2; ++round) {
    const auto world = open(journal.field);
    INFO((world ? "" : world.error().message));
    REQUIRE(world);
    CHECK((*world)->editHash() == edits.hash());
  }
  CHECK(contentOf(journal.path) == before);
  const auto refused = open(WorldField(formerWorld("box(3m"), std::pmr::get_default_resource()));
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::bad_input);
  CHECK(contentOf(journal.path) == before);
}

TEST_CASE("a journal of version 0.2 takes the identity of now when it is written anew", "[edits][files]") {
  const FormerJournal journal;
  REQUIRE(journal.now.grammar != journal.of_then);
  CHECK(grammarIn(journal.path) == journal.of_then);
  CHECK(EditJournal::open(journal.path, journal.now).error().code == Code::bad_input);
  CHECK(EditJournal::open(journal.path, journal.now, [] { return uint64_t{1}; }).error().code == Code::bad_input);
  size_t asked = 0;
  const FormerGrammar former = [&] {
    ++asked;
    return journal.of_then;
  };
  EditLog log({1});
  {
    const Result<OpenedJournal> opened = EditJournal::open(journal.path, journal.now, former);
    REQUIRE(opened);
    CHECK(opened->operations.size() == kEdits);
    CHECK(opened->message.empty());
    REQUIRE(log.merge(opened->operations));
    std::mt19937 random(1);
    // If a brush is undone, redone and undone again, only the last undo is still needed, so the other operations can be
    // left out of the journal.
    for (int i = 0; i < 75; ++i) {
      const EditId undone = log.undo(log.add(randomBrush(random, IntBox{{}, {}}.grown(1000), 500))->id)->id;
      REQUIRE(log.undo(log.undo(undone)->id));
    }
    opened->journal->append(log.operations().subspan(kEdits));
  }
  CHECK(asked == 1);
  CHECK(grammarIn(journal.path) == journal.of_then);
  for (int round = 0; round < 2; ++round) {
    const Result<OpenedJournal> opened = EditJournal::open(journal.path, journal.now, former);
    REQUIRE(opened);
    CHECK((opened->left_out > 200) == (round == 0));
    EditLog again({1});
    REQUIRE(again.merge(opened->operations));
    CHECK(again.snapshot()->brushes() == log.snapshot()->brushes());
    CHECK(grammarIn(journal.path) == journal.now.grammar);
  }
  CHECK(asked == 2);
}
