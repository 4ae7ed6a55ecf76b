// How light is scattered in a medium.

// The phase function: returns the share of light that is scattered in a direction (Henyey and Greenstein 1941). cosine:
// cosine of the angle to the light's previous direction; g: mean cosine; 0: equally in all directions; towards 1:
// forwards.
float phase(float cosine, float g) {
  float s = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (12.5663706 * s * sqrt(s));
}

// Returns the sunlight, of irradiance 1, that a place scatters along a ray. depth: optical depth of the light's way to
// the place. The first octave is single scattering, with extinction by the law of Beer and Lambert. Light that is
// scattered repeatedly reaches farther and loses its direction: each further octave represents more scattering, with
// half the strength, half the extinction and half the mean cosine of the previous one (Wrenninge, Kulla and Lundqvist
// 2013, "Oz: the great and volumetric"; Hillaire 2016, "Physically based sky, atmosphere and cloud rendering in
// Frostbite").
float scattered(float cosine, float depth, float g, uint octaves) {
  float sum = 0.0, share = 1.0;
  for (uint i = 0u; i < octaves; ++i) {
    sum += share * phase(cosine, g * share) * exp(-depth * share);
    share *= 0.5;
  }
  return sum;
}
