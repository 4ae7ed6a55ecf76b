#include "asset/glb_accessor.h"

#include <array>
#include <cstring>

namespace sgm::asset {

namespace {

constexpr size_t kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr size_t kNowhere = SIZE_MAX;  ///< an offset that is no whole number: beyond every end

std::string numbered(std::string_view what, size_t number) {
  return std::string(what).append(" ").append(std::to_string(number));
}

/// of: such as "accessors"
Error wrongIn(std::string_view of, size_t number, std::string_view member, std::string_view what) {
  const std::string pointer = "/" + std::string(of) + "/" + std::to_string(number);
  return wrongInJson(what, member.empty() ? pointer : pointer + "/" + std::string(member));
}

size_t offsetIn(const JsonValue& value) {
  return value.find("byteOffset") == nullptr ? 0 : value.count("byteOffset").value_or(kNowhere);
}

size_t componentBytes(size_t component) {
  switch (component) {
    case kFloat:
    case kUnsignedInt:
      return 4;
    case kUnsignedShort:
      return 2;
    case kUnsignedByte:
      return 1;
    default:
      return 0;
  }
}

/// Whether `count` elements of `size` bytes, each `stride` behind the one before, from `offset` on lie in `available`
/// bytes; without a product or a sum that may overflow.
bool liesWithin(size_t offset, size_t count, size_t size, size_t stride, size_t available) {
  if (offset > available || size > available - offset) return false;
  return count - 1 <= (available - offset - size) / stride;
}

/// Little-endian, as the machines are that we build for.
template <class Value>
Value valueAt(const std::byte* at) {
  Value value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// The first corner that is none of the primitive's points; nothing where there is none. stride and the loop's type are
/// known to the compiler, for this is what reading a large file comes to.
template <class Index>
std::optional<size_t> appendTriangles(const std::byte* first, size_t count, const GlbCorners& corners,
                                      std::vector<std::array<uint32_t, 3>>& out) {
  const size_t before = out.size();
  out.resize(before + count / 3);
  const size_t second = corners.mirrored ? 2 : 1;
  for (size_t t = 0; t < count / 3; ++t) {
    std::array<Index, 3> index;
    std::memcpy(index.data(), first + t * sizeof index, sizeof index);
    for (size_t k = 0; k < 3; ++k)
      if (index[k] >= corners.points) return 3 * t + k;
    out[before + t] = {corners.first + index[0], corners.first + index[second], corners.first + index[3 - second]};
  }
  return std::nullopt;
}

}  // namespace

GlbAccessors::GlbAccessors(const JsonValue& root, std::span<const std::byte> binary, size_t binary_at)
    : binary_(binary), binary_at_(binary_at) {
  // Read once: members are searched for by name, and a small file may name one accessor a million times.
  for (const JsonValue& value : root.list("accessors")) {
    const JsonValue *type = value.find("type"), *normalized = value.find("normalized");
    const std::string_view name = type != nullptr ? std::string_view(type->text) : std::string_view();
    accessors_.push_back({.type = name == "SCALAR" ? Type::scalar
                                  : name == "VEC2" ? Type::pair
                                  : name == "VEC3" ? Type::triple
                                                   : Type::other,
                          .component = value.count("componentType").value_or(0),
                          .offset = offsetIn(value),
                          .count = value.count("count"),
                          .view = value.count("bufferView"),
                          .normalized = normalized != nullptr && normalized->number == 1,
                          .sparse = value.find("sparse") != nullptr});
  }
  // The first buffer is the file's own binary part, unless it says that it lies elsewhere.
  const std::span<const JsonValue> buffers = root.list("buffers");
  const bool elsewhere = !buffers.empty() && buffers.front().find("uri") != nullptr;
  for (const JsonValue& value : root.list("bufferViews")) {
    views_.push_back({.own = value.count("buffer") == 0u && !elsewhere,
                      .offset = offsetIn(value),
                      .length = value.count("byteLength").value_or(0),
                      .stride = value.find("byteStride") == nullptr
                                    ? std::nullopt
                                    : std::optional(value.count("byteStride").value_or(0))});
  }
}

Result<GlbAccessors::Elements> GlbAccessors::elements(size_t number, Type type) const {
  const Accessor& a = accessors_[number];
  const auto wrong = [&](std::string_view member, std::string_view what) {
    return wrongIn("accessors", number, member, numbered("accessor", number).append(what));
  };
  if (a.sparse) return wrong("sparse", " is sparse");
  if (a.type != type) {
    constexpr std::string_view kTypes[] = {" is not of type SCALAR", " is not of type VEC2", " is not of type VEC3"};
    return wrong("type", kTypes[static_cast<size_t>(type)]);
  }
  if (type == Type::scalar && (a.component == kFloat || componentBytes(a.component) == 0))
    return wrong("componentType", " does not hold unsigned whole numbers");
  if (type == Type::pair && a.component != kFloat &&
      !(a.normalized && (a.component == kUnsignedByte || a.component == kUnsignedShort)))
    return wrong("componentType", " does not hold floats, or whole numbers that are normalized");
  if (type == Type::triple && a.component != kFloat) return wrong("componentType", " does not hold floats");
  if (!a.count || *a.count == 0) return wrong("count", " holds nothing");
  if (!a.view || *a.view >= views_.size()) return wrong("bufferView", " has no buffer view");
  const BufferView& v = views_[*a.view];
  const auto wrongView = [&](std::string_view member, std::string_view what) {
    return wrongIn("bufferViews", *a.view, member, numbered("buffer view", *a.view).append(what));
  };
  if (!v.own) return wrongView("buffer", " is not of the file's own binary part");
  if (v.offset > binary_.size() || v.length > binary_.size() - v.offset)
    return wrongView("", " reaches beyond the end of the binary part");
  const size_t size = componentBytes(a.component) * (1 + static_cast<size_t>(type));
  Elements out{.count = *a.count, .stride = v.stride.value_or(size)};
  if (out.stride < size || out.stride > 252)
    return wrongView("byteStride", " has a stride that its elements do not fit into");
  if (!liesWithin(a.offset, out.count, size, out.stride, v.length))
    return wrong("", " reaches beyond the end of its buffer view");
  out.first = binary_.data() + v.offset + a.offset;
  return out;
}

Result<void> GlbAccessors::points(size_t a, const MeshLimits& limits, std::vector<Point>& out) const {
  const Result<Elements> from = elements(a, Type::triple);
  if (!from) return from.error();
  const size_t before = out.size();
  if (from->count > limits.mostPoints() - before) return overLimit(limits.mostPoints(), "points");
  out.resize(before + from->count);
  for (size_t i = 0; i < from->count; ++i) {
    const std::byte* const at = from->first + i * from->stride;
    const auto v = valueAt<std::array<float, 3>>(at);
    const Point p{double{v[0]}, double{v[1]}, double{v[2]}};
    if (!limits.isPlace(p.x, p.y, p.z))
      return wrongAtByte(numbered("accessor", a) + " has a position " + noPlaceWithin(limits), byteOf(at));
    out[before + i] = p;
  }
  return {};
}

Result<void> GlbAccessors::asManyAs(size_t a, size_t count) const {
  if (accessors_[a].count == count) return {};
  return wrongIn("accessors", a, "count",
                 numbered("accessor", a) + " does not hold as many elements as there are positions");
}

Result<void> GlbAccessors::normals(size_t a, size_t count, std::vector<Normal>& out) const {
  const Result<Elements> from = elements(a, Type::triple);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t before = out.size();
  out.resize(before + count);
  for (size_t i = 0; i < count; ++i) {
    const std::byte* const at = from->first + i * from->stride;
    const auto n = valueAt<Normal>(at);
    if (!isFloat(double{n[0]}) || !isFloat(double{n[1]}) || !isFloat(double{n[2]}))
      return wrongAtByte(numbered("accessor", a) + " has a normal that is not finite", byteOf(at));
    out[before + i] = n;
  }
  return {};
}

Result<void> GlbAccessors::coordinates(size_t a, size_t count, std::vector<TextureCoordinates>& out) const {
  const Result<Elements> from = elements(a, Type::pair);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t component = accessors_[a].component, bytes = componentBytes(component);
  const auto number = [&](const std::byte* at) {
    if (component == kFloat) return valueAt<float>(at);
    if (component == kUnsignedShort) return static_cast<float>(valueAt<uint16_t>(at)) / 65535.0f;
    return static_cast<float>(valueAt<uint8_t>(at)) / 255.0f;
  };
  const size_t before = out.size();
  out.resize(before + count);
  for (size_t i = 0; i < count; ++i) {
    const std::byte* const at = from->first + i * from->stride;
    const float u = number(at), v = number(at + bytes);
    if (!isFloat(double{u}) || !isFloat(double{v}))
      return wrongAtByte(numbered("accessor", a) + " has texture coordinates that are not finite", byteOf(at));
    out[before + i] = {u, 1 - v};  // a picture's rows go down
  }
  return {};
}

Result<void> GlbAccessors::triangles(size_t a, const GlbCorners& corners, const MeshLimits& limits,
                                     std::vector<std::array<uint32_t, 3>>& out) const {
  const Result<Elements> from = elements(a, Type::scalar);
  if (!from) return from.error();
  if (from->count % 3 != 0)
    return wrongIn("accessors", a, "count", numbered("accessor", a) + " ends within a triangle");
  if (from->count / 3 > limits.triangles - out.size()) return overLimit(limits.triangles, "triangles");
  const size_t bytes = componentBytes(accessors_[a].component);
  if (from->stride != bytes)
    return wrongIn("bufferViews", *accessors_[a].view, "byteStride", "indices have a stride of their own");
  const auto beyond = bytes == 4   ? appendTriangles<uint32_t>(from->first, from->count, corners, out)
                      : bytes == 2 ? appendTriangles<uint16_t>(from->first, from->count, corners, out)
                                   : appendTriangles<uint8_t>(from->first, from->count, corners, out);
  if (!beyond) return {};
  return wrongAtByte(numbered("accessor", a) + " has a corner that is none of the primitive's " +
                         std::to_string(corners.points) + " points",
                     byteOf(from->first + *beyond * bytes));
}

}  // namespace sgm::asset
