#include "cuda/driver_context.h"

namespace sgm::cuda {

Error errorOf(const DriverTable& driver, CuResult result, const std::string& what) {
  const char* text = nullptr;
  if (driver.getErrorString(result, &text) != kCuSuccess || text == nullptr) text = "unknown error";
  const std::string message = what + ": " + text + " (CUresult " + std::to_string(result) + ")";
  switch (result) {
    case kCuOutOfMemory:
      return {Code::out_of_memory, message};
    case kCuNoDevice:
      return {Code::unsupported, "the CUDA driver finds no GPU: " + message};
    case kCuDriverMismatch:
    case kCuUnknownPtx:
    case kCuNoBinary:
      return {Code::unsupported, "the CUDA driver is too old for this build, update it: " + message};
    default:
      // Any other failure counts as a loss of the device: after it the context stays unusable, and only a new context
      // helps.
      return {Code::device_lost, message};
  }
}

Opened::~Opened() {
  if (context == nullptr) return;
  {
    const Current current(driver, context);
    if (current && pool != nullptr) driver.memPoolDestroy(pool);
    if (current && module != nullptr) driver.moduleUnload(module);
  }
  if (!borrowed) driver.ctxDestroy(context);
}

Result<void> Opened::check(CuResult result, const char* what) const {
  if (result == kCuSuccess) return {};
  const Error error = errorOf(driver, result, std::string(what) + " on " + info.name);
  if (error.code == Code::device_lost) lost.store(true);
  return error;
}

}  // namespace sgm::cuda
