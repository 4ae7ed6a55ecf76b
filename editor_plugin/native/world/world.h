#pragma once
// SgmWorld3D: a grammar's world in the scene, streamed around viewers.

#include "frame_times.h"
#include "godot/conversion.h"
#include "world/monitors.h"
#include "world/stage.h"

namespace sgm_godot {

struct ClassRecord;

/// The C++ part of an SgmWorld3D node: its stage (the running parts of the world), and the changes of settings that are
/// not yet applied to the stage. Most methods for scripts are functions in edits.h, queries.h, density.h, measures.h
/// and statistics.h. Main thread only, except Stage::active().
class World : public Instance {
 public:
  World(Plugin& plugin, Object self);
  static void registerClass(ClassRecord& record);

  void notify(int32_t what) override;
  bool set(const std::string& name, const Variant& value) override;
  bool get(const std::string& name, Variant& value) const override;
  std::vector<Property> properties() const override;
  Variant revertsTo(const std::string& name) const override;

  const WorldNode& node() const { return node_; }
  const Stage& stage() const { return stage_; }
  Stage& stage() { return stage_; }
  Messages& messages() { return node_.messages; }
  const FrameTimes& frameTimes() const { return times_; }

  /// Whether a session runs. A world that has just entered the scene starts its session now, so that scripts can call
  /// its methods at once.
  bool isReady();
  /// Changes a setting, and notes the effect of the change; does nothing if the setting already has the value.
  template <class T>
  void change(T Settings::*setting, T value, Settings::Effect effect) {
    if (isSameSetting(node_.settings.*setting, value)) return;
    node_.settings.*setting = std::move(value);
    if (effect == Settings::kPlacement) stage_.setOrigin(node_.settings.origin);
    mark(effect);
  }
  void setGrammar(Object grammar);
  /// Handles the grammar's signal `changed`.
  void followGrammar();
  void restart() { mark(Settings::kRestart); }
  /// Blocks until everything around the viewers is drawn, but at most `seconds`. Returns false after the timeout or an
  /// error.
  bool waitUntilIdle(double seconds);

 private:
  void enter();
  void leave();
  void frame();
  void physicsFrame();
  void followFile(double delta);
  void mark(unsigned effects);
  void followChanges();
  void followPlace();
  void start();

  WorldNode node_;
  Stage stage_;
  unsigned unfollowed_ = Settings::kNothing;  // the effects of settings that have changed, but are not applied yet
  Monitors monitors_;
  FrameTimes times_;
  double since_file_ = 0;  // seconds since the last check of the grammar's file
};

}  // namespace sgm_godot
