#include "asset/glb_reader.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "asset/glb_accessor.h"
#include "asset/glb_transform.h"
#include "asset/json_reader.h"
#include "asset/text_reader.h"

namespace sgm::asset {

namespace {

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr size_t kTriangles = 4;  ///< a primitive's mode
constexpr size_t kDeepestNode = 64;

uint32_t wordAt(std::span<const std::byte> bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

struct Chunks {
  std::string_view json;
  std::span<const std::byte> binary;
  size_t binary_at = 0;
};

Result<Chunks> chunksOf(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof kMagic || wordAt(bytes, 0) != kMagic)
    return Error{Code::bad_input, "it is no GLB file: it does not begin with `glTF`", 0, 0};
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) return wrongAtByte("it ends within its header", bytes.size());
  if (wordAt(bytes, 4) != 2)
    return wrongAtByte("it is glTF of version " + std::to_string(wordAt(bytes, 4)) + ", not 2", 4);
  if (wordAt(bytes, 8) != bytes.size())
    return wrongAtByte(
        "it says that it has " + std::to_string(wordAt(bytes, 8)) + " bytes, and has " + std::to_string(bytes.size()),
        8);
  Chunks out;
  size_t at = kHeaderBytes;
  for (size_t number = 0; bytes.size() - at >= kChunkHeaderBytes; ++number) {
    const size_t size = wordAt(bytes, at);
    const uint32_t kind = wordAt(bytes, at + 4);
    if (size > bytes.size() - at - kChunkHeaderBytes) return wrongAtByte("a part of it reaches beyond its end", at);
    if (number == 0 && kind != kJsonChunk) return wrongAtByte("its first part is not JSON", at + 4);
    at += kChunkHeaderBytes;
    const auto part = bytes.subspan(at, size);
    if (number == 0) out.json = {reinterpret_cast<const char*>(part.data()), part.size()};
    if (number == 1 && kind == kBinaryChunk) {
      out.binary = part;
      out.binary_at = at;
    }
    // Parts are padded to four bytes.
    at += std::min((size + 3) / 4 * 4, bytes.size() - at);
  }
  return out;
}

std::optional<size_t> wholeOf(const JsonValue& value) {
  if (value.kind != JsonValue::Kind::number || !(value.number >= 0 && value.number < 1e9)) return std::nullopt;
  return static_cast<size_t>(value.number);
}

/// A primitive as the file says: numbers of accessors.
struct GlbPrimitive {
  static constexpr size_t kAbsent = SIZE_MAX, kWrong = SIZE_MAX - 1;
  size_t mode = kTriangles, material = kAbsent;
  size_t position = kAbsent, normal = kAbsent, coordinates = kAbsent, indices = kAbsent;

  explicit GlbPrimitive(const JsonValue& value) {
    const auto number = [](const JsonValue* of, std::string_view name) {
      return of == nullptr || of->find(name) == nullptr ? kAbsent : of->count(name).value_or(kWrong);
    };
    const JsonValue* attributes = value.find("attributes");
    mode = value.find("mode") == nullptr ? kTriangles : number(&value, "mode");
    material = number(&value, "material");
    position = number(attributes, "POSITION");
    normal = number(attributes, "NORMAL");
    coordinates = number(attributes, "TEXCOORD_0");
    indices = number(&value, "indices");
  }
};

class SceneReader {
 public:
  SceneReader(const JsonValue& root, const Chunks& chunks, const MeshLimits& limits)
      : root_(root), nodes_(root.list("nodes")), accessors_(root, chunks.binary, chunks.binary_at), limits_(limits) {}

  Result<TriangleMesh> run() {
    for (const JsonValue& material : root_.list("materials")) {
      const JsonValue* name = material.find("name");
      mesh_.material_names.push_back(name != nullptr ? name->text : std::string());
    }
    // Read once: nodes may show one mesh many times.
    for (const JsonValue& mesh : root_.list("meshes")) {
      std::vector<GlbPrimitive>& primitives = meshes_.emplace_back();
      for (const JsonValue& primitive : mesh.list("primitives")) primitives.emplace_back(primitive);
    }
    makeRoom();
    if (nodes_.size() > limits_.nodes) return overLimit(limits_.nodes, "nodes");
    seen_.assign(nodes_.size(), false);
    if (Result<void> found = roots(); !found) return found.error();
    while (!open_.empty()) {
      const Open next = std::move(open_.back());
      open_.pop_back();
      if (Result<void> read = node(next); !read) return read.error();
    }
    if (mesh_.triangles.empty()) return Error{Code::bad_input, "it shows no triangles", 0, 0};
    if (!mesh_.normals.empty()) mesh_.normals.values.resize(mesh_.points.size());
    if (!mesh_.coordinates.empty()) mesh_.coordinates.values.resize(mesh_.points.size());
    return std::move(mesh_);
  }

 private:
  struct Open {
    size_t node, depth;
    GlbTransform place;
    size_t parent;  ///< a node, or as many as there are: the scene
  };

  /// For each mesh shown once, all at once: what grows step by step is there twice. Never for more than the bytes that
  /// are there can hold.
  void makeRoom() {
    size_t points = 0, corners = 0;
    bool normals = false, coordinates = false;
    for (const std::vector<GlbPrimitive>& mesh : meshes_) {
      for (const GlbPrimitive& p : mesh) {
        const size_t own = accessors_.countAtMost(p.position);
        points += own;
        corners += p.indices == GlbPrimitive::kAbsent ? own : accessors_.countAtMost(p.indices);
        normals = normals || p.normal != GlbPrimitive::kAbsent;
        coordinates = coordinates || p.coordinates != GlbPrimitive::kAbsent;
      }
    }
    points = std::min({points, limits_.mostPoints(), accessors_.bytes() / 12});
    const size_t triangles = std::min({corners / 3, limits_.triangles, accessors_.bytes() / 3});
    mesh_.points.reserve(points);
    if (normals) mesh_.normals.values.reserve(points);
    if (coordinates) mesh_.coordinates.values.reserve(points);
    mesh_.triangles.reserve(triangles);
    mesh_.materials.reserve(triangles);
  }

  /// Puts the scene's nodes on the list, the first one last.
  Result<void> roots() {
    const auto scenes = root_.list("scenes");
    std::vector<size_t> first;
    if (scenes.empty()) {
      std::vector<bool> child(nodes_.size(), false);
      for (const JsonValue& node : nodes_)
        for (const JsonValue& below : node.list("children"))
          if (const auto i = wholeOf(below); i && *i < nodes_.size()) child[*i] = true;
      for (size_t i = 0; i < nodes_.size(); ++i)
        if (!child[i]) first.push_back(i);
    } else {
      const size_t scene = root_.find("scene") == nullptr ? 0 : root_.count("scene").value_or(scenes.size());
      if (scene >= scenes.size()) return wrongInJson("its scene is not there", "/scene");
      scene_ = "/scenes/" + std::to_string(scene) + "/nodes";
      for (const JsonValue& node : scenes[scene].list("nodes")) first.push_back(wholeOf(node).value_or(nodes_.size()));
    }
    for (size_t i = first.size(); i-- > 0;) open_.push_back({first[i], 0, {}, nodes_.size()});
    return {};
  }

  static std::string nodePointer(size_t node) { return "/nodes/" + std::to_string(node); }

  Result<void> node(const Open& at) {
    const auto wrongHere = [&](std::string_view what) {
      return wrongInJson(what, at.parent < nodes_.size() ? nodePointer(at.parent) + "/children" : scene_);
    };
    if (at.node >= nodes_.size()) return wrongHere("a node that is named is not there");
    const std::string name = "node " + std::to_string(at.node);
    if (seen_[at.node] || at.depth > kDeepestNode) return wrongHere(name + " stands below two others, or too deep");
    seen_[at.node] = true;
    const JsonValue& value = nodes_[at.node];
    const Result<GlbTransform> own = glbTransformOf(value, at.node);
    if (!own) return own.error();
    const GlbTransform place = at.place.after(*own);
    if (value.find("mesh") != nullptr) {
      const auto number = value.count("mesh");
      if (!number || *number >= meshes_.size())
        return wrongInJson(name + " shows a mesh that is not there", nodePointer(at.node) + "/mesh");
      for (size_t i = 0; i < meshes_[*number].size(); ++i)
        if (Result<void> read = primitive(*number, i, place); !read) return read;
    }
    const auto children = value.list("children");
    for (size_t i = children.size(); i-- > 0;)
      open_.push_back({wholeOf(children[i]).value_or(nodes_.size()), at.depth + 1, place, at.node});
    return {};
  }

  Result<void> primitive(size_t mesh, size_t number, const GlbTransform& place) {
    const GlbPrimitive& p = meshes_[mesh][number];
    const auto wrong = [&](std::string_view what, std::string_view member) {
      return wrongInJson(
          what, "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(number) + std::string(member));
    };
    const auto named = [&](std::string_view what) { return "mesh " + std::to_string(mesh) + std::string(what); };
    const auto missing = [&](size_t accessor) {
      return accessor != GlbPrimitive::kAbsent && accessor >= accessors_.size();
    };
    const auto notThere = [&](std::string_view what, std::string_view member) {
      return wrong(named(" has ") + std::string(what) + " that are not there", member);
    };
    if (p.mode != kTriangles) return wrong(named(" is not made of triangles"), "/mode");
    if (p.position == GlbPrimitive::kAbsent) return wrong(named(" has no positions"), "/attributes");
    if (missing(p.position)) return notThere("positions", "/attributes/POSITION");
    if (missing(p.normal)) return notThere("normals", "/attributes/NORMAL");
    if (missing(p.coordinates)) return notThere("texture coordinates", "/attributes/TEXCOORD_0");
    if (missing(p.indices)) return notThere("indices", "/indices");
    const size_t first = mesh_.points.size();
    if (Result<void> read = points(p, place); !read) return read;
    // Each node's numbers are small, and yet a row of them leads anywhere.
    for (size_t i = first; !place.rests() && i < mesh_.points.size(); ++i)
      if (const Point& at = mesh_.points[i]; !limits_.isPlace(at.x, at.y, at.z))
        return wrong(named(" has a position ") + noPlaceWithin(limits_) + ", once it is moved", "");
    const GlbCorners corners{mesh_.points.size() - first, static_cast<uint32_t>(first), place.mirrors()};
    if (p.indices != GlbPrimitive::kAbsent) {
      if (Result<void> read = accessors_.triangles(p.indices, corners, limits_, mesh_.triangles); !read) return read;
    } else if (corners.points % 3 != 0) {
      return wrong(named(" ends within a triangle"), "/attributes/POSITION");
    } else if (corners.points / 3 > limits_.triangles - mesh_.triangles.size()) {
      return overLimit(limits_.triangles, "triangles");
    } else {
      for (uint32_t i = corners.first; i < mesh_.points.size(); i += 3)
        mesh_.triangles.push_back(corners.mirrored ? std::array{i, i + 2, i + 1} : std::array{i, i + 1, i + 2});
    }
    const bool known = p.material < mesh_.material_names.size() && !mesh_.material_names[p.material].empty();
    mesh_.materials.resize(mesh_.triangles.size(), known ? static_cast<uint32_t>(p.material) : kNoMaterial);
    return {};
  }

  /// With normals and texture coordinates.
  Result<void> points(const GlbPrimitive& p, const GlbTransform& place) {
    const size_t first = mesh_.points.size();
    if (Result<void> read = accessors_.points(p.position, limits_, mesh_.points); !read) return read;
    const std::span<Point> added = std::span(mesh_.points).subspan(first);
    if (!place.rests())
      for (Point& one : added) one = place(one);
    if (p.normal != GlbPrimitive::kAbsent) {
      std::vector<Normal>& normals = mesh_.normals.values;
      normals.resize(first);
      if (Result<void> read = accessors_.normals(p.normal, added.size(), normals); !read) return read;
      const GlbTransform turn{place.forNormals(), {}};
      for (Normal& n : std::span(normals).subspan(first)) {
        const Point moved = turn.turned({double{n[0]}, double{n[1]}, double{n[2]}});
        n = unitNormal(moved.x, moved.y, moved.z);
      }
    }
    if (p.coordinates == GlbPrimitive::kAbsent) return {};
    mesh_.coordinates.values.resize(first);
    return accessors_.coordinates(p.coordinates, added.size(), mesh_.coordinates.values);
  }

  const JsonValue& root_;
  std::span<const JsonValue> nodes_;
  GlbAccessors accessors_;
  const MeshLimits& limits_;
  std::vector<std::vector<GlbPrimitive>> meshes_;
  std::string scene_ = "/nodes";
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

Result<TriangleMesh> readGlb(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const Result<Chunks> chunks = chunksOf(bytes);
  if (!chunks) return chunks.error();
  if (chunks->json.size() > limits.json_bytes) return overLimit(limits.json_bytes, "bytes of JSON");
  const Result<JsonValue> root = readJson(chunks->json);
  if (!root) return root.error();
  for (const JsonValue& extension : root->list("extensionsRequired"))
    if (!harmless(extension.text))
      return wrongInJson("it needs the extension " + shown(extension.text), "/extensionsRequired");
  return SceneReader(*root, *chunks, limits).run();
}

}  // namespace sgm::asset
