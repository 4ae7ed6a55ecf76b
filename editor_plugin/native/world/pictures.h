#pragma once

#include "materials.h"
#include "picture.h"
#include "session.h"

namespace sgm_godot {

/// The pictures of a world in the engine's scene, each with its materials: that of the running session, and the
/// previous one until the current one has something to show. Main thread.
class Pictures {
 public:
  /// Names of the grammar's materials, and the settings that materials follow.
  struct Paint {
    std::vector<std::string> names;
    const Settings& settings;
  };
  explicit Pictures(Plugin& plugin) : plugin_(plugin) {}

  /// Takes out the picture that shows something, the current one or the previous one; may return null.
  std::unique_ptr<Picture> take();
  /// Puts a picture back that was taken.
  void giveBack(std::unique_ptr<Picture> picture) { current_ = std::move(picture); }
  /// Begins an empty picture. `previous` stays in the scene until then. `look`: without materials.
  void begin(std::unique_ptr<Picture> previous, const Paint& paint, Look look);
  void clear();
  void dropPrevious() { previous_.reset(); }

  /// Changes the materials of what is drawn.
  void repaint(const Paint& paint);
  /// Draws the session anew, where materials have other slots.
  void repack(const Paint& paint, Look look, const Session& session);
  void setLook(const Look& look);
  void setPlacement(const Placement& placement);

  /// Null if no session runs.
  Picture* current() const { return current_.get(); }
  Materials& materials() { return materials_; }
  const Materials& materials() const { return materials_; }

 private:
  std::unique_ptr<Picture> create(Look look) const;  // with the materials as they are

  Plugin& plugin_;
  Materials materials_, previous_materials_;
  std::unique_ptr<Picture> current_, previous_;
};

}  // namespace sgm_godot
