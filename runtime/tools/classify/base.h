#pragma once
// The database of reference histograms: one SQLite file, whose contents are verified as far as possible.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/classify.h"

namespace sgm::masters {

/// Reference histograms for any number of keys (histogram settings), and the classification limits of each key.
struct MasterSet {
  std::vector<measure::Master> masters;
  std::vector<measure::MasterLimits> limits;

  /// The reference histograms of one key.
  std::vector<measure::Master> of(const measure::MasterKey& key) const;
  /// The classification limits (maximum distances) of a key; null if the set has no limits for this key.
  const measure::MasterLimits* limitsOf(const measure::MasterKey& key) const;
};

/// The reference histograms compiled into the program: built_in_masters.inc, as `sgm masters build --emit` writes it.
MasterSet builtInMasters();

/// Why a file cannot be read as a database of reference histograms.
enum class Damage {
  none,
  damaged,  ///< not a database of reference histograms, or incomplete
  newer,    ///< written by a later version of the program; must not be replaced
  io,       ///< cannot be opened: missing, no permission, locked
};

struct ReadBase {
  std::optional<MasterSet> set;  ///< set if damage is Damage::none
  Damage damage = Damage::none;
  std::string what;  ///< the problem, in one line without the file's name
};
/// Runs SQLite's quick_check, reads the whole database, and compares every row with its checksum. Writes only the
/// temporary files that SQLite needs beside an open file, and writes nothing into a write-protected folder.
ReadBase readBase(const std::filesystem::path& file);

/// Replaces the file's contents by `set`. A new file appears completely or not at all. An existing file changes in one
/// transaction, so it keeps its previous contents if the disk is full or the process ends. Errors: io; bad_input if the
/// file exists and is not an intact database.
Result<void> writeBase(const std::filesystem::path& file, const MasterSet& set);

/// Checks whether writeBase() could start. Creates the file's folder. Errors: those of writeBase().
Result<void> checkWritable(const std::filesystem::path& file);

/// The path sgm/masters.db in $XDG_DATA_HOME, or in ~/.local/share if that variable is not set; empty if HOME is not
/// set either.
std::filesystem::path defaultBase();

struct OpenedBase {
  MasterSet set;
  std::string from;    ///< path of the database that was read, or "built in"
  std::string notice;  ///< message about damage of the file and how it was handled; empty if the file was intact
};
/// Opens the user's database. If the file is missing, returns the built-in reference histograms and writes nothing. A
/// damaged file is renamed to the first free name of FILE.damaged-1, FILE.damaged-2 and so on, and replaced by the
/// built-in set. Errors: io; unsupported for a database of a later version.
Result<OpenedBase> openBase(const std::filesystem::path& file);

}  // namespace sgm::masters
