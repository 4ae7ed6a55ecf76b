// Tests child processes from start to end: their streams, their limits, and what they leave behind.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "process_support.h"

using namespace sgm;
using namespace sgm::platform;
using Kind = ProcessExit::Kind;
using Stop = ProcessOutput::Stop;

namespace {

/// Settings that pass the text to the child's standard input through a pipe.
RunSettings told(const std::string& text) {
  RunSettings run = within(std::chrono::minutes(1));
  run.input = text;
  return run;
}

ProcessSettings reader(const std::string& command) {
  ProcessSettings settings = isolatedShell(command);
  settings.input = {Stream::pipe};
  return settings;
}

}  // namespace

TEST_CASE("a child's streams and status are read", "[base][process][threads]") {
  const size_t before = openDescriptors();
  const std::string text(1'000'000, 'x');
  const ProcessOutput said = outputOf(reader("cat; echo complaint >&2; exit 7"), told(text));
  CHECK(said.stop == Stop::none);
  CHECK(said.exit.kind == Kind::exited);
  CHECK(said.exit.number == 7);
  CHECK_FALSE(said.exit.succeeded());
  CHECK(said.output == text);
  CHECK(said.error == "complaint\n");
  CHECK(openDescriptors() == before);
}

TEST_CASE("a child that does not read is no failure", "[base][process]") {
  const std::string text(3'000'000, 'x');
  const ProcessOutput said = outputOf(reader("exec <&-; echo deaf"), told(text));
  CHECK(said.exit.succeeded());
  CHECK(said.output == "deaf\n");
}

TEST_CASE("a host may have closed its standard streams", "[base][process]") {
  const pid_t host = fork();
  REQUIRE(host >= 0);
  if (host == 0) {
    for (int stream = 0; stream < 3; ++stream) close(stream);
    const Result<ProcessOutput> said = runProcess(reader("cat; echo complaint >&2"), told("text"));
    _exit(said && said->output == "text" && said->error == "complaint\n" ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(host, &status, 0) == host);
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

TEST_CASE("a child that takes too long is ended, with what it started", "[base][process][threads]") {
  const Watch watch;
  const ProcessOutput said =
      outputOf(isolatedShell("trap '' TERM INT HUP; sleep 1000 & echo $!; while :; do sleep 1000; done"),
               within(std::chrono::milliseconds(300)));
  CHECK(said.stop == Stop::time_limit);
  CHECK(said.exit.kind == Kind::killed);
  CHECK(watch.seconds() >= 0.3);
  CHECK(watch.seconds() < 20);
  CHECK(endsSoon(std::stoi(said.output)));
}

TEST_CASE("a child that closes its streams is waited for, and not longer than others", "[base][process]") {
  const ProcessOutput late =
      outputOf(isolatedShell("exec >&- 2>&-; sleep 1000"), within(std::chrono::milliseconds(300)));
  CHECK(late.stop == Stop::time_limit);
  CHECK(outputOf(isolatedShell("echo said; exec >&- 2>&-; sleep 0.2; exit 3")).exit.number == 3);
}

TEST_CASE("a child that says too much is ended", "[base][process][threads]") {
  RunSettings run = within(std::chrono::minutes(1));
  run.max_output = 100'000;
  const ProcessOutput endless = outputOf(isolatedShell("yes"), run);
  CHECK(endless.stop == Stop::output_limit);
  CHECK(endless.output.size() <= 100'001);
  for (const size_t most : {size_t{4}, size_t{5}, size_t{6}}) {
    run.max_output = most;
    CHECK((outputOf(isolatedShell("printf 12345"), run).stop == Stop::none) == (most >= 5));
  }
  // The child may write any amount to standard error; only the first 4,096 bytes are kept.
  const ProcessOutput loud = outputOf(isolatedShell("yes | head -c 1000000 >&2; echo done"));
  CHECK(loud.stop == Stop::none);
  CHECK(loud.output == "done\n");
  CHECK(loud.error.size() == 4096);
}

TEST_CASE("output of any size arrives whole", "[base][process]") {
  for (const unsigned size : {0u, 1u, 65'535u, 65'536u, 65'537u, 5'000'000u})
    CHECK(outputOf(shell("yes | head -c " + std::to_string(size))).output.size() == size);
}

TEST_CASE("a grandchild that holds the streams is not waited for", "[base][process][threads]") {
  const Watch watch;
  const ProcessOutput said = outputOf(isolatedShell("sleep 1000 & echo $!"));
  CHECK(watch.seconds() < 20);
  CHECK(said.exit.succeeded());
  CHECK(endsSoon(std::stoi(said.output)));
  // A grandchild that has a session of its own and continues to write is neither waited for nor killed.
  const ProcessOutput escaped =
      outputOf(isolatedShell("told=$(mktemp -u); mkfifo $told; setsid sh -c 'echo $$; : >$0; exec yes >&2' $told & "
                             "read -r end <$told; rm $told; sleep 0.3; echo done"));
  CHECK(escaped.exit.succeeded());
  CHECK(escaped.output.ends_with("done\n"));
  CHECK(endsSoon(std::stoi(escaped.output)));  // the grandchild ends by SIGPIPE, because its pipe is closed
}

TEST_CASE("a host that ignores its children's ends still has their output", "[base][process][threads]") {
  const auto handler = std::signal(SIGCHLD, SIG_IGN);
  const ProcessOutput good = outputOf(isolatedShell("echo done; exit 5"));
  const ProcessOutput late = outputOf(isolatedShell("sleep 1000"), within(std::chrono::milliseconds(200)));
  const ProcessOutput holding = outputOf(isolatedShell("sleep 1000 & echo $!"));
  ProcessSettings missing = isolatedShell("");
  missing.program = "/none";
  CHECK_FALSE(runProcess(missing));
  std::signal(SIGCHLD, handler);
  CHECK(good.stop == Stop::none);
  CHECK(good.exit.kind == Kind::unknown);
  CHECK(good.output == "done\n");
  CHECK(late.stop == Stop::time_limit);
  CHECK(holding.stop == Stop::none);
  CHECK(endsSoon(std::stoi(holding.output)));
}

TEST_CASE("a host's own children are left to it, and none of ours is left", "[base][process]") {
  const pid_t own = fork();
  REQUIRE(own >= 0);
  if (own == 0) _exit(9);
  for (int i = 0; i < 5; ++i) CHECK(outputOf(shell("exit 1")).exit.number == 1);
  ProcessSettings missing = shell("");
  missing.program = "/none";
  CHECK_FALSE(Process::start(missing));
  int status = 0;
  REQUIRE(waitpid(own, &status, 0) == own);
  CHECK(WEXITSTATUS(status) == 9);
  CHECK(waitpid(-1, &status, WNOHANG) == -1);
  CHECK(errno == ECHILD);
}

TEST_CASE("a child is ended on request", "[base][process][threads]") {
  Result<Cancellation> cancellation = Cancellation::create();
  REQUIRE(cancellation);
  RunSettings run = within(std::chrono::minutes(1));
  run.cancellation = &*cancellation;
  CHECK(outputOf(isolatedShell("echo done"), run).stop == Stop::none);
  std::thread asks([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    cancellation->request();
  });
  const Watch watch;
  const ProcessOutput said = outputOf(isolatedShell("echo $$; exec sleep 1000"), run);
  asks.join();
  CHECK(said.stop == Stop::cancelled);
  CHECK(watch.seconds() < 20);
  CHECK_FALSE(runs(std::stoi(said.output)));
  // A cancelled RunSettings stays cancelled, so a second run ends as well.
  CHECK(outputOf(isolatedShell("sleep 1000"), run).stop == Stop::cancelled);
}

TEST_CASE("threads start children at the same time, and each has its own output", "[base][process][threads]") {
  std::vector<std::thread> threads;
  std::vector<std::string> outputs(8);
  for (size_t t = 0; t < outputs.size(); ++t)
    threads.emplace_back([&outputs, t] {
      for (int i = 0; i < 10; ++i) {
        const std::string text = std::to_string(t) + " " + std::to_string(i) + "\n";
        const Result<ProcessOutput> said = runProcess(reader("cat"), told(text));
        if (said && said->exit.succeeded() && said->output == text) outputs[t] += "+";
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(outputs == std::vector<std::string>(8, "++++++++++"));
}
