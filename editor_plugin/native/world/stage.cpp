#include "world/stage.h"

#include <cmath>

#include "colliders.h"
#include "godot/log.h"

namespace sgm_godot {

Stage::Stage(WorldNode& node) : node_(node), pictures_(node.plugin), anchor_scenes_(node), viewers_(node) {}

Stage::~Stage() { stop(); }

Look Stage::look() const {
  Look look;
  look.scenario = node_.call("get_world_3d").call("get_scenario").to<Rid>();
  look.placement = node_.placement();
  look.shadow = node_.settings.cast_shadow;
  look.visible = node_.call("is_visible_in_tree").truth();
  look.layers = node_.settings.render_layers;
  look.owner = node_.object;
  return look;
}

Pictures::Paint Stage::paint() const { return {materialNames(node_.compiled().get()), node_.settings}; }

void Stage::stop() {
  pictures_.clear();
  colliders_.reset();
  anchor_scenes_.clear();
  active_.set(nullptr);
}

void Stage::start(const GrammarOwner& grammar) {
  // Only one world at a time can write a journal. If the settings name a journal, the previous session therefore ends
  // before the new one starts.
  const bool is_exclusive = !node_.settings.journal.empty();
  std::unique_ptr<Picture> previous = pictures_.take();
  if (is_exclusive) {
    stop();
    node_.plugin.background->finish();
  }
  std::string failure;
  std::shared_ptr<Session> session = Session::create(node_.plugin, grammar, node_.settings, failure);
  if (session == nullptr) {
    if (!is_exclusive) pictures_.giveBack(std::move(previous));
    logError("SgmWorld3D: " + failure);
    node_.messages.fail(failure);
    return;
  }
  stop();
  active_.set(std::move(session));
  pictures_.begin(std::move(previous), paint(), look());
  if (node_.settings.collision && !node_.plugin.in_editor) {
    colliders_ = std::make_unique<Colliders>(
        node_.plugin, Colliders::Space{node_.call("get_world_3d").call("get_space").to<Rid>(), node_.placement(),
                                       node_.object, node_.settings.collision_layer, node_.settings.collision_mask});
  }
  viewers_.forgetGround();
  was_idle_ = false;
  node_.messages.clearError();
  warnOfScale();
  node_.messages.announce("restarted");
}

void Stage::setField(const GrammarOwner& grammar) {
  if (Failure failure = session()->set(grammar, node_.settings)) {
    logError("SgmWorld3D: " + *failure);
    node_.messages.fail(*failure);
  }
}

void Stage::repaint(bool is_repacking) {
  if (is_repacking) {
    pictures_.repack(paint(), look(), *session());
  } else {
    pictures_.repaint(paint());
  }
}

void Stage::followLook() { pictures_.setLook(look()); }

void Stage::followPlacement() {
  const Placement placement = node_.placement();
  warnOfScale();
  pictures_.setPlacement(placement);
  if (colliders_) colliders_->setPlacement(placement);
  anchor_scenes_.move(session()->grammar().get());
  pictures_.materials().resend();
}

void Stage::followBodyLayers() {
  if (colliders_) colliders_->setLayers(node_.settings.collision_layer, node_.settings.collision_mask);
}

void Stage::warnOfScale() {
  const Transform node = node_.placement().node;
  bool is_scaled = false;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 column = node.column(axis);
    is_scaled = is_scaled || std::abs(std::hypot(column.x, column.y, column.z) - 1) > 1e-3f;
  }
  if (is_scaled && !was_scaled_) {
    logWarning("SgmWorld3D: " + node_.call("get_name").to<std::string>() +
               " is scaled, by itself or by its parents: a world may be moved and turned, but its lengths are metres");
  }
  was_scaled_ = is_scaled;
}

}  // namespace sgm_godot
