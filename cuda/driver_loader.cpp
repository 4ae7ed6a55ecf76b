// Where the driver and the kernels' image come from.

#include <dlfcn.h>

#include "cuda/driver_device.h"

#ifdef SGM_CUDA_IMAGE
// The file as it is, without a detour over an array's text of several times its size.
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

/// Stays in memory: what a driver keeps for threads must outlive them.
void* openLibrary() { return dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL); }

}  // namespace

bool haveDriver() { return openLibrary() != nullptr; }

Result<DriverTable> openDriver() {
  void* library = openLibrary();
  if (!library) return Error{Code::unsupported, "no NVIDIA driver here: there is no libcuda.so.1"};
  DriverTable table;
  const char* missing = nullptr;
#define SGM_CU(entry, name, parameters)                                        \
  table.entry = reinterpret_cast<decltype(table.entry)>(dlsym(library, name)); \
  if (table.entry == nullptr && missing == nullptr) missing = name;
  SGM_CU_FUNCTIONS
#undef SGM_CU
  if (missing != nullptr) {
    return Error{Code::unsupported,
                 std::string("the NVIDIA driver is too old, it has no ") + missing + ": update it to 11.2 or newer"};
  }
  if (const CuResult result = table.init(0); result != kCuSuccess) {
    const char* text = nullptr;
    if (table.getErrorString(result, &text) != kCuSuccess || text == nullptr) text = "unknown error";
    return Error{Code::unsupported, std::string("the NVIDIA driver does not start: ") + text};
  }
  return table;
}

}  // namespace sgm::cuda
