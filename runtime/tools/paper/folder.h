#pragma once
// Writes a folder of files that appears completely or not at all.

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

/// File names of the page and of the manifest, and the manifest's first line, which identifies a folder as a report.
/// Each further line of the manifest is the XXH64 of a file's bytes in 16 hexadecimal digits, two spaces, and its path.
inline constexpr const char* kReportPage = "index.html";
inline constexpr const char* kReportManifest = "manifest.txt";
inline constexpr const char* kReportSign = "The files of a report of sgm paper by XXH64";

/// Checks whether a report may be written to `target`: it does not exist, or is an empty folder, or an earlier report
/// in which nothing was added or changed since, at any depth. Leaves no files. signals: see writeReportFolder. Error:
/// io if something else is at `target`, the parent folder is not writable, or its file system cannot exchange an
/// earlier report for a new one.
Result<void> checkReportFolder(const std::filesystem::path& target, EndingSignals* signals = nullptr);

/// Writes the files and their manifest into a folder beside the target, and then renames it to the target in one step,
/// which removes an earlier report. After any failure, even if the process is killed, the target is completely old or
/// completely new. Leaves no other files. signals: defers ending signals while files would be left behind; null: no
/// signal is deferred. Errors: as checkReportFolder; io, for example if the disk is full.
/// checkReportFolder; io, for example if the disk is full.
Result<void> writeReportFolder(const std::filesystem::path& target, std::vector<FolderFile> files,
                               EndingSignals* signals = nullptr);

}  // namespace sgm::cli
