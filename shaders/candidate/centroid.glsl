// The closest triangle of B to a candidate's centroid: a stream beside the frontier, with the same
// places, that is there only where centroids are queried. Include after `centroid_nearest` is
// declared.
#ifndef VKH_SHADERS_LIB_CENTROID_GLSL
#define VKH_SHADERS_LIB_CENTROID_GLSL

const bool kKnowsCentroids = (kSwitches & kUseCentroid) != 0u;

uint nearest_to_centroid(uint place) { return kKnowsCentroids ? centroid_nearest[place] : kNone; }

#endif
