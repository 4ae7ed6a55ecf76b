#include "derive/interpret/activations.h"

#include <utility>

namespace sgm::interpret {

uint32_t Activations::add(Activation&& activation) {
  all_.push_back(std::move(activation));
  return count() - 1;
}

uint32_t Activations::countChild(uint32_t parent, uint32_t rule) {
  std::vector<uint32_t>& counts = all_[parent].child_counts;
  size_t at = 0;
  while (at < counts.size() && counts[at] != rule) at += 2;
  if (at == counts.size()) counts.insert(counts.end(), {rule, 0});
  return counts[at + 1]++;
}

std::string Activations::pathText(uint32_t activation) const {
  std::vector<uint32_t> path;
  for (uint32_t i = activation; i != kNone; i = all_[i].parent) path.push_back(i);
  if (path.empty()) return {};
  const Program& program = in_.program;
  std::string text;
  if (!isWhole(in_.layer)) {
    text.append(program.text(in_.layer.name)).append("(").append(std::to_string(in_.cell.x));
    text.append(", ").append(std::to_string(in_.cell.y)).append(", ").append(std::to_string(in_.cell.z)).append(")");
  }
  for (size_t i = path.size(); i-- > 0;) {
    const Activation& a = all_[path[i]];
    if (!text.empty()) text += '/';
    if (a.edit != kNone) {
      text += "override";
      continue;
    }
    if (a.qualifier != kNoId) text.append(program.text(a.qualifier)).append(".");
    text += program.text(program.rules[a.rule].name);
    if (a.parent == kNone) continue;
    text += '[';
    text += std::to_string(a.index);
    text += ']';
  }
  return text;
}

uint32_t Activations::outsideOfEdits(uint32_t activation) const {
  uint32_t outside = activation;
  for (uint32_t i = activation; i != kNone; i = all_[i].parent)
    if (all_[i].edit != kNone) outside = all_[i].parent;
  return outside;
}

}  // namespace sgm::interpret
