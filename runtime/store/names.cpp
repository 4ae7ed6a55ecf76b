#include "base/plain_text.h"
#include "store/frames.h"

namespace sgm::store {

std::string nameOf(const ContentId& id) { return hexText(id.high, 16) + hexText(id.low, 16); }

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
