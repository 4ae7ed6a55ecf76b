#pragma once
// The CUDA backend with its kernels running on the CPU, and the CPU backend with which it is compared.

#include <memory>
#include <vector>

#include "backend/backend.h"
#include "backend/cpu/cpu_backend.h"
#include "catch.h"
#include "cuda/cuda_backend.h"
#include "host_device.h"
#include "mesh_jobs.h"

namespace sgm {

struct CudaMachine {
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  std::unique_ptr<Backend> scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::unique_ptr<Backend> cuda;

  explicit CudaMachine(cuda::HostDeviceOptions host = shuffled(), const cuda::Room& room = {}) {
    CudaBackendOptions options;
    options.room = room;
    options.open = [host] { return Result<std::unique_ptr<cuda::Device>>(cuda::makeHostDevice(host)); };
    Result<std::unique_ptr<Backend>> cpu = makeCpuBackend("", *jobs, std::pmr::get_default_resource(), {});
    REQUIRE(cpu);
    Result<std::unique_ptr<Backend>> made =
        makeCudaBackend(options, std::move(*cpu), std::pmr::get_default_resource(), {});
    REQUIRE(made);
    cuda = std::move(*made);
  }
  CudaMachine(const CudaMachine&) = delete;
  CudaMachine& operator=(const CudaMachine&) = delete;
  explicit operator bool() const { return true; }

  static constexpr bool kAnyPrism = true;
  Backend& device() const { return *cuda; }
  /// Always true: CUDA has no validation layer whose messages could be checked.
  bool silent() const { return true; }

  static cuda::HostDeviceOptions shuffled() {
    cuda::HostDeviceOptions options;
    options.shuffled = 20'260'101;
    return options;
  }
};

using TestedMachine = CudaMachine;

}  // namespace sgm
