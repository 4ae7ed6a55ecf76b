#pragma once
// The materials that a world's surfaces are drawn with. Main thread.

#include "morph_ranges.h"
#include "settings.h"
#include "tools/materials/material.h"

namespace sgm_godot {

struct Plugin;

class Materials {
 public:
  /// Loads the plugin's own shader; where it is not there, a plain material takes its place, and the log is told.
  void rebuild(Plugin& plugin, const std::vector<std::string>& names, const Settings& settings);

  const std::vector<uint16_t>& slots() const { return slots_; }  // by material of the grammar
  std::vector<Rid> rids() const;                                 // by slot
  const std::vector<Color>& palette() const { return palette_; }
  /// The slot's material as a game set it; nil for the blended one.
  const Variant& material(uint16_t slot) const { return materials_[slot].own; }
  const std::string& name(uint16_t slot) const { return materials_[slot].name; }

  /// Has everything sent again.
  void resend() { sent_ = false; }
  /// What shaders of surfaces read, all that changes from frame to frame; `viewers` in the scene.
  void update(const std::vector<Vector3>& viewers, const MorphRanges& ranges, double cell_size,
              const Placement& placement);

 private:
  struct Slot {
    std::string name;
    Variant own;  // nil: the plugin's
    Variant used;
  };
  void send(const char* parameter, const Variant& value) const;

  std::vector<uint16_t> slots_;
  std::vector<Slot> materials_;
  std::vector<Color> palette_;
  std::vector<sgm::MaterialLook> looks_;
  std::vector<Vector3> viewers_;
  MorphRanges ranges_;
  bool sent_ = false;
};

}  // namespace sgm_godot
