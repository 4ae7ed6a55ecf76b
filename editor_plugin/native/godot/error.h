#pragma once
// The values of the engine's enum Error (@GlobalScope) that the plugin returns.

#include <cstdint>

namespace sgm_godot {

inline constexpr int64_t kOk = 0, kFailed = 1, kErrorUnconfigured = 3, kErrorFileCannotOpen = 12, kErrorFileCannotWrite = 13,
                         kErrorInvalidData = 30, kErrorInvalidParameter = 31, kErrorParse = 43;

}  // namespace sgm_godot
