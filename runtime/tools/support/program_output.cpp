#include "tools/support/program_output.h"
#include "base/plain_text.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

extern char** environ;

namespace sgm::cli {

Result<ProgramOutput> outputOf(const std::vector<std::string>& command) {
  const auto failure = [&](int code) {
    return Error{code == ENOENT ? Code::unsupported : Code::io, command[0] + " cannot be run: " + systemMessage(code)};
  };
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return failure(errno);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t process = 0;
  const int code = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  ProgramOutput result;
  if (code == 0) {
    std::array<char, 4096> part;
    for (ssize_t got = 0; (got = read(ends[0], part.data(), part.size())) > 0 || (got < 0 && errno == EINTR);) {
      if (got > 0) result.output.append(part.data(), static_cast<size_t>(got));
    }
  }
  close(ends[0]);
  if (code != 0) return failure(code);
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return failure(errno);
  }
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace sgm::cli
