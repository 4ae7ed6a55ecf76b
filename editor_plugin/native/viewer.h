#pragma once
// SgmViewer3D: a place in the scene around which worlds are streamed.

#include "godot/conversion.h"

namespace sgm_godot {

struct ClassRecord;

class Viewer : public Instance {
 public:
  using Instance::Instance;
  static void registerClass(ClassRecord& record);
  /// The node group to which viewers belong while they are in the scene tree.
  static constexpr const char* kGroup = "sgm_viewers";

  void notify(int32_t what) override;
  bool enabled() const { return enabled_; }
  double weight() const { return weight_; }
  double fov() const { return fov_; }  // vertical field of view in degrees; 0 stands for 70 degrees
  bool directional() const { return directional_; }

 private:
  void setEnabled(bool value) { enabled_ = value; }
  void setWeight(double value) { weight_ = value; }
  void setFov(double value) { fov_ = value; }
  void setDirectional(bool value) { directional_ = value; }

  bool enabled_ = true, directional_ = false;
  double weight_ = 1, fov_ = 0;
};

}  // namespace sgm_godot
