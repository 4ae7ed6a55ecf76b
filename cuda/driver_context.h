#pragma once
// A driver context with the kernels, our own or the engine's, and the conversion of its results to errors.

#include <array>
#include <atomic>
#include <string>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// Converts a result other than success: out_of_memory, unsupported or device_lost.
Error errorOf(const DriverTable& driver, CuResult result, const std::string& what);

/// Makes a context current for this thread during its lifetime.
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
  /// If false, a call would run in another context.
  explicit operator bool() const { return pushed_; }
  static Error refused() { return {Code::device_lost, "the CUDA context can no longer be used"}; }

 private:
  const DriverTable& driver_;
  const bool pushed_;
};

/// The state that streams and imported memory share with their device.
struct Opened {
  const DriverTable driver;
  DeviceInfo info;
  CuContext context = nullptr;
  CuStream stream = nullptr;  ///< the engine's, for all batches; null: each has its own
  bool borrowed = false;      ///< the context is the engine's
  mutable std::atomic<bool> lost{false};
  CuModule module = nullptr;
  /// Our own pool: the device's default pool is shared with the engine, and is not freed when a context is lost.
  CuPool pool = nullptr;
  std::array<CuFunction, static_cast<size_t>(Kernel::count)> functions{};

  explicit Opened(const DriverTable& table) : driver(table) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened();
  /// Converts a result, and records a loss.
  Result<void> check(CuResult result, const char* what) const;
};

}  // namespace sgm::cuda
