#include "tools/service/judge/inspector.h"

#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

#include "base/plain_text.h"
#include "base/platform/process.h"
#include "base/thread_name.h"
#include "tools/service/judge/inspector_answer.h"

namespace sgm::service {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kMaxMastersJobs = 64;

/// Environment variables of the inspecting processes: only those that they need to find programs and libraries.
std::vector<std::string> environmentOfChildren() {
  std::vector<std::string> kept{"LC_ALL=C"};
  for (const char* name : {"PATH", "LD_LIBRARY_PATH"})
    if (const char* value = std::getenv(name)) kept.push_back(std::string(name) + "=" + value);
  return kept;
}

/// Calls a callback of the inspector's user and ignores its exceptions, which would end the host program.
template <class... Arguments>
void call(const std::function<void(Arguments...)>& function, std::type_identity_t<Arguments>... arguments) {
  try {
    if (function) function(std::move(arguments)...);
  } catch (...) {
    // A failing callback cannot be reported to its caller.
  }
}

/// The result of say(), or `otherwise` if say() throws.
template <class Say>
Inspection saidOr(Inspection& otherwise, const Say& say) noexcept {
  try {
    return say();
  } catch (...) {
    return std::move(otherwise);
  }
}

class ProcessInspector final : public Inspector {
 public:
  ProcessInspector(const InspectorSettings& settings, platform::Cancellation stop)
      : settings_(settings), environment_(environmentOfChildren()), stop_(std::move(stop)) {}
  ~ProcessInspector() override;
  /// Error: io.
  Result<void> start();

  Result<void> wouldTake() const override;
  Result<void> inspect(Upload upload, std::function<void()> began, std::function<void(Inspection)> done) override;
  void readMasters(std::function<void(Inspection)> done) override {
    queueMasters({{}, false, std::move(done), outOfMemoryProblem()});
  }
  void writeMasters(std::string json, std::function<void(Inspection)> done) override {
    queueMasters({std::move(json), true, std::move(done), outOfMemoryProblem()});
  }
  InspectorCounts counts() const override;

 private:
  struct Job {
    Upload upload;
    std::function<void()> began;
    std::function<void(Inspection)> done;
    Inspection out_of_memory;  ///< answer for the case that memory runs out; made in advance
    bool stopped = false;      ///< true if the inspector is ending: the upload then gets a 503 instead of an inspection
  };
  struct MastersJob {
    std::string json;
    bool writes = false;
    std::function<void(Inspection)> done;
    Inspection out_of_memory;
    bool stopped = false;
  };

  Result<void> wouldTakeLocked(bool program_runs) const;
  void queueMasters(MastersJob job);
  template <class AnyJob>
  std::optional<AnyJob> take(std::deque<AnyJob>& waiting);
  void work();
  void workOnMasters();
  void run(Job& job);
  Inspection judge(const Upload& upload) const;
  Inspection judgeMasters(const MastersJob& job) const;
  /// Runs a process with these arguments, and returns its answer. input: the process's standard input. text: if `input`
  /// is a pipe, the text that is written to it.
  Inspection answerTo(std::vector<std::string> arguments, platform::Stream input, std::string_view text,
                      Answer wanted) const;
  void count(const Inspection& said, double seconds);

  const InspectorSettings settings_;
  const std::vector<std::string> environment_;
  /// The destructor requests this cancellation to wake the threads that wait for a process.
  platform::Cancellation stop_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::deque<Job> waiting_;
  std::deque<MastersJob> masters_waiting_;
  InspectorCounts counts_;
  std::vector<std::thread> threads_;
};

ProcessInspector::~ProcessInspector() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  stop_.request();
  for (std::thread& thread : threads_) thread.join();
}

Result<void> ProcessInspector::start() {
  try {
    threads_.reserve(settings_.jobs + 1);
    for (unsigned i = 0; i < settings_.jobs; ++i)
      threads_.emplace_back([this] {
        nameThread("sgm inspector");
        work();
      });
    threads_.emplace_back([this] { workOnMasters(); });
  } catch (const std::system_error& e) {
    return Error{Code::io, std::string("cannot start a thread: ") + e.what()};
  }
  return {};
}

Result<void> ProcessInspector::wouldTakeLocked(bool program_runs) const {
  if (settings_.program.empty())
    return Error{Code::unsupported, "this service cannot validate: it is configured without an inspector program"};
  if (!program_runs)
    return Error{Code::unsupported,
                 "this service cannot validate: " + settings_.program + " is not an executable program"};
  if (counts_.running + waiting_.size() >= settings_.jobs + settings_.waiting)
    return Error{Code::limit, std::to_string(waiting_.size()) + " uploads are already waiting: try again later"};
  return {};
}

Result<void> ProcessInspector::wouldTake() const {
  // Called without the lock, since access to a file system may block.
  const bool program_runs = platform::isProgram(settings_.program);
  const std::lock_guard lock(mutex_);
  return wouldTakeLocked(program_runs);
}

Result<void> ProcessInspector::inspect(Upload upload, std::function<void()> began,
                                       std::function<void(Inspection)> done) {
  const bool program_runs = platform::isProgram(settings_.program);
  Job job{std::move(upload), std::move(began), std::move(done), outOfMemoryProblem()};
  try {
    const std::lock_guard lock(mutex_);
    if (const Result<void> takes = wouldTakeLocked(program_runs); !takes) return takes;
    waiting_.push_back(std::move(job));
  } catch (const std::bad_alloc&) {
    // This text is short enough for std::string's internal buffer, so it needs no allocation.
    return Error{Code::limit, "out of memory"};
  }
  changed_.notify_all();
  return {};
}

void ProcessInspector::queueMasters(MastersJob job) {
  const bool program = !settings_.program.empty();
  try {
    const std::lock_guard lock(mutex_);
    if (program && masters_waiting_.size() < kMaxMastersJobs) {
      masters_waiting_.push_back(std::move(job));
      changed_.notify_all();
      return;
    }
  } catch (const std::bad_alloc&) {
    return call(job.done, std::move(job.out_of_memory));
  }
  call(job.done, saidOr(job.out_of_memory, [program] {
         return program ? problemOf(503, "queue_full",
                                    "too many requests are waiting for the reference histograms: try again later")
                        : problemOf(503, "no_validator",
                                    "this service is configured without a program that reads reference histograms");
       }));
}

InspectorCounts ProcessInspector::counts() const {
  const std::lock_guard lock(mutex_);
  InspectorCounts counts = counts_;
  counts.waiting = static_cast<unsigned>(waiting_.size());
  return counts;
}

/// Waits for the next job and removes it from the queue. Returns nullopt if the inspector is ending and the queue is
/// empty. The caller must destroy the job without holding the lock: the job may hold the last descriptor of a large
/// file, whose deletion takes time.
template <class AnyJob>
std::optional<AnyJob> ProcessInspector::take(std::deque<AnyJob>& waiting) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return stopping_ || !waiting.empty(); });
  if (waiting.empty()) return std::nullopt;
  std::optional<AnyJob> job(std::move(waiting.front()));
  waiting.pop_front();
  job->stopped = stopping_;
  if constexpr (std::is_same_v<AnyJob, Job>) counts_.running += stopping_ ? 0u : 1u;
  return job;
}

void ProcessInspector::work() {
  while (std::optional<Job> job = take(waiting_)) {
    if (job->stopped) {
      call(job->done, saidOr(job->out_of_memory, stoppedProblem));
    } else {
      run(*job);
    }
  }
}

void ProcessInspector::run(Job& job) {
  call(job.began);
  const Clock::time_point start = Clock::now();
  Inspection said = saidOr(job.out_of_memory, [&] { return judge(job.upload); });
  count(said, std::chrono::duration<double>(Clock::now() - start).count());
  call(job.done, std::move(said));
}

void ProcessInspector::workOnMasters() {
  while (std::optional<MastersJob> job = take(masters_waiting_))
    call(job->done, saidOr(job->out_of_memory, [&] { return job->stopped ? stoppedProblem() : judgeMasters(*job); }));
}

/// Adds a finished inspection to the counts. Called before `done`: when a client has the answer, the counts already
/// include it.
void ProcessInspector::count(const Inspection& said, double seconds) {
  const std::lock_guard lock(mutex_);
  --counts_.running;
  if (said.status == 503) return;
  const auto kind = said.status == 200   ? said.valid ? &InspectorCounts::valid : &InspectorCounts::invalid
                    : said.status == 422 ? &InspectorCounts::refused
                                         : &InspectorCounts::failed;
  ++(counts_.*kind);
  counts_.seconds_sum += seconds;
  for (size_t i = 0; i < counts_.seconds.size(); ++i)
    if (seconds <= std::ldexp(1.0, static_cast<int>(i) - 8)) ++counts_.seconds[i];
}

Inspection ProcessInspector::judge(const Upload& upload) const {
  std::vector<std::string> arguments{"inspect", "--kind=" + std::string(nameOf(upload.kind))};
  // Name and value are joined with '=', so that a value that begins with '-' is not taken for an option. Empty values
  // are omitted: after `--name=`, the command line would take the next argument as the value.
  if (!upload.name.empty()) arguments.push_back("--name=" + upload.name);
  for (const auto& [name, value] : upload.options)
    if (!value.empty()) arguments.push_back("--" + name + "=" + value);
  const platform::File file(platform::openAgain(upload.file()));
  if (!file) return problemOf(500, "validator_crashed", "the upload cannot be read: " + systemMessage(errno));
  return answerTo(std::move(arguments), {platform::Stream::file, file.number()}, {}, Answer::report);
}

Inspection ProcessInspector::judgeMasters(const MastersJob& job) const {
  if (job.writes && settings_.masters.empty())
    return problemOf(409, "read_only",
                     "the built-in reference histograms cannot be replaced: name a database with --masters FILE");
  return answerTo({"inspect", job.writes ? "--store-masters" : "--list-masters"}, {platform::Stream::pipe}, job.json,
                  Answer::masters);
}

Inspection ProcessInspector::answerTo(std::vector<std::string> arguments, platform::Stream input, std::string_view text,
                                      Answer wanted) const {
  platform::ProcessSettings settings;
  settings.program = settings_.program;
  settings.arguments = std::move(arguments);
  settings.arguments.push_back("--memory=" + std::to_string(settings_.memory >> 20));
  settings.arguments.push_back("--seconds=" + std::to_string(settings_.time.count()));
  if (!settings_.masters.empty()) settings.arguments.push_back("--masters=" + settings_.masters);
  settings.environment = environment_;
  settings.inherits_environment = false;
  settings.input = input;
  settings.output = settings.error = {platform::Stream::pipe};
  settings.isolated = true;
  platform::RunSettings run;
  run.input = text;
  run.time = settings_.time;
  run.max_output = kMaxAnswer;
  run.cancellation = &stop_;
  const Result<platform::ProcessOutput> said = platform::runProcess(settings, run);
  if (!said) return problemOf(500, "validator_crashed", said.error().message);
  return inspectionOf(*said, settings_.time, wanted);
}

}  // namespace

Result<std::unique_ptr<Inspector>> Inspector::create(const InspectorSettings& settings) {
  const bool fits = settings.jobs >= 1 && settings.jobs <= 64 && settings.waiting <= 4096 &&
                    settings.memory >= uint64_t{64} << 20 && settings.time.count() >= 1 &&
                    settings.time.count() <= 86400;
  if (!fits)
    return Error{Code::invalid_argument,
                 "an inspector must have 1 to 64 jobs and at most 4096 waiting uploads, and its processes at least 64 "
                 "MB of memory and 1 to 86400 s"};
  Result<platform::Cancellation> stop = platform::Cancellation::create();
  if (!stop) return stop.error();
  auto made = std::make_unique<ProcessInspector>(settings, std::move(*stop));
  if (const Result<void> started = made->start(); !started) return started.error();
  return std::unique_ptr<Inspector>(std::move(made));
}

}  // namespace sgm::service
