#pragma once
// The CUDA devices of this machine, through the driver.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cuda/device.h"
#include "cuda/driver_api.h"

namespace sgm::cuda {

/// Whether this machine has an NVIDIA driver, usable or not.
bool haveDriver();

/// Opens and initialises the driver. unsupported: missing or too old; the message says what to do.
Result<DriverTable> openDriver();

/// The GPU kernels in this build; empty if it was built without nvcc.
std::span<const std::byte> kernelImage();

/// The reason why the device cannot mesh, as a sentence; empty if it can. Pure.
std::string lackOf(const DeviceInfo& info);

/// All devices of the driver, including unusable ones. Errors: device_lost, unsupported.
Result<std::vector<DeviceInfo>> listDevices(const DriverTable& driver);

/// Like openDriver() and listDevices().
Result<std::vector<DeviceInfo>> listDevices();

/// The engine's context and stream, which must outlive the device.
struct BorrowedContext {
  CuContext context = nullptr;
  CuStream stream = nullptr;         ///< for all batches; null: create streams
  uint64_t mesh_bytes = UINT64_MAX;  ///< limit for meshes that stay on the device
};

/// Opens a device in the engine's context, which the engine keeps; each call restores the thread's current context.
/// Errors: as openDevice().
Result<std::unique_ptr<Device>> borrowDevice(const DriverTable& driver, std::span<const std::byte> image,
                                             const BorrowedContext& lent);

/// The index of the GPU in the list. unsupported: the driver does not have it. Other errors: as listDevices().
Result<int> findDevice(const DriverTable& driver, const DeviceId& id);

/// Opens a device with its own context, so that its failures affect no other one. index: in the list; -1: the first
/// usable device. image: the kernels as compiled by nvcc. Errors: unsupported, out_of_memory, device_lost.
Result<std::unique_ptr<Device>> openDevice(const DriverTable& driver, std::span<const std::byte> image, int index = -1);

}  // namespace sgm::cuda
