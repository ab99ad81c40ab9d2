// One corner of a face, projected by the host: coordinates of any size and place keep their bits.
#version 450

layout(location = 0) in vec3 position;  // in Vulkan's clip space
layout(location = 1) in vec4 colour;    // shaded
layout(location = 2) in uvec4 is_so;    // 1: the face is hatched; its colour is the share's; a disc
layout(location = 3) in float share;    // of the bar; colour.r is then the light

layout(location = 0) flat out vec4 face_colour;
layout(location = 1) noperspective out vec3 barycentric;
layout(location = 2) flat out uvec3 face_is_so;
layout(location = 3) noperspective out float bar_share;

void main() {
  gl_Position = vec4(position, 1);
  const int corner = gl_VertexIndex % 3;  // a draw begins with a face
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  face_colour = colour;
  face_is_so = is_so.xyz;
  bar_share = share;
}
