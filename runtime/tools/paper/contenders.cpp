#include "tools/paper/contenders.h"

#include <fmt/core.h>

#include <algorithm>

#include "tools/support/region.h"

namespace sgm::cli {
namespace {

/// named: the user has requested this backend. A software device that is not named is not measured, as `auto` does not
/// choose it either.
Result<Contender> makeContender(const std::string& name, const std::string& backend, bool named, unsigned threads) {
  Contender contender;
  contender.name = name;
  Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(threads);
  if (!jobs) return jobs.error();
  WorldOptions options;
  options.backend = backend;
  Result<std::unique_ptr<Backend>> made = backendOf(options, **jobs);
  if (!made) {
    if (made.error().code != Code::unsupported) return made.error();
    contender.reason = made.error().message;
    return contender;
  }
  const BackendCapabilities& capabilities = (*made)->capabilities();
  if (capabilities.software && !named) {
    contender.reason = fmt::format("{} is software, which is measured only on request: use --backend {}",
                                   capabilities.device, backend);
    return contender;
  }
  contender.device = capabilities.device;
  if (capabilities.kind == BackendKind::cpu) contender.workers = capabilities.concurrency;
  contender.jobs = std::move(*jobs);
  contender.backend = std::move(*made);
  return contender;
}

}  // namespace

Result<std::vector<Contender>> makeContenders(const std::vector<std::string>& backends, unsigned threads) {
  std::vector<Contender> contenders;
  Result<Contender> sequential = makeContender("sequential", "cpu", true, 1);
  if (!sequential) return sequential.error();
  contenders.push_back(std::move(*sequential));
  for (const char* backend : {"cpu", "vulkan", "cuda"}) {
    const bool named = std::find(backends.begin(), backends.end(), backend) != backends.end();
    if (!named && !backends.empty()) continue;
    Result<Contender> made = makeContender(backend, backend, named, threads);
    if (!made) return made.error();
    contenders.push_back(std::move(*made));
  }
  return contenders;
}

}  // namespace sgm::cli
