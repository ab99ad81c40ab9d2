/* VkHausdorff: certified directed Hausdorff distance h(A, B) = max over points p of A of min over
 * points q of B |p - q| between triangle meshes, recorded into your command buffers on your Vulkan
 * device.
 *
 * What you get. A report with lower <= h(A, B) <= upper in exact real arithmetic, for the float32
 * coordinates in your buffers, whatever ended the run. Distances are in the units of the
 * coordinates. Every recorded step narrows the interval; you may stop after any.
 *
 * What it does not do. It never submits, waits, allocates device memory, creates a device, opens a
 * file, prints or reads the environment. It exports no symbol but vkh*. Recording cannot fail;
 * sizes and support are asked first.
 *
 * Order of use, once a device:      vkhQuerySupport, vkhCreateContext
 *               once a mesh B:      vkhGetHierarchyRequirements, vkhCmdBuildHierarchy
 *               once a pair:        vkhGetWorkspaceRequirements, vkhCmdBegin
 *               then as you like:   vkhCmdAdvance (n waves), vkhCmdWriteReport
 *
 * Coordinates should be of order 1: scale by a power of two and move the meshes near the origin
 * first (both are exact or nearly so; h scales along). The error analysis holds for coordinates up
 * to 2^15; features under 2^-48 are points to it.
 *
 * Threads. A context is immutable and may be used from several threads at once. A command buffer,
 * as always in Vulkan, is recorded by one thread at a time. Two recordings that run at the same
 * time on the device must not share a workspace.
 *
 * Synchronization. Every vkhCmd* function starts with a barrier that makes earlier compute and
 * transfer writes of the same queue visible to it; wait for anything else (host writes are covered
 * by the submission, other queues by your semaphores) yourself. What they write is written in
 * VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT with VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT; put your own
 * barrier from there to your use of it. They leave compute pipeline, push constants and push
 * descriptors of set 0 at VK_PIPELINE_BIND_POINT_COMPUTE changed. Queue: VK_QUEUE_COMPUTE_BIT. */
#ifndef VKHAUSDORFF_H
#define VKHAUSDORFF_H

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct VkhContext_T* VkhContext;

typedef enum VkhResult {
  VKH_SUCCESS = 0,
  VKH_ERROR_UNSUPPORTED = -1, /* the device lacks something; vkhQuerySupport says what */
  VKH_ERROR_PIPELINE = -2, /* the driver refused a pipeline or ran out of host or device memory */
  VKH_ERROR_TOO_LARGE = -3 /* a mesh or workspace exceeds a limit of the device or of the engine */
} VkhResult;

/* Stages that can be switched off, for ablations; the interval stays true without any of them. */
typedef enum VkhSwitchBits {
  VKH_SWITCH_CENTROID = 1,       /* the triangle closest to a candidate's centroid, in ha and u3 */
  VKH_SWITCH_PARENT_SAMPLES = 2, /* the triangles closest to the parent's six points, likewise */
  VKH_SWITCH_TOLERANCE_CULL = 4, /* cull at lower + tolerance instead of lower */
  VKH_SWITCH_THIN = 8,           /* double longest-edge bisection of thin candidates */
  VKH_SWITCH_PAIRS = 16,         /* u3, the pairwise split bound */
  VKH_SWITCH_U4 = 32,            /* u4, the point-point bisector bound */
  VKH_SWITCH_WARM_START = 64,    /* start queries from the parent's known triangles */
  VKH_SWITCH_ALL = 127,
  VKH_SWITCH_COVERAGE = 128,    /* no stage of the method: VkhProblem::coverageBuffer is written */
  VKH_SWITCH_DEFAULT = 127 - 32 /* all but u4, which decides no candidate that u3 over all pairs
                                   leaves: measured, 0 of 400,000 */
} VkhSwitchBits;

/* The caller's device. `device` may be null for vkhQuerySupport. */
typedef struct VkhDeviceInfo {
  PFN_vkGetInstanceProcAddr getInstanceProcAddr;
  VkInstance instance; /* Vulkan 1.2 or later */
  VkPhysicalDevice physicalDevice;
  VkDevice device; /* created with what vkhGetRequiredExtensions and vkhQuerySupport name */
} VkhDeviceInfo;

/* Device extensions that must be enabled, a static array: VK_KHR_synchronization2 and
 * VK_KHR_push_descriptor. The features scalarBlockLayout (Vulkan 1.2) and synchronization2 must be
 * enabled too. Nothing else is: no fp64, no 64-bit or float atomics, no ray queries, no fixed
 * subgroup size. */
const char* const* vkhGetRequiredExtensions(uint32_t* count);

/* Whether a physical device can run the engine. Writes the reasons why not, separated by "; " and
 * cut at `capacity` bytes including the end; `reasons` may be null if capacity is 0. Returns
 * VKH_SUCCESS or VKH_ERROR_UNSUPPORTED. */
VkhResult vkhQuerySupport(const VkhDeviceInfo* info, char* reasons, size_t capacity);

typedef struct VkhContextCreateInfo {
  VkhDeviceInfo device;
  VkPipelineCache pipelineCache; /* may be null */
  uint32_t switches;             /* VkhSwitchBits that are on; VKH_SWITCH_ALL is the full method */
} VkhContextCreateInfo;

/* Creates the pipelines, on up to 8 threads of its own while it runs. Nothing of `info` but the
 * handles in `device` is kept; they must outlive the context. */
VkhResult vkhCreateContext(const VkhContextCreateInfo* info, VkhContext* context);
/* No command buffer that was recorded with the context may still be pending. Null is fine. */
void vkhDestroyContext(VkhContext context);

/* A triangle mesh in the caller's buffers. Positions are three float32 at vertexOffset + i *
 * vertexStride; offset and stride are multiples of 4 bytes. Indices are VK_INDEX_TYPE_UINT16
 * (indexOffset a multiple of 2) or _UINT32 (a multiple of 4), three a face, each below vertexCount:
 * indices out of range and coordinates that are not finite are not checked on the GPU and give
 * undefined results. Vertices that no face uses are not part of the mesh. Degenerate faces are
 * segments or points. Both buffers: VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; each range is at most
 * maxStorageBufferRange. Indices are read in words
 * of 4 bytes: with 16-bit indices the buffer must reach to the end of the last index's word. */
typedef struct VkhMesh {
  VkBuffer vertexBuffer;
  VkDeviceSize vertexOffset; /* bytes */
  uint32_t vertexStride;     /* bytes */
  uint32_t vertexCount;      /* 1 .. 2^28 */
  VkBuffer indexBuffer;
  VkDeviceSize indexOffset; /* bytes */
  VkIndexType indexType;
  uint32_t faceCount; /* 1 .. 2^28 */
  /* May be null: a vertex is then its float32 position. Otherwise a vertex is the exact sum of that
   * and of three more float32 at vertexLowOffset + i * vertexStride, each at most half an ulp of
   * its high part: 48-bit coordinates. Usage as above. */
  VkBuffer vertexLowBuffer;
  VkDeviceSize vertexLowOffset; /* bytes, a multiple of 4 */
} VkhMesh;

/* A range of a buffer that the caller owns. offset: a multiple of 256 bytes. Usage: STORAGE_BUFFER,
 * INDIRECT_BUFFER, TRANSFER_SRC and TRANSFER_DST. Memory: device-local is best; it need not be
 * host-visible. */
typedef struct VkhMemory {
  VkBuffer buffer;
  VkDeviceSize offset; /* bytes */
  VkDeviceSize size;   /* bytes */
} VkhMemory;

typedef struct VkhHierarchyRequirements {
  VkDeviceSize hierarchySize; /* bytes; kept as long as the hierarchy is used */
  VkDeviceSize scratchSize;   /* bytes; free again once the build has run, e.g. for the workspace */
} VkhHierarchyRequirements;

/* B's bounding volume hierarchy: memory that vkhCmdBuildHierarchy has filled. */
typedef struct VkhHierarchy {
  VkhMemory memory;
  uint32_t faceCount;   /* set by the build */
  uint32_t vertexCount; /* set by the build */
} VkhHierarchy;

VkhResult vkhGetHierarchyRequirements(VkhContext context, uint32_t vertexCount, uint32_t faceCount,
                                      VkhHierarchyRequirements* requirements);

typedef struct VkhWorkspaceRequirements {
  VkDeviceSize minimum;     /* bytes; works, slowly */
  VkDeviceSize recommended; /* bytes; the frontier seldom has to be regulated */
  VkDeviceSize maximum;     /* bytes; more is not used, by limits of the device */
} VkhWorkspaceRequirements;

/* Sizes for A. Anything from minimum to maximum is right: a smaller workspace costs time, never
 * truth. */
VkhResult vkhGetWorkspaceRequirements(VkhContext context, uint32_t vertexCount, uint32_t faceCount,
                                      VkhWorkspaceRequirements* requirements);

/* Timestamps, for those who want them: one is written at the start of each vkhCmd* function and one
 * after each stage, from query `count` on; names[i] is the stage that ends with query i, null where
 * a function starts. The caller resets the pool and provides `capacity` names; recording stops to
 * write when it is full. */
typedef struct VkhProfile {
  VkQueryPool pool;
  uint32_t capacity;
  uint32_t count;
  const char** names; /* static strings */
} VkhProfile;

/* Builds the hierarchy of B into `hierarchy->memory` (filled in by the caller) and sets
 * hierarchy->faceCount. Reads the mesh's buffers in compute shaders; writes hierarchy and scratch.
 * The mesh's buffers are not needed afterwards. */
void vkhCmdBuildHierarchy(VkhContext context, VkCommandBuffer commandBuffer, const VkhMesh* mesh,
                          VkhHierarchy* hierarchy, const VkhMemory* scratch, VkhProfile* profile);

/* One run: h(a, b). */
typedef struct VkhProblem {
  VkhMesh a;
  VkhHierarchy b;
  VkhMemory workspace;
  /* >= 0, in the coordinates' units: candidates within it of the lower bound are closed. */
  float cullTolerance;
  /* Use the vertices' low parts, and steer by 48-bit positions: where there are low parts, and for
   * tolerances under about 1e-6 of the coordinates' magnitude. The interval is certified either
   * way, for the vertices that this selects. */
  VkBool32 twoFloat;
  /* Null, or with a context of VKH_SWITCH_COVERAGE: 16 bytes a face of A, usage STORAGE_BUFFER and
   * TRANSFER_DST, the offset a multiple of 256 bytes. Written by compute shaders and transfers:
   * vkhCmdBegin clears it, the waves add what they close, vkhCmdWriteReport what is open. It holds
   * faceCount 64-bit integers (two little-endian words each), what of each face has been closed,
   * and faceCount more, what is open, in units of 2^-40 of the face. After vkhCmdWriteReport the
   * two are 2^40 together, or both 0 for a face that waits for its first bound. */
  VkBuffer coverageBuffer;
  VkDeviceSize coverageOffset; /* bytes */
} VkhProblem;

/* Starts a run: copies A into the workspace, queries each vertex of A, finds the first lower bound.
 * After it the workspace holds the run; a's buffers are not needed afterwards. */
void vkhCmdBegin(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                 VkhProfile* profile);

/* Records `waves` waves. A wave after the end costs a few empty dispatches, so more than are needed
 * may be recorded; the same command buffer may be submitted again. */
void vkhCmdAdvance(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                   uint32_t waves, VkhProfile* profile);

typedef enum VkhStatus {
  VKH_STATUS_RUNNING = 0, /* candidates are left: advance further, or take the interval as it is */
  VKH_STATUS_DECIDED = 1, /* none is left: upper - lower is at most cullTolerance and rounding */
  VKH_STATUS_PRECISION = 2, /* none is left, but some could not be decided in float32 */
  VKH_STATUS_MEMORY = 3     /* the workspace is full and nothing in it can be refined in place */
} VkhStatus;

enum { VKH_MAX_WAVE_RECORDS = 64 };

typedef struct VkhWaveRecord {
  uint32_t parents, candidates, queries, survivors, deferred;
  float lower, upper; /* as they steer the run; not certified */
} VkhWaveRecord;

/* What vkhCmdWriteReport writes: sizeof(VkhReport) bytes, little-endian, no padding. */
typedef struct VkhReport {
  float lower; /* certified: lower <= h(A, B) */
  float upper; /* certified: h(A, B) <= upper; 3e38 while faces of A wait for their first bound */
  /* The same interval with more bits than two float32 near h have: certified, base + lowerAbove <=
   * h(A, B) <= base + upperAbove, the sums taken exactly (in double). */
  float base, lowerAbove, upperAbove;
  uint32_t status; /* VkhStatus */
  uint32_t waves;
  float witnessPosition[3]; /* the point of A that proves `lower`, rounded */
  float witnessDistance;
  uint32_t witnessFaceA;
  uint32_t witnessBarycentric[2]; /* of the face's second and third corner, in units of 2^-20 */
  uint32_t witnessTriangle;       /* internal */
  uint32_t witnessFaceB;          /* the face of B closest to it */
  uint32_t remaining;             /* candidates still open */
  uint32_t candidateTotal;
  uint32_t queryTotal;
  uint32_t peakFrontier;
  uint32_t culled[8]; /* exact, u1, u2, ha, u3, u4, lower raised, precision */
  VkhWaveRecord waveRecords[VKH_MAX_WAVE_RECORDS]; /* wave w in w % VKH_MAX_WAVE_RECORDS */
} VkhReport;

/* Certifies the witness against every triangle of B and writes the report at `offset` (a multiple
 * of 256 bytes) of `buffer` (usage STORAGE_BUFFER). Costs a pass over B's triangles. The run can be
 * advanced further afterwards. */
void vkhCmdWriteReport(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       VkBuffer buffer, VkDeviceSize offset, VkhProfile* profile);

#ifdef __cplusplus
}
#endif
#endif
