// Tests the detection of saved files.

#include "tools/preview/file_watch.h"

#include <chrono>

#include "temporary_folder.h"

using namespace sgm;
using namespace sgm::preview;

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Writes a file, and sets its time `seconds` later, so that the test also works on file systems with coarse times.
void save(const std::filesystem::path& file, const std::string& text, int seconds) {
  write(file, text);
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(seconds));
}

/// Calls changed() twice: the first call detects that the file has changed, the second that it no longer changes.
/// Returns true if either call returned true.
bool changedSoon(FileWatch& watch) {
  const bool first = watch.changed();
  return watch.changed() || first;
}

}  // namespace

TEST_CASE("a save is told once", "[preview]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "a.sgm", other = folder.path / "b.sgm";
  write(file, "one");
  write(other, "two");
  FileWatch watch;
  watch.watch({file, other});
  CHECK_FALSE(changedSoon(watch));
  save(other, "six", 5);
  CHECK(changedSoon(watch));
  CHECK_FALSE(changedSoon(watch));
  save(file, "longer", 0);
  CHECK(changedSoon(watch));
  CHECK_FALSE(changedSoon(watch));
}

TEST_CASE("a file that is being written is waited for", "[preview]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "a.sgm";
  write(file, "one");
  FileWatch watch;
  watch.watch({file});
  for (int i = 0; i < 5; ++i) {
    save(file, std::string(static_cast<size_t>(i), 'x'), i + 1);
    CHECK_FALSE(watch.changed());
  }
  CHECK(watch.changed());
}

TEST_CASE("files come, go and are replaced", "[preview]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "a.sgm", fresh = folder.path / "new";
  FileWatch watch;
  watch.watch({file});
  CHECK_FALSE(changedSoon(watch));
  write(file, "one");
  CHECK(changedSoon(watch));
  // Many editors write a new file, and rename it to the old name.
  save(fresh, "two", 9);
  std::filesystem::rename(fresh, file);
  CHECK(changedSoon(watch));
  std::filesystem::remove(file);
  CHECK(changedSoon(watch));
  CHECK_FALSE(changedSoon(watch));
}
