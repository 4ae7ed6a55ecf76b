#include "world/anchor_scenes.h"

#include <chrono>

#include "godot/log.h"

namespace sgm_godot {

void AnchorScenes::follow(const std::vector<Picture::Change>& changes, const sgm_grammar* grammar) {
  const Anchors::News news = anchors_.follow(changes);
  for (const uint64_t key : news.gone) {
    remove(key);
    node_.messages.announce("anchor_removed", key);
  }
  const Placement here = node_.placement();
  for (const sgm_anchor& anchor : news.come) {
    const Variant described = anchorOf(grammar, anchor, here);
    node_.messages.announce("anchor_ready", described);
    if (node_.settings.anchor_scenes.value.has(described.get("kind"))) unplaced_.push_back(anchor);
  }
}

void AnchorScenes::place(const ActiveSession& active, double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const std::shared_ptr<Session> session = active.current();
  const std::shared_ptr<const bool> exists = lifetime_.watch();
  while (*exists && active.current() == session && !unplaced_.empty()) {
    const sgm_anchor anchor = unplaced_.front();
    unplaced_.pop_front();
    const Variant described = anchorOf(session->grammar().get(), anchor, {Transform(), node_.settings.origin});
    const Variant scene = node_.settings.anchor_scenes.value.get(described.get("kind"));
    const Variant node = scene.object() != nullptr ? scene.call("instantiate") : Variant();
    if (node.object() != nullptr && !node.call("is_class", "Node3D").truth()) {
      logWarning("SgmWorld3D: the root of a scene in anchor_scenes is no Node3D: it stays out");
      node.call("free");
    } else if (node.object() != nullptr) {
      node.call("set_transform", described.get("transform"));
      scenes_[anchor.key] = {engine().object_get_instance_id(node.object()), anchor};
      constexpr int64_t kInternalModeFront = 1;  // INTERNAL_MODE_FRONT of the engine's class Node: internal children
                                                 // are not saved with a scene
      node_.call("add_child", node, false, kInternalModeFront);
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return;
  }
}

void AnchorScenes::move(const sgm_grammar* grammar) {
  for (const auto& [key, placed] : scenes_) {
    const Object node = engine().object_get_instance_from_id(placed.node);
    if (node == nullptr) continue;
    const Variant described = anchorOf(grammar, placed.anchor, {Transform(), node_.settings.origin});
    Variant(node).call("set_transform", described.get("transform"));
  }
}

void AnchorScenes::remove(uint64_t key) {
  std::erase_if(unplaced_, [&](const sgm_anchor& anchor) { return anchor.key == key; });
  const auto found = scenes_.find(key);
  if (found == scenes_.end()) return;
  const Object node = engine().object_get_instance_from_id(found->second.node);
  scenes_.erase(found);
  if (node != nullptr) Variant(node).call("queue_free");
}

void AnchorScenes::clear() {
  unplaced_.clear();
  for (const uint64_t key : anchors_.clear()) {
    remove(key);
    if (node_.in_tree) node_.messages.announce("anchor_removed", key);
  }
}

}  // namespace sgm_godot
