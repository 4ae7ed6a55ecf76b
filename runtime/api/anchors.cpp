#include "api/anchors.h"

#include <algorithm>

#include "api/barrier.h"
#include "api/field.h"

using namespace sgm::api;

namespace {

sgm_anchor toC(const sgm::Anchor& anchor) {
  sgm_anchor out{};
  for (int axis = 0; axis < 3; ++axis) out.position[axis] = anchor.frame.origin[axis];
  for (size_t i = 0; i < 9; ++i) out.rotation[i] = anchor.frame.rows[i];
  out.kind = anchor.kind;
  out.name = anchor.name;
  out.tag = anchor.tag;
  out.key = anchor.key.value;
  return out;
}

}  // namespace

namespace sgm::api {

Result<std::vector<sgm_anchor>> anchorsIn(const WorldField& world, const IntBox& box) {
  const Result<std::vector<Anchor>> found = world.anchors(box);
  if (!found) return found.error();
  std::vector<sgm_anchor> anchors;
  anchors.reserve(found->size());
  for (const Anchor& anchor : *found) anchors.push_back(toC(anchor));
  return anchors;
}

}  // namespace sgm::api

sgm_result sgm_field_anchors(sgm_field* field, const int32_t minimum[3], const int32_t maximum[3], sgm_anchor* anchors,
                             size_t* count, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (field == nullptr) return nullArgument(error, "field");
    if (minimum == nullptr) return nullArgument(error, "minimum");
    if (maximum == nullptr) return nullArgument(error, "maximum");
    if (count == nullptr) return nullArgument(error, "count");
    sgm::IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      if (minimum[axis] >= maximum[axis])
        return fail(error, SGM_ERR_INVALID_ARGUMENT, "minimum does not lie below maximum on each axis");
      box.lo[axis] = minimum[axis];
      box.hi[axis] = maximum[axis];
    }
    const sgm::Result<std::vector<sgm_anchor>> found = anchorsIn(field->world, box);
    if (!found) return fail(error, found.error());
    const size_t room = anchors == nullptr ? 0 : *count;
    *count = found->size();
    if (anchors != nullptr) std::copy_n(found->begin(), std::min(room, found->size()), anchors);
    return room < found->size() ? SGM_INCOMPLETE : SGM_OK;
  });
}
