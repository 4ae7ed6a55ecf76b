#pragma once
// The CUDA devices of this machine, by the driver's interface.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// Whether this machine has an NVIDIA driver, be it of use or not.
bool haveDriver();

/// The machine's driver, initialised. unsupported: there is none, or it is too old, and what to do.
Result<DriverTable> openDriver();

/// The kernels as this build has them for GPUs; empty: it was made without nvcc.
std::span<const std::byte> kernelImage();

/// Why the device cannot mesh, in one sentence; empty: it can. Pure.
std::string lackOf(const DeviceInfo& info);

/// Every device of the driver, those that cannot be used too. Errors: device_lost, unsupported.
Result<std::vector<DeviceInfo>> listDevices(const DriverTable& driver);

/// As openDriver() and listDevices().
Result<std::vector<DeviceInfo>> listDevices();

/// The engine's. Both outlive the device.
struct BorrowedContext {
  CuContext context = nullptr;
  CuStream stream = nullptr;         ///< for all batches; null: streams of our own
  uint64_t mesh_bytes = UINT64_MAX;  ///< the most for meshes that stay on the device
};

/// Opens a device in the engine's context, which stays the engine's; a thread's current context is as before after
/// every call. Errors: as openDevice().
Result<std::unique_ptr<Device>> borrowDevice(const DriverTable& driver, std::span<const std::byte> image,
                                             const BorrowedContext& lent);

/// The number of the GPU, as listed. unsupported: it is none of the driver's. Other errors: as listDevices().
Result<int> findDevice(const DriverTable& driver, const DeviceId& id);

/// Opens a device with a context of its own, so that what fails in it is nobody else's loss. index: as listed; -1: the
/// first that can be used. image: the kernels, as nvcc makes them. Errors: unsupported, out_of_memory, device_lost.
Result<std::unique_ptr<Device>> openDevice(const DriverTable& driver, std::span<const std::byte> image, int index = -1);

}  // namespace sgm::cuda
