#pragma once
// Child processes for tests: shell commands.

#include <chrono>
#include <filesystem>
#include <thread>

#include "../programs.h"
#include "base/platform/process.h"

namespace sgm {

inline platform::ProcessSettings shell(const std::string& command) {
  platform::ProcessSettings settings;
  settings.program = "/bin/sh";
  settings.arguments = {"-c", command};
  settings.input = {platform::Stream::none};
  settings.output = settings.error = {platform::Stream::pipe};
  return settings;
}

/// Like shell(), but the command runs in its own process group, with its own environment.
inline platform::ProcessSettings isolatedShell(const std::string& command) {
  platform::ProcessSettings settings = shell(command);
  settings.environment = {"PATH=/usr/local/bin:/usr/bin:/bin"};
  settings.inherits_environment = false;
  settings.isolated = true;
  return settings;
}

inline platform::RunSettings within(std::chrono::milliseconds time) {
  platform::RunSettings run;
  run.time = time;
  return run;
}

inline platform::ProcessOutput outputOf(const platform::ProcessSettings& settings,
                                        const platform::RunSettings& run = within(std::chrono::minutes(1))) {
  Result<platform::ProcessOutput> said = platform::runProcess(settings, run);
  REQUIRE(said);
  return std::move(*said);
}

inline size_t openDescriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<size_t>(std::distance(begin(all), end(all)));
}

class Watch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

inline bool endsSoon(int process) {
  const Watch watch;
  while (runs(process) && watch.seconds() < 10) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !runs(process);
}

}  // namespace sgm
