#include "asset/glb_accessor.h"

#include <cstring>

namespace sgm::asset {

namespace {

constexpr size_t kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

Error bad(std::string message) { return {Code::bad_input, std::move(message), 0, 0}; }

std::string numbered(std::string_view what, size_t number) {
  return std::string(what).append(" ").append(std::to_string(number));
}

/// Whether `count` elements of `size` bytes, each `stride` behind the one before, from `offset` on lie in `available`
/// bytes; without a product or a sum that may overflow.
bool liesWithin(size_t offset, size_t count, size_t size, size_t stride, size_t available) {
  if (offset > available || size > available - offset) return false;
  return count - 1 <= (available - offset - size) / stride;
}

}  // namespace

Result<GlbAccessors::View> GlbAccessors::view(size_t accessor, std::string_view type, bool floats, size_t most) const {
  const std::string name = numbered("accessor", accessor);
  const auto accessors = root_.list("accessors");
  if (accessor >= accessors.size()) return bad(name + " is not there");
  const JsonValue& a = accessors[accessor];
  if (a.find("sparse") != nullptr) return bad(name + " is sparse");
  const JsonValue* given = a.find("type");
  if (given == nullptr || given->text != type) return bad(name + " is not of type " + std::string(type));
  View out;
  const size_t component = a.count("componentType").value_or(0);
  if (floats ? component == kFloat : component == kUnsignedInt)
    out.component_bytes = 4;
  else if (!floats && component == kUnsignedShort)
    out.component_bytes = 2;
  else if (!floats && component == kUnsignedByte)
    out.component_bytes = 1;
  else
    return bad(name + (floats ? " does not hold floats" : " does not hold unsigned whole numbers"));
  const auto count = a.count("count");
  if (!count || *count == 0) return bad(name + " holds nothing");
  if (*count > most) return Error{Code::limit, name + " holds more than " + std::to_string(most) + " elements", 0, 0};
  out.count = *count;
  const auto views = root_.list("bufferViews");
  const auto number = a.count("bufferView");
  if (!number || *number >= views.size()) return bad(name + " has no buffer view");
  const JsonValue& v = views[*number];
  const std::string view_name = numbered("buffer view", *number);
  if (v.count("buffer") != 0u) return bad(view_name + " is not of the file's own binary part");
  const size_t offset = v.count("byteOffset").value_or(0), length = v.count("byteLength").value_or(0);
  if (offset > binary_.size() || length > binary_.size() - offset)
    return bad(view_name + " reaches beyond the end of the binary part");
  const size_t size = out.component_bytes * (floats ? 3 : 1);
  out.stride = v.count("byteStride").value_or(size);
  if (out.stride < size || out.stride > 252) return bad(view_name + " has a stride that its elements do not fit into");
  const size_t start = a.count("byteOffset").value_or(0);
  if (!liesWithin(start, out.count, size, out.stride, length))
    return bad(name + " reaches beyond the end of its buffer view");
  out.first = binary_.data() + offset + start;
  return out;
}

Result<std::vector<Point>> GlbAccessors::points(size_t accessor, size_t most) const {
  const Result<View> from = view(accessor, "VEC3", true, most);
  if (!from) return from.error();
  std::vector<Point> out;
  out.reserve(from->count);
  for (size_t i = 0; i < from->count; ++i) {
    float v[3];
    std::memcpy(v, from->first + i * from->stride, sizeof v);
    const Point p{double{v[0]}, double{v[1]}, double{v[2]}};
    constexpr double kFarthest = 1e6;
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::fabs(p[axis]) <= kFarthest))
        return bad(numbered("accessor", accessor) + " has a position that is no place within 1,000 km");
    out.push_back(p);
  }
  return out;
}

Result<std::vector<uint32_t>> GlbAccessors::indices(size_t accessor, size_t most) const {
  const Result<View> from = view(accessor, "SCALAR", false, most);
  if (!from) return from.error();
  std::vector<uint32_t> out;
  out.reserve(from->count);
  for (size_t i = 0; i < from->count; ++i) {
    uint32_t value = 0;  // little-endian, as the machines are that we build for
    std::memcpy(&value, from->first + i * from->stride, from->component_bytes);
    out.push_back(value);
  }
  return out;
}

}  // namespace sgm::asset
