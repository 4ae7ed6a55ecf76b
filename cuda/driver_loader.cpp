// Loads the CUDA driver, and embeds the compiled kernels into the library.

#include "base/platform/library.h"
#include "cuda/driver_device.h"

#ifdef SGM_CUDA_IMAGE
// The assembler embeds the file (.incbin). As a C array, it would take several times its size in source code, and
// compile slowly.
asm(".pushsection .rodata, \"a\", @progbits\n"
    ".balign 64\n"
    ".hidden sgm_cuda_image\n"
    ".global sgm_cuda_image\n"
    "sgm_cuda_image:\n"
    ".incbin \"" SGM_CUDA_IMAGE
    "\"\n"
    ".hidden sgm_cuda_image_end\n"
    ".global sgm_cuda_image_end\n"
    "sgm_cuda_image_end:\n"
    ".popsection\n");
extern "C" {
extern const std::byte sgm_cuda_image[] __attribute__((visibility("hidden")));
extern const std::byte sgm_cuda_image_end[] __attribute__((visibility("hidden")));
}
#endif

namespace sgm::cuda {

std::span<const std::byte> kernelImage() {
#ifdef SGM_CUDA_IMAGE
  return {sgm_cuda_image, sgm_cuda_image_end};
#else
  return {};
#endif
}

namespace {

/// The library is never unloaded: the driver keeps thread-local data until the threads end.
void* openLibrary() { return platform::openLibrary("libcuda.so.1"); }

}  // namespace

bool haveDriver() { return openLibrary() != nullptr; }

Result<DriverTable> openDriver() {
  void* library = openLibrary();
  if (!library) return Error{Code::unsupported, "there is no NVIDIA driver: libcuda.so.1 is missing"};
  DriverTable table;
  const char* missing = nullptr;
#define SGM_CU(entry, name, parameters)                                                     \
  table.entry = reinterpret_cast<decltype(table.entry)>(platform::symbolOf(library, name)); \
  if (table.entry == nullptr && missing == nullptr) missing = name;
  SGM_CU_FUNCTIONS
#undef SGM_CU
  if (missing != nullptr) {
    return Error{Code::unsupported,
                 std::string("the NVIDIA driver is too old and lacks ") + missing + ": update it to 11.2 or newer"};
  }
  if (const CuResult result = table.init(0); result != kCuSuccess) {
    const char* text = nullptr;
    if (table.getErrorString(result, &text) != kCuSuccess || text == nullptr) text = "unknown error";
    return Error{Code::unsupported, std::string("the NVIDIA driver does not start: ") + text};
  }
  return table;
}

}  // namespace sgm::cuda
