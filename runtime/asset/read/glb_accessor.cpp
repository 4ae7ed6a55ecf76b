#include "asset/read/glb_accessor.h"

#include <cstring>

namespace sgm::asset {

namespace {

constexpr size_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                 kFloat = 5126;
constexpr size_t kNowhere = SIZE_MAX;  ///< the value for an invalid byteOffset: it is larger than every buffer, so it
                                       ///< is rejected later
/// The maximum number of elements of an accessor without a buffer view. Such elements take no bytes in the file, so the
/// size of the file does not limit their number.
constexpr size_t kMaxZeros = size_t{1} << 24;

std::string numbered(std::string_view what, size_t number) {
  return std::string(what).append(" ").append(std::to_string(number));
}

Error wrongIn(size_t accessor, std::string_view member, std::string_view what) {
  const std::string pointer = "/accessors/" + std::to_string(accessor);
  return wrongInJson(numbered("accessor", accessor).append(what),
                     member.empty() ? pointer : pointer + "/" + std::string(member));
}

size_t offsetIn(const JsonValue& value) {
  return value.find("byteOffset") == nullptr ? 0 : value.count("byteOffset").value_or(kNowhere);
}

size_t componentBytes(size_t component) {
  switch (component) {
    case kFloat:
    case kUnsignedInt:
      return 4;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kByte:
    case kUnsignedByte:
      return 1;
    default:
      return 0;
  }
}

/// True if `count` elements of `size` bytes, `stride` bytes apart and beginning at `offset`, lie within `available`
/// bytes. Uses no products or sums that could overflow. Requires count >= 1.
bool liesWithin(size_t offset, size_t count, size_t size, size_t stride, size_t available) {
  if (offset > available || size > available - offset) return false;
  return count - 1 <= (available - offset - size) / stride;
}

/// Reads a little-endian value; it is copied as it is, since all supported machines are little-endian.
template <class Value>
Value valueAt(const std::byte* at) {
  Value value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

double numberAt(const std::byte* at, size_t component, bool normalized) {
  switch (component) {
    case kByte:
      return normalized ? std::max(valueAt<int8_t>(at) / 127.0, -1.0) : valueAt<int8_t>(at);
    case kUnsignedByte:
      return normalized ? valueAt<uint8_t>(at) / 255.0 : valueAt<uint8_t>(at);
    case kShort:
      return normalized ? std::max(valueAt<int16_t>(at) / 32767.0, -1.0) : valueAt<int16_t>(at);
    case kUnsignedShort:
      return normalized ? valueAt<uint16_t>(at) / 65535.0 : valueAt<uint16_t>(at);
    case kUnsignedInt:
      return valueAt<uint32_t>(at);
    default:
      return double{valueAt<float>(at)};
  }
}

/// Appends triangles. Returns the position of the first index that is not below the number of points; nullopt if all
/// are valid. The type of indices is a template parameter, so that the stride is constant: this loop dominates the time
/// of reading a large file.
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

std::string noPointOf(size_t points) {
  return " has a corner that is not one of the primitive's " + std::to_string(points) + " points";
}

}  // namespace

GlbAccessors::Accessor GlbAccessors::accessorIn(const JsonValue& value) {
  const JsonValue *type = value.find("type"), *normalized = value.find("normalized"), *sparse = value.find("sparse");
  const std::string_view name = type != nullptr ? std::string_view(type->text) : std::string_view();
  Accessor out{.type = name == "SCALAR" ? Type::scalar
                       : name == "VEC2" ? Type::pair
                       : name == "VEC3" ? Type::triple
                       : name == "VEC4" ? Type::quadruple
                       : name == "MAT4" ? Type::matrix
                                        : Type::other,
               .component = value.count("componentType").value_or(0),
               .offset = offsetIn(value),
               .count = value.count("count"),
               .view = value.find("bufferView") == nullptr
                           ? std::nullopt
                           : std::optional(value.count("bufferView").value_or(kNowhere)),
               .normalized = normalized != nullptr && normalized->number == 1,
               .sparse = {}};
  if (sparse != nullptr) {
    out.sparse = Sparse();
    Sparse& s = *out.sparse;
    s.count = sparse->count("count").value_or(0);
    if (const JsonValue* indices = sparse->find("indices")) {
      s.index_view = indices->count("bufferView");
      s.index_offset = offsetIn(*indices);
      s.index_component = indices->count("componentType").value_or(0);
    }
    if (const JsonValue* values = sparse->find("values")) {
      s.value_view = values->count("bufferView");
      s.value_offset = offsetIn(*values);
    }
  }
  return out;
}

GlbAccessors::GlbAccessors(const JsonValue& root, const GlbContainer& file, bool quantized)
    : buffers_(root, file), quantized_(quantized) {
  // Parse all accessors once: JSON members are looked up by name, which is slow, and a small file may refer to the same
  // accessor a million times.
  for (const JsonValue& value : root.list("accessors")) accessors_.push_back(accessorIn(value));
}

bool GlbAccessors::mayHold(const Accessor& a, Holds holds) const {
  const bool small =
      a.component == kByte || a.component == kUnsignedByte || a.component == kShort || a.component == kUnsignedShort;
  const bool without_sign = a.component == kUnsignedByte || a.component == kUnsignedShort;
  switch (holds) {
    case Holds::floats:
      return a.component == kFloat;
    case Holds::small:
      return a.component == kFloat || (quantized_ && small);
    case Holds::fractions:
      return a.component == kFloat || (small && a.normalized);
    case Holds::unsigned_small:
      return without_sign && !a.normalized;
    case Holds::indices:
      return without_sign || a.component == kUnsignedInt;
  }
  return false;
}

/// Returns the bytes of an accessor's elements in a buffer view. packed: the elements are contiguous, regardless of the
/// view's stride.
Result<GlbAccessors::Elements> GlbAccessors::elementsIn(size_t number, std::string_view member, size_t view,
                                                        size_t offset, size_t count, size_t size, bool packed) const {
  const auto joined = [&](std::string_view name) {
    return member.empty() ? std::string(name) : std::string(member).append("/").append(name);
  };
  if (view >= buffers_.viewCount()) return wrongIn(number, joined("bufferView"), " has no buffer view");
  const Result<GlbBuffers::View> v = buffers_.view(view);
  if (!v) return v.error();
  const size_t stride = packed ? size : v->stride.value_or(size);
  if (stride < size || stride > 252)
    return wrongInJson(numbered("buffer view", view) + " has a stride that its elements do not fit into",
                       "/bufferViews/" + std::to_string(view) + "/byteStride");
  if (!liesWithin(offset, count, size, stride, v->bytes.size()))
    return wrongIn(number, member, " reaches beyond the end of its buffer view");
  return Elements{v->bytes.data() + offset, count, stride, v->buffer};
}

Result<GlbAccessors::Elements> GlbAccessors::elements(size_t number, Type type, Holds holds) const {
  const Accessor& a = accessors_[number];
  constexpr size_t kNumbers[] = {1, 2, 3, 4, 16};
  const size_t numbers = kNumbers[static_cast<size_t>(type)];
  if (a.type != type) {
    constexpr std::string_view kTypes[] = {" is not of type SCALAR", " is not of type VEC2", " is not of type VEC3",
                                           " is not of type VEC4", " is not of type MAT4"};
    return wrongIn(number, "type", kTypes[static_cast<size_t>(type)]);
  }
  if (!mayHold(a, holds)) {
    constexpr std::string_view kHolds[] = {
        " does not hold floats", " does not hold floats", " does not hold floats, or whole numbers that are normalized",
        " does not hold unsigned whole numbers", " does not hold unsigned whole numbers"};
    const bool small = holds == Holds::small && componentBytes(a.component) != 0 && a.component != kUnsignedInt;
    return wrongIn(number, "componentType",
                   std::string(kHolds[static_cast<size_t>(holds)]) +
                       (small ? ", and the file does not use KHR_mesh_quantization" : ""));
  }
  if (!a.count || *a.count == 0) return wrongIn(number, "count", " holds nothing");
  if (a.sparse && (a.sparse->count == 0 || a.sparse->count > *a.count))
    return wrongIn(number, "sparse/count", " replaces none of its elements, or more than it has");
  if (a.view) return elementsIn(number, "", *a.view, a.offset, *a.count, componentBytes(a.component) * numbers, false);
  if (*a.count > kMaxZeros) return wrongIn(number, "count", " holds too many elements for one without a buffer view");
  return Elements{nullptr, *a.count, 0, 0};
}

Error GlbAccessors::wrongAt(size_t a, std::string_view what, size_t buffer, const std::byte* at) const {
  return {Code::bad_input,
          numbered("accessor", a).append(what) + (at == nullptr ? "" : ", at " + buffers_.placeOf(buffer, at)), 0, 0};
}

Result<void> GlbAccessors::asManyAs(size_t a, size_t count) const {
  if (accessors_[a].count == count) return {};
  return wrongIn(a, "count", " does not hold as many elements as there are positions");
}

/// Calls `put` with the index and the numbers of each element. Elements that sparse storage replaces are passed twice,
/// the second time with their final numbers. put: returns false to reject the numbers. complaint: the text of the error
/// about rejected numbers.
template <size_t N, class Put>
Result<void> GlbAccessors::each(size_t number, const Elements& from, std::string_view complaint, const Put& put) const {
  const Accessor& a = accessors_[number];
  const size_t bytes = componentBytes(a.component);
  if (from.first != nullptr && a.component == kFloat) {
    for (size_t i = 0; i < from.count; ++i) {
      const std::byte* const at = from.first + i * from.stride;
      const auto v = valueAt<std::array<float, N>>(at);
      std::array<double, N> values;
      for (size_t k = 0; k < N; ++k) values[k] = double{v[k]};
      if (!put(i, values)) return wrongAt(number, complaint, from.buffer, at);
    }
  } else {
    for (size_t i = 0; i < from.count; ++i) {
      const std::byte* const at = from.first == nullptr ? nullptr : from.first + i * from.stride;
      std::array<double, N> values{};
      for (size_t k = 0; at != nullptr && k < N; ++k) values[k] = numberAt(at + k * bytes, a.component, a.normalized);
      if (!put(i, values)) return wrongAt(number, complaint, from.buffer, at);
    }
  }
  return a.sparse ? eachSparse<N>(number, complaint, put) : Result<void>();
}

template <size_t N, class Put>
Result<void> GlbAccessors::eachSparse(size_t number, std::string_view complaint, const Put& put) const {
  const Accessor& a = accessors_[number];
  const Sparse& s = *a.sparse;
  const size_t index_bytes = componentBytes(s.index_component), bytes = componentBytes(a.component);
  if (index_bytes == 0 || s.index_component == kFloat || s.index_component == kByte || s.index_component == kShort)
    return wrongIn(number, "sparse/indices/componentType", " has sparse indices that are not unsigned whole numbers");
  const Result<Elements> indices =
      elementsIn(number, "sparse/indices", s.index_view.value_or(kNowhere), s.index_offset, s.count, index_bytes, true);
  if (!indices) return indices.error();
  const Result<Elements> from =
      elementsIn(number, "sparse/values", s.value_view.value_or(kNowhere), s.value_offset, s.count, N * bytes, true);
  if (!from) return from.error();
  for (size_t i = 0; i < s.count; ++i) {
    const std::byte *const index_at = indices->first + i * index_bytes, *const at = from->first + i * from->stride;
    const double index = numberAt(index_at, s.index_component, false);
    if (index >= static_cast<double>(*a.count))
      return wrongIn(number, "sparse/indices", " replaces an element that it does not have");
    std::array<double, N> values;
    for (size_t k = 0; k < N; ++k) values[k] = numberAt(at + k * bytes, a.component, a.normalized);
    if (!put(static_cast<size_t>(index), values)) return wrongAt(number, complaint, from->buffer, at);
  }
  return {};
}

Result<void> GlbAccessors::points(size_t a, const MeshLimits& limits, std::vector<Point>& out) const {
  const Result<Elements> from = elements(a, Type::triple, Holds::small);
  if (!from) return from.error();
  const size_t before = out.size();
  if (from->count > limits.maxPoints() - before) return overLimit(limits.maxPoints(), "points");
  out.resize(before + from->count);
  Point* const to = out.data() + before;
  return each<3>(a, *from, " has a position " + noPlaceWithin(limits), [&](size_t i, const std::array<double, 3>& v) {
    to[i] = {v[0], v[1], v[2]};
    return limits.isPlace(v[0], v[1], v[2]);
  });
}

Result<void> GlbAccessors::vectors(size_t a, size_t count, std::vector<Point>& out) const {
  const Result<Elements> from = elements(a, Type::triple, Holds::small);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t before = out.size();
  out.resize(before + count);
  return each<3>(a, *from, " has a number that is not finite", [&](size_t i, const std::array<double, 3>& v) {
    out[before + i] = {v[0], v[1], v[2]};
    return isFloat(v[0]) && isFloat(v[1]) && isFloat(v[2]);
  });
}

Result<void> GlbAccessors::normals(size_t a, size_t count, std::vector<Normal>& out) const {
  const Result<Elements> from = elements(a, Type::triple, Holds::small);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t before = out.size();
  out.resize(before + count);
  Normal* const to = out.data() + before;
  return each<3>(a, *from, " has a normal that is not finite", [&](size_t i, const std::array<double, 3>& v) {
    to[i] = {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    return isFloat(v[0]) && isFloat(v[1]) && isFloat(v[2]);
  });
}

Result<void> GlbAccessors::coordinates(size_t a, size_t count, std::vector<TextureCoordinates>& out) const {
  const Result<Elements> from = elements(a, Type::pair, quantized_ ? Holds::small : Holds::fractions);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t before = out.size();
  out.resize(before + count);
  return each<2>(a, *from, " has texture coordinates that are not finite",
                 [&](size_t i, const std::array<double, 2>& v) {
                   out[before + i] = {static_cast<float>(v[0]), static_cast<float>(v[1])};
                   return isFloat(v[0]) && isFloat(v[1]);
                 });
}

Result<void> GlbAccessors::fractions(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const {
  const Result<Elements> from = elements(a, Type::quadruple, Holds::fractions);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t before = out.size();
  out.resize(before + count);
  return each<4>(a, *from, " has a number that is not finite", [&](size_t i, const std::array<double, 4>& v) {
    out[before + i] = v;
    return isFloat(v[0]) && isFloat(v[1]) && isFloat(v[2]) && isFloat(v[3]);
  });
}

Result<void> GlbAccessors::joints(size_t a, size_t count, std::vector<std::array<double, 4>>& out) const {
  const Result<Elements> from = elements(a, Type::quadruple, Holds::unsigned_small);
  if (!from) return from.error();
  if (Result<void> many = asManyAs(a, count); !many) return many;
  const size_t before = out.size();
  out.resize(before + count);
  return each<4>(a, *from, "", [&](size_t i, const std::array<double, 4>& v) {
    out[before + i] = v;
    return true;
  });
}

Result<void> GlbAccessors::matrices(size_t a, size_t least, std::vector<std::array<double, 16>>& out) const {
  const Result<Elements> from = elements(a, Type::matrix, Holds::floats);
  if (!from) return from.error();
  if (from->count < least) return wrongIn(a, "count", " holds fewer matrices than the skin has joints");
  out.resize(from->count);
  return each<16>(a, *from, " has a number that is not finite", [&](size_t i, const std::array<double, 16>& v) {
    out[i] = v;
    return std::all_of(v.begin(), v.end(), isFloat);
  });
}

Result<void> GlbAccessors::indices(size_t a, size_t points, const MeshLimits& limits,
                                   std::vector<uint32_t>& out) const {
  const Result<Elements> from = elements(a, Type::scalar, Holds::indices);
  if (!from) return from.error();
  if (from->count / 3 > limits.triangles) return overLimit(limits.triangles, "triangles");
  out.resize(from->count);
  return each<1>(a, *from, noPointOf(points), [&](size_t i, const std::array<double, 1>& v) {
    out[i] = static_cast<uint32_t>(v[0]);
    return v[0] < static_cast<double>(points);
  });
}

Result<void> GlbAccessors::triangles(size_t a, const GlbCorners& corners, const MeshLimits& limits,
                                     std::vector<std::array<uint32_t, 3>>& out) const {
  const Result<Elements> from = elements(a, Type::scalar, Holds::indices);
  if (!from) return from.error();
  if (from->count % 3 != 0) return wrongIn(a, "count", " ends within a triangle");
  if (from->count / 3 > limits.triangles - out.size()) return overLimit(limits.triangles, "triangles");
  const size_t bytes = componentBytes(accessors_[a].component);
  if (from->first == nullptr || accessors_[a].sparse) {
    std::vector<uint32_t> list;
    if (Result<void> read = indices(a, corners.points, limits, list); !read) return read;
    for (size_t t = 0; t < list.size() / 3; ++t) {
      const uint32_t *const index = &list[3 * t], second = corners.mirrored ? 2 : 1;
      out.push_back({corners.first + index[0], corners.first + index[second], corners.first + index[3 - second]});
    }
    return {};
  }
  if (from->stride != bytes)
    return wrongInJson("indices have a stride of their own",
                       "/bufferViews/" + std::to_string(*accessors_[a].view) + "/byteStride");
  const auto beyond = bytes == 4   ? appendTriangles<uint32_t>(from->first, from->count, corners, out)
                      : bytes == 2 ? appendTriangles<uint16_t>(from->first, from->count, corners, out)
                                   : appendTriangles<uint8_t>(from->first, from->count, corners, out);
  if (!beyond) return {};
  return wrongAt(a, noPointOf(corners.points), from->buffer, from->first + *beyond * bytes);
}

}  // namespace sgm::asset
