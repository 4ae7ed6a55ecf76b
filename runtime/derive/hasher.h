#pragma once
// A running hash of values, equal on every machine.

#include <bit>
#include <cstdint>

#include "base/hash.h"
#include "derive/shape.h"

namespace sgm {

class Hasher {
 public:
  void add(uint64_t v) { value_ = hashCombine(value_, v); }
  void add(float v) { add(uint64_t{std::bit_cast<uint32_t>(v)}); }
  void add(int32_t v) { add(uint64_t{static_cast<uint32_t>(v)}); }
  void add(uint32_t v) { add(uint64_t{v}); }
  void add(Int3 p) {
    add(p.x);
    add(p.y);
    add(p.z);
  }
  void add(const Frame& f) {
    add(f.origin);
    for (float row : f.rows) add(row);
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0;
};

}  // namespace sgm
