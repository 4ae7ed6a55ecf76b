#pragma once
// The base of reference histograms: one SQLite file, whose contents are verified as far as possible.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/classify.h"

namespace sgm::masters {

/// Reference histograms of any keys, and limits for each key.
struct MasterSet {
  std::vector<measure::Master> masters;
  std::vector<measure::MasterLimits> limits;

  /// The reference histograms of one key.
  std::vector<measure::Master> of(const measure::MasterKey& key) const;
  /// Null if there are none.
  const measure::MasterLimits* limitsOf(const measure::MasterKey& key) const;
};

/// The compiled-in set: built_in_masters.inc, as `sgm masters build --emit` writes it.
MasterSet builtInMasters();

/// Why a file cannot be read as a base.
enum class Damage {
  none,
  damaged,  ///< not a base, or incomplete
  newer,    ///< of a later version, which must not be replaced
  io,       ///< cannot be opened: missing, no permission, locked
};

struct ReadBase {
  std::optional<MasterSet> set;  ///< set if damage is none
  Damage damage = Damage::none;
  std::string what;  ///< the problem, in one line without the file's name
};
/// Reads the whole base after quick_check, and compares every row with its checksum. Writes only the temporary files
/// that SQLite needs beside an open file, and nothing into a write-protected folder.
ReadBase readBase(const std::filesystem::path& file);

/// Makes the file hold exactly this set. A new file appears completely or not at all. An existing one changes in one
/// transaction, so a full disk or the process's end leaves its previous contents. Errors: io; bad_input if the file
/// exists and is not a sound base.
Result<void> writeBase(const std::filesystem::path& file, const MasterSet& set);

/// Whether writeBase() could start. Creates the file's folder. Errors: those of writeBase.
Result<void> checkWritable(const std::filesystem::path& file);

/// $XDG_DATA_HOME/sgm/masters.db, or the same in ~/.local/share; empty if neither is known.
std::filesystem::path defaultBase();

struct OpenedBase {
  MasterSet set;
  std::string from;    ///< the file, or "built in"
  std::string notice;  ///< the damage and its treatment; empty: none
};
/// Opens the default base. If it is missing, returns the built-in reference histograms, and writes nothing. A damaged
/// one is moved aside to FILE.damaged-1 and so on, and replaced by the built-in set. Errors: io; unsupported for a base
/// of a later version.
Result<OpenedBase> openBase(const std::filesystem::path& file);

}  // namespace sgm::masters
