#include "api/anchors.h"

#include <algorithm>
#include <cstring>

#include "api/barrier.h"
#include "api/field.h"

using namespace sgm::api;

namespace sgm::api {

sgm_anchor anchorOf(const Anchor& anchor) {
  sgm_anchor out{};
  for (int axis = 0; axis < 3; ++axis) out.position[axis] = anchor.frame.origin[axis];
  for (size_t i = 0; i < 9; ++i) out.rotation[i] = anchor.frame.rows[i];
  out.kind = anchor.kind;
  out.name = anchor.name;
  out.tag = anchor.tag;
  out.key = anchor.key.value;
  return out;
}

}  // namespace sgm::api

sgm_result sgm_field_anchors(sgm_field* field, const int32_t minimum[3], const int32_t maximum[3], sgm_anchor* anchors,
                             size_t anchor_stride, size_t* count, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (field == nullptr) return nullArgument(error, "field");
    if (minimum == nullptr) return nullArgument(error, "minimum");
    if (maximum == nullptr) return nullArgument(error, "maximum");
    if (count == nullptr) return nullArgument(error, "count");
    if (sgm_result r = checkStride<sgm_anchor>(error, anchor_stride, "anchor_stride"); r != SGM_OK) return r;
    sgm::IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      if (minimum[axis] >= maximum[axis])
        return fail(error, SGM_ERR_INVALID_ARGUMENT, "minimum must be below maximum on every axis");
      box.lo[axis] = minimum[axis];
      box.hi[axis] = maximum[axis];
    }
    const sgm::Result<std::vector<sgm::Anchor>> found = field->content->world.anchors(box);
    if (!found) return fail(error, found.error());
    const size_t room = *count;
    *count = found->size();
    if (anchors == nullptr) return SGM_OK;
    for (size_t i = 0; i < std::min(room, found->size()); ++i) {
      const sgm_anchor anchor = anchorOf((*found)[i]);
      std::memcpy(reinterpret_cast<char*>(anchors) + i * anchor_stride, &anchor, sizeof anchor);
    }
    return room < found->size() ? SGM_INCOMPLETE : SGM_OK;
  });
}
