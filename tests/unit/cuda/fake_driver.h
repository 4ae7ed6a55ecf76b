#pragma once
// The driver that pretends (fake_gpu.h), for one test.

#include <array>
#include <cstddef>

#include "fake_gpu.h"

namespace sgm::cuda {

/// The fake runs every kernel, whatever the image is.
inline constexpr std::array<std::byte, 16> kFakeImage{};

class FakeDriver {
 public:
  FakeDriver() { beginFake(); }
  /// CHECKs that nothing is left.
  ~FakeDriver();
  FakeDriver(const FakeDriver&) = delete;
  FakeDriver& operator=(const FakeDriver&) = delete;

  using State = FakeState;
  DriverTable table() const { return fakeTable(); }
  State& state() const { return fakeState(); }
};

}  // namespace sgm::cuda
