#include "asset/read/glb_skin.h"

#include <cmath>

namespace sgm::asset {

namespace {

std::string skinText(size_t skin) { return "skin " + std::to_string(skin); }
std::string skinPointer(size_t skin) { return "/skins/" + std::to_string(skin); }

void addTo(GlbTransform& sum, double weight, const GlbTransform& of) {
  for (size_t k = 0; k < 3; ++k) sum.columns[k] = sum.columns[k] + weight * of.columns[k];
  sum.origin = sum.origin + weight * of.origin;
}

}  // namespace

GlbSkins::GlbSkins(const JsonValue& root, const GlbAccessors& accessors)
    : nodes_(root.list("nodes")), skins_(root.list("skins")), accessors_(accessors), joints_(skins_.size()) {
  if (skins_.empty()) return;
  parents_.assign(nodes_.size(), nodes_.size());
  in_world_.resize(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i)
    for (const JsonValue& child : nodes_[i].list("children"))
      if (const auto c = child.whole(); c && *c < nodes_.size()) parents_[*c] = i;
}

Result<GlbTransform> GlbSkins::nodeInWorld(size_t node) {
  // Collect the ancestors whose world transform is not known yet, then compute the transforms from the topmost one
  // down.
  std::vector<size_t> above;
  for (size_t at = node; at < nodes_.size() && !in_world_[at]; at = parents_[at]) {
    if (above.size() > nodes_.size())
      return wrongInJson("node " + std::to_string(node) + " stands below itself", "/nodes/" + std::to_string(node));
    above.push_back(at);
  }
  for (size_t i = above.size(); i-- > 0;) {
    const Result<GlbTransform> own = glbTransformOf(nodes_[above[i]], above[i]);
    if (!own) return own.error();
    const size_t parent = parents_[above[i]];
    in_world_[above[i]] = parent < nodes_.size() ? in_world_[parent]->after(*own) : *own;
  }
  return *in_world_[node];
}

Result<void> GlbSkins::readJoints(size_t skin) {
  std::vector<GlbTransform>& out = joints_[skin];
  if (!out.empty()) return {};
  const JsonValue& value = skins_[skin];
  const auto joints = value.list("joints");
  if (joints.empty()) return wrongInJson(skinText(skin) + " has no joints", skinPointer(skin));
  std::vector<std::array<double, 16>> inverse;
  if (value.find("inverseBindMatrices") != nullptr) {
    const auto accessor = value.count("inverseBindMatrices");
    if (!accessor || *accessor >= accessors_.size())
      return wrongInJson(skinText(skin) + " refers to matrices that do not exist",
                         skinPointer(skin) + "/inverseBindMatrices");
    if (Result<void> read = accessors_.matrices(*accessor, joints.size(), inverse); !read) return read;
  }
  std::vector<GlbTransform> read;
  for (size_t j = 0; j < joints.size(); ++j) {
    const auto node = joints[j].whole();
    if (!node || *node >= nodes_.size())
      return wrongInJson(skinText(skin) + " refers to a joint that does not exist", skinPointer(skin) + "/joints");
    const Result<GlbTransform> in_world = nodeInWorld(*node);
    if (!in_world) return in_world.error();
    std::optional<GlbTransform> bound = GlbTransform{};
    if (!inverse.empty()) bound = glbTransformOf(inverse[j]);
    if (!bound)
      return wrongInJson(skinText(skin) + " has a matrix whose last row is not 0, 0, 0, 1",
                         skinPointer(skin) + "/inverseBindMatrices");
    read.push_back(in_world->after(*bound));
  }
  out = std::move(read);
  return {};
}

Result<std::vector<GlbTransform>> GlbSkins::pose(size_t skin, const GlbBinding& binding, size_t points) {
  if (Result<void> read = readJoints(skin); !read) return read.error();
  const std::vector<GlbTransform>& joints = joints_[skin];
  constexpr GlbTransform kUnmoved{{Point{}, Point{}, Point{}}, {}};
  std::vector<GlbTransform> out(points, kUnmoved);
  std::vector<double> sums(points, 0.0);
  std::vector<std::array<double, 4>> numbers, weights;
  for (size_t set = 0; set < binding.joints.size(); ++set) {
    numbers.clear();
    weights.clear();
    if (Result<void> read = accessors_.joints(binding.joints[set], points, numbers); !read) return read.error();
    if (Result<void> read = accessors_.fractions(binding.weights[set], points, weights); !read) return read.error();
    for (size_t i = 0; i < points; ++i) {
      for (size_t k = 0; k < 4; ++k) {
        if (weights[i][k] == 0) continue;
        if (numbers[i][k] >= static_cast<double>(joints.size()))
          return wrongInJson("accessor " + std::to_string(binding.joints[set]) + " binds point " + std::to_string(i) +
                                 " to a joint that " + skinText(skin) + " does not have",
                             "/accessors/" + std::to_string(binding.joints[set]));
        addTo(out[i], weights[i][k], joints[static_cast<size_t>(numbers[i][k])]);
        sums[i] += weights[i][k];
      }
    }
  }
  for (size_t i = 0; i < points; ++i) {
    constexpr double kRounding = 0.01;
    if (!(std::fabs(sums[i] - 1) <= kRounding)) unbalanced_.add([&] { return skinPointer(skin) + " of its JSON"; });
    if (sums[i] == 1) continue;
    // Divide the sum by the total weight, because weights in the file are rounded. A point without weights follows the
    // first joint.
    const GlbTransform sum = out[i];
    out[i] = sums[i] > 0 ? kUnmoved : joints[0];
    if (sums[i] > 0) addTo(out[i], 1 / sums[i], sum);
  }
  return out;
}

void GlbSkins::addNotes(std::vector<std::string>& notes) const {
  addNote(notes, unbalanced_, "point has weights of joints that do not sum to 1",
          "points have weights of joints that do not sum to 1", ": divided by their sum");
}

}  // namespace sgm::asset
