// The shared parts of the renderer's shaders: levels of detail, the choice among them, the caption.
#ifndef VKH_EXAMPLES_FRAME_GLSL
#define VKH_EXAMPLES_FRAME_GLSL

const uint kLevels = 4u;
const uint kRows = 4u;
const uint kColumns = 52u;

// The ways to draw a mesh.
const uint kModePlain = 0u;   // the chosen level, smooth
const uint kModeEdges = 1u;   // the chosen level, flat, with its edges
const uint kModeErrors = 2u;  // the finest level, coloured by its distance from the chosen one

struct Level {
  uint first_vertex, first_index, cells_u, cells_v;
};

struct DrawCommand {  // VkDrawIndirectCommand
  uint vertex_count, instance_count, first_vertex, first_instance;
};

struct Choice {
  DrawCommand draw;  // of the chosen level
  uint level;
  uint pixels[3];  // a float's bits: how many pixels levels 1, 2, 3 are off, where it is most
  uint text[kRows * kColumns];
};

uint faces_of(Level level) { return 2u * level.cells_u * level.cells_v; }

// The place of the upper end of a finest face's distance from a level: of each level, the engine
// has written the lower ends of all faces before the upper ones.
uint error_at(uint level, uint faces, uint face) { return (2u * level - 1u) * faces + face; }

#endif
