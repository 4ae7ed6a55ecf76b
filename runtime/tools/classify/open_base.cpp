// Finds and opens the user's database of reference histograms, and replaces a damaged one.

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/plain_text.h"
#include "tools/classify/base.h"

namespace sgm::masters {
namespace {

constexpr int kMaxDamaged = 10'000;

bool isThere(const std::string& file) {
  struct stat about {};
  return lstat(file.c_str(), &about) == 0;
}

/// Renames a damaged database file to FILE.damaged-N. Returns the new name, or an empty text with errno set if renaming
/// fails. Moves SQLite's write-ahead log first: otherwise SQLite would replay that log into the next database.
std::string moveAside(const std::string& file) {
  for (int i = 1; i <= kMaxDamaged; ++i) {
    const std::string aside = file + ".damaged-" + std::to_string(i);
    if (isThere(aside) || isThere(aside + "-wal") || isThere(aside + "-shm")) continue;
    for (const char* part : {"-wal", "-shm", ""}) {
      if (std::rename((file + part).c_str(), (aside + part).c_str()) != 0 && errno != ENOENT) return {};
    }
    return aside;
  }
  errno = EEXIST;
  return {};
}

}  // namespace

std::filesystem::path defaultBase() {
  // Relative paths are ignored (XDG Base Directory Specification).
  const auto absolute = [](const char* variable) {
    const char* text = std::getenv(variable);
    return text != nullptr && *text == '/' ? std::string(text) : std::string();
  };
  if (const std::string data = absolute("XDG_DATA_HOME"); !data.empty()) return data + "/sgm/masters.db";
  const std::string home = absolute("HOME");
  return home.empty() ? home : home + "/.local/share/sgm/masters.db";
}

Result<OpenedBase> openBase(const std::filesystem::path& file) {
  if (file.empty() || !isThere(file.string())) return OpenedBase{builtInMasters(), "built in", {}};
  ReadBase read = readBase(file);
  const std::string name = file.string();
  switch (read.damage) {
    case Damage::none:
      return OpenedBase{std::move(*read.set), name, {}};
    case Damage::newer:
      return Error{Code::unsupported, name + ": " + read.what + ": use that version, or --masters FILE"};
    case Damage::io:
      return Error{Code::io, "cannot read " + name + ": " + read.what};
    case Damage::damaged:
      break;
  }
  OpenedBase opened{builtInMasters(), "built in", {}};
  const std::string aside = moveAside(name);
  if (aside.empty()) {
    opened.notice = name + " is damaged (" + read.what + ") and cannot be moved aside (" + systemMessage(errno) +
                    "): the built-in reference histograms are used";
    return opened;
  }
  opened.notice = name + " was damaged (" + read.what + "): it is named " + aside + " now";
  if (const Result<void> written = writeBase(file, opened.set); !written) {
    opened.notice += ", and the built-in reference histograms are used: " + written.error().message;
    return opened;
  }
  opened.notice += ", and the built-in reference histograms have replaced it";
  opened.from = name;
  return opened;
}

}  // namespace sgm::masters
