// Vectors of crossed edges, used for grids and for chunks. See cells.inl.

/// A vector of edges of plane z.
struct EdgeLanes {
  Int x, y, z, axis;
  Bool along_x, along_y, along_z;
};

FN EdgeLanes unpackEdges(const uint32_t* edges, size_t z) {
  const Uint edge = toUintBits(loadLanes(edges));
  const Int axis = toIntBits(edge >> 2 * kPlaceBits);
  return {toIntBits(edge & Uint(kPlaceMask)),
          toIntBits(edge >> kPlaceBits & Uint(kPlaceMask)),
          broadcastInt(static_cast<int32_t>(z)),
          axis,
          axis == broadcastInt(0),
          axis == broadcastInt(1),
          axis == broadcastInt(2)};
}

/// Same as crossing() of mesh/vertex.h. The rounded quotient of the float division may be one too large or too small;
/// the integer arithmetic after it corrects this.
FN Int crossingOf(Int q0, Int q1) {
  const Int zero = broadcastInt(0), one = broadcastInt(1);
  const Int a = sel(q0 < zero, wrapSub(zero, q0), q0), b = sel(q1 < zero, wrapSub(zero, q1), q1);
  const Int sum = wrapAdd(a, b), twice = wrapAdd(sum, sum);
  PRECISE Real rounded = quotient(toReal(a) * broadcast(256.0f), toReal(sum)) + broadcast(0.5f);
  Int t = toInt(rounded);
  const Int rest = wrapSub(wrapAdd(wrapMul(a, broadcastInt(512)), sum), wrapMul(t, twice));
  t = sel(rest < zero, wrapSub(t, one), sel(rest >= twice, wrapAdd(t, one), t));
  t = sel(t < one, one, t);
  return sel(t > broadcastInt(255), broadcastInt(255), t);
}

/// Returns the vertex's offset along its edge, in the format of makeCubePlaces().
FN Int placeOffset(const EdgeLanes& e, Int t) {
  return wrapMul(t, sel(e.along_x, broadcastInt(1), sel(e.along_y, broadcastInt(1 << 9), broadcastInt(1 << 18))));
}
