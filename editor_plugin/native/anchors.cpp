#include "anchors.h"

namespace sgm_godot {

Variant anchorOf(const sgm_grammar* grammar, const sgm_anchor& anchor, const Placement& placement) {
  Transform local;
  // The anchor's rotation matrix maps world directions to the anchor's own. Its transpose has the anchor's axes as
  // columns.
  const float* r = anchor.rotation;
  local.rows[0] = {r[0], r[3], r[6]};
  local.rows[1] = {r[1], r[4], r[7]};
  local.rows[2] = {r[2], r[5], r[8]};
  local.origin = placement.local(anchor.position);
  const auto text = [](const char* name) { return Variant(name == nullptr ? "" : name); };
  Variant result = Variant::dictionary();
  result.set("kind", text(sgm_grammar_name(grammar, anchor.kind)));
  result.set("name", text(sgm_grammar_name(grammar, anchor.name)));
  result.set("tag", text(anchor.tag == 0 ? "" : sgm_grammar_tag(grammar, anchor.tag)));
  result.set("key", anchor.key);
  result.set("transform", placement.node.after(local));
  return result;
}

Anchors::News Anchors::follow(const std::vector<Picture::Change>& changes) {
  News news;
  std::vector<uint64_t> dropped;
  std::unordered_map<uint64_t, sgm_anchor> added;
  for (const Picture::Change& change : changes) {
    std::vector<uint64_t>& here = by_chunk_[change.key];
    dropped.insert(dropped.end(), here.begin(), here.end());
    here.clear();
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    if (change.mesh != nullptr && sgm_mesh_get_view(change.mesh.get(), &view, nullptr) == SGM_OK) {
      for (uint32_t i = 0; i < view.anchor_count; ++i) {
        const auto& anchor = *reinterpret_cast<const sgm_anchor*>(reinterpret_cast<const char*>(view.anchors) +
                                                                  size_t{i} * view.anchor_stride);
        here.push_back(anchor.key);
        if (shown_[anchor.key]++ == 0) added.emplace(anchor.key, anchor);
      }
    }
    if (here.empty()) by_chunk_.erase(change.key);
  }
  for (const uint64_t key : dropped) {
    const auto found = shown_.find(key);
    if (found == shown_.end() || --found->second > 0) continue;
    shown_.erase(found);
    if (added.erase(key) == 0) news.gone.push_back(key);
  }
  for (const auto& [key, anchor] : added) news.come.push_back(anchor);
  return news;
}

std::vector<uint64_t> Anchors::clear() {
  std::vector<uint64_t> keys;
  for (const auto& [key, count] : shown_) keys.push_back(key);
  shown_.clear();
  by_chunk_.clear();
  return keys;
}

}  // namespace sgm_godot
