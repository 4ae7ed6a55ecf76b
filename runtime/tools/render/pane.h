#pragma once
// The unevenness of window panes and water surfaces, and clouds in reflections.

#include <cmath>

#include "tools/render/illuminated.h"
#include "tools/render/puff_noise.h"

namespace sgm {

/// The distorted normal of a pane. Old panes are wavy and each is slightly tilted, so each reflects another part of the
/// sky. p: position plus RenderFrame::pattern_offset, metres.
inline vec3 paneNormal(vec3 normal, vec3 p) {
  // A random tilt for each sash (the frame of one pane).
  const auto lot = [&](float by) {
    const float v = std::sin(by + 12.99f * std::floor(0.9f * (p.x + p.z)) + 78.23f * std::floor(0.42f * p.y)) * 43.76f;
    return v - std::floor(v) - 0.5f;
  };
  const vec3 askew(lot(0), lot(1.7f), lot(3.1f));
  const vec3 wave(std::sin(1.9f * p.y + 0.7f * p.x), std::sin(2.3f * (p.x + p.z) + 0.6f * p.y),
                  std::sin(1.7f * p.z + 1.1f * p.y));
  return glm::normalize(normal + 0.016f * wave + 0.045f * askew);
}

/// The normal of open water with wind ripples of several wavelengths and directions. p: position plus
/// RenderFrame::pattern_offset, metres.
inline vec3 rippledNormal(vec3 normal, vec3 p) {
  constexpr int kWaves = 6;
  const float gust = 0.6f + 0.4f * std::sin(0.31f * p.x + 1.7f * std::sin(0.23f * p.z)) * std::sin(0.27f * p.z);
  float turn = 0.4f, wave = 2.6f, east = 0, south = 0, bent = 0;
  for (int i = 0; i < kWaves; ++i) {
    const float c = std::cos(turn), s = std::sin(turn);
    const float slope = std::cos(wave * (c * p.x + s * p.z) + 1.9f * bent);
    east += c * slope;
    south += s * slope;
    bent += slope;
    turn += 2.4f;
    wave *= 1.62f;
  }
  return glm::normalize(normal + 0.022f * gust * vec3(east, 0, south));
}

/// The share of the sky's light that fair-weather clouds hide in an upward direction. Approximates
/// shaders/render/clouds.glsl.
inline float mirroredClouds(vec3 direction) {
  const vec3 level = 300.0f * direction / (direction.y + 0.12f);
  return 0.8f * smoothstep(0.45f, 0.85f, 1 - puffHollows(vec3(level.x, 0, level.z), 128, 8));
}

}  // namespace sgm
