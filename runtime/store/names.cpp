#include "store/frames.h"

namespace sgm::store {

std::string nameOf(const ContentId& id) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string name;
  for (const uint64_t half : {id.high, id.low}) {
    for (int shift = 60; shift >= 0; shift -= 4) name += kDigits[half >> shift & 15];
  }
  return name;
}

}  // namespace sgm::store
