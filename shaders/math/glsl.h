// Lets the headers of shaders/math compile as C++ too: GLSL's vector types and functions by GLM,
// and its parameter qualifiers.
#ifndef VKH_SHADERS_MATH_GLSL_H
#define VKH_SHADERS_MATH_GLSL_H

#ifdef __cplusplus
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "shaders/gpu_types.h"
#define VKH_LIB_BEGIN namespace vkh::lib {
#define VKH_LIB_END }
#define VKH_FN inline
#define VKH_OUT(type) type&
#define VKH_PRECISE
namespace vkh::lib {
using uint = uint32_t;
inline uint floatBitsToUint(float x) { return std::bit_cast<uint>(x); }
inline float uintBitsToFloat(uint x) { return std::bit_cast<float>(x); }
using glm::abs;
using glm::clamp;
using glm::max;
using glm::min;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec3;
using std::sqrt;  // of floats
using namespace vkh::gpu;
}  // namespace vkh::lib
#else
#include "shaders/gpu_types.h"
#define VKH_LIB_BEGIN
#define VKH_LIB_END
#define VKH_FN
#define VKH_OUT(type) out type
#define VKH_PRECISE precise
#endif
#endif
