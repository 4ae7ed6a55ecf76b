#pragma once
// The simulated driver (fake_gpu.h) for the duration of one test.

#include <array>
#include <cstddef>

#include "fake_gpu.h"

namespace sgm::cuda {

/// A kernel image. The simulated driver runs its kernels whatever the image contains.
inline constexpr std::array<std::byte, 16> kFakeImage{};

class FakeDriver {
 public:
  FakeDriver() { beginFake(); }
  /// CHECKs that no object of the driver is left.
  ~FakeDriver();
  FakeDriver(const FakeDriver&) = delete;
  FakeDriver& operator=(const FakeDriver&) = delete;

  using State = FakeState;
  DriverTable table() const { return fakeTable(); }
  State& state() const { return fakeState(); }
};

}  // namespace sgm::cuda
