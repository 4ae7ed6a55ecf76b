#pragma once

#include "world/active_session.h"
#include "world/anchor_scenes.h"
#include "world/pictures.h"
#include "world/viewers.h"

namespace sgm_godot {

class Colliders;

/// The parts of a world that exist while its session runs: pictures, colliders and the scenes of anchors, streamed
/// around viewers. Main thread, except active().
class Stage {
 public:
  explicit Stage(WorldNode& node);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Starts a session of the node's settings in place of the one that runs, and announces `restarted`; the previous
  /// picture stays until the new one has something to show. On an error, which is reported, the running session stays,
  /// unless it has to end first because of its journal.
  void start(const GrammarOwner& grammar);
  void stop();

  // The following change a running session.
  void setField(const GrammarOwner& grammar);
  /// is_repacking: the materials have other slots.
  void repaint(bool is_repacking);
  void followLook();
  void followPlacement();
  void followBodyLayers();

  /// A frame: hands over new parts of the world until `seconds_left` returns 0 or less.
  void stream(double delta, const std::function<double()>& seconds_left);
  /// Blocks until everything around the viewers is there, at most `seconds`. Returns whether it is.
  bool waitUntilIdle(double seconds);
  /// A physics frame: announces viewers that have ground now.
  void lookForGround();

  bool isRunning() const { return session() != nullptr; }
  bool isIdle() const;
  const std::shared_ptr<Session>& session() const { return active_.current(); }  // null if none runs
  const ActiveSession& active() const { return active_; }                        // for any thread
  void setOrigin(Vector3i origin) { active_.setOrigin(origin); }
  const Pictures& pictures() const { return pictures_; }
  const Colliders* colliders() const { return colliders_.get(); }  // null if there are none
  Viewers& viewers() { return viewers_; }

 private:
  Look look() const;
  Pictures::Paint paint() const;
  void warnOfScale();
  /// Tells the session of the viewers. Returns its error, if there is one.
  Failure setViewers();
  void receive(const std::vector<sgm_world_event>& events);
  void show(const std::vector<Picture::Change>& changes);

  WorldNode& node_;
  ActiveSession active_;
  Pictures pictures_;
  std::unique_ptr<Colliders> colliders_;
  AnchorScenes anchor_scenes_;
  Viewers viewers_;
  bool was_idle_ = false;
  bool was_scaled_ = false;
  bool colliders_first_ = false;  // in the next frame
};

}  // namespace sgm_godot
