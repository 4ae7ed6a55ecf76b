#pragma once

#include "materials.h"
#include "picture.h"
#include "session.h"

namespace sgm_godot {

/// The pictures of a world, that is, the objects that draw it in the engine's scene. There are up to two: the picture
/// of the running session, and the previous picture, which stays until the current one has chunks to show. Each has
/// materials of its own. Main thread only.
class Pictures {
 public:
  /// The names of the grammar's materials, and the settings that determine how materials look.
  struct Paint {
    std::vector<std::string> names;
    const Settings& settings;
  };
  explicit Pictures(Plugin& plugin) : plugin_(plugin) {}

  /// Removes and returns the picture that currently shows chunks: the current one or the previous one; may be null.
  std::unique_ptr<Picture> take();
  /// Makes a picture that came from take() the current picture again.
  void giveBack(std::unique_ptr<Picture> picture) { current_ = std::move(picture); }
  /// Starts a new, empty picture. `previous` stays in the scene until the new picture shows chunks. `look` is the new
  /// picture's look; its slots and materials are ignored.
  void begin(std::unique_ptr<Picture> previous, const Paint& paint, Look look);
  void clear();
  void dropPrevious() { previous_.reset(); }

  /// Changes the materials of the drawn chunks.
  void repaint(const Paint& paint);
  /// Packs and draws all chunks of the session again, because the materials have other slots.
  void repack(const Paint& paint, Look look, const Session& session);
  void setLook(const Look& look);
  void setPlacement(const Placement& placement);

  /// Returns null if no session runs.
  Picture* current() const { return current_.get(); }
  Materials& materials() { return materials_; }
  const Materials& materials() const { return materials_; }

 private:
  std::unique_ptr<Picture> create(Look look) const;  // makes a picture with the current materials

  Plugin& plugin_;
  Materials materials_, previous_materials_;
  std::unique_ptr<Picture> current_, previous_;
};

}  // namespace sgm_godot
