// The light of the sky, the sun and lamps, written in the subset of GLSL that C++ accepts. Shaders use it to light
// visible surfaces; runtime/tools/render/light_tracer.cpp uses it for indirect light.

// Returns the light of the sky in a direction, without the sun's disc: deep blue overhead, paler towards the horizon
// because of the longer way through air, nearly white in the haze there, and brighter around the sun. Below the
// horizon, returns the light of endless ground.
FN vec3 skyLight(vec3 d, vec3 to_sun) {
  float h = max(d.y, 0.0f), s = max(dot(d, to_sun), 0.0f);
  vec3 c = mix(vec3(0.085f, 0.21f, 0.49f), vec3(0.33f, 0.50f, 0.75f), exp(-3.0f * h));
  c = mix(c, vec3(0.74f, 0.80f, 0.86f), 0.82f * exp(-10.0f * h));
  c += vec3(1.0f, 0.86f, 0.66f) * (0.16f * pow(s, 6.0f) + 0.26f * pow(s, 40.0f) + 0.5f * pow(s, 400.0f));
  return mix(vec3(0.22f, 0.21f, 0.19f), c, smoothstep(-0.12f, 0.0f, d.y));
}

// Returns the light on a surface that faces the sun.
FN vec3 sunLight() { return vec3(2.75f, 2.38f, 1.92f); }

// Returns the share of a lamp's colour that reaches a surface at this distance; it is 0 beyond 4.5 times the range
// (`reach`).
FN float lampFall(float distance_to_lamp, float reach) {
  float end = distance_to_lamp / (4.5f * reach);
  if (end >= 1.0f) return 0.0f;
  float window = 1.0f - end * end;
  return window * window * 1.4f * reach * reach / (distance_to_lamp * distance_to_lamp + 0.45f * reach * reach);
}

// Returns the brightness of the headlamp's beam, which is wide with a soft border. cosine: cosine of the angle between
// the beam's axis and the direction to the surface.
FN float lampBeam(float cosine) { return mix(0.16f, 1.0f, smoothstep(0.45f, 0.97f, cosine)); }
