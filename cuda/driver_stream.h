#pragma once
// Streams of an opened context, and memory of other APIs imported into it.

#include <memory>

#include "cuda/driver_context.h"

namespace sgm::cuda {

/// As Device::makeStream. The device must outlive it.
Result<std::unique_ptr<Stream>> makeDriverStream(const Opened& device, StreamUse use);

/// As Device::import.
Result<std::shared_ptr<const ImportedMemory>> importMemory(std::shared_ptr<const Opened> device,
                                                           const SharedBlock& block);

}  // namespace sgm::cuda
