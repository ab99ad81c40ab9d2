// A vertex of a scene: 32 bytes, of which the engine reads the position (stride 32).
#ifndef VKH_EXAMPLES_VERTEX_GLSL
#define VKH_EXAMPLES_VERTEX_GLSL

struct SceneVertex {
  vec3 position;
  vec3 normal;
  vec2 spare;
};

#endif
