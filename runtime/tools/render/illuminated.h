#pragma once
// Includes the shader header shaders/render/illumination.h as C++.

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace sgm {

#define FN inline
using glm::dot, glm::exp, glm::max, glm::mix, glm::pow, glm::smoothstep, glm::vec3;
#include "render/illumination.h"
#undef FN

}  // namespace sgm
