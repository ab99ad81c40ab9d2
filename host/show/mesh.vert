// One corner of a face, projected by the host: coordinates of any size and place keep their bits.
#version 450

layout(location = 0) in vec3 position;  // in Vulkan's clip space
layout(location = 1) in vec4 colour;    // shaded; a: the darkness of the face's edges
layout(location = 2) in uint hatched;   // 1: the face is

layout(location = 0) flat out vec4 face_colour;
layout(location = 1) noperspective out vec3 barycentric;
layout(location = 2) flat out uint face_hatched;

void main() {
  gl_Position = vec4(position, 1);
  const int corner = gl_VertexIndex % 3;  // a draw begins with a face
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  face_colour = colour;
  face_hatched = hatched;
}
