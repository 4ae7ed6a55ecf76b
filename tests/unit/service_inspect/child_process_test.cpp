#include "tools/service/judge/child_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <thread>

#include "scripts.h"

using namespace sgm;
using namespace sgm::service;

namespace {

ChildSettings shell(const std::string& command) {
  ChildSettings settings;
  settings.program = "/bin/sh";
  settings.arguments = {"-c", command};
  settings.environment = {"PATH=/usr/local/bin:/usr/bin:/bin"};
  settings.time = std::chrono::seconds(60);
  return settings;
}

ChildOutcome outcomeOf(const ChildSettings& settings) {
  Result<ChildOutcome> outcome = runChild(settings);
  REQUIRE(outcome);
  return std::move(*outcome);
}

size_t openDescriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<size_t>(std::distance(begin(all), end(all)));
}

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool endsSoon(int process) {
  const Clock clock;
  while (runs(process) && clock.seconds() < 10) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !runs(process);
}

}  // namespace

TEST_CASE("a child's streams and status are read", "[threads]") {
  const size_t before = openDescriptors();
  ChildSettings settings = shell("cat; echo complaint >&2; exit 7");
  const std::string text(1'000'000, 'x');
  settings.text = text;
  const ChildOutcome outcome = outcomeOf(settings);
  CHECK(outcome.end == ChildEnd::exited);
  CHECK(outcome.status == 7);
  CHECK(outcome.output == text);
  CHECK(outcome.complaint == "complaint\n");
  CHECK(openDescriptors() == before);
}

TEST_CASE("a child reads the file that it is given") {
  const TemporaryFolder folder;
  const int file = open(makeFile(folder, "f", "what is in it").c_str(), O_RDONLY | O_CLOEXEC);
  ChildSettings settings = shell("cat");
  settings.input = file;
  CHECK(outcomeOf(settings).output == "what is in it");
  CHECK(fcntl(file, F_GETFD) >= 0);
  close(file);
}

TEST_CASE("a child that does not read is no failure") {
  ChildSettings settings = shell("exec <&-; echo deaf");
  const std::string text(3'000'000, 'x');
  settings.text = text;
  const ChildOutcome outcome = outcomeOf(settings);
  CHECK(outcome.status == 0);
  CHECK(outcome.output == "deaf\n");
}

TEST_CASE("a child has the signals' defaults, and the host's environment is its own") {
  setenv("SGM_TEST_SECRET", "secret", 1);
  const auto handler = std::signal(SIGTERM, SIG_IGN);
  sigset_t blocked, usual;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &usual);
  const ChildOutcome outcome = outcomeOf(shell("echo \"[$SGM_TEST_SECRET]\"; kill -TERM $$; sleep 20"));
  pthread_sigmask(SIG_SETMASK, &usual, nullptr);
  std::signal(SIGTERM, handler);
  unsetenv("SGM_TEST_SECRET");
  CHECK(outcome.end == ChildEnd::signalled);
  CHECK(outcome.signal == SIGTERM);
  CHECK(outcome.output == "[]\n");
}

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
TEST_CASE("a child has none of the host's descriptors") {
  const int leaked = open("/dev/null", O_RDONLY);
  REQUIRE(leaked >= 3);
  // Of the list's own folder there is one more.
  const std::string listed = outcomeOf(shell("ls /proc/self/fd")).output;
  close(leaked);
  CHECK(listed == "0\n1\n2\n3\n");
}
#endif

TEST_CASE("a host may have closed its standard streams") {
  const pid_t host = fork();
  REQUIRE(host >= 0);
  if (host == 0) {
    for (int stream = 0; stream < 3; ++stream) close(stream);
    ChildSettings settings = shell("cat; echo complaint >&2");
    settings.text = "text";
    const Result<ChildOutcome> outcome = runChild(settings);
    _exit(outcome && outcome->output == "text" && outcome->complaint == "complaint\n" ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(host, &status, 0) == host);
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

TEST_CASE("a child that takes too long is ended, with what it started", "[threads]") {
  ChildSettings settings = shell("trap '' TERM INT HUP; sleep 1000 & echo $!; while :; do sleep 1000; done");
  settings.time = std::chrono::milliseconds(300);
  const Clock clock;
  const ChildOutcome outcome = outcomeOf(settings);
  CHECK(outcome.end == ChildEnd::late);
  CHECK(clock.seconds() >= 0.3);
  CHECK(clock.seconds() < 20);
  CHECK(endsSoon(std::stoi(outcome.output)));
}

TEST_CASE("a child that closes its streams is waited for, and not longer than others") {
  ChildSettings settings = shell("exec >&- 2>&-; sleep 1000");
  settings.time = std::chrono::milliseconds(300);
  CHECK(outcomeOf(settings).end == ChildEnd::late);
  CHECK(outcomeOf(shell("echo said; exec >&- 2>&-; sleep 0.2; exit 3")).status == 3);
}

TEST_CASE("a child that says too much is ended", "[threads]") {
  ChildSettings settings = shell("yes");
  settings.most_output = 100'000;
  const ChildOutcome endless = outcomeOf(settings);
  CHECK(endless.end == ChildEnd::talkative);
  CHECK(endless.output.size() <= 100'001);
  for (const size_t most : {size_t{4}, size_t{5}, size_t{6}}) {
    settings = shell("printf 12345");
    settings.most_output = most;
    CHECK((outcomeOf(settings).end == ChildEnd::exited) == (most >= 5));
  }
  // Complaints are no answer: the beginning is kept.
  const ChildOutcome loud = outcomeOf(shell("yes | head -c 1000000 >&2; echo done"));
  CHECK(loud.end == ChildEnd::exited);
  CHECK(loud.output == "done\n");
  CHECK(loud.complaint.size() == 4096);
}

TEST_CASE("a grandchild that holds the streams is not waited for", "[threads]") {
  const Clock clock;
  const ChildOutcome outcome = outcomeOf(shell("sleep 1000 & echo $!"));
  CHECK(clock.seconds() < 20);
  CHECK(outcome.end == ChildEnd::exited);
  CHECK(outcome.status == 0);
  CHECK(endsSoon(std::stoi(outcome.output)));
  // Nor one that is in a session of its own, and goes on talking; only that one is nobody's to end.
  const ChildOutcome escaped =
      outcomeOf(shell("told=$(mktemp -u); mkfifo $told; setsid sh -c 'echo $$; : >$0; exec yes >&2' $told & "
                      "read -r end <$told; rm $told; sleep 0.3; echo done"));
  CHECK(escaped.end == ChildEnd::exited);
  CHECK(escaped.output.ends_with("done\n"));
  const int process = std::stoi(escaped.output);
  CHECK(endsSoon(process));  // by its own broken pipe
}

TEST_CASE("a host that ignores its children's ends still has their output", "[threads]") {
  const auto handler = std::signal(SIGCHLD, SIG_IGN);
  const ChildOutcome good = outcomeOf(shell("echo done; exit 5"));
  ChildSettings settings = shell("sleep 1000");
  settings.time = std::chrono::milliseconds(200);
  const ChildOutcome late = outcomeOf(settings);
  const ChildOutcome holding = outcomeOf(shell("sleep 1000 & echo $!"));
  std::signal(SIGCHLD, handler);
  CHECK(good.end == ChildEnd::exited);
  CHECK_FALSE(good.status);
  CHECK(good.output == "done\n");
  CHECK(late.end == ChildEnd::late);
  CHECK(holding.end == ChildEnd::exited);
  CHECK(endsSoon(std::stoi(holding.output)));
}

TEST_CASE("a host's own children are left to it") {
  const pid_t own = fork();
  REQUIRE(own >= 0);
  if (own == 0) _exit(9);
  for (int i = 0; i < 5; ++i) CHECK(outcomeOf(shell("exit 1")).status == 1);
  int status = 0;
  REQUIRE(waitpid(own, &status, 0) == own);
  CHECK(WEXITSTATUS(status) == 9);
  CHECK(waitpid(-1, &status, WNOHANG) == -1);  // and none of ours is left
  CHECK(errno == ECHILD);
}

TEST_CASE("a child is ended when that is asked for", "[threads]") {
  Result<Pipe> pipe = Pipe::create();
  REQUIRE(pipe);
  ChildSettings settings = shell("echo $$; exec sleep 1000");
  settings.cancel = pipe->from.number();
  std::thread asks([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    pipe->to.reset();
  });
  const Clock clock;
  const ChildOutcome outcome = outcomeOf(settings);
  asks.join();
  CHECK(outcome.end == ChildEnd::cancelled);
  CHECK(clock.seconds() < 20);
  CHECK_FALSE(runs(std::stoi(outcome.output)));
}

TEST_CASE("what is no program cannot be started") {
  const TemporaryFolder folder;
  const size_t before = openDescriptors();
  for (const std::string& path : {(folder.path / "none").string(), folder.path.string(), makeFile(folder, "f", "x")}) {
    ChildSettings settings;
    settings.program = path;
    const Result<ChildOutcome> outcome = runChild(settings);
    REQUIRE_FALSE(outcome);
    CHECK(outcome.error().code == Code::io);
    CHECK(outcome.error().message.find(path) != std::string::npos);
  }
  CHECK(openDescriptors() == before);
}
