#include "asset/read/ply_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "asset/read/mesh_notes.h"
#include "asset/read/ply_header.h"
#include "asset/read/ply_values.h"
#include "asset/read/polygon_cutter.h"
#include "asset/read/text_reader.h"

namespace sgm::asset {

namespace {

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

  static constexpr std::string_view kUnit = "byte";

  void beginRecord() { element_ = at_; }
  bool endRecord() { return true; }
  [[gnu::always_inline]] bool take(PlyType type, double& out) {
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
  size_t place() const { return element_; }
  bool mustReadAll() const { return false; }
  static bool hasSpareLines() { return false; }
  Result<void> end(bool whole, std::vector<std::string>& notes) {
    if (whole && at_ < bytes_.size())
      notes.push_back(
          counted(bytes_.size() - at_, "byte after its last element is", "bytes after its last element are") +
          " left out, at " + byteText(at_));
    return {};
  }
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
    const bool strips = named("tristrips") != header_.elements.end();
    if (!strips && named("face") == header_.elements.end())
      return Error{Code::bad_input, "it has no element `face`", 0, 0};
    vertex_count_ = std::min(vertices->count, limits_.maxPoints());
    size_t due = 0;  // number of element kinds up to the last one with points or triangles; later kinds need not be
                     // read
    for (size_t i = 0; i < header_.elements.size(); ++i)
      if (isRead(header_.elements[i])) due = i + 1;
    size_t next = 0;
    for (; next < header_.elements.size() && (next < due || values_.mustReadAll()); ++next)
      if (Result<void> read = elements(header_.elements[next]); !read) return read.error();
    const bool whole = next == header_.elements.size();
    if (Result<void> ended = values_.end(whole, mesh_.notes); !ended) return ended.error();
    if (mesh_.triangles.empty()) return Error{Code::bad_input, "it has no triangles", 0, 0};
    if (Result<void> done = cutter_.finish(); !done) return done.error();
    addNote(mesh_.notes, small_, "face has fewer than three corners and is left out",
            "faces have fewer than three corners and are left out");
    mesh_.materials.assign(mesh_.triangles.size(), kNoMaterial);
    return std::move(mesh_);
  }

 private:
  static bool isRead(const PlyElement& element) {
    return element.name == "vertex" || element.name == "face" || element.name == "tristrips";
  }

  Result<void> elements(const PlyElement& element) {
    values_.beginRecord();
    if (!element.properties.empty() && element.count > values_.most(element))
      return values_.wrong("its header declares " + std::to_string(element.count) + " of the element " +
                           shown(element.name) + ", and it has bytes for " + std::to_string(values_.most(element)) +
                           " at most");
    if (element.name == "vertex") return vertices(element);
    if (isRead(element)) return faces(element);
    // Skip elements without properties: they take no bytes, so the declared number may be arbitrarily large.
    for (size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      values_.beginRecord();
      for (const PlyProperty& p : element.properties)
        if (!skip(p)) return endsWithin(element, i);
      if (!values_.endRecord()) return endsWithin(element, i);
    }
    return {};
  }

  Error endsWithin(const PlyElement& element, size_t i) const {
    return values_.wrong((bad_length_ ? "it has a list without a length" : values_.problem()) + " within " +
                         std::to_string(i) + " of " + std::to_string(element.count) + " of the element " +
                         shown(element.name) + ", counted from 0" + perhapsVertices(element));
  }

  /// Returns a hint for errors after the vertices of a text file: an invalid line may be a vertex that the header does
  /// not count.
  std::string perhapsVertices(const PlyElement& element) const {
    if (element.name == "vertex" || !values_.hasSpareLines()) return {};
    return ": the file has more lines than the header declares, perhaps more vertices";
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
  /// Returns, for each property, which of the values x y z nx ny nz u v it sets (0..7); kNowhere if none.
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
    if (element.count > limits_.maxPoints()) return overLimit(limits_.maxPoints(), "points");
    mesh_.points.reserve(element.count);
    if (has_normals_) mesh_.normals.values.reserve(element.count);
    if (has_coordinates_) mesh_.coordinates.values.reserve(element.count);
    for (size_t i = 0; i < element.count; ++i) {
      double v[kNowhere + 1] = {};
      values_.beginRecord();
      for (size_t p = 0; p < role.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.count ? !skip(property) : !values_.take(property.type, v[role[p]])) return endsWithin(element, i);
      }
      if (!values_.endRecord()) return endsWithin(element, i);
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

  /// Reads all elements `face` or `tristrips`.
  Result<void> faces(const PlyElement& element) {
    if (element.count == 0) return {};
    const size_t count = element.properties.size();
    const size_t list = std::min(element.find("vertex_indices"), element.find("vertex_index"));
    if (list == count || !element.properties[list].count || element.properties[list].type >= PlyType::float32)
      return Error{Code::bad_input,
                   "its element " + shown(element.name) + " has no list `vertex_indices` of whole numbers", 0, 0};
    const bool strips = element.name == "tristrips";
    mesh_.triangles.reserve(std::min(element.count, limits_.triangles));
    for (size_t i = 0; i < element.count; ++i) {
      values_.beginRecord();
      for (size_t p = 0; p < count; ++p) {
        const PlyProperty& property = element.properties[p];
        if (p != list && !skip(property)) return endsWithin(element, i);
        if (p != list) continue;
        if (Result<void> read = face(element, i, property, strips); !read) return read;
      }
      if (!values_.endRecord()) return endsWithin(element, i);
    }
    return {};
  }

  /// Reads a list of point indices: the corners of a face or, if `strips`, triangle strips separated by -1.
  Result<void> face(const PlyElement& element, size_t i, const PlyProperty& list, bool strips) {
    double length = 0;
    if (!takeLength(list, length)) return endsWithin(element, i);
    corners_.clear();
    for (double k = 0; k < length; ++k) {
      double value = 0;
      if (!values_.take(list.type, value)) return endsWithin(element, i);
      const bool ends = strips && value == -1;
      if (!ends && (!(value >= 0 && value < static_cast<double>(vertex_count_)) || value != std::floor(value)))
        return values_.wrong((strips ? "strip " : "face ") + std::to_string(i) +
                             " has a corner that is not one of the file's " + std::to_string(vertex_count_) +
                             " vertices" + perhapsVertices(element));
      corners_.push_back(ends ? kStripEnd : static_cast<uint32_t>(value));
    }
    if (strips) return strip();
    return corners_.size() == 3 ? triangle(corners_[0], corners_[1], corners_[2]) : polygon();
  }

  Result<void> triangle(uint32_t a, uint32_t b, uint32_t c) {
    if (mesh_.triangles.size() >= limits_.triangles) return overLimit(limits_.triangles, "triangles");
    mesh_.triangles.push_back({a, b, c});
    return {};
  }

  Result<void> polygon() {
    if (corners_.size() < 3) {
      small_.add([&] { return std::string(Values::kUnit) + " " + std::to_string(values_.place()); });
      return {};
    }
    dropRepeatedCorners(corners_, std::equal_to<uint32_t>());
    for (size_t k = 2; k < corners_.size(); ++k)
      if (Result<void> made = triangle(corners_[0], corners_[k - 1], corners_[k]); !made) return made;
    return corners_.size() == 3 ? Result<void>() : cutter_.add(corners_.size(), values_.place());
  }

  /// Adds the triangles of a strip, every other one reversed. Degenerate triangles with a repeated corner are left out:
  /// they only connect strips.
  Result<void> strip() {
    size_t begin = 0;
    for (size_t k = 0; k < corners_.size(); ++k) {
      if (corners_[k] == kStripEnd) begin = k + 1;
      if (k < begin + 2) continue;
      const uint32_t a = corners_[k - 2], b = corners_[k - 1], c = corners_[k];
      if (a == b || b == c || c == a) continue;
      const bool odd = (k - begin) % 2 == 1;
      if (Result<void> made = odd ? triangle(b, a, c) : triangle(a, b, c); !made) return made;
    }
    return {};
  }

  static constexpr uint32_t kStripEnd = 0xFFFFFFFFu;

  const PlyHeader& header_;
  const MeshLimits& limits_;
  Values values_;
  TriangleMesh mesh_;
  PolygonCutter cutter_{mesh_, Values::kUnit};
  std::vector<uint32_t> corners_;
  NotedPlaces small_;
  size_t vertex_count_ = 0;
  bool bad_length_ = false;
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
