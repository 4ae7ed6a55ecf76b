#pragma once
// The CUDA backend on a GPU of this machine, and the CPU backend with which it is compared.

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "backend/backend.h"
#include "backend/cpu/cpu_backend.h"
#include "backend/open/open_backend.h"
#include "catch.h"
#include "mesh_jobs.h"

namespace sgm {

/// Opens the CUDA backend. If there is no GPU, the whole program is skipped with exit status 77, unless
/// SGM_REQUIRE_CUDA is set.
struct CudaDeviceMachine {
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  std::unique_ptr<Backend> scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::unique_ptr<Backend> cuda;

  CudaDeviceMachine() {
    BackendRequest request;
    request.kind = BackendKind::cuda;
    Result<std::unique_ptr<Backend>> made = makeBackend(request, *jobs, std::pmr::get_default_resource());
    if (made) {
      cuda = std::move(*made);
      return;
    }
    INFO(made.error().message);
    REQUIRE(std::getenv("SGM_REQUIRE_CUDA") == nullptr);
    std::fprintf(stderr, "SKIPPED: nothing was run on a GPU: %s\n", made.error().message.c_str());
    std::exit(77);
  }
  CudaDeviceMachine(const CudaDeviceMachine&) = delete;
  CudaDeviceMachine& operator=(const CudaDeviceMachine&) = delete;
  explicit operator bool() const { return true; }

  static constexpr bool kAnyPrism = true;
  Backend& device() const { return *cuda; }
  /// Always true: CUDA has no validation layer, and an error that the driver detects makes the batch fail.
  bool silent() const { return true; }
};

using TestedMachine = CudaDeviceMachine;

}  // namespace sgm
