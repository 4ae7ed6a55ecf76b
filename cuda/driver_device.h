#pragma once
// Finds and opens the CUDA devices of this machine through the CUDA driver.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// True if this machine has an NVIDIA driver, whether usable or not.
bool haveDriver();

/// Loads and initialises the CUDA driver. Error: unsupported if it is missing or too old, with a remedy in the message.
Result<DriverTable> openDriver();

/// Returns the compiled kernels (fatbin) that this build contains; empty if it was built without nvcc.
std::span<const std::byte> kernelImage();

/// Returns the reason why the library cannot use the device, as a sentence; empty if it can. Pure.
std::string unsupportedReason(const DeviceInfo& info);

/// Lists all devices that the driver reports, including unusable ones. Errors: device_lost, unsupported.
Result<std::vector<DeviceInfo>> listDevices(const DriverTable& driver);

/// Loads the driver by openDriver() and lists its devices.
Result<std::vector<DeviceInfo>> listDevices();

/// A CUDA context and a stream that belong to the engine and must outlive the device.
struct BorrowedContext {
  CuContext context = nullptr;
  CuStream stream = nullptr;         ///< the stream for all batches; null: each batch gets a stream of its own
  uint64_t mesh_bytes = UINT64_MAX;  ///< limit in bytes for meshes that stay on the device
};

/// Opens a device in the engine's CUDA context, without taking ownership. After each call of the device, the thread's
/// current CUDA context is the same as before. Errors: those of openDevice().
Result<std::unique_ptr<Device>> borrowDevice(const DriverTable& driver, std::span<const std::byte> image,
                                             const BorrowedContext& external);

/// Returns the index, in listDevices(), of the GPU with this id. Error: unsupported if the driver does not list it;
/// also those of listDevices().
Result<int> findDevice(const DriverTable& driver, const DeviceId& id);

/// Opens a device in a new context, so that failures affect no other context. index: position in listDevices(); -1: the
/// first usable device. image: the kernels as compiled by nvcc. Errors: unsupported, out_of_memory, device_lost.
Result<std::unique_ptr<Device>> openDevice(const DriverTable& driver, std::span<const std::byte> image, int index = -1);

}  // namespace sgm::cuda
