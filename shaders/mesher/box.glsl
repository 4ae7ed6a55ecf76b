// A box of integer positions, in the form that common/bounds.h requires.
struct Box3 {
  int lo_x, lo_y, lo_z, hi_x, hi_y, hi_z;
};

Box3 makeBox(ivec3 lo, ivec3 hi) {
  Box3 box;
  box.lo_x = lo.x;
  box.lo_y = lo.y;
  box.lo_z = lo.z;
  box.hi_x = hi.x;
  box.hi_y = hi.y;
  box.hi_z = hi.z;
  return box;
}
