// A vertex of a scene: 32 bytes, of which the engine reads the position (stride 32).
#ifndef VKH_EXAMPLES_VERTEX_GLSL
#define VKH_EXAMPLES_VERTEX_GLSL

struct SceneVertex {
  vec3 position;
  float distance;  // from the level that is drawn, for the colour
  vec3 normal;
  float spare;
};

#endif
