#pragma once

#include "world/active_session.h"
#include "world/anchor_scenes.h"
#include "world/pictures.h"
#include "world/viewers.h"

namespace sgm_godot {

class Colliders;

/// The parts of a world that exist while its session runs: pictures, colliders and the scenes of anchors, all of them
/// streamed around viewers. Main thread only, except active().
class Stage {
 public:
  explicit Stage(WorldNode& node);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Replaces the running session by a session with the node's current settings, and queues the signal `restarted`. The
  /// previous picture stays until the new session has something to show. An error is reported; the running session then
  /// continues, unless it had to end first because of its journal.
  void start(const GrammarOwner& grammar);
  void stop();

  // The following functions change the settings of a running session.
  void setField(const GrammarOwner& grammar);
  /// Changes the materials. is_repacking: true if materials have other slots; all meshes are then packed again.
  void repaint(bool is_repacking);
  void followLook();
  void followPlacement();
  void followBodyLayers();

  /// Does the work of a frame: updates the session, and hands over meshes, colliders and scenes to the engine until
  /// `seconds_left` returns 0 or less.
  void stream(double delta, const std::function<double()>& seconds_left);
  /// Blocks until everything around the viewers is drawn, but at most `seconds`. Returns false after the timeout or an
  /// error.
  bool waitUntilIdle(double seconds);
  /// Does the work of a physics frame: queues the signal `walkable` for each viewer that now has ground below it.
  void lookForGround();

  bool isRunning() const { return session() != nullptr; }
  bool isIdle() const;
  const std::shared_ptr<Session>& session() const { return active_.current(); }  // null if no session runs
  const ActiveSession& active() const { return active_; }                        // thread-safe
  void setOrigin(Vector3i origin) { active_.setOrigin(origin); }
  const Pictures& pictures() const { return pictures_; }
  const Colliders* colliders() const { return colliders_.get(); }  // null if the world has no colliders
  Viewers& viewers() { return viewers_; }

 private:
  Look look() const;
  Pictures::Paint paint() const;
  void warnOfScale();
  /// Passes the viewers to the session. Returns the session's error; nullopt on success.
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
  bool colliders_first_ = false;  // true: the next frame makes colliders first, and the drawn meshes after them
};

}  // namespace sgm_godot
