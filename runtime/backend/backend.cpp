#include "backend/backend.h"

namespace sgm {

const char* backendName(BackendKind kind) {
  switch (kind) {
    case BackendKind::cpu:
      return "cpu";
    case BackendKind::vulkan:
      return "vulkan";
    case BackendKind::cuda:
      return "cuda";
  }
  return "";
}

}  // namespace sgm
