#include "base/platform/figures.h"

#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "base/file_reader.h"

namespace sgm::platform {
namespace {

/// Returns the content of a file in /proc; empty if it does not exist.
std::string procFile(const char* name) {
  constexpr uint64_t kMaxBytes = uint64_t{64} << 20;
  Result<std::string> content = readFile(name, kMaxBytes);
  return content ? std::move(*content) : std::string();
}

/// Returns the time when the machine booted, in seconds since 1970; nullopt if /proc/stat does not tell it.
std::optional<double> bootTime() {
  std::istringstream in(procFile("/proc/stat"));
  for (std::string word; in >> word;) {
    double seconds = 0;
    if (word == "btime" && in >> seconds) return seconds;
  }
  return std::nullopt;
}

/// Reads processor time and start time from /proc/self/stat. Fields are counted from the last ')', because the
/// program's name before it may contain any characters.
void readTimes(ProcessFigures& figures) {
  const std::string stat = procFile("/proc/self/stat");
  const size_t name_end = stat.rfind(')');
  const long ticks = sysconf(_SC_CLK_TCK);
  if (name_end == stat.npos || ticks <= 0) return;
  constexpr int kFirstField = 3, kUser = 14, kSystem = 15, kStart = 22;
  std::istringstream in(stat.substr(name_end + 1));
  std::string field;
  double user = 0, system = 0, start = 0;
  for (int number = kFirstField; number <= kStart; ++number) {
    if (number != kUser && number != kSystem && number != kStart) {
      in >> field;
    } else {
      in >> (number == kUser ? user : number == kSystem ? system : start);
    }
  }
  if (!in) return;
  figures.cpu_seconds = (user + system) / static_cast<double>(ticks);
  if (const std::optional<double> boot = bootTime()) figures.start_seconds = *boot + start / static_cast<double>(ticks);
}

std::optional<uint64_t> openFiles() {
  std::error_code error;
  uint64_t count = 0;
  std::filesystem::directory_iterator at("/proc/self/fd", error);
  for (; !error && at != std::filesystem::directory_iterator(); at.increment(error)) ++count;
  // Do not count the descriptor through which this function reads the folder /proc/self/fd.
  return error || count == 0 ? std::nullopt : std::optional(count - 1);
}

}  // namespace

ProcessFigures processFigures() {
  ProcessFigures figures;
  std::istringstream memory(procFile("/proc/self/statm"));
  uint64_t pages = 0, resident = 0;
  const long page = sysconf(_SC_PAGESIZE);
  if (page > 0 && memory >> pages >> resident) figures.resident_bytes = resident * static_cast<uint64_t>(page);
  readTimes(figures);
  figures.open_files = openFiles();
  return figures;
}

}  // namespace sgm::platform
