// The shared parts of the renderer's shaders: levels of detail, the choice among them, the caption.
#ifndef VKH_EXAMPLES_FRAME_GLSL
#define VKH_EXAMPLES_FRAME_GLSL

const uint kLevels = 4u;
const uint kRows = 4u;
const uint kColumns = 52u;

// The ways to draw a mesh.
const uint kModePlain = 0u;     // the chosen level, smooth
const uint kModeEdges = 1u;     // the chosen level, flat, with its edges
const uint kModeDistance = 2u;  // the finest level, coloured by its distance from the chosen one

struct Level {
  uint first_vertex, first_index, cells_u, cells_v;
};

struct DrawCommand {  // VkDrawIndirectCommand
  uint vertex_count, instance_count, first_vertex, first_instance;
};

struct Choice {
  DrawCommand draw;  // of the chosen level
  uint level;
  float fill[3];  // upper bound of levels 1, 2, 3 in pixels
  uint text[kRows * kColumns];
};

#endif
