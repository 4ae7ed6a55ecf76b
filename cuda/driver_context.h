#pragma once
// A context of the driver's with the kernels in it, our own or an engine's, and what its calls' results mean.

#include <array>
#include <atomic>
#include <string>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// What a result other than success says. out_of_memory, unsupported, device_lost.
Error errorOf(const DriverTable& driver, CuResult result, const std::string& what);

/// Makes a context this thread's for as long as it lives.
class Current {
 public:
  Current(const DriverTable& driver, CuContext context)
      : driver_(driver), pushed_(driver.ctxPushCurrent(context) == kCuSuccess) {}
  ~Current() {
    CuContext popped = nullptr;
    if (pushed_) driver_.ctxPopCurrent(&popped);
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  /// Where not, another's context would take the call.
  explicit operator bool() const { return pushed_; }
  static Error refused() { return {Code::device_lost, "the CUDA context can no longer be used"}; }

 private:
  const DriverTable& driver_;
  const bool pushed_;
};

/// What streams, and what was imported, share with their device.
struct Opened {
  const DriverTable driver;
  DeviceInfo info;
  CuContext context = nullptr;
  CuStream stream = nullptr;  ///< the engine's, for all batches; null: each has one of our own
  bool borrowed = false;      ///< the context is the engine's
  mutable std::atomic<bool> lost{false};
  CuModule module = nullptr;
  /// Our own: the device's is shared with the engine, and gives nothing back when a context is lost.
  CuPool pool = nullptr;
  std::array<CuFunction, static_cast<size_t>(Kernel::count)> functions{};

  explicit Opened(const DriverTable& table) : driver(table) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened();
  /// Notes a loss.
  Result<void> check(CuResult result, const char* what) const;
};

}  // namespace sgm::cuda
