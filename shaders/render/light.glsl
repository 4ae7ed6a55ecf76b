// The light that reaches a surface, and the light that the surface reflects to the eye.

#include "render/sky.glsl"

ivec2 planeSize() { return ivec2(frame.size.xy * frame.size.z); }

// Returns the ambient openness of a surface in screen space, 0..1 (after McGuire et al., "The alchemy screen-space
// ambient obscurance").
float openness(ivec2 at, vec3 p, vec3 n, float distance_to_eye, float radius, float turn) {
  const int kTaps = 9;
  float reach = clamp(radius / (distance_to_eye * frame.eye.w), 4.0, 0.22 * float(planeSize().y));
  float hidden = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    float f = (float(i) + 0.5) / float(kTaps), angle = 6.2831853 * (turn + 5.0 * f);
    ivec2 tap = at + ivec2(vec2(cos(angle), sin(angle)) * (reach * f));
    if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, planeSize()))) continue;
    vec4 q = texelFetch(position_plane, tap, 0);
    if (q.w == 0.0) continue;
    vec3 v = q.xyz - p;
    float d2 = dot(v, v);
    float fade = max(0.0, 1.0 - d2 / (4.0 * radius * radius));
    hidden += fade * max(0.0, dot(v, n) - 0.004 * distance_to_eye) * radius / (d2 + 0.03 * radius * radius);
  }
  return clamp(1.0 - 0.42 * hidden / float(kTaps) * 2.0, 0.0, 1.0);
}

// Returns the share of light that is reflected to the eye, including the factor n.l: diffuse reflection by Lambert's
// law, wrapped for translucent materials, and a GGX highlight.
vec3 reflected(Surface s, vec3 to_light, vec3 to_eye) {
  float nl = dot(s.normal, to_light);
  float wrap = 0.6 * s.translucency;
  float diffuse = max(0.0, (nl + wrap) / (1.0 + wrap));
  // Transmitted light is tinted twice by the material's colour.
  vec3 twice = s.albedo / max(max(s.albedo.r, s.albedo.g), max(s.albedo.b, 1e-4));
  vec3 through = mix(vec3(1.0), twice, s.translucency * (1.0 - smoothstep(-0.2, 0.6, nl)));
  vec3 result = s.albedo * through * diffuse;
  if (nl > 0.0 && s.specular > 0.0) {
    vec3 h = normalize(to_light + to_eye);
    float nh = max(dot(s.normal, h), 0.0), nv = max(dot(s.normal, to_eye), 0.05), lh = max(dot(to_light, h), 0.0);
    float a = s.roughness * s.roughness, a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float k = 0.5 * a + 0.02;
    float shape = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    float fresnel = s.specular + (1.0 - s.specular) * pow(1.0 - lh, 5.0);
    result += vec3(nl * fresnel * min(0.25 * a2 / (d * d) * shape, 40.0));
  }
  return result;
}

// Returns the light of a lamp that haze scatters towards the eye, up to distance t along d: the integral of 1 / r^2.
// The halo is wide and has no bright core, which would look like a highlight on a shiny surface.
float glow(vec3 d, float t, vec3 lamp, float reach) {
  vec3 q = frame.eye.xyz - lamp;
  float b = dot(d, q), s = inversesqrt(max(dot(q, q) - b * b, 0.06 * reach * reach));
  return s * (atan((t + b) * s) - atan(b * s));
}
