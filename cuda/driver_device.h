#pragma once
// Finds and opens the CUDA devices of this machine, through the driver.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// True if this machine has an NVIDIA driver, whether usable or not.
bool haveDriver();

/// Loads and initialises the driver. Error: unsupported if it is missing or too old; the message says what to do.
Result<DriverTable> openDriver();

/// Returns the compiled GPU kernels in this build; empty if it was built without nvcc.
std::span<const std::byte> kernelImage();

/// Returns the reason why the device cannot mesh, as a sentence; empty if it can. Pure.
std::string unsupportedReason(const DeviceInfo& info);

/// Lists all devices of the driver, including unusable ones. Errors: device_lost, unsupported.
Result<std::vector<DeviceInfo>> listDevices(const DriverTable& driver);

/// Calls openDriver() and listDevices(driver).
Result<std::vector<DeviceInfo>> listDevices();

/// A context and a stream of the engine, which must outlive the device.
struct BorrowedContext {
  CuContext context = nullptr;
  CuStream stream = nullptr;         ///< used for all batches; null: each batch gets a stream of its own
  uint64_t mesh_bytes = UINT64_MAX;  ///< limit in bytes for meshes that stay on the device
};

/// Opens a device in the engine's context, which the engine still owns. Each call restores the thread's current
/// context. Errors: same as openDevice().
Result<std::unique_ptr<Device>> borrowDevice(const DriverTable& driver, std::span<const std::byte> image,
                                             const BorrowedContext& external);

/// Returns the index of the GPU in listDevices(). Error: unsupported if the driver does not have it; others as
/// listDevices().
Result<int> findDevice(const DriverTable& driver, const DeviceId& id);

/// Opens a device with a context of its own, so that its failures affect no other context. index: in listDevices(); -1:
/// the first usable device. image: the kernels as compiled by nvcc. Errors: unsupported, out_of_memory, device_lost.
Result<std::unique_ptr<Device>> openDevice(const DriverTable& driver, std::span<const std::byte> image, int index = -1);

}  // namespace sgm::cuda
