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

void putId(const ContentId& id, ByteWriter& out) {
  out.put(id.high);
  out.put(id.low);
}

ContentId getId(ByteReader& in) {
  ContentId id;
  id.high = in.get<uint64_t>();
  id.low = in.get<uint64_t>();
  return id;
}

}  // namespace sgm::store
