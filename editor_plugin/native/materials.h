#pragma once
// The engine materials with which a world's surfaces are drawn. Main thread only.

#include "morph_ranges.h"
#include "settings.h"
#include "tools/materials/material.h"

namespace sgm_godot {

struct Plugin;

class Materials {
 public:
  /// Loads the plugin's own shader. If its file is missing, uses a plain material and logs a warning.
  void rebuild(Plugin& plugin, const std::vector<std::string>& names, const Settings& settings);

  // slot of each material, indexed by material of the grammar
  const std::vector<uint16_t>& slots() const { return slots_; }
  std::vector<Rid> rids() const;  // the engine's id of each material, indexed by slot
  const std::vector<Color>& palette() const { return palette_; }
  /// The material that a game has set for a slot; nil for slot 0, the blended material.
  const Variant& material(uint16_t slot) const { return materials_[slot].own; }
  const std::string& name(uint16_t slot) const { return materials_[slot].name; }

  /// Makes the next update() send all parameters again.
  void resend() { sent_ = false; }
  /// Sends the parameters of the surface shaders that change from frame to frame. viewers: in scene coordinates.
  void update(const std::vector<Vector3>& viewers, const MorphRanges& ranges, double cell_size,
              const Placement& placement);

 private:
  struct Slot {
    std::string name;
    Variant own;  // the material that the game has set; nil: the plugin's material is used
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
