#pragma once
// A folder of files that appears completely or not at all.

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "tools/support/ending_signals.h"

namespace sgm::cli {

struct FolderFile {
  std::string path;  ///< relative, forward slashes
  std::string bytes;
};

/// The page, and the manifest that identifies an earlier report: this line, then for every file the XXH64 of its bytes
/// in 16 hexadecimal digits, two spaces, and its path.
inline constexpr const char* kReportPage = "index.html";
inline constexpr const char* kReportManifest = "manifest.txt";
inline constexpr const char* kReportSign = "The files of a report of sgm paper by XXH64";

/// Checks whether a report may be written there: nothing exists, or an empty folder, or an earlier report in which
/// nothing was added or changed since, at any depth. Leaves no files. signals: see writeReportFolder. Error: io if
/// something else is there, the parent folder is not writable, or its file system cannot exchange an earlier report for
/// a new one.
Result<void> checkReportFolder(const std::filesystem::path& target, EndingSignals* signals = nullptr);

/// Writes the files and their manifest into a folder beside the target, and gives it the target's name in one step,
/// which removes an earlier report. After any failure, even if the process is killed, the target is either old or new.
/// Leaves no other files, also after signals that their handler defers: `signals`, or null. Errors: as
/// checkReportFolder; io, for example if the disk is full.
Result<void> writeReportFolder(const std::filesystem::path& target, std::vector<FolderFile> files,
                               EndingSignals* signals = nullptr);

}  // namespace sgm::cli
