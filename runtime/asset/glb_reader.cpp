#include "asset/glb_reader.h"

#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "asset/glb_accessor.h"
#include "asset/json_reader.h"

namespace sgm::asset {

namespace {

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr size_t kTriangles = 4;  ///< a primitive's mode
constexpr size_t kDeepestNode = 64;

Error refuse(std::string message) { return {Code::bad_input, std::move(message), 0, 0}; }

uint32_t wordAt(std::span<const std::byte> bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

struct Chunks {
  std::string_view json;
  std::span<const std::byte> binary;
};

Result<Chunks> chunksOf(std::span<const std::byte> bytes) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes || wordAt(bytes, 0) != kMagic)
    return refuse("it is no GLB file: it does not begin with `glTF`");
  if (wordAt(bytes, 4) != 2) return refuse("it is glTF of version " + std::to_string(wordAt(bytes, 4)) + ", not 2");
  if (wordAt(bytes, 8) != bytes.size())
    return refuse("it says that it has " + std::to_string(wordAt(bytes, 8)) + " bytes, and has " +
                  std::to_string(bytes.size()));
  Chunks out;
  size_t at = kHeaderBytes;
  for (size_t number = 0; bytes.size() - at >= kChunkHeaderBytes; ++number) {
    const size_t size = wordAt(bytes, at);
    const uint32_t kind = wordAt(bytes, at + 4);
    at += kChunkHeaderBytes;
    if (size > bytes.size() - at) return refuse("a part of it reaches beyond its end");
    const auto part = bytes.subspan(at, size);
    if (number == 0 && kind != kJsonChunk) return refuse("its first part is not JSON");
    if (number == 0) out.json = {reinterpret_cast<const char*>(part.data()), part.size()};
    if (number == 1 && kind == kBinaryChunk) out.binary = part;
    // Parts are padded to four bytes.
    at += std::min((size + 3) / 4 * 4, bytes.size() - at);
  }
  return out;
}

/// p -> columns * p + origin.
struct Transform {
  std::array<Point, 3> columns{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  Point origin;

  Point turned(Point p) const { return p.x * columns[0] + p.y * columns[1] + p.z * columns[2]; }
  Point operator()(Point p) const { return turned(p) + origin; }
  Transform after(const Transform& inner) const {
    return {{turned(inner.columns[0]), turned(inner.columns[1]), turned(inner.columns[2])}, (*this)(inner.origin)};
  }
  bool mirrors() const { return dot(cross(columns[0], columns[1]), columns[2]) < 0; }
};

/// As many numbers as there are in `out`; false where the member is something else. A missing one leaves them be.
template <size_t N>
bool readNumbers(const JsonValue& node, std::string_view name, std::array<double, N>& out) {
  if (node.find(name) == nullptr) return true;
  const auto list = node.list(name);
  if (list.size() != N) return false;
  for (size_t i = 0; i < N; ++i) {
    if (list[i].kind != JsonValue::Kind::number || !(std::fabs(list[i].number) <= 1e9)) return false;
    out[i] = list[i].number;
  }
  return true;
}

Result<Transform> transformOf(const JsonValue& node, size_t number) {
  const std::string name = "node " + std::to_string(number);
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::array<double, 3> moved{}, scaled{1, 1, 1};
  std::array<double, 4> q{0, 0, 0, 1};
  if (!readNumbers(node, "matrix", m) || !readNumbers(node, "translation", moved) ||
      !readNumbers(node, "scale", scaled) || !readNumbers(node, "rotation", q))
    return refuse(name + " is moved by what are not numbers, or not as many as it takes");
  Transform out;
  if (node.find("matrix") != nullptr) {
    out.columns = {Point{m[0], m[1], m[2]}, Point{m[4], m[5], m[6]}, Point{m[8], m[9], m[10]}};
    out.origin = {m[12], m[13], m[14]};
    return out;
  }
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(size > 0)) return refuse(name + " is turned by a quaternion without a length");
  const double x = q[0] / size, y = q[1] / size, z = q[2] / size, w = q[3] / size;
  out.columns[0] = scaled[0] * Point{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
  out.columns[1] = scaled[1] * Point{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
  out.columns[2] = scaled[2] * Point{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
  out.origin = {moved[0], moved[1], moved[2]};
  return out;
}

class SceneReader {
 public:
  SceneReader(const JsonValue& root, std::span<const std::byte> binary, const GlbLimits& limits)
      : root_(root), accessors_(root, binary), limits_(limits) {}

  Result<TriangleMesh> run() {
    for (const JsonValue& material : root_.list("materials")) {
      const JsonValue* name = material.find("name");
      mesh_.material_names.push_back(name != nullptr ? name->text : std::string());
    }
    const auto nodes = root_.list("nodes");
    if (nodes.size() > limits_.nodes)
      return Error{Code::limit, "it has more than " + std::to_string(limits_.nodes) + " nodes", 0, 0};
    seen_.assign(nodes.size(), false);
    if (Result<void> found = roots(); !found) return found.error();
    while (!open_.empty()) {
      const Open next = std::move(open_.back());
      open_.pop_back();
      if (Result<void> read = node(next); !read) return read.error();
    }
    if (mesh_.triangles.empty()) return refuse("it shows no triangles");
    return std::move(mesh_);
  }

 private:
  struct Open {
    size_t node, depth;
    Transform place;
  };

  /// Puts the scene's nodes on the list, the first one last.
  Result<void> roots() {
    const auto nodes = root_.list("nodes"), scenes = root_.list("scenes");
    std::vector<size_t> first;
    if (scenes.empty()) {
      std::vector<bool> child(nodes.size(), false);
      for (const JsonValue& node : nodes)
        for (const JsonValue& below : node.list("children"))
          if (const auto i = whole(below); i && *i < nodes.size()) child[*i] = true;
      for (size_t i = 0; i < nodes.size(); ++i)
        if (!child[i]) first.push_back(i);
    } else {
      const size_t scene = root_.count("scene").value_or(0);
      if (scene >= scenes.size()) return refuse("its scene is not there");
      for (const JsonValue& node : scenes[scene].list("nodes")) first.push_back(whole(node).value_or(nodes.size()));
    }
    for (size_t i = first.size(); i-- > 0;) open_.push_back({first[i], 0, {}});
    return {};
  }

  static std::optional<size_t> whole(const JsonValue& value) {
    if (value.kind != JsonValue::Kind::number || !(value.number >= 0 && value.number < 1e9)) return std::nullopt;
    return static_cast<size_t>(value.number);
  }

  Result<void> node(const Open& at) {
    const auto nodes = root_.list("nodes");
    if (at.node >= nodes.size()) return refuse("a node that is named is not there");
    if (seen_[at.node] || at.depth > kDeepestNode)
      return refuse("node " + std::to_string(at.node) + " stands below two others, or too deep");
    seen_[at.node] = true;
    const JsonValue& value = nodes[at.node];
    const Result<Transform> own = transformOf(value, at.node);
    if (!own) return own.error();
    const Transform place = at.place.after(*own);
    if (value.find("mesh") != nullptr) {
      const auto meshes = root_.list("meshes");
      const auto number = value.count("mesh");
      if (!number || *number >= meshes.size())
        return refuse("node " + std::to_string(at.node) + " shows a mesh that is not there");
      for (const JsonValue& primitive : meshes[*number].list("primitives"))
        if (Result<void> read = this->primitive(primitive, *number, place); !read) return read;
    }
    const auto children = value.list("children");
    for (size_t i = children.size(); i-- > 0;)
      open_.push_back({whole(children[i]).value_or(nodes.size()), at.depth + 1, place});
    return {};
  }

  Result<void> primitive(const JsonValue& value, size_t mesh, const Transform& place) {
    const std::string name = "mesh " + std::to_string(mesh);
    if (value.count("mode").value_or(kTriangles) != kTriangles) return refuse(name + " is not made of triangles");
    const JsonValue* attributes = value.find("attributes");
    const auto position = attributes != nullptr ? attributes->count("POSITION") : std::nullopt;
    if (!position) return refuse(name + " has no positions");
    const size_t first = mesh_.points.size();
    const Result<std::vector<Point>> points = accessors_.points(*position, limits_.points - first);
    if (!points) return points.error();
    for (const Point& p : *points) mesh_.points.push_back(place(p));
    std::vector<uint32_t> corners;
    const size_t most = 3 * (limits_.triangles - mesh_.triangles.size());
    if (value.find("indices") != nullptr) {
      const auto accessor = value.count("indices");
      if (!accessor) return refuse(name + " has indices that are not there");
      Result<std::vector<uint32_t>> indices = accessors_.indices(*accessor, most);
      if (!indices) return indices.error();
      corners = std::move(*indices);
    } else if (points->size() > most) {
      return Error{Code::limit, "it has more than " + std::to_string(limits_.triangles) + " triangles", 0, 0};
    } else {
      for (uint32_t i = 0; i < points->size(); ++i) corners.push_back(i);
    }
    if (corners.size() % 3 != 0) return refuse(name + " ends within a triangle");
    const size_t material = value.count("material").value_or(mesh_.material_names.size());
    const bool named = material < mesh_.material_names.size() && !mesh_.material_names[material].empty();
    const bool mirrored = place.mirrors();
    for (size_t i = 0; i < corners.size(); i += 3) {
      std::array<uint32_t, 3> triangle{};
      for (size_t k = 0; k < 3; ++k) {
        if (corners[i + k] >= points->size()) return refuse(name + " has a triangle with a corner that is not there");
        triangle[k] = static_cast<uint32_t>(first + corners[i + k]);
      }
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
      mesh_.materials.push_back(named ? static_cast<uint32_t>(material) : kNoMaterial);
    }
    return {};
  }

  const JsonValue& root_;
  GlbAccessors accessors_;
  const GlbLimits& limits_;
  TriangleMesh mesh_;
  std::vector<bool> seen_;
  std::vector<Open> open_;
};

/// Extensions that change nothing of where triangles lie.
bool harmless(std::string_view extension) {
  return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
         extension == "KHR_lights_punctual" || extension == "EXT_texture_webp";
}

}  // namespace

Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const GlbLimits& limits) {
  const Result<Chunks> chunks = chunksOf(bytes);
  if (!chunks) return chunks.error();
  if (chunks->json.size() > limits.json_bytes)
    return Error{Code::limit, "its JSON has more than " + std::to_string(limits.json_bytes) + " bytes", 0, 0};
  const Result<JsonValue> root = readJson(chunks->json);
  if (!root) return root.error();
  for (const JsonValue& extension : root->list("extensionsRequired"))
    if (!harmless(extension.text)) return refuse("it needs the extension `" + extension.text + "`");
  return SceneReader(*root, chunks->binary, limits).run();
}

}  // namespace sgm::asset
