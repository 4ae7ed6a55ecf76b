#include "fake_driver.h"

#include "catch.h"

namespace sgm::cuda {

FakeDriver::~FakeDriver() {
  const State& left = state();
  CHECK(left.contexts == 0);
  if (!left.may_leave) {
    CHECK(left.modules == 0);
    CHECK(left.pools == 0);
    CHECK(left.streams == 0);
    CHECK(left.events == 0);
    CHECK(left.imports + left.mapped == 0);
    if (!left.unsure) CHECK(left.device_blocks + left.pinned_blocks == 0);
  }
  CHECK(fakeDepth() == 0);
  CHECK(left.calls_without == 0);
  // Releases objects that the tests left, so that leak checkers do not report them.
  endFake();
}

}  // namespace sgm::cuda
