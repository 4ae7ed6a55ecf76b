#include "tools/paper/backend_runs.h"

#include <fmt/core.h>

#include <algorithm>

#include "tools/support/region.h"

namespace sgm::cli {
namespace {

/// Opens one backend for measuring. named: the user has requested this backend. A software device is measured only if
/// it is named, since `auto` does not choose it either.
Result<BackendRun> makeBackendRun(const std::string& name, const std::string& backend, bool named, unsigned threads) {
  BackendRun backend_run;
  backend_run.name = name;
  Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(threads);
  if (!jobs) return jobs.error();
  WorldOptions options;
  options.backend = backend;
  Result<std::unique_ptr<Backend>> made = backendOf(options, **jobs);
  if (!made) {
    if (made.error().code != Code::unsupported) return made.error();
    backend_run.reason = made.error().message;
    return backend_run;
  }
  const BackendCapabilities& capabilities = (*made)->capabilities();
  if (capabilities.software && !named) {
    backend_run.reason = fmt::format("{} is software, which is measured only on request: use --backend {}",
                                     capabilities.device, backend);
    return backend_run;
  }
  backend_run.device = capabilities.device;
  if (capabilities.kind == BackendKind::cpu) backend_run.workers = capabilities.concurrency;
  backend_run.jobs = std::move(*jobs);
  backend_run.backend = std::move(*made);
  return backend_run;
}

}  // namespace

Result<std::vector<BackendRun>> makeBackendRuns(const std::vector<std::string>& backends, unsigned threads) {
  std::vector<BackendRun> backend_runs;
  Result<BackendRun> sequential = makeBackendRun("sequential", "cpu", true, 1);
  if (!sequential) return sequential.error();
  backend_runs.push_back(std::move(*sequential));
  for (const char* backend : {"cpu", "vulkan", "cuda"}) {
    const bool named = std::find(backends.begin(), backends.end(), backend) != backends.end();
    if (!named && !backends.empty()) continue;
    Result<BackendRun> made = makeBackendRun(backend, backend, named, threads);
    if (!made) return made.error();
    backend_runs.push_back(std::move(*made));
  }
  return backend_runs;
}

}  // namespace sgm::cli
