// Tests the start of child processes: their program, environment, streams, signals and limits.

#include "base/platform/process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "process_support.h"

using namespace sgm;
using namespace sgm::platform;
using Kind = ProcessExit::Kind;

namespace {

/// Sets an environment variable for the lifetime of this object.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::string said(const std::string& command, const ProcessLimits& limits) {
  ProcessSettings settings = shell(command);
  settings.sandbox = limits;
  return outputOf(settings).output;
}

ProcessSettings named(const std::string& program) {
  ProcessSettings settings = shell("");
  settings.program = program;
  settings.arguments.clear();
  return settings;
}

}  // namespace

TEST_CASE("an exit status of any number comes back", "[base][process]") {
  for (int status = 0; status < 256; status += 5) {
    const ProcessExit exit = outputOf(shell("exit " + std::to_string(status))).exit;
    CHECK(exit.kind == Kind::exited);
    CHECK(exit.number == status);
    CHECK(exit.succeeded() == (status == 0));
  }
}

TEST_CASE("the end by a signal is told apart", "[base][process]") {
  const auto endBy = [](const std::string& signal) { return outputOf(shell("kill -" + signal + " $$")).exit; };
  CHECK(endBy("SEGV").kind == Kind::crashed);
  CHECK(endBy("SEGV").number == SIGSEGV);
  CHECK(endBy("ABRT").kind == Kind::crashed);
  CHECK(endBy("KILL").kind == Kind::killed);
  CHECK(endBy("TERM").kind == Kind::ended);
  CHECK(endBy("TERM").number == SIGTERM);
  CHECK(endBy("XCPU").kind == Kind::out_of_time);
}

TEST_CASE("arguments and variables arrive as they are", "[base][process]") {
  const Variable inherited("SGM_TEST_INHERITED", "inherited"), replaced("SGM_TEST_REPLACED", "before");
  ProcessSettings settings =
      shell("printf '%s|' \"$@\" \"$SGM_TEST_INHERITED\" \"$SGM_TEST_REPLACED\" \"$SGM_TEST_NEW\"");
  settings.arguments.insert(settings.arguments.end(),
                            {"sh", "", " a  b ", "\"'$x\\", "f\xC3\xBC \xE7\x8C\xAB", "line\nline"});
  settings.environment = {"SGM_TEST_REPLACED=after", "SGM_TEST_NEW=\xC3\xBC=1"};
  const std::string arguments = "| a  b |\"'$x\\|f\xC3\xBC \xE7\x8C\xAB|line\nline|";
  CHECK(outputOf(settings).output == arguments + "inherited|after|\xC3\xBC=1|");
  settings.inherits_environment = false;
  CHECK(outputOf(settings).output == arguments + "|after|\xC3\xBC=1|");
}

TEST_CASE("a name without a slash is looked for in PATH", "[base][process]") {
  const TemporaryFolder folder;
  const std::string first = (folder.path / "first").string(), second = (folder.path / "second").string();
  std::filesystem::create_directories(first);
  std::filesystem::create_directories(second);
  const Variable path("PATH", first + ":" + (folder.path / "none").string() + ":" + second);
  const Result<Process> missing = Process::start(named("sgm_test_program"));
  REQUIRE_FALSE(missing);
  CHECK(missing.error().code == Code::unsupported);
  CHECK(missing.error().message == "sgm_test_program cannot be run: No such file or directory");
  makeScript(folder, "second/sgm_test_program", "echo second");
  CHECK(outputOf(named("sgm_test_program")).output == "second\n");
  // A file that cannot be executed is skipped if a later folder of PATH has the program. Otherwise, the error states
  // why this file cannot be executed.
  makeFile(folder, "first/sgm_test_program", "text");
  CHECK(outputOf(named("sgm_test_program")).output == "second\n");
  std::filesystem::remove(second + "/sgm_test_program");
  const Result<Process> unrunnable = Process::start(named("sgm_test_program"));
  REQUIRE_FALSE(unrunnable);
  CHECK(unrunnable.error().code == Code::io);
  CHECK(unrunnable.error().message == "sgm_test_program cannot be run: Permission denied");
}

TEST_CASE("what is no program cannot be started", "[base][process]") {
  const TemporaryFolder folder;
  const size_t before = openDescriptors();
  for (const std::string& path : {(folder.path / "none").string(), folder.path.string(), makeFile(folder, "f", "x")}) {
    CHECK_FALSE(isProgram(path));
    const Result<ProcessOutput> output = runProcess(named(path));
    REQUIRE_FALSE(output);
    CHECK(output.error().code == Code::io);
    CHECK(output.error().message.find(path) != std::string::npos);
  }
  CHECK(openDescriptors() == before);
  const Result<std::string> own = ownProgram();
  REQUIRE(own);
  CHECK(isProgram(*own));
  CHECK(std::filesystem::equivalent(*own, "/proc/self/exe"));
}

TEST_CASE("a program that is still being written is started once it is whole", "[base][process][threads]") {
  const TemporaryFolder folder;
  const std::string path = makeScript(folder, "program", "echo whole");
  File writing(openFile(path, kWrite));
  REQUIRE(writing);
  std::thread closes([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    writing = File();
  });
  const Result<ProcessOutput> output = runProcess(named(path));
  closes.join();
  REQUIRE(output);
  CHECK(output->output == "whole\n");
}

TEST_CASE("streams lead to files, to each other and to nothing", "[base][process]") {
  const TemporaryFolder folder;
  const File input(openFile(makeFile(folder, "in", "what is in it"), kRead)), output(openScratchFile(folder.path));
  REQUIRE(output);
  ProcessSettings settings = shell("cat; echo complaint >&2");
  settings.input = {Stream::file, input.number()};
  CHECK(outputOf(settings).output == "what is in it");
  settings.input = {Stream::none};
  settings.error = {Stream::output};
  CHECK(outputOf(settings).output == "complaint\n");
  settings.output = {Stream::file, output.number()};
  CHECK(outputOf(settings).output.empty());
  FileStatus status;
  REQUIRE(statusOf(output.number(), status) == 0);
  CHECK(status.bytes == std::string("complaint\n").size());
  settings.output = settings.error = {Stream::none};
  CHECK(outputOf(settings).exit.succeeded());
  // The child received a copy of the descriptor. The original is still open in this process.
  CHECK(fcntl(input.number(), F_GETFD) >= 0);
  settings.input = {Stream::file, 100'000};
  CHECK_FALSE(Process::start(settings));
}

TEST_CASE("a child is written to while it reads", "[base][process]") {
  const TemporaryFolder folder;
  ProcessSettings settings = shell("wc -c >\"" + (folder.path / "size").string() + "\"");
  settings.input = {Stream::pipe};
  settings.output = settings.error = {Stream::none};
  Result<Process> counts = Process::start(settings);
  REQUIRE(counts);
  for (int i = 0; i < 30; ++i) REQUIRE(counts->write(std::string(100'000, 'x')));
  CHECK(counts->isRunning());
  counts->closeInput();
  CHECK_FALSE(counts->write("more"));
  CHECK(counts->wait().succeeded());
  CHECK_FALSE(counts->isRunning());
  CHECK(contentOf(folder.path / "size") == "3000000\n");

  settings.arguments = {"-c", "exit 3"};
  Result<Process> deaf = Process::start(settings);
  REQUIRE(deaf);
  const std::string much(1'000'000, 'x');
  while (deaf->write(much)) {
  }
  CHECK(deaf->wait().number == 3);
}

TEST_CASE("a child ends with its owner", "[base][process]") {
  std::optional<Process> child;
  ProcessSettings settings = shell("exec sleep 1000");
  settings.output = settings.error = {Stream::none};
  {
    Result<Process> started = Process::start(settings);
    REQUIRE(started);
    child.emplace(std::move(*started));
  }
  CHECK(child->isRunning());
  CHECK(child->end().kind == Kind::killed);
  CHECK(child->end().kind == Kind::unknown);
  const Watch watch;
  { const Result<Process> other = Process::start(settings); }
  CHECK(watch.seconds() < 20);
}

TEST_CASE("an isolated child has the signals' defaults, and a group of its own", "[base][process]") {
  const auto handler = std::signal(SIGTERM, SIG_IGN);
  sigset_t blocked, usual;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &usual);
  const ProcessOutput isolated = outputOf(isolatedShell("ps -o pgid= -p $$; echo $$; kill -TERM $$; sleep 20"));
  const ProcessOutput other = outputOf(shell("kill -TERM $$; echo survives"));
  pthread_sigmask(SIG_SETMASK, &usual, nullptr);
  std::signal(SIGTERM, handler);
  CHECK(isolated.exit.kind == Kind::ended);
  CHECK(isolated.exit.number == SIGTERM);
  const size_t line = isolated.output.find('\n');
  CHECK(std::stoi(isolated.output) == std::stoi(isolated.output.substr(line)));
  CHECK(other.output == "survives\n");
}

TEST_CASE("a child has none of the host's files, or those that were opened to be inherited", "[base][process]") {
  const int leaked = open("/dev/null", O_RDONLY);
  REQUIRE(leaked >= 3);
  const File ours(openFile("/dev/null", kRead));
  // Descriptor 3 is the folder that `ls` itself has opened.
  CHECK(outputOf(shell("ls /proc/self/fd")).output == "0\n1\n2\n3\n");
  const auto inherits = [](int file) {
    ProcessSettings settings = shell("[ -e /proc/$$/fd/" + std::to_string(file) + " ]");
    settings.inherits_files = true;
    return outputOf(settings).exit.succeeded();
  };
  CHECK(inherits(leaked));
  CHECK_FALSE(inherits(ours.number()));
  close(leaked);
}

TEST_CASE("limits hold when the program starts, and cannot be raised", "[base][process]") {
  ProcessLimits limits;
  limits.cpu_seconds = 6.5;
  limits.file_bytes = 1 << 20;
  limits.open_files = 50;
  CHECK(said("ulimit -t; ulimit -n; ulimit -c", limits) == "7\n50\n0\n");
  CHECK(said("ulimit -H -t; ulimit -H -n; ulimit -n 60 2>/dev/null || echo refused", limits) == "8\n50\nrefused\n");
  const TemporaryFolder folder;
  CHECK(said("head -c 2000000 /dev/zero >\"" + (folder.path / "large").string() + "\" 2>/dev/null || echo refused",
             limits) == "refused\n");
  limits.memory_bytes = uint64_t{512} << 20;
  const std::string memory = said("ulimit -v", limits);
  CHECK((memory == "524288\n" || memory == "unlimited\n"));  // "unlimited" is printed under a sanitizer
}

TEST_CASE("a limit of processor time ends a child", "[base][process]") {
  ProcessSettings settings = shell("while :; do :; done");
  settings.sandbox = ProcessLimits{0, 0.5, 0, 0};
  CHECK(outputOf(settings).exit.kind == Kind::out_of_time);
  const auto handler = std::signal(SIGXCPU, SIG_IGN);
  CHECK(outputOf(settings).exit.kind == Kind::out_of_time);
  std::signal(SIGXCPU, handler);
}

TEST_CASE("a sandboxed child ends with the process that started it", "[base][process]") {
  const TemporaryFolder folder;
  const std::string told = (folder.path / "id").string();
  const pid_t host = fork();
  REQUIRE(host >= 0);
  if (host == 0) {
    ProcessSettings settings = shell("echo $$ >\"" + told + "\"; exec sleep 1000");
    settings.output = settings.error = {Stream::none};
    settings.sandbox = ProcessLimits();
    const Result<Process> child = Process::start(settings);
    while (contentOf(told).empty()) usleep(1000);
    _exit(child ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(host, &status, 0) == host);
  REQUIRE(WEXITSTATUS(status) == 0);
  CHECK(endsSoon(std::stoi(contentOf(told))));
}
