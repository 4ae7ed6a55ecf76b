#pragma once
// A folder of files that appears whole or not at all.

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

struct FolderFile {
  std::string path;  ///< relative, forward slashes
  std::string bytes;
};

/// What a report's folder holds at its top; an earlier one has nothing else.
inline constexpr const char* kReportPage = "index.html";
inline constexpr const char* kReportFolders[] = {"pictures", "grammars"};
/// Stands in the page of every report, by which an earlier one is known.
inline constexpr const char* kReportSign = "<meta name=\"generator\" content=\"sgm paper\"/>";

/// Whether a report may be written there: nothing is there, an empty folder, or an earlier report and nothing else.
/// Writes nothing that stays. Errors: io, where something else is there, or the folder around it cannot be written to.
Result<void> checkReportFolder(const std::filesystem::path& target);

/// Writes the files into a folder beside the target, and gives it the target's name; an earlier report goes. Signals
/// that would end the process wait for that. Whatever fails, the target is as it was and nothing else is left.
/// Errors: as checkReportFolder; io, for instance where the disk is full.
Result<void> writeReportFolder(const std::filesystem::path& target, const std::vector<FolderFile>& files);

}  // namespace sgm::cli
