#include "asset/read/glb_scene.h"

#include <utility>

namespace sgm::asset {

namespace {

std::string nodePointer(size_t node) { return "/nodes/" + std::to_string(node); }
std::string nodeText(size_t node) { return "node " + std::to_string(node); }

const JsonValue* extensionOf(const JsonValue& value, std::string_view name) {
  const JsonValue* extensions = value.find("extensions");
  return extensions == nullptr ? nullptr : extensions->find(name);
}

}  // namespace

Result<void> GlbScene::show() {
  if (nodes_.size() > limits_.nodes) return overLimit(limits_.nodes, "nodes");
  seen_.assign(nodes_.size(), false);
  if (Result<void> found = openRoots(); !found) return found;
  while (!open_.empty()) {
    const Open next = std::move(open_.back());
    open_.pop_back();
    if (Result<void> visited = visit(next); !visited) return visited;
  }
  addNote(meshes_.mesh().notes, hidden_, "node is hidden, with all below it", "nodes are hidden, with all below them",
          ": left out");
  return {};
}

/// Pushes the root nodes of the scene on the stack, the first node last, so that it is visited first.
Result<void> GlbScene::openRoots() {
  const auto scenes = root_.list("scenes");
  std::vector<size_t> first;
  if (scenes.empty()) {
    std::vector<bool> child(nodes_.size(), false);
    for (const JsonValue& node : nodes_)
      for (const JsonValue& below : node.list("children"))
        if (const auto i = below.whole(); i && *i < nodes_.size()) child[*i] = true;
    for (size_t i = 0; i < nodes_.size(); ++i)
      if (!child[i]) first.push_back(i);
  } else {
    const size_t scene = root_.find("scene") == nullptr ? 0 : root_.count("scene").value_or(scenes.size());
    if (scene >= scenes.size()) return wrongInJson("its scene does not exist", "/scene");
    scene_ = "/scenes/" + std::to_string(scene) + "/nodes";
    for (const JsonValue& node : scenes[scene].list("nodes")) first.push_back(node.whole().value_or(nodes_.size()));
    if (scenes.size() > 1)
      meshes_.mesh().notes.push_back("it has " + std::to_string(scenes.size()) + " scenes, and only scene " +
                                     std::to_string(scene) + " is read");
  }
  for (size_t i = first.size(); i-- > 0;) open_.push_back({first[i], {}, nodes_.size()});
  return {};
}

Result<void> GlbScene::visit(const Open& at) {
  const auto wrongHere = [&](std::string_view what) {
    return wrongInJson(what, at.parent < nodes_.size() ? nodePointer(at.parent) + "/children" : scene_);
  };
  if (at.node >= nodes_.size()) return wrongHere("it refers to a node that does not exist");
  if (seen_[at.node]) return wrongHere(nodeText(at.node) + " stands below two others, or below itself");
  seen_[at.node] = true;
  const JsonValue& value = nodes_[at.node];
  if (const JsonValue* visibility = extensionOf(value, "KHR_node_visibility")) {
    const JsonValue* visible = visibility->find("visible");
    if (visible != nullptr && visible->kind == JsonValue::Kind::boolean && visible->number == 0) {
      hidden_.add([&] { return nodePointer(at.node) + " of its JSON"; });
      return {};
    }
  }
  const Result<GlbTransform> own = glbTransformOf(value, at.node);
  if (!own) return own.error();
  const GlbTransform place = at.place.after(*own);
  if (value.find("mesh") != nullptr)
    if (Result<void> shown = showMesh(at.node, place); !shown) return shown;
  const auto children = value.list("children");
  for (size_t i = children.size(); i-- > 0;)
    open_.push_back({children[i].whole().value_or(nodes_.size()), place, at.node});
  return {};
}

Result<void> GlbScene::showMesh(size_t node, const GlbTransform& place) {
  const JsonValue& value = nodes_[node];
  const auto mesh = value.count("mesh");
  if (!mesh || *mesh >= meshes_.size())
    return wrongInJson(nodeText(node) + " refers to a mesh that does not exist", nodePointer(node) + "/mesh");
  GlbShown shown{.mesh = *mesh, .place = place, .skin = {}, .weights = meshes_.weightsOf(*mesh)};
  if (value.find("weights") != nullptr) {
    shown.weights.clear();
    for (const JsonValue& weight : value.list("weights")) shown.weights.push_back(weight.number);
  }
  if (value.find("skin") != nullptr) {
    shown.skin = value.count("skin").value_or(root_.list("skins").size());
    if (*shown.skin >= root_.list("skins").size())
      return wrongInJson(nodeText(node) + " refers to a skin that does not exist", nodePointer(node) + "/skin");
  }
  const JsonValue* const instancing = extensionOf(value, "EXT_mesh_gpu_instancing");
  const JsonValue* const attributes = instancing == nullptr ? nullptr : instancing->find("attributes");
  if (attributes == nullptr) return meshes_.show(shown);
  const Result<std::vector<GlbTransform>> each = instances(*attributes, node);
  if (!each) return each.error();
  for (const GlbTransform& one : *each) {
    shown.place = place.after(one);
    if (Result<void> read = meshes_.show(shown); !read) return read;
  }
  return {};
}

/// Returns the transforms of a node's instances, relative to the node.
Result<std::vector<GlbTransform>> GlbScene::instances(const JsonValue& attributes, size_t node) const {
  const std::string pointer = nodePointer(node) + "/extensions/EXT_mesh_gpu_instancing/attributes";
  std::optional<size_t> count;
  std::vector<Point> translations, scales;
  std::vector<std::array<double, 4>> rotations;
  for (const char* const name : {"TRANSLATION", "ROTATION", "SCALE"}) {
    if (attributes.find(name) == nullptr) continue;
    const size_t accessor = attributes.count(name).value_or(accessors_.size());
    if (accessor >= accessors_.size() || !accessors_.countOf(accessor))
      return wrongInJson(nodeText(node) + " refers to instances that do not exist", pointer);
    if (count && accessors_.countOf(accessor) != count)
      return wrongInJson(nodeText(node) + " has instances of different numbers", pointer);
    count = accessors_.countOf(accessor);
    const std::string_view kind = name;
    Result<void> read = kind == "TRANSLATION" ? accessors_.vectors(accessor, *count, translations)
                        : kind == "SCALE"     ? accessors_.vectors(accessor, *count, scales)
                                              : accessors_.fractions(accessor, *count, rotations);
    if (!read) return read.error();
  }
  std::vector<GlbTransform> out;
  for (size_t i = 0; i < count.value_or(1); ++i) {
    const std::array<double, 4> rotation = rotations.empty() ? std::array<double, 4>{0, 0, 0, 1} : rotations[i];
    if (rotation == std::array<double, 4>{})
      return wrongInJson(nodeText(node) + " has an instance turned by a quaternion without a length", pointer);
    out.push_back(glbTransformOf(translations.empty() ? Point{} : translations[i], rotation,
                                 scales.empty() ? Point{1, 1, 1} : scales[i]));
  }
  return out;
}

}  // namespace sgm::asset
