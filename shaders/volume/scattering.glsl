// What light does in a medium.

// Share of the light that goes on at this cosine of the angle to where it went; g is the mean cosine: 0 on all sides,
// towards 1 ahead (Henyey and Greenstein 1941).
float phase(float cosine, float g) {
  float s = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (12.5663706 * s * sqrt(s));
}

// Light of the sun, of irradiance 1, that a place sends along a ray, by the optical depth that it came through.
// The first octave is single scattering, with Beer and Lambert's extinction. Light that is scattered often goes farther
// and forgets where it came from: each further octave stands for more of it, with half the strength, half the
// extinction and half the mean cosine of the one before (Wrenninge, Kulla and Lundqvist 2013, "Oz: the great and
// volumetric"; Hillaire 2016, "Physically based sky, atmosphere and cloud rendering in Frostbite").
float scattered(float cosine, float depth, float g, uint octaves) {
  float sum = 0.0, share = 1.0;
  for (uint i = 0u; i < octaves; ++i) {
    sum += share * phase(cosine, g * share) * exp(-depth * share);
    share *= 0.5;
  }
  return sum;
}
