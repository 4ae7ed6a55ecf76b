// What lies behind everything, and how light becomes a pixel. Whoever includes this has frame.sun, towards the sun.

// Light from the sky in a direction.
vec3 sky(vec3 d) {
  float h = max(d.y, 0.0);
  vec3 c = mix(vec3(0.48, 0.64, 0.82), vec3(0.055, 0.17, 0.47), pow(h, 0.5));
  c = mix(c, vec3(0.30, 0.34, 0.36), smoothstep(0.0, -0.5, d.y));
  float s = max(dot(d, frame.sun.xyz), 0.0);
  return c + vec3(1.0, 0.85, 0.62) * (0.16 * pow(s, 6.0) + 0.35 * pow(s, 60.0));
}

// What the air between the eye and whatever lies in direction d adds, once it hides all of it.
vec3 hazeIn(vec3 d) { return mix(vec3(0.48, 0.62, 0.80), sky(d), 0.3); }

vec3 toneMap(vec3 c) {  // Narkowicz's fit of the ACES curve
  c *= 0.8;
  return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}

vec3 encodeSrgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
