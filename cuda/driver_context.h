#pragma once
// A CUDA context, created by the library or by the engine, with the kernels loaded into it. Converts the driver's
// results to errors.

#include <array>
#include <atomic>
#include <string>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// Converts a driver result other than success to an error: out_of_memory, unsupported or device_lost.
Error errorOf(const DriverTable& driver, CuResult result, const std::string& what);

/// Makes a CUDA context current for this thread during the object's lifetime.
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
  /// False if the context could not be made current. The caller must then not call driver functions: they would act on
  /// another context.
  explicit operator bool() const { return pushed_; }
  static Error refused() { return {Code::device_lost, "the CUDA context can no longer be used"}; }

 private:
  const DriverTable& driver_;
  const bool pushed_;
};

/// The state of an open device, which its streams and imported memory share.
struct Opened {
  const DriverTable driver;
  DeviceInfo info;
  CuContext context = nullptr;
  CuStream stream = nullptr;  ///< the engine's stream, used for all batches; null: each batch gets a stream of its own
  bool borrowed = false;      ///< true if the context belongs to the engine
  mutable std::atomic<bool> lost{false};
  CuModule module = nullptr;
  /// The library's own memory pool. The device's default pool is not used: the engine also allocates from that pool,
  /// and a loss of the context does not free it.
  CuPool pool = nullptr;
  std::array<CuFunction, static_cast<size_t>(Kernel::count)> functions{};

  explicit Opened(const DriverTable& table) : driver(table) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened();
  /// Converts a driver result to an error; if the device is lost, sets `lost`.
  Result<void> check(CuResult result, const char* what) const;
};

}  // namespace sgm::cuda
