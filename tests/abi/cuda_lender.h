#pragma once
// A test engine that provides its CUDA context to the library, on a simulated GPU.

#include <dlfcn.h>
#include <sgm/sgm_cuda.h>

#include "cuda/driver_device.h"
#include "cuda/fake_gpu.h"
#include "fixture.h"

/// Returns the state of the simulated GPU in the libcuda.so.1 that this process has loaded.
inline sgm::cuda::FakeState& pretendedGpu() {
  // openDriver() loads the simulated driver, whose GPU is created when it is first requested.
  REQUIRE(sgm::cuda::openDriver());
  void* const library = dlopen("libcuda.so.1", RTLD_NOW | RTLD_NOLOAD);
  REQUIRE(library != nullptr);
  const auto state = reinterpret_cast<sgm::cuda::FakeState* (*)()>(dlsym(library, "sgm_fake_state"));
  REQUIRE(state != nullptr);
  return *state();
}

/// The test engine: owns a CUDA context and optionally a stream, and describes them to the library.
class CudaLender {
 public:
  explicit CudaLender(bool with_stream = false) {
    auto driver = sgm::cuda::openDriver();
    INFO((driver ? std::string() : driver.error().message));
    REQUIRE(driver);
    driver_ = *driver;
    REQUIRE(driver_.ctxCreate(&context_, 0, 0) == sgm::cuda::kCuSuccess);
    if (with_stream) REQUIRE(driver_.streamCreate(&stream_, 0) == sgm::cuda::kCuSuccess);
    sgm::cuda::CuContext popped = nullptr;
    driver_.ctxPopCurrent(&popped);
  }
  ~CudaLender() {
    driver_.ctxPushCurrent(context_);
    if (stream_ != nullptr) driver_.streamDestroy(stream_);
    sgm::cuda::CuContext popped = nullptr;
    driver_.ctxPopCurrent(&popped);
    driver_.ctxDestroy(context_);
  }
  CudaLender(const CudaLender&) = delete;
  CudaLender& operator=(const CudaLender&) = delete;

  sgm_cuda_device_desc lend() const {
    sgm_cuda_device_desc desc = SGM_CUDA_DEVICE_DESC_INIT;
    desc.context = reinterpret_cast<CUctx_st*>(context_);
    desc.stream = reinterpret_cast<CUstream_st*>(stream_);
    return desc;
  }
  RuntimeOwner runtime() const {
    RuntimeOwner runtime = makeRuntime();
    const sgm_cuda_device_desc desc = lend();
    sgm_error error = SGM_ERROR_INIT;
    const sgm_result result = sgm_runtime_lend_cuda(runtime.get(), &desc, &error);
    INFO(error.message);
    REQUIRE(result == SGM_OK);
    return runtime;
  }

 private:
  sgm::cuda::DriverTable driver_;
  sgm::cuda::CuContext context_ = nullptr;
  sgm::cuda::CuStream stream_ = nullptr;
};

inline sgm_backend_info infoOf(const RuntimeOwner& runtime, sgm_backend backend) {
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  REQUIRE(sgm_backend_query(runtime.get(), backend, &info, nullptr) == SGM_OK);
  return info;
}
