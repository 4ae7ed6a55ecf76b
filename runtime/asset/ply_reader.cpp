#include "asset/ply_reader.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "asset/ply_header.h"
#include "asset/text_reader.h"

namespace sgm::asset {

namespace {

/// The numbers of a text, one behind the other; lines play no part but in messages.
class PlyTextValues {
 public:
  PlyTextValues(std::string_view file, const PlyHeader& header)
      : text_(file.substr(header.bytes)), lines_before_(header.lines) {}

  void beginElement() {}
  bool take(PlyType, double& out) {
    const std::string_view word = text_.wordOfAnyLine();
    const std::optional<double> value = numberIn(word);
    if (!value) problem_ = word.empty() ? "it ends" : "it has " + shown(word) + ", which is no number,";
    out = value.value_or(0);
    return value.has_value();
  }
  /// Each number takes a digit and a blank.
  size_t most(const PlyElement& element) const { return (text_.bytesLeft() + 1) / (2 * element.properties.size()); }
  const std::string& problem() const { return problem_; }
  Error wrong(std::string_view what) const { return wrongAtLine(what, lines_before_ + text_.line()); }

 private:
  TextReader text_;
  size_t lines_before_;
  std::string problem_;
};

template <class T, bool kBigEndian>
double numberAt(const std::byte* at) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (kBigEndian) std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

template <bool kBigEndian>
class PlyBinaryValues {
 public:
  PlyBinaryValues(std::string_view file, const PlyHeader& header)
      : bytes_(std::as_bytes(std::span(file))), at_(header.bytes), element_(at_) {}

  void beginElement() { element_ = at_; }
  bool take(PlyType type, double& out) {
    if (bytes_.size() - at_ < sizeOf(type)) return false;
    const std::byte* const from = bytes_.data() + at_;
    at_ += sizeOf(type);
    switch (type) {
      case PlyType::int8:
        out = numberAt<int8_t, kBigEndian>(from);
        break;
      case PlyType::uint8:
        out = numberAt<uint8_t, kBigEndian>(from);
        break;
      case PlyType::int16:
        out = numberAt<int16_t, kBigEndian>(from);
        break;
      case PlyType::uint16:
        out = numberAt<uint16_t, kBigEndian>(from);
        break;
      case PlyType::int32:
        out = numberAt<int32_t, kBigEndian>(from);
        break;
      case PlyType::uint32:
        out = numberAt<uint32_t, kBigEndian>(from);
        break;
      case PlyType::float32:
        out = numberAt<float, kBigEndian>(from);
        break;
      case PlyType::float64:
        out = numberAt<double, kBigEndian>(from);
        break;
    }
    return true;
  }
  size_t most(const PlyElement& element) const {
    size_t least = 0;
    for (const PlyProperty& p : element.properties) least += sizeOf(p.count.value_or(p.type));
    return (bytes_.size() - at_) / least;
  }
  std::string problem() const { return "it ends"; }
  Error wrong(std::string_view what) const { return wrongAtByte(what, element_); }

 private:
  std::span<const std::byte> bytes_;
  size_t at_, element_;
};

template <class Values>
class PlyBodyReader {
 public:
  PlyBodyReader(std::string_view file, const PlyHeader& header, const MeshLimits& limits)
      : header_(header), limits_(limits), values_(file, header) {}

  Result<TriangleMesh> run() {
    const auto named = [&](std::string_view name) {
      return std::find_if(header_.elements.begin(), header_.elements.end(),
                          [&](const PlyElement& e) { return e.name == name; });
    };
    const auto vertices = named("vertex");
    if (vertices == header_.elements.end()) return Error{Code::bad_input, "it has no element `vertex`", 0, 0};
    if (named("face") == header_.elements.end()) return Error{Code::bad_input, "it has no element `face`", 0, 0};
    vertex_count_ = std::min(vertices->count, limits_.mostPoints());
    for (const PlyElement& element : header_.elements) {
      if (Result<void> read = elements(element); !read) return read.error();
      // What comes behind both is nobody's.
      if (points_read_ && faces_read_) break;
    }
    if (mesh_.triangles.empty()) return Error{Code::bad_input, "it has no triangles", 0, 0};
    mesh_.materials.assign(mesh_.triangles.size(), kNoMaterial);
    return std::move(mesh_);
  }

 private:
  Result<void> elements(const PlyElement& element) {
    const bool vertex = element.name == "vertex", face = element.name == "face";
    points_read_ = points_read_ || vertex;
    faces_read_ = faces_read_ || face;
    values_.beginElement();
    if (!element.properties.empty() && element.count > values_.most(element))
      return values_.wrong("it says that it has " + std::to_string(element.count) + " of the element " +
                           shown(element.name) + ", and has bytes for " + std::to_string(values_.most(element)) +
                           " at most");
    if (vertex) return vertices(element);
    if (face) return faces(element);
    // Without properties they are nothing, however many.
    for (size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      values_.beginElement();
      for (const PlyProperty& p : element.properties)
        if (!skip(p)) return endsWithin(element, i);
    }
    return {};
  }

  Error endsWithin(const PlyElement& element, size_t i) const {
    return values_.wrong((bad_length_ ? "it has a list of no length" : values_.problem()) + " within " +
                         std::to_string(i) + " of " + std::to_string(element.count) + " of the element " +
                         shown(element.name) + ", counted from 0");
  }

  bool skip(const PlyProperty& property) {
    double value = 0, length = 1;
    if (property.count && !takeLength(property, length)) return false;
    for (double i = 0; i < length; ++i)
      if (!values_.take(property.type, value)) return false;
    return true;
  }

  bool takeLength(const PlyProperty& property, double& length) {
    if (!values_.take(*property.count, length)) return false;
    bad_length_ = !(length >= 0) || length != std::floor(length);
    return !bad_length_;
  }

  static constexpr size_t kNowhere = 8;
  /// Where each property goes: x y z, nx ny nz, u v, or nowhere.
  std::vector<size_t> roles(const PlyElement& element) {
    std::vector<size_t> out(element.properties.size(), kNowhere);
    const auto give = [&](std::initializer_list<std::string_view> names, size_t first) {
      for (const std::string_view name : names) {
        const size_t i = element.find(name);
        if (i == element.properties.size() || element.properties[i].count) return false;
      }
      for (const std::string_view name : names) out[element.find(name)] = first++;
      return true;
    };
    has_places_ = give({"x", "y", "z"}, 0);
    has_normals_ = give({"nx", "ny", "nz"}, 3);
    has_coordinates_ = give({"u", "v"}, 6) || give({"s", "t"}, 6) || give({"texture_u", "texture_v"}, 6);
    return out;
  }

  Result<void> vertices(const PlyElement& element) {
    const std::vector<size_t> role = roles(element);
    if (!has_places_) return Error{Code::bad_input, "its element `vertex` has not all of x, y and z", 0, 0};
    if (element.count > limits_.mostPoints()) return overLimit(limits_.mostPoints(), "points");
    mesh_.points.reserve(element.count);
    if (has_normals_) mesh_.normals.values.reserve(element.count);
    if (has_coordinates_) mesh_.coordinates.values.reserve(element.count);
    for (size_t i = 0; i < element.count; ++i) {
      double v[kNowhere + 1] = {};
      values_.beginElement();
      for (size_t p = 0; p < role.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.count ? !skip(property) : !values_.take(property.type, v[role[p]])) return endsWithin(element, i);
      }
      const auto vertex = [&] { return "vertex " + std::to_string(i) + " has "; };
      if (!limits_.isPlace(v[0], v[1], v[2])) return values_.wrong(vertex() + "a position " + noPlaceWithin(limits_));
      mesh_.points.push_back({v[0], v[1], v[2]});
      if (has_normals_) {
        if (!isFloat(v[3]) || !isFloat(v[4]) || !isFloat(v[5]))
          return values_.wrong(vertex() + "a normal that is not finite");
        mesh_.normals.values.push_back(unitNormal(v[3], v[4], v[5]));
      }
      if (has_coordinates_) {
        if (!isFloat(v[6]) || !isFloat(v[7]))
          return values_.wrong(vertex() + "texture coordinates that are not finite");
        mesh_.coordinates.values.push_back({static_cast<float>(v[6]), static_cast<float>(v[7])});
      }
    }
    return {};
  }

  Result<void> faces(const PlyElement& element) {
    const size_t count = element.properties.size();
    const size_t list = std::min(element.find("vertex_indices"), element.find("vertex_index"));
    if (list == count || !element.properties[list].count || element.properties[list].type >= PlyType::float32)
      return Error{Code::bad_input, "its element `face` has no list `vertex_indices` of whole numbers", 0, 0};
    mesh_.triangles.reserve(std::min(element.count, limits_.triangles));
    for (size_t i = 0; i < element.count; ++i) {
      values_.beginElement();
      for (size_t p = 0; p < count; ++p) {
        if (p != list && !skip(element.properties[p])) return endsWithin(element, i);
        if (p != list) continue;
        if (Result<void> read = face(element, i, element.properties[p]); !read) return read;
      }
    }
    return {};
  }

  Result<void> face(const PlyElement& element, size_t i, const PlyProperty& list) {
    double length = 0;
    if (!takeLength(list, length)) return endsWithin(element, i);
    uint32_t first = 0, last = 0;
    for (double k = 0; k < length; ++k) {
      double value = 0;
      if (!values_.take(list.type, value)) return endsWithin(element, i);
      if (!(value >= 0 && value < static_cast<double>(vertex_count_)) || value != std::floor(value))
        return values_.wrong("face " + std::to_string(i) + " has a corner that is none of the file's " +
                             std::to_string(vertex_count_) + " vertices");
      const uint32_t corner = static_cast<uint32_t>(value);
      if (k >= 2) {
        if (mesh_.triangles.size() >= limits_.triangles) return overLimit(limits_.triangles, "triangles");
        mesh_.triangles.push_back({first, last, corner});
      }
      if (k == 0) first = corner;
      last = corner;
    }
    return {};
  }

  const PlyHeader& header_;
  const MeshLimits& limits_;
  Values values_;
  TriangleMesh mesh_;
  size_t vertex_count_ = 0;
  bool points_read_ = false, faces_read_ = false, bad_length_ = false;
  bool has_places_ = false, has_normals_ = false, has_coordinates_ = false;
};

}  // namespace

Result<TriangleMesh> readPly(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Result<PlyHeader> header = readPlyHeader(file);
  if (!header) return header.error();
  if (header->format == PlyFormat::ascii) return PlyBodyReader<PlyTextValues>(file, *header, limits).run();
  if (header->format == PlyFormat::binary_big_endian)
    return PlyBodyReader<PlyBinaryValues<true>>(file, *header, limits).run();
  return PlyBodyReader<PlyBinaryValues<false>>(file, *header, limits).run();
}

}  // namespace sgm::asset
