#include "world/world.h"

#include <chrono>
#include <utility>

#include "colliders.h"
#include "world/named_settings.h"

namespace sgm_godot {
namespace {

// Numbers of the engine's notifications.
constexpr int32_t kEnterTree = 10, kExitTree = 11, kInternalProcess = 25, kInternalPhysicsProcess = 26,
                  kVisibilityChanged = 43, kTransformChanged = 2000;

constexpr double kFileSeconds = 0.5;  // seconds between two checks whether the grammar's file has changed

/// Whether two grammars have the same materials, tags and names: the numbers of materials and tags in vertices then
/// have the same meaning.
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

World::World(Plugin& plugin, Object self) : Instance(plugin, self), node_{plugin, self}, stage_(node_) {}

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
      mark(Settings::kLook);
      break;
    case kTransformChanged:
      mark(Settings::kPlacement);
      break;
    default:
      break;
  }
}

bool World::set(const std::string& name, const Variant& value) {
  const std::optional<Settings::Effect> effect = setNamed(node_.settings, name, value);
  if (effect) mark(*effect);
  return effect.has_value();
}

bool World::get(const std::string& name, Variant& value) const {
  std::optional<Variant> found = namedValue(node_.settings, node_.compiled().get(), name);
  if (found) value = std::move(*found);
  return found.has_value();
}

std::vector<Instance::Property> World::properties() const {
  return namedProperties(node_.settings, node_.compiled().get());
}

Variant World::revertsTo(const std::string& name) const { return namedDefault(node_.compiled().get(), name); }

void World::enter() {
  node_.in_tree = true;
  if (plugin().rendering == nullptr) plugin().rendering = std::make_unique<Rendering>();
  if (plugin().physics == nullptr) plugin().physics = std::make_unique<Physics>();
  own("set_notify_transform", true);
  own("set_process_internal", true);
  own("set_physics_process_internal", true);
  monitors_.add(self());
  restart();
}

void World::leave() {
  node_.in_tree = false;
  monitors_.remove();
  stage_.stop();
  own("set_process_internal", false);
  own("set_physics_process_internal", false);
  stage_.viewers().clear();
}

void World::setGrammar(Object grammar) {
  Variant& current = node_.grammar;
  if (grammar == current.object()) return;
  const Name changed("changed");
  const Variant handler = callable(self(), Name("_grammar_changed"));
  if (!current.isNil() && current.call("is_connected", changed, handler).truth()) {
    current.call("disconnect", changed, handler);
  }
  current = instanceOf<Grammar>(grammar) != nullptr ? Variant(grammar) : Variant();
  if (!current.isNil()) current.call("connect", changed, handler);
  restart();
  own("notify_property_list_changed");
}

void World::followGrammar() {
  if (instanceOf<Grammar>(node_.grammar) == nullptr) return;
  mark(Settings::kField);
  own("notify_property_list_changed");
  const std::string error = Variant(node_.grammar).call("get_error_text").to<std::string>();
  if (!error.empty()) {
    messages().fail(error);
  } else {
    messages().clearError();
  }
  messages().emit();
}

bool World::isReady() {
  if (!stage_.isRunning() && (unfollowed_ & Settings::kRestart)) followChanges();
  return stage_.isRunning();
}

void World::start() {
  const bool has_grammar = instanceOf<Grammar>(node_.grammar) != nullptr;
  const GrammarOwner compiled = node_.compiled();
  if (node_.in_tree && compiled != nullptr && (!plugin().in_editor || node_.settings.preview)) {
    stage_.start(compiled);
    return;
  }
  stage_.stop();
  if (has_grammar && compiled == nullptr && messages().error().empty()) {
    messages().fail(Variant(node_.grammar).call("get_error_text").to<std::string>());
  }
}

// Changes of the placement and the look apply to the drawn world at once. The node's next frame would be too late: it
// may come after the player's frame, or never while the game is paused.
void World::mark(unsigned effects) {
  unfollowed_ |= effects;
  if (effects & (Settings::kLook | Settings::kPlacement)) followPlace();
}

void World::followChanges() {
  unsigned effects = std::exchange(unfollowed_, Settings::kNothing);
  if (effects == Settings::kNothing) return;
  const GrammarOwner compiled = node_.compiled();
  const bool is_running = stage_.isRunning();
  if ((effects & Settings::kField) && is_running && compiled != nullptr &&
      !sameNames(stage_.session()->grammar().get(), compiled.get())) {
    effects |= Settings::kRestart;
  }
  if ((effects & Settings::kField) && !is_running) effects |= Settings::kRestart;
  if (effects & Settings::kRestart) {
    start();
    return;
  }
  if (!is_running) return;
  if ((effects & Settings::kField) && compiled != nullptr) stage_.setField(compiled);
  if (effects & (Settings::kPaint | Settings::kRepack)) stage_.repaint((effects & Settings::kRepack) != 0);
  unfollowed_ |= effects & (Settings::kLook | Settings::kPlacement);
  followPlace();
  if (effects & Settings::kBodies) stage_.followBodyLayers();
}

void World::followPlace() {
  if (!stage_.isRunning() || stage_.pictures().current() == nullptr || !node_.in_tree) return;
  const unsigned effects = unfollowed_ & (Settings::kLook | Settings::kPlacement);
  unfollowed_ &= ~effects;
  if (effects & Settings::kLook) stage_.followLook();
  if (effects & Settings::kPlacement) stage_.followPlacement();
}

void World::frame() {
  using Clock = std::chrono::steady_clock;
  times_.nextFrame();
  {
    const FrameTimes::Span span(times_);
    const Clock::time_point start = Clock::now();
    const double delta = own("get_process_delta_time").to<double>();
    followFile(delta);
    followChanges();
    if (stage_.isRunning()) {
      stage_.stream(delta, [&] {
        return node_.settings.frame_budget / 1000 - std::chrono::duration<double>(Clock::now() - start).count();
      });
    }
  }
  messages().emit();
}

void World::physicsFrame() {
  if (stage_.colliders() == nullptr || !stage_.isRunning()) return;
  {
    const FrameTimes::Span span(times_);
    stage_.lookForGround();
  }
  messages().emit();
}

void World::followFile(double delta) {
  since_file_ += delta;
  if (since_file_ < kFileSeconds || !node_.settings.hot_reload) return;
  since_file_ = 0;
  if (!plugin().in_editor) {
    const Variant system(engine().global_get_singleton(Name("OS").get()));
    if (!system.call("is_debug_build").truth()) return;
  }
  if (auto* grammar = instanceOf<Grammar>(node_.grammar)) grammar->followFile();
}

bool World::waitUntilIdle(double seconds) {
  followChanges();
  if (!stage_.isRunning()) return false;
  const bool is_idle = stage_.waitUntilIdle(seconds);
  messages().emit();
  return is_idle;
}

}  // namespace sgm_godot
