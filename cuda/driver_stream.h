#pragma once
// Streams of an opened context, and memory of other APIs imported into it.

#include <memory>

#include "cuda/driver_context.h"

namespace sgm::cuda {

/// Same as Device::makeStream. The device must outlive the stream.
Result<std::unique_ptr<Stream>> makeDriverStream(const Opened& device, StreamUse use);

/// Same as Device::import.
Result<std::shared_ptr<const ImportedMemory>> importMemory(std::shared_ptr<const Opened> device,
                                                           const SharedBlock& block);

}  // namespace sgm::cuda
