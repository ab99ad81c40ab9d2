// VkhReport (vkhausdorff.h) as your shader reads it, in a scalar or std430 block:
//   layout(std430, binding = 0) readonly buffer Reports { VkhReport report; };
#ifndef VKHAUSDORFF_REPORT_GLSL
#define VKHAUSDORFF_REPORT_GLSL

#define VKH_STATUS_RUNNING 0u
#define VKH_STATUS_DECIDED 1u
#define VKH_STATUS_PRECISION 2u
#define VKH_STATUS_MEMORY 3u
#define VKH_STATUS_WITHIN 4u
#define VKH_STATUS_BEYOND 5u
#define VKH_STATUS_INPUT 6u
#define VKH_MAX_WAVE_RECORDS 64
#define VKH_MAX_CULLS 16

struct VkhWaveRecord {
  uint parents, candidates, queries, survivors, deferred;
  float lower, upper;
};

struct VkhReport {
  float lower;
  float upper;
  float base, lowerAbove, upperAbove;
  uint status;
  uint certified;
  uint waves;
  float witnessPosition[3];
  float witnessDistance;
  uint witnessFaceA;
  uint witnessBarycentric[2];
  uint reserved;
  uint witnessFaceB;
  uint remaining;
  uint candidateTotal;
  uint queryTotal;
  uint peakFrontier;
  uint wanted;
  uint culled[VKH_MAX_CULLS];
  VkhWaveRecord waveRecords[VKH_MAX_WAVE_RECORDS];
  uint witnessBarycentricLow[2];
};

#endif
