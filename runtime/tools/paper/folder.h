#pragma once
// Writes a folder of files atomically: it appears completely or not at all.

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "tools/support/ending_signals.h"

namespace sgm::cli {

struct FolderFile {
  std::string path;  ///< path relative to the folder, with forward slashes
  std::string bytes;
};

/// File names of the page and of the manifest, and the first line of the manifest, by which a folder is recognized as a
/// report. Each further line of the manifest is the XXH64 of a file's bytes in 16 hexadecimal digits, two spaces, and
/// the path of the file.
inline constexpr const char* kReportPage = "index.html";
inline constexpr const char* kReportManifest = "manifest.txt";
inline constexpr const char* kReportSign = "The files of a report of sgm paper by XXH64";

/// Checks whether a report may be written to `target`: the path does not exist, is an empty folder, or is an earlier
/// report whose files are unchanged, without additional files. Leaves no files. signals: see writeReportFolder. Error:
/// io if anything else is at `target`, the parent folder is not writable, or its file system cannot exchange an earlier
/// report for a new one.
Result<void> checkReportFolder(const std::filesystem::path& target, EndingSignals* signals = nullptr);

/// Writes the files and their manifest into a temporary folder beside the target, and then renames this folder to the
/// target in one step, which replaces an earlier report. After any failure, even if the process is killed, the target
/// is completely old or completely new. Unless the process is killed, no other files remain. signals: defers ending
/// signals while temporary files exist; null: signals are not deferred. Errors: those of checkReportFolder; io, for
/// example if the disk is full.
Result<void> writeReportFolder(const std::filesystem::path& target, std::vector<FolderFile> files,
                               EndingSignals* signals = nullptr);

}  // namespace sgm::cli
