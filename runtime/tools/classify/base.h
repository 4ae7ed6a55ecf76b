#pragma once
// The base of master histograms: one SQLite file, which is believed only as far as it can be checked.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/classify.h"

namespace sgm::masters {

/// Masters of any keys, and limits for each of these.
struct MasterSet {
  std::vector<measure::Master> masters;
  std::vector<measure::MasterLimits> limits;

  /// The masters of one key.
  std::vector<measure::Master> of(const measure::MasterKey& key) const;
  /// Null where there are none.
  const measure::MasterLimits* limitsOf(const measure::MasterKey& key) const;
};

/// The set that was compiled in: built_in_masters.inc, as `sgm masters build --emit` writes it.
MasterSet builtInMasters();

/// Why a file is not read as a base.
enum class Damage {
  none,
  damaged,  ///< it is no base of ours, or not all of what was written
  newer,    ///< of a later version: not ours to replace
  io,       ///< cannot be opened: missing, no permission, locked
};

struct ReadBase {
  std::optional<MasterSet> set;  ///< there where damage is none
  Damage damage = Damage::none;
  std::string what;  ///< is wrong, in one line without the file's name
};
/// Reads all of it, after quick_check, and compares every row with its checksum. Writes nothing but what SQLite itself
/// needs beside the file while it is open, and nothing in a folder that is write-protected.
ReadBase readBase(const std::filesystem::path& file);

/// Makes the file hold this set and nothing else. A new file appears whole or not at all; in one that is there the
/// change is one transaction, so that a full disk or the process's end leaves what was there before.
/// Errors: io; bad_input where the file is there and is no sound base.
Result<void> writeBase(const std::filesystem::path& file, const MasterSet& set);

/// Whether writeBase() would begin. Makes the folder that the file is to be in. Errors: those of writeBase.
Result<void> checkWritable(const std::filesystem::path& file);

/// $XDG_DATA_HOME/sgm/masters.db, or that in ~/.local/share; empty where neither is known.
std::filesystem::path defaultBase();

struct OpenedBase {
  MasterSet set;
  std::string from;    ///< the file, or "built in"
  std::string notice;  ///< what was damaged and what became of it; empty: nothing
};
/// The base at its own place. Where there is none, the masters that are built in, and nothing is written. A damaged one
/// is moved aside, as FILE.damaged-1 and so on, and the built-in masters take its place.
/// Errors: io, and unsupported for a base of a later version.
Result<OpenedBase> openBase(const std::filesystem::path& file);

}  // namespace sgm::masters
