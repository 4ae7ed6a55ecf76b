#pragma once
// SgmWorld3D: the world of a grammar in the scene, streamed around viewers.

#include <deque>
#include <functional>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "anchors.h"
#include "colliders.h"
#include "frame_times.h"
#include "godot/conversion.h"
#include "materials.h"
#include "session.h"

namespace sgm_godot {

struct ClassRecord;

class World : public Instance {
 public:
  World(Plugin& plugin, Object self) : Instance(plugin, self) {}
  ~World() override;
  static void registerClass(ClassRecord& record);

  void notify(int32_t what) override;
  bool set(const std::string& name, const Variant& value) override;
  bool get(const std::string& name, Variant& value) const override;
  std::vector<Property> properties() const override;
  Variant revertsTo(const std::string& name) const override;

 private:
  // The work that a changed setting requires: kLook and kPlacement immediately, the others in the next frame. Each flag
  // stands for its own work only; none includes another's.
  enum Effect : unsigned {
    kNothing = 0,
    kField = 1,    // replaces the field of the same world
    kRestart = 2,  // makes another world
    kPaint = 4,    // replaces materials
    kRepack = 8,   // repacks meshes for other slots
    kLook = 16,    // changes visibility, shadows, layers
    kPlacement = 32,
    kBodies = 64,  // changes collision layers
  };
  template <auto member>
  using SettingType = std::remove_reference_t<decltype(std::declval<Settings&>().*member)>;
  template <auto member, Effect effect>
  void change(SettingType<member> value) {
    if (settings_.*member == value) return;
    {
      // Other threads read the origin under this lock. The previous value is destroyed outside of the lock.
      const std::lock_guard lock(session_mutex_);
      std::swap(settings_.*member, value);
    }
    dirty_ |= effect;
    // The drawn chunks follow immediately: this node's next frame may come later than the player's, or be paused.
    if constexpr (effect == kPlacement || effect == kLook) followPlace();
  }
  template <auto member>
  SettingType<member> setting() const {
    return settings_.*member;
  }

  // world.cpp: functions from entering the scene tree to leaving it
  void enter();
  void leave();
  void followChanges();
  void followPlace();
  void tellOfScale();
  void startSession();
  void stopSession();
  void setSession(std::shared_ptr<Session> session);
  std::shared_ptr<Session> session() const;  // thread-safe
  struct PlacedSession {
    std::shared_ptr<Session> session;
    Vector3i origin;
  };
  /// The session and the placement of its world, both from the same moment. Thread-safe.
  PlacedSession placedSession() const;
  void setGrammar(Object grammar);
  Object grammar() const { return grammar_.object(); }
  void grammarChanged();
  void setAnchorScenes(const Dictionary& scenes);
  Dictionary anchorScenes() const { return {settings_.anchor_scenes}; }
  void restart() { dirty_ |= kRestart; }
  /// Called by script functions: starts a world that has just entered the scene. Returns false if it does not run.
  bool ready();
  bool running() const { return session_ != nullptr; }
  std::string errorText() const { return error_; }
  void fail(const std::string& message);
  /// Queues a signal until the work that it reports is done, because a listener may end this world or start another.
  template <class... Arguments>
  void announce(const char* signal, const Arguments&... arguments) {
    announced_.emplace_back(signal, std::vector<Variant>{Variant(arguments)...});
  }
  /// Emits the queued signals. Must be the last action of a call: this object may be destroyed afterwards.
  void emitAnnounced();
  Placement placement() const;
  Look look() const;
  std::vector<std::string> materialNames() const;

  // world_frame.cpp: work of every frame
  void frame();
  void stream(double delta, const std::function<double()>& left);
  void physicsFrame();
  void gatherViewers(double delta);
  void addViewer(uint64_t id, const Transform& place, double fov, double weight, bool directional, double delta);
  void receive(std::vector<sgm_world_event>&& events);
  void tell(std::vector<Picture::Change>&& changes);
  void tellOfAnchors(const std::vector<Picture::Change>& changes);
  void placeScenes(double seconds);
  void moveScenes();
  void removeScene(uint64_t key);
  void followFile(double delta);
  bool standsOnCollider(Vector3 position);
  void setEditorView(const Transform& view, double fov);
  bool waitUntilIdle(double seconds);
  bool isIdle() const;

  // world_edits.cpp: digging and building
  Integers dig(const Vector3& position, double radius, double smooth);
  Integers build(const Vector3& position, double radius, const std::string& material, double smooth);
  Integers edit(const Dictionary& brush);
  Integers lay(const sgm_brush& brush);
  Integers undo(const Integers& id);
  int64_t editCount() const;
  Bytes exportEdits(int64_t since);
  int64_t importEdits(const Bytes& bytes);
  int64_t flushEdits();
  int64_t editsHash() const;
  std::optional<uint16_t> materialNumber(const std::string& name) const;
  std::optional<uint16_t> tagNumber(const std::string& name) const;

  // world_queries.cpp: queries of the world
  Dictionary rayCast(const Vector3& from, const Vector3& direction, double length);
  Dictionary closestPoint(const Vector3& position, double max_distance);
  Dictionary described(const sgm_surface_point& point) const;
  Points findWay(const Vector3& from, const Vector3& to, double radius);
  Array anchors(const Aabb& box);
  Aabb bounds() const;
  int64_t worldHash(const Aabb& box, int64_t level);
  Dictionary statistics() const;
  double monitor(const std::string& name) const;
  void addMonitors();
  void removeMonitors();

  // world_density.cpp: data for renderers of fog
  Bytes sampleDensity(const Vector3& corner, double spacing, const Vector3i& size, const Vector3& to_sun, double fade,
                      double edge);

  // world_measures.cpp: measures and export of the drawn meshes
  Dictionary measures() const;
  Dictionary measureDrawn(int64_t bins) const;
  Array bakeChunks() const;

  Settings settings_;
  Variant grammar_;
  unsigned dirty_ = kNothing;
  bool in_tree_ = false;
  std::string error_;

  std::shared_ptr<Session> session_;
  mutable std::mutex session_mutex_;  // locked to change session_ or settings_, and to read them on other threads
  Materials materials_;
  Materials retired_materials_;  // the materials with which retired_ is drawn
  std::unique_ptr<Picture> picture_;
  std::unique_ptr<Picture> retired_;  // picture of the previous session, kept until this session has something to show
  std::unique_ptr<Colliders> colliders_;
  Anchors anchors_;
  std::deque<sgm_anchor> unplaced_;  // anchors whose scenes have yet to be instantiated
  struct Placed {
    uint64_t node;  // instance id of the node
    sgm_anchor anchor;
  };
  std::unordered_map<uint64_t, Placed> scenes_;  // indexed by the anchor's key

  std::vector<sgm_viewer> viewers_;
  std::vector<Vector3> viewer_places_;  // in scene coordinates
  std::vector<Units> viewer_units_;
  struct Watched {
    Vector3 position;
    bool walkable = false;
    bool seen = false;
  };
  std::unordered_map<uint64_t, Watched> watched_;  // indexed by the instance id of the viewer's node
  std::optional<Transform> editor_view_;
  double editor_fov_ = 70;

  std::deque<std::pair<const char*, std::vector<Variant>>> announced_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  FrameTimes times_;
  double since_file_ = 0;
  bool was_idle_ = false;
  bool told_of_scale_ = false;
  bool colliders_first_ = false;
  std::vector<std::string> monitors_;
};

}  // namespace sgm_godot
