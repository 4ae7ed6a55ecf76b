#include "viewer.h"

#include "godot/class_binder.h"

namespace sgm_godot {
namespace {

constexpr int32_t kEnterTree = 10;

}  // namespace

void Viewer::notify(int32_t what) {
  if (what == kEnterTree) own("add_to_group", Name(kGroup));
}

void Viewer::registerClass(ClassRecord& record) {
  record.name = "SgmViewer3D";
  record.parent = "Node3D";
  ClassBinder::add<Viewer>(record)
      .property<&Viewer::setEnabled, &Viewer::enabled>("enabled")
      .property<&Viewer::setWeight, &Viewer::weight>("weight", range("0.01,100,0.01,exp"))
      .property<&Viewer::setFov, &Viewer::fov>("fov", range("0,170,0.1,degrees"))
      .property<&Viewer::setDirectional, &Viewer::directional>("directional");
}

}  // namespace sgm_godot
