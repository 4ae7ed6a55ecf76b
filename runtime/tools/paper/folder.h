#pragma once
// A folder of files that appears whole or not at all.

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

/// The page, and the file by which an earlier report is known: this line, then of every file the XXH64 of its bytes in
/// 16 hexadecimal digits, two spaces, and its path.
inline constexpr const char* kReportPage = "index.html";
inline constexpr const char* kReportManifest = "manifest.txt";
inline constexpr const char* kReportSign = "The files of a report of sgm paper by XXH64";

/// Whether a report may be written there: nothing is there, an empty folder, or an earlier report with nothing in it,
/// at any depth, that was added or changed since. Writes nothing that stays. signals: see writeReportFolder.
/// Errors: io, where something else is there, the folder around it cannot be written to, or its file system cannot
/// exchange an earlier report for a new one.
Result<void> checkReportFolder(const std::filesystem::path& target, EndingSignals* signals = nullptr);

/// Writes the files, and their manifest, into a folder beside the target, and gives it the target's name in one step;
/// an earlier report goes. Whatever fails, and even if the process is killed, the target is as it was or as it shall
/// be. Nothing else is left, also by signals that their handler lets wait: `signals`, or null where there is none.
/// Errors: as checkReportFolder; io, for instance where the disk is full.
Result<void> writeReportFolder(const std::filesystem::path& target, std::vector<FolderFile> files,
                               EndingSignals* signals = nullptr);

}  // namespace sgm::cli
