#include "world.h"

#include <cmath>

#include "godot/log.h"
#include "plugin.h"

namespace sgm_godot {
namespace {

// Numbers of the engine's notifications.
constexpr int32_t kEnterTree = 10, kExitTree = 11, kInternalProcess = 25, kInternalPhysicsProcess = 26,
                  kVisibilityChanged = 43, kTransformChanged = 2000;

}  // namespace

World::~World() {
  *alive_ = false;
  stopSession();
}

void World::notify(int32_t what) {
  switch (what) {
    case kEnterTree:
      enter();
      break;
    case kExitTree:
      leave();
      break;
    case kInternalProcess:
      frame();
      break;
    case kInternalPhysicsProcess:
      physicsFrame();
      break;
    case kVisibilityChanged:
      dirty_ |= kLook;
      followPlace();
      break;
    case kTransformChanged:
      dirty_ |= kPlacement;
      followPlace();
      break;
    default:
      break;
  }
}

void World::enter() {
  in_tree_ = true;
  if (plugin().rendering == nullptr) plugin().rendering = std::make_unique<Rendering>();
  if (plugin().physics == nullptr) plugin().physics = std::make_unique<Physics>();
  own("set_notify_transform", true);
  own("set_process_internal", true);
  own("set_physics_process_internal", true);
  addMonitors();
  restart();
}

void World::leave() {
  in_tree_ = false;
  removeMonitors();
  stopSession();
  own("set_process_internal", false);
  own("set_physics_process_internal", false);
  viewers_.clear();
  watched_.clear();
}

void World::setGrammar(Object grammar) {
  if (grammar == grammar_.object()) return;
  const Name changed("changed");
  const Variant heard = callable(self(), Name("_grammar_changed"));
  if (!grammar_.isNil() && grammar_.call("is_connected", changed, heard).truth()) {
    grammar_.call("disconnect", changed, heard);
  }
  grammar_ = instanceOf<Grammar>(grammar) != nullptr ? Variant(grammar) : Variant();
  if (!grammar_.isNil()) grammar_.call("connect", changed, heard);
  restart();
  own("notify_property_list_changed");
}

void World::setAnchorScenes(const Dictionary& scenes) {
  settings_.anchor_scenes = scenes.value;
  restart();
}

void World::grammarChanged() {
  const auto* grammar = instanceOf<Grammar>(grammar_);
  if (grammar == nullptr) return;
  dirty_ |= kField;
  own("notify_property_list_changed");
  const std::string error = Variant(grammar_).call("get_error_text").to<std::string>();
  if (!error.empty()) {
    fail(error);
  } else {
    error_.clear();
  }
  emitAnnounced();
}

bool World::ready() {
  if (session_ == nullptr && (dirty_ & kRestart)) followChanges();
  return session_ != nullptr;
}

void World::fail(const std::string& message) {
  error_ = message;
  announce("failed", message);
}

void World::emitAnnounced() {
  const std::shared_ptr<bool> alive = alive_;
  while (*alive && !announced_.empty()) {
    const auto [signal, arguments] = std::move(announced_.front());
    announced_.pop_front();
    const Variant named{Name(signal)};
    arguments.empty() ? own("emit_signal", named) : own("emit_signal", named, arguments.front());
  }
}

Placement World::placement() const {
  return {in_tree_ ? own("get_global_transform").to<Transform>() : Transform(), settings_.origin};
}

Look World::look() const {
  Look look;
  look.scenario = own("get_world_3d").call("get_scenario").to<Rid>();
  look.placement = placement();
  look.slots = materials_.slots();
  look.materials = materials_.rids();
  look.shadow = settings_.cast_shadow;
  look.visible = own("is_visible_in_tree").truth();
  look.layers = settings_.render_layers;
  look.owner = self();
  return look;
}

std::vector<std::string> World::materialNames() const {
  std::vector<std::string> names;
  const auto* grammar = instanceOf<Grammar>(grammar_);
  if (grammar == nullptr) return names;
  const sgm_grammar* compiled = grammar->compiled().get();
  for (uint32_t i = 0; i < sgm_grammar_material_count(compiled); ++i) {
    const std::string name = sgm_grammar_material(compiled, i);
    names.push_back(name.empty() ? "default" : name);
  }
  return names;
}

void World::setSession(std::shared_ptr<Session> session) {
  {
    const std::lock_guard lock(session_mutex_);
    session_.swap(session);
  }
  // The previous session is released here, outside of the lock, because its destruction may take time.
}

std::shared_ptr<Session> World::session() const {
  const std::lock_guard lock(session_mutex_);
  return session_;
}

World::PlacedSession World::placedSession() const {
  const std::lock_guard lock(session_mutex_);
  return {session_, settings_.origin};
}

void World::stopSession() {
  picture_.reset();
  retired_.reset();
  colliders_.reset();
  unplaced_.clear();
  for (const uint64_t key : anchors_.clear()) {
    removeScene(key);
    if (in_tree_) announce("anchor_removed", key);
  }
  setSession(nullptr);
}

void World::startSession() {
  const auto* grammar = instanceOf<Grammar>(grammar_);
  if (!in_tree_ || grammar == nullptr || grammar->compiled() == nullptr || (plugin().in_editor && !settings_.preview)) {
    stopSession();
    if (grammar != nullptr && grammar->compiled() == nullptr && error_.empty()) {
      fail(Variant(grammar_).call("get_error_text").to<std::string>());
    }
    return;
  }
  // Only one world at a time can open a journal, so the previous session must end before the next one starts.
  const bool exclusive = !settings_.journal.empty();
  const bool empty = picture_ == nullptr || picture_->counts().chunks == 0;
  std::unique_ptr<Picture> before = empty && retired_ != nullptr ? std::move(retired_) : std::move(picture_);
  if (exclusive) {
    stopSession();
    plugin().background->finish();
  }
  std::string failure;
  std::shared_ptr<Session> session = Session::create(plugin(), grammar->compiled(), settings_, failure);
  if (session == nullptr) {
    // Keep the previous picture visible.
    if (!exclusive) picture_ = std::move(before);
    logError("SgmWorld3D: " + failure);
    fail(failure);
    return;
  }
  stopSession();
  retired_ = std::move(before);
  setSession(std::move(session));
  retired_materials_ = materials_;
  materials_.rebuild(plugin(), materialNames(), settings_);
  picture_ = std::make_unique<Picture>(plugin(), look());
  if (settings_.collision && !plugin().in_editor) {
    colliders_ = std::make_unique<Colliders>(
        plugin(), Colliders::Space{own("get_world_3d").call("get_space").to<Rid>(), placement(), self(),
                                   settings_.collision_layer, settings_.collision_mask});
  }
  for (auto& [id, watched] : watched_) watched.walkable = false;
  was_idle_ = false;
  error_.clear();
  tellOfScale();
  announce("restarted");
}

namespace {

/// Whether the material and tag numbers in vertices have the same meaning in both grammars.
bool sameNames(const sgm_grammar* a, const sgm_grammar* b) {
  const auto same = [&](auto count, auto name) {
    if (count(a) != count(b)) return false;
    for (uint32_t i = 0; i < count(a); ++i) {
      if (std::string_view(name(a, i)) != name(b, i)) return false;
    }
    return true;
  };
  return same(sgm_grammar_material_count, sgm_grammar_material) && same(sgm_grammar_tag_count, sgm_grammar_tag) &&
         same(sgm_grammar_name_count, sgm_grammar_name);
}

}  // namespace

void World::followChanges() {
  unsigned dirty = std::exchange(dirty_, kNothing);
  if (dirty == kNothing) return;
  const auto* grammar = instanceOf<Grammar>(grammar_);
  const bool compiled = grammar != nullptr && grammar->compiled() != nullptr;
  if ((dirty & kField) && session_ != nullptr && compiled &&
      !sameNames(session_->grammar().get(), grammar->compiled().get())) {
    dirty |= kRestart;
  }
  if ((dirty & kField) && session_ == nullptr) dirty |= kRestart;
  if (dirty & kRestart) {
    startSession();
    return;
  }
  if (session_ == nullptr) return;
  if ((dirty & kField) && compiled) {
    if (Failure failure = session_->set(grammar->compiled(), settings_)) {
      logError("SgmWorld3D: " + *failure);
      fail(*failure);
    }
  }
  if (dirty & (kPaint | kRepack)) {
    if (dirty & kRepack) retired_materials_ = materials_;
    materials_.rebuild(plugin(), materialNames(), settings_);
    if (dirty & kRepack) {
      auto next = std::make_unique<Picture>(plugin(), look());
      next->takeDrawn(session_->drawn(), *picture_);
      if (retired_ == nullptr || picture_->counts().chunks != 0) retired_ = std::move(picture_);
      picture_ = std::move(next);
    } else {
      picture_->setMaterials(materials_.rids());
    }
  }
  dirty_ |= dirty & (kLook | kPlacement);
  followPlace();
  if ((dirty & kBodies) && colliders_) colliders_->setLayers(settings_.collision_layer, settings_.collision_mask);
}

void World::tellOfScale() {
  const Transform node = placement().node;
  bool scaled = false;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 column = node.column(axis);
    scaled = scaled || std::abs(std::hypot(column.x, column.y, column.z) - 1) > 1e-3f;
  }
  if (scaled && !told_of_scale_) {
    logWarning("SgmWorld3D: " + own("get_name").to<std::string>() +
               " is scaled, by itself or by its parents: a world may be moved and turned, but its lengths are metres");
  }
  told_of_scale_ = scaled;
}

void World::followPlace() {
  if (session_ == nullptr || picture_ == nullptr || !in_tree_) return;
  const unsigned dirty = dirty_ & (kLook | kPlacement);
  dirty_ &= ~dirty;
  if (dirty & kLook) {
    const Look seen = look();
    picture_->setLook(seen.shadow, seen.visible, seen.layers);
    if (retired_) retired_->setLook(seen.shadow, seen.visible, seen.layers);
  }
  if (dirty & kPlacement) {
    const Placement place = placement();
    tellOfScale();
    picture_->setPlacement(place);
    if (retired_) retired_->setPlacement(place);
    if (colliders_) colliders_->setPlacement(place);
    moveScenes();
    materials_.resend();
  }
}

}  // namespace sgm_godot
