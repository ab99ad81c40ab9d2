// VkhReport, VkhSurveyReport and VkhStatistics (vkhausdorff.h) as your shader reads them, in a
// scalar or std430 block:
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

struct VkhReport {
  float lower;
  float upper;
  float base, lowerAbove, upperAbove;
  uint status;
  uint waves;
  uint remaining;
  uint wanted;
  float witnessPosition[3];
  uint witnessFaceA;
  uint witnessFaceB;
  uint witnessBarycentric[2];
  uint witnessBarycentricLow[2];
};

struct VkhSurveyReport {
  uint status;
  uint waves;
  uint cells;
  uint open;
};

struct VkhWaveRecord {
  uint parents, candidates, queries, survivors, deferred;
  float lower, upper;
};

struct VkhStatistics {
  uint certified;
  uint culled[VKH_MAX_CULLS];
  uint candidateTotal;
  uint queryTotal;
  uint peakFrontier;
  VkhWaveRecord waveRecords[VKH_MAX_WAVE_RECORDS];
};

#endif
