#pragma once
// Streams of an open CUDA context, and the import of memory of other APIs into the context.

#include <memory>

#include "cuda/driver_context.h"

namespace sgm::cuda {

/// Implements Device::makeStream. The device must outlive the stream.
Result<std::unique_ptr<Stream>> makeDriverStream(const Opened& device, StreamUse use);

/// Implements Device::import.
Result<std::shared_ptr<const ImportedMemory>> importMemory(std::shared_ptr<const Opened> device,
                                                           const SharedBlock& block);

}  // namespace sgm::cuda
