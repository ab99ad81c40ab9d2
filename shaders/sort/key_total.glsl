// How many keys there are: as the host says, or where the device alone knows, in a buffer. Include
// after `push` and `key_count` are declared.
#ifndef VKH_SHADERS_LIB_KEY_TOTAL_GLSL
#define VKH_SHADERS_LIB_KEY_TOTAL_GLSL

uint key_total() {
  uint total = push.count;
  if (total == kNone) total = key_count;
  return total;
}

#endif
