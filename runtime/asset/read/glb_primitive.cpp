#include "asset/read/glb_primitive.h"

#include <algorithm>
#include <utility>

namespace sgm::asset {

namespace {

constexpr size_t kAbsent = SIZE_MAX, kWrong = SIZE_MAX - 1;
/// Values of the member `mode` of a glTF primitive.
constexpr size_t kLineStrip = 3, kTriangles = 4, kStrip = 5, kFan = 6;

size_t indexIn(const JsonValue* of, std::string_view name) {
  return of == nullptr || of->find(name) == nullptr ? kAbsent : of->count(name).value_or(kWrong);
}

std::string setName(std::string_view attribute, size_t set) {
  return std::string(attribute).append("_").append(std::to_string(set));
}

}  // namespace

GlbMeshes::GlbMeshes(const JsonValue& root, const GlbAccessors& accessors, std::vector<GlbMaterial> materials,
                     const MeshLimits& limits)
    : accessors_(accessors), materials_(std::move(materials)), limits_(limits), skins_(root, accessors) {
  for (const GlbMaterial& material : materials_) mesh_.material_names.push_back(material.name);
  // Parse all meshes once, since many nodes may use the same mesh.
  for (const JsonValue& value : root.list("meshes")) {
    Mesh& mesh = meshes_.emplace_back();
    for (const JsonValue& primitive : value.list("primitives")) mesh.primitives.push_back(primitiveIn(primitive));
    for (const JsonValue& weight : value.list("weights")) mesh.weights.push_back(weight.number);
  }
  makeRoom();
}

GlbMeshes::Attributes GlbMeshes::attributesIn(const JsonValue* of, size_t set) {
  return {indexIn(of, "POSITION"), indexIn(of, "NORMAL"), indexIn(of, setName("TEXCOORD", set))};
}

GlbMeshes::Primitive GlbMeshes::primitiveIn(const JsonValue& value) const {
  const JsonValue *const attributes = value.find("attributes"), *const extensions = value.find("extensions");
  Primitive out{};
  out.mode = value.find("mode") == nullptr ? kTriangles : indexIn(&value, "mode");
  out.material = indexIn(&value, "material");
  out.indices = indexIn(&value, "indices");
  if (out.material < materials_.size()) out.coordinates_set = materials_[out.material].coordinates;
  out.own = attributesIn(attributes, out.coordinates_set);
  for (const JsonValue& target : value.list("targets"))
    out.targets.push_back(attributesIn(&target, out.coordinates_set));
  for (size_t set = 0;; ++set) {
    const size_t joints = indexIn(attributes, setName("JOINTS", set));
    const size_t weights = indexIn(attributes, setName("WEIGHTS", set));
    if (joints == kAbsent || weights == kAbsent) break;
    out.binding.joints.push_back(joints);
    out.binding.weights.push_back(weights);
  }
  out.compressed = extensions != nullptr && extensions->find("KHR_draco_mesh_compression") != nullptr;
  return out;
}

/// Reserves memory for all used meshes at once, because growing a vector needs old and new memory at the same time.
/// Reserves at most as many elements as the file has bytes for, since the declared counts are untrusted.
void GlbMeshes::makeRoom() {
  size_t points = 0, corners = 0;
  bool normals = false, coordinates = false;
  for (const Mesh& mesh : meshes_) {
    for (const Primitive& p : mesh.primitives) {
      const size_t own = accessors_.countAtMost(p.own.position);
      points += own;
      corners += p.indices == kAbsent ? own : accessors_.countAtMost(p.indices);
      normals = normals || p.own.normal != kAbsent;
      coordinates = coordinates || p.own.coordinates != kAbsent;
    }
  }
  points = std::min({points, limits_.maxPoints(), accessors_.bytes() / 12});
  const size_t triangles = std::min({corners / 3, limits_.triangles, accessors_.bytes() / 3});
  mesh_.points.reserve(points);
  if (normals) mesh_.normals.values.reserve(points);
  if (coordinates) mesh_.coordinates.values.reserve(points);
  mesh_.triangles.reserve(triangles);
  mesh_.materials.reserve(triangles);
}

std::string GlbMeshes::pointerOf(const Here& here) const {
  return "/meshes/" + std::to_string(here.mesh) + "/primitives/" + std::to_string(here.number);
}

Error GlbMeshes::wrong(const Here& here, std::string_view what, std::string_view member) const {
  return wrongInJson("mesh " + std::to_string(here.mesh) + std::string(what), pointerOf(here) + std::string(member));
}

/// Returns an error if the primitive refers to an accessor that does not exist.
Result<void> GlbMeshes::areThere(const Here& here) const {
  const Primitive& p = here.primitive;
  const auto missing = [&](size_t accessor) { return accessor != kAbsent && accessor >= accessors_.size(); };
  const auto notThere = [&](std::string_view what, const std::string& member) {
    return wrong(here, " refers to " + std::string(what) + " that do not exist", member);
  };
  if (missing(p.own.position)) return notThere("positions", "/attributes/POSITION");
  if (missing(p.own.normal)) return notThere("normals", "/attributes/NORMAL");
  if (missing(p.own.coordinates))
    return notThere("texture coordinates", "/attributes/" + setName("TEXCOORD", p.coordinates_set));
  if (missing(p.indices)) return notThere("indices", "/indices");
  for (size_t t = 0; t < p.targets.size(); ++t)
    for (const size_t accessor : {p.targets[t].position, p.targets[t].normal, p.targets[t].coordinates})
      if (missing(accessor)) return notThere("morph targets", "/targets/" + std::to_string(t));
  for (size_t set = 0; set < p.binding.joints.size(); ++set)
    if (missing(p.binding.joints[set]) || missing(p.binding.weights[set]))
      return notThere("joints or weights", "/attributes/" + setName("JOINTS", set));
  return {};
}

Result<void> GlbMeshes::show(const GlbShown& shown) {
  const Mesh& mesh = meshes_[shown.mesh];
  for (size_t i = 0; i < mesh.primitives.size(); ++i)
    if (Result<void> read = primitive({shown.mesh, i, mesh.primitives[i]}, shown); !read) return read;
  return {};
}

Result<void> GlbMeshes::primitive(const Here& here, const GlbShown& shown) {
  const Primitive& p = here.primitive;
  const auto place = [&] { return pointerOf(here) + " of its JSON"; };
  if (p.mode > kFan) return wrong(here, " has a mode that glTF does not have", "/mode");
  if (p.mode <= kLineStrip) {
    lines_.add(place);
    return {};
  }
  if (p.own.position == kAbsent) {
    placeless_.add(place);
    return {};
  }
  if (Result<void> there = areThere(here); !there) return there;
  if (accessors_.isZero(p.own.position)) {
    if (p.compressed) return wrong(here, " is compressed by the extension `KHR_draco_mesh_compression`", "/extensions");
    zero_.add(place);
  }
  const size_t first = mesh_.points.size();
  std::vector<GlbTransform> pose;
  if (Result<void> read = addPoints(here, shown, pose); !read) return read;
  const bool skinned = !pose.empty();
  const GlbCorners corners{mesh_.points.size() - first, static_cast<uint32_t>(first),
                           !skinned && shown.place.mirrors()};
  const size_t before = mesh_.triangles.size();
  if (Result<void> added = addTriangles(here, corners); !added) return added;
  for (size_t t = before; skinned && t < mesh_.triangles.size(); ++t) {
    auto& [a, b, c] = mesh_.triangles[t];
    const int mirrored =
        int{pose[a - first].mirrors()} + int{pose[b - first].mirrors()} + int{pose[c - first].mirrors()};
    if (mirrored >= 2) std::swap(b, c);
  }
  const bool known = p.material < mesh_.material_names.size() && !mesh_.material_names[p.material].empty();
  mesh_.materials.resize(mesh_.triangles.size(), known ? static_cast<uint32_t>(p.material) : kNoMaterial);
  return {};
}

/// Adds the primitive's points, with their normals and texture coordinates. pose: output; if the mesh has a skin, the
/// transform of each point.
Result<void> GlbMeshes::addPoints(const Here& here, const GlbShown& shown, std::vector<GlbTransform>& pose) {
  const Primitive& p = here.primitive;
  const size_t first = mesh_.points.size();
  if (Result<void> read = accessors_.points(p.own.position, limits_, mesh_.points); !read) return read;
  const size_t count = mesh_.points.size() - first;
  if (p.own.normal != kAbsent) {
    mesh_.normals.values.resize(first);
    if (Result<void> read = accessors_.normals(p.own.normal, count, mesh_.normals.values); !read) return read;
  }
  if (p.own.coordinates != kAbsent) {
    mesh_.coordinates.values.resize(first);
    if (Result<void> read = accessors_.coordinates(p.own.coordinates, count, mesh_.coordinates.values); !read)
      return read;
  } else if (p.coordinates_set > 0) {
    uncharted_.add([&] { return pointerOf(here) + " of its JSON"; });
  }
  if (Result<void> morphed = morph(here, shown, first); !morphed) return morphed;
  if (shown.skin) {
    if (p.binding.joints.empty()) {
      unbound_.add([&] { return pointerOf(here) + " of its JSON"; });
    } else {
      Result<std::vector<GlbTransform>> found = skins_.pose(*shown.skin, p.binding, count);
      if (!found) return found.error();
      pose = std::move(*found);
    }
  }
  const std::span<Point> added = std::span(mesh_.points).subspan(first);
  const bool moved = !pose.empty() || !shown.place.rests();
  for (size_t i = 0; moved && i < count; ++i) added[i] = pose.empty() ? shown.place(added[i]) : pose[i](added[i]);
  // Check positions after the transform: each node's transform is limited, but the product of a chain of nodes may be
  // large.
  for (size_t i = 0; (moved || !p.targets.empty()) && i < count; ++i)
    if (!limits_.isPlace(added[i].x, added[i].y, added[i].z))
      return wrong(here, " has a position " + noPlaceWithin(limits_) + ", once it is moved", "");
  if (p.own.normal != kAbsent) moveNormals(first, shown, pose);
  if (p.own.coordinates == kAbsent) return {};
  const bool laid = p.material < materials_.size() && materials_[p.material].transform;
  for (TextureCoordinates& at : std::span(mesh_.coordinates.values).subspan(first)) {
    if (laid) at = (*materials_[p.material].transform)(at);
    if (!isFloat(double{at[0]}) || !isFloat(double{at[1]}))
      return wrong(here, " has texture coordinates that are not finite, once they are transformed", "");
    at[1] = 1 - at[1];  // glTF's second texture coordinate grows downward, this library's upward
  }
  return {};
}

/// Adds the displacements of all morph targets with a non-zero weight.
Result<void> GlbMeshes::morph(const Here& here, const GlbShown& shown, size_t first) {
  const std::vector<Attributes>& targets = here.primitive.targets;
  const Attributes& own = here.primitive.own;
  const size_t count = mesh_.points.size() - first;
  for (size_t t = 0; t < std::min(targets.size(), shown.weights.size()); ++t) {
    const double weight = shown.weights[t];
    if (weight == 0) continue;
    std::vector<Point> by;
    if (targets[t].position != kAbsent) {
      if (Result<void> read = accessors_.vectors(targets[t].position, count, by); !read) return read;
      for (size_t i = 0; i < count; ++i) mesh_.points[first + i] = mesh_.points[first + i] + weight * by[i];
    }
    if (targets[t].normal != kAbsent && own.normal != kAbsent) {
      by.clear();
      if (Result<void> read = accessors_.vectors(targets[t].normal, count, by); !read) return read;
      for (size_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis)
          mesh_.normals.values[first + i][static_cast<size_t>(axis)] += static_cast<float>(weight * by[i][axis]);
    }
    if (targets[t].coordinates != kAbsent && own.coordinates != kAbsent) {
      std::vector<TextureCoordinates> moved;
      if (Result<void> read = accessors_.coordinates(targets[t].coordinates, count, moved); !read) return read;
      for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < 2; ++k)
          mesh_.coordinates.values[first + i][k] += static_cast<float>(weight * double{moved[i][k]});
    }
  }
  return {};
}

void GlbMeshes::moveNormals(size_t first, const GlbShown& shown, const std::vector<GlbTransform>& pose) {
  GlbTransform turn{shown.place.forNormals(), {}};
  for (size_t i = first; i < mesh_.normals.values.size(); ++i) {
    Normal& n = mesh_.normals.values[i];
    if (!pose.empty()) turn.columns = pose[i - first].forNormals();
    const Point moved = turn.turned({double{n[0]}, double{n[1]}, double{n[2]}});
    n = unitNormal(moved.x, moved.y, moved.z);
  }
}

Result<void> GlbMeshes::addTriangles(const Here& here, const GlbCorners& corners) {
  const Primitive& p = here.primitive;
  if (p.mode != kTriangles) return addStripOrFan(here, corners);
  if (p.indices != kAbsent) return accessors_.triangles(p.indices, corners, limits_, mesh_.triangles);
  if (corners.points % 3 != 0) return wrong(here, " ends within a triangle", "/attributes/POSITION");
  if (corners.points / 3 > limits_.triangles - mesh_.triangles.size()) return overLimit(limits_.triangles, "triangles");
  for (uint32_t i = corners.first; i < mesh_.points.size(); i += 3)
    mesh_.triangles.push_back(corners.mirrored ? std::array{i, i + 2, i + 1} : std::array{i, i + 1, i + 2});
  return {};
}

/// Adds the triangles of a strip or fan. Degenerate triangles with a repeated corner are left out: they only connect
/// strips.
Result<void> GlbMeshes::addStripOrFan(const Here& here, const GlbCorners& corners) {
  const Primitive& p = here.primitive;
  std::vector<uint32_t> list;
  if (p.indices != kAbsent) {
    if (Result<void> read = accessors_.indices(p.indices, corners.points, limits_, list); !read) return read;
  } else {
    for (uint32_t i = 0; i < corners.points; ++i) list.push_back(i);
  }
  if (list.size() < 3) return wrong(here, " has a strip or a fan of fewer than three corners", "");
  if (list.size() - 2 > limits_.triangles - mesh_.triangles.size()) return overLimit(limits_.triangles, "triangles");
  const auto isTriangle = [&](size_t i) {
    return list[i] != list[i + 1] && list[i + 1] != list[i + 2] && list[i + 2] != list[i];
  };
  // If all triangles at even positions are degenerate, the strip is a chain of separate triangles that were joined
  // without regard to the alternating orientation: then no triangle is reversed.
  bool unruly = p.mode == kStrip;
  for (size_t i = 0; unruly && i + 2 < list.size(); i += 2) unruly = !isTriangle(i);
  const size_t before = mesh_.triangles.size();
  for (size_t i = 0; i + 2 < list.size(); ++i) {
    // The order of corners is that of the glTF specification (section 3.7.2.1), which reverses every other triangle of
    // a strip.
    const size_t odd = unruly ? 0 : i % 2;
    std::array<uint32_t, 3> t{list[i], list[i + 1 + odd], list[i + 2 - odd]};
    if (p.mode == kFan) t = {list[i + 1], list[i + 2], list[0]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    if (corners.mirrored) std::swap(t[1], t[2]);
    mesh_.triangles.push_back({corners.first + t[0], corners.first + t[1], corners.first + t[2]});
  }
  if (unruly && mesh_.triangles.size() > before) unruly_.add([&] { return pointerOf(here) + " of its JSON"; });
  return {};
}

Result<TriangleMesh> GlbMeshes::finish() {
  std::vector<std::string>& notes = mesh_.notes;
  addNote(notes, lines_, "primitive of lines or points is left out", "primitives of lines or points are left out");
  addNote(notes, placeless_, "primitive has no positions and is left out",
          "primitives have no positions and are left out");
  addNote(notes, unruly_, "strip has triangles at odd places only", "strips have triangles at odd places only",
          ": read without the reversal that the format requires");
  addNote(notes, zero_, "primitive has positions without bytes", "primitives have positions without bytes",
          ": all of them are 0");
  addNote(notes, uncharted_, "primitive lacks the texture coordinates that its material names",
          "primitives lack the texture coordinates that their materials name", ": read without them");
  addNote(notes, unbound_, "primitive has a skin and no joints or weights",
          "primitives have a skin and no joints or weights", ": moved by the node");
  skins_.addNotes(notes);
  if (mesh_.triangles.empty()) {
    std::string why = "it shows no triangles";
    for (const std::string& note : notes) why.append(": ").append(note);
    return Error{Code::bad_input, why, 0, 0};
  }
  if (!mesh_.normals.empty()) mesh_.normals.values.resize(mesh_.points.size());
  if (!mesh_.coordinates.empty()) mesh_.coordinates.values.resize(mesh_.points.size());
  return std::move(mesh_);
}

}  // namespace sgm::asset
