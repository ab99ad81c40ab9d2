/* VkHausdorff: certified directed Hausdorff distance h(A, B) = max over points p of A of min over
 * points q of B |p - q| between triangle meshes, recorded into your command buffers on your Vulkan
 * device.
 *
 * Result: a report with lower <= h(A, B) <= upper in exact real arithmetic, for the float32
 * coordinates in your buffers, no matter what ended the run. Distances are in the units of the
 * coordinates. Every recorded step narrows the interval; you may stop after any.
 *
 * Out of scope: it never submits, waits, allocates device memory, creates a device, opens a
 * file, prints or reads the environment. It exports no symbol but vkh*. Recording cannot fail where
 * descriptors can be pushed; sizes and support are queried first.
 *
 * Order of use, once a device:      vkhQuerySupport, vkhCreateContext
 *               once a mesh B:      vkhGetHierarchyRequirements, vkhCmdBuildHierarchy
 *               whenever B moves:   vkhCmdRefitHierarchy, or build again
 *               once a pair:        vkhGetWorkspaceRequirements, vkhCmdBegin
 *               then as you like:   vkhCmdAdvance (n waves), vkhCmdWriteReport
 *               points alone:       vkhCmdFindClosest, which needs B and no pair
 *               each face's error:  vkhGetSurveySize, vkhCmdBeginSurvey, vkhCmdAdvanceSurvey (n
 *                                   waves), vkhCmdWriteSurveyFaces
 *               many pairs at once: vkhCmdRunTasks, which builds, begins, advances and reports
 * All of it may stand in one command buffer, or be spread over many: two waves a frame and a report
 * after each. Reports of one run nest: lower never falls and upper never rises, except for
 * rounding. For meshes that deform, each frame is: refit if B has moved, begin (warm), advance,
 * report. A has nothing to refit: vkhCmdBegin reads it again.
 *
 * Coordinates should be of order 1: scale by a power of two and move the meshes near the origin
 * first (both are exact or nearly so; h scales along). The error analysis holds for coordinates up
 * to 2^15; it treats features under 2^-48 as points.
 *
 * Threads: a context is immutable and may be used from several threads at once. A command buffer,
 * as always in Vulkan, is recorded by one thread at a time. Two recordings that run at the same
 * time on the device must not share a workspace, a scratch, a report, statistics or a coverage
 * buffer, and a BVH must not be built or refitted while a run reads it.
 *
 * Recording: outside a render pass, into a primary or secondary command buffer whose pool's queue
 * family has VK_QUEUE_COMPUTE_BIT. The command buffer may be submitted any number of times, one at
 * a time, and works on what the buffers hold then. The structs and arrays that a function is given
 * are read before it returns; buffers and the context must live until the command buffer has run.
 *
 * Synchronization: every vkhCmd* function starts with a memory barrier of its own:
 *   from COMPUTE_SHADER and ALL_TRANSFER, SHADER_WRITE and TRANSFER_WRITE,
 *   to COMPUTE_SHADER, ALL_TRANSFER and DRAW_INDIRECT, all accesses that the engine makes there.
 * So a compute shader or copy before it, in the same queue, may write a mesh, and one may have read
 * an older report, without a barrier of yours; and vkhCmd* functions need none between them. Wait
 * for anything else yourself: host writes are covered by the submission, other queues by your
 * semaphores, other stages (a vertex shader that still reads the buffer which the report is to be
 * written to) by your barrier to COMPUTE_SHADER.
 *   Your part after it: the report (and each BVH) is written in COMPUTE_SHADER with
 * SHADER_STORAGE_WRITE; put a barrier from there to your use of it. Your meshes are read in
 * COMPUTE_SHADER with SHADER_STORAGE_READ; compute shaders and copies that are recorded later may
 * write them again as they are, since the engine's own barriers stand between; before any other
 * stage writes them, wait for COMPUTE_SHADER (no access mask: nothing is written). Scratch and
 * workspace are written by ALL_TRANSFER too: before you use that memory for something else, wait
 * for both.
 *
 * Queue families: buffers of VK_SHARING_MODE_EXCLUSIVE belong to one family. Buffers that you give
 * to the engine must belong to the family that runs its commands; it records no transfer of
 * ownership. A mesh that another family has written, or a report that another family reads, needs
 * your release and acquire, or VK_SHARING_MODE_CONCURRENT. Scratch and workspace hold nothing
 * before the first use, and need none.
 *
 * Clobbered: at VK_PIPELINE_BIND_POINT_COMPUTE the pipeline and the descriptor sets; the push
 * constants of all stages. Nothing of VK_PIPELINE_BIND_POINT_GRAPHICS, no dynamic state.
 *
 * Structs that may grow have their size first: set it to sizeof, as compiled. A library that does
 * not know a struct's size refuses it.
 *
 * Errors: functions that can fail return VkhResult and then leave their output as it was (a context
 * becomes null). Recording cannot fail (but see vkhGetRecordingResult): what could go wrong is
 * refused before, or is a rule below, and breaking a rule is undefined as in Vulkan. With
 * VKH_CONTEXT_CHECK_CALLS any build names the broken rule (strides, offsets, sizes, counts, types);
 * without it a build of the engine without NDEBUG asserts the same. Some are found in any build,
 * and end as VKH_STATUS_INPUT. The validation layers see the engine's commands as yours. */
#ifndef VKHAUSDORFF_H
#define VKHAUSDORFF_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

/* The version of this header. Before 1.0 a minor version may break what the one before promised. */
#define VKH_VERSION_MAJOR 0
#define VKH_VERSION_MINOR 3
#define VKH_VERSION_PATCH 0
/* To compare with: #if VKH_VERSION >= VKH_MAKE_VERSION(0, 2, 0) */
#define VKH_MAKE_VERSION(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))
#define VKH_VERSION VKH_MAKE_VERSION(VKH_VERSION_MAJOR, VKH_VERSION_MINOR, VKH_VERSION_PATCH)
#define VKH_VERSION_STRING "0.3.0"

/* Marks what the library exports. A shared library on Windows needs VKH_SHARED defined by its
 * users, as the CMake target and pkg-config do, and VKH_BUILDS_ENGINE by its own build. */
#if defined(_WIN32) && defined(VKH_SHARED) && defined(VKH_BUILDS_ENGINE)
#define VKH_API __declspec(dllexport)
#elif defined(_WIN32) && defined(VKH_SHARED)
#define VKH_API __declspec(dllimport)
#elif defined(__GNUC__)
#define VKH_API __attribute__((visibility("default")))
#else
#define VKH_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The pipelines for one device and one set of switches. It has no device memory. */
typedef struct VkhContext_T* VkhContext;

typedef enum VkhResult {
  VKH_SUCCESS = 0,
  VKH_ERROR_UNSUPPORTED = -1, /* the device lacks something; vkhQuerySupport says what */
  VKH_ERROR_PIPELINE = -2,  /* the driver refused a pipeline or ran out of host or device memory */
  VKH_ERROR_TOO_LARGE = -3, /* a mesh exceeds 2^28, or one storage buffer binding (but see
                             * VKH_CONTEXT_BY_ADDRESS); or is empty */
  VKH_ERROR_MEMORY = -4,    /* no host or device memory for descriptor sets */
  VKH_ERROR_NOT_ENABLED = -5, /* the device has what is needed, and was created without it; known
                                 only where the driver gives no function of it then */
  /* A struct's `size` or a flag that no known version has; with VKH_CONTEXT_CHECK_CALLS a broken
   * rule.
   */
  VKH_ERROR_MISUSE = -6
} VkhResult;

/* The constant's name, such as "VKH_ERROR_PIPELINE", a static string; never null. */
VKH_API const char* vkhResultString(VkhResult result);

/* VKH_VERSION of the linked library; a shared one may differ from this header. */
VKH_API uint32_t vkhGetVersion(void);

/* The profile of a device: decides on kernels and dispatches. The interval is true either way. */
typedef enum VkhDeviceKind {
  VKH_DEVICE_KIND_AUTO = 0,  /* NARROW for VK_PHYSICAL_DEVICE_TYPE_CPU, WIDE for all others */
  VKH_DEVICE_KIND_WIDE = 1,  /* GPU profile, many workgroups: a small wave gets more invocations */
  VKH_DEVICE_KIND_NARROW = 2 /* CPU profile, few workgroups at once: no invocation without work */
} VkhDeviceKind;

/* Further features of a context. The values do not overlap VkhSwitchBits.
 */
typedef enum VkhContextFlagBits {
  VKH_CONTEXT_COVERAGE = 0x80, /* runs write VkhRunOptions::coverageBuffer */
  VKH_CONTEXT_CELLS = 0x20000, /* vkhCmdBoundCells and surveys can be recorded */
  /* For tolerances under 5e-7 of A's diagonal: edges are halved 40 times, not 20. */
  VKH_CONTEXT_FINE = 0x40000,
  /* Each mesh is checked on the device where it is read, by vkhCmdBuildHierarchy,
   * vkhCmdRefitHierarchy, vkhCmdBegin and tasks: indices below vertexCount, coordinates that are
   * finite and up to 2^15, low parts of at most half an ulp, of the vertices that faces use. A run
   * with a mesh that fails has reports of VKH_STATUS_INPUT, which name a face. Without it none of
   * this is checked, and such a mesh gives an untrue interval. */
  VKH_CONTEXT_CHECK_INPUT = 0x80000,
  VKH_CONTEXT_CLOSEST = 0x100000, /* vkhCmdFindClosest can be recorded */
  /* For meshes whose buffers no binding reaches. Kernels are given the addresses of the buffers
   * that hold a mesh or a BVH. At most 4 bytes a face and a vertex are bound, 16 a face of A with
   * VKH_CONTEXT_COVERAGE: a device that binds 128 MiB takes 33 million faces. It binds 2 million of
   * B. Every bit of a report is the same. Needs the feature bufferDeviceAddress (Vulkan 1.2),
   * enabled; without it vkhCreateContext returns VKH_ERROR_UNSUPPORTED. The buffers of each VkhMesh
   * and VkhMemory: also usage SHADER_DEVICE_ADDRESS, in memory allocated with
   * VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, at multiples of 16 bytes. vertexCount * vertexStride is
   * at most 8 GiB. robustBufferAccess does not hold for addresses. */
  VKH_CONTEXT_BY_ADDRESS = 0x200000,
  /* Any build looks for broken rules in the calls that record: pointers, strides, offsets, sizes,
   * counts, types, ranges. A call that breaks one reports it to VkhContextCreateInfo::onMisuse and
   * records nothing; vkhGetRecordingResult then returns VKH_ERROR_MISUSE for the command buffer,
   * which must not be submitted. */
  VKH_CONTEXT_CHECK_CALLS = 0x400000
} VkhContextFlagBits;
typedef uint32_t VkhContextFlags; /* VkhContextFlagBits that are on */

/* The caller's device. Functions are found through getInstanceProcAddr, never linked: you may have
 * opened the loader yourself, or it may be a layer. `device` may be null before it is created.
 * Where VK_EXT_debug_utils is enabled, kernels have names and stages have labels in captures. */
typedef struct VkhDeviceInfo {
  PFN_vkGetInstanceProcAddr getInstanceProcAddr;
  VkInstance instance; /* Vulkan 1.2 or later */
  VkPhysicalDevice physicalDevice;
  VkDevice device; /* created with what vkhGetRequiredExtensions and vkhQuerySupport name */
  /* The version that `instance` was created for, VkApplicationInfo::apiVersion: Vulkan has no way
   * to ask for it, and an older instance is then named before a function of Vulkan 1.1 is called.
   * 0: unknown, so that an older one is named only once `device` shows it. */
  uint32_t apiVersion;
} VkhDeviceInfo;

/* Device extensions that must be enabled, a static array of `count` static strings: those of
 * VK_KHR_synchronization2 (if none: Vulkan 1.3, device and instance) and VK_KHR_push_descriptor (if
 * none: vkhReleaseCommandBuffer) that the device has; none where Vulkan 1.2 is missing. The
 * features scalarBlockLayout (Vulkan 1.2) and synchronization2 must be enabled too. Nothing else
 * is: no fp64, no 64-bit or float atomics, no ray queries, no fixed subgroup size. */
VKH_API const char* const* vkhGetRequiredExtensions(const VkhDeviceInfo* info, uint32_t* count);

/* Whether a physical device can run the engine: extensions, features, limits, subgroup operations.
 * Writes the reasons why not, separated by "; " and cut at `capacity` bytes including the end;
 * `reasons` may be null if capacity is 0. Returns VKH_SUCCESS or VKH_ERROR_UNSUPPORTED. It cannot
 * see whether the extensions and features are enabled on your device: vkhCreateContext looks for
 * the functions that extensions bring. */
VKH_API VkhResult vkhQuerySupport(const VkhDeviceInfo* info, char* reasons, size_t capacity);

/* Calls work(data, i) once for each i below count, in any order and on any threads, and returns
 * when all calls have returned. `user` is VkhContextCreateInfo::parallelUser. */
typedef void (*VkhParallelFor)(void* user, uint32_t count, void (*work)(void* data, uint32_t i),
                               void* data);

/* Called with the first rule that a call breaks, a static string such as "VkhMesh::vertexStride: at
 * least 12 bytes", on the thread that records. */
typedef void (*VkhMisuse)(void* user, VkCommandBuffer commandBuffer, const char* rule);

typedef struct VkhContextCreateInfo {
  size_t size; /* sizeof(VkhContextCreateInfo) */
  VkhDeviceInfo device;
  VkPipelineCache pipelineCache; /* may be null */
  VkhContextFlags flags;
  VkhDeviceKind deviceKind; /* 0: by the device's type */
  /* 0: the parts of the method that pay on the device. vkhausdorff_experimental.h has others. */
  uint32_t switches;
  /* The most threads that create pipelines at once, the calling one among them. 1: the engine
   * starts no thread. 0: up to 8. Unused with `parallelFor`. */
  uint32_t threads;
  /* Null, or what calls on threads of yours; the engine then starts none. */
  VkhParallelFor parallelFor;
  void* parallelUser;
  VkhMisuse onMisuse; /* with VKH_CONTEXT_CHECK_CALLS; may be null */
  void* misuseUser;   /* the first argument of onMisuse */
} VkhContextCreateInfo;

/* Zeros in all but `size` and `device` are right: certified, and what pays on the device. Creates
 * the pipelines, on several threads while it runs (`threads`); this is the one slow call (seconds
 * where the driver has not compiled them before, so keep a pipeline cache). Nothing of `info` but
 * the handles in `device` is kept; they must outlive the context. Returns VKH_SUCCESS,
 * VKH_ERROR_UNSUPPORTED (vkhQuerySupport says why, or VKH_CONTEXT_BY_ADDRESS needs a feature),
 * VKH_ERROR_NOT_ENABLED, VKH_ERROR_PIPELINE or VKH_ERROR_MISUSE; on failure *context is null and
 * nothing is left.
 *
 * A device in C, with one queue, that `info` then names:
 *
 *     VkPhysicalDeviceSynchronization2Features synchronization = {
 *         .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
 *         .synchronization2 = VK_TRUE};
 *     VkPhysicalDeviceScalarBlockLayoutFeatures scalar = {
 *         .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES,
 *         .pNext = &synchronization,
 *         .scalarBlockLayout = VK_TRUE};
 *     VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
 *                                  .pNext = &scalar,
 *                                  .queueCreateInfoCount = 1,
 *                                  .pQueueCreateInfos = &queue};
 *     create.ppEnabledExtensionNames =
 *         vkhGetRequiredExtensions(&info, &create.enabledExtensionCount);
 */
VKH_API VkhResult vkhCreateContext(const VkhContextCreateInfo* info, VkhContext* context);
/* No command buffer that was recorded with the context may still be pending. Null is fine. */
VKH_API void vkhDestroyContext(VkhContext context);

/* For devices without VK_KHR_push_descriptor, and with VKH_CONTEXT_CHECK_CALLS; elsewhere both do
 * nothing. Without the extension a command buffer binds descriptor sets, which the context keeps.
 * The first, after recording: VKH_ERROR_MEMORY if one could not be allocated; VKH_ERROR_MISUSE if a
 * checked call broke a rule. Commands are then missing: do not submit. The second frees the sets
 * and forgets broken rules: call it once the command buffer has run, before it is freed or recorded
 * again. With push descriptors and no broken rule it has nothing to free, and may be left out. */
VKH_API VkhResult vkhGetRecordingResult(VkhContext context, VkCommandBuffer commandBuffer);
VKH_API void vkhReleaseCommandBuffer(VkhContext context, VkCommandBuffer commandBuffer);

/* A triangle mesh in the caller's buffers. Positions are three float32 at vertexOffset + i *
 * vertexStride; offset and stride are multiples of 4 bytes. Indices are VK_INDEX_TYPE_UINT16
 * (indexOffset a multiple of 2) or _UINT32 (a multiple of 4), three a face, each below vertexCount.
 * Without VKH_CONTEXT_CHECK_INPUT the GPU checks nothing: coordinates not finite and indices out of
 * range give an untrue interval; the latter are taken for the last vertex. Unused vertices are no
 * part of the mesh. Degenerate faces are segments or points. Both buffers: usage STORAGE_BUFFER;
 * each range is at most maxStorageBufferRange less 256 bytes, except with VKH_CONTEXT_BY_ADDRESS,
 * and with 16-bit indices it must reach to the end of the last index's 4-byte word. A and B may
 * share buffers. The engine never writes them. */
typedef struct VkhMesh {
  VkBuffer vertexBuffer;
  VkDeviceSize vertexOffset; /* bytes */
  uint32_t vertexStride;     /* bytes, at least 12 */
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

/* A range of a buffer that the caller owns; ranges may share a buffer and must not overlap unless
 * stated below. offset: a multiple of 256 bytes. Usage: STORAGE_BUFFER, INDIRECT_BUFFER,
 * TRANSFER_SRC and TRANSFER_DST. Memory: device-local is best; it need not be host-visible. Content
 * before the first use: anything. */
typedef struct VkhMemory {
  VkBuffer buffer;
  VkDeviceSize offset; /* bytes */
  VkDeviceSize size;   /* bytes: what is required, or more */
} VkhMemory;

enum { VKH_MAX_RANGES = 8 };

typedef struct VkhHierarchyRequirements {
  VkDeviceSize hierarchySize; /* bytes; kept as long as the BVH is used */
  VkDeviceSize scratchSize;   /* bytes; free again once the build has run, e.g. for the workspace */
  /* The ranges of memory that hold the BVH, and the bytes of each: one, of hierarchySize, unless
   * that is more than the device allocates at once (maxMemoryAllocationSize). A list larger than
   * that has a range to itself, since many devices allocate more than they promise. */
  uint32_t rangeCount;
  VkDeviceSize ranges[VKH_MAX_RANGES];
} VkhHierarchyRequirements;

/* B's bounding volume hierarchy (BVH): memory that vkhCmdBuildHierarchy has filled. It holds a copy
 * of B and serves any number of runs. It is a value: copy it into each VkhProblem that uses it. */
typedef struct VkhHierarchy {
  VkhMemory memory;
  uint32_t faceCount;   /* set by the build */
  uint32_t vertexCount; /* set by the build */
  /* If VkhHierarchyRequirements::rangeCount is above 1: its second range, its third, .. */
  VkhMemory more[VKH_MAX_RANGES - 1];
} VkhHierarchy;

/* Sizes for B. Returns VKH_SUCCESS or VKH_ERROR_TOO_LARGE. */
VKH_API VkhResult vkhGetHierarchyRequirements(VkhContext context, uint32_t vertexCount,
                                              uint32_t faceCount,
                                              VkhHierarchyRequirements* requirements);

typedef struct VkhWorkspaceRequirements {
  VkDeviceSize minimum; /* bytes; works, in many more waves */
  /* bytes; as a rule no more waves than in the recommended one. On a GPU: 0.1 MB for a
   * triangle, 3.3 MB for 64 to 1,300 faces, 17 MB for 7,000 to 20,000. */
  VkDeviceSize compact;
  VkDeviceSize recommended; /* bytes; the frontier seldom has to be regulated */
  VkDeviceSize maximum;     /* bytes; more is not used, because of device limits */
} VkhWorkspaceRequirements;

/* Sizes for A. Anything from minimum to maximum is right: a smaller workspace costs time, but the
 * interval stays true. A pair that holds more candidates than there is room for takes more waves;
 * pauseWhenFull lets it have more room when it needs it. tools/bench/workspace_bench.cpp measures
 * what each size costs. Returns VKH_SUCCESS or VKH_ERROR_TOO_LARGE. */
VKH_API VkhResult vkhGetWorkspaceRequirements(VkhContext context, uint32_t vertexCount,
                                              uint32_t faceCount,
                                              VkhWorkspaceRequirements* requirements);

/* Bytes, from minimum to maximum, of a workspace with room for `candidates` at once. */
VKH_API VkDeviceSize vkhGetWorkspaceSize(VkhContext context, uint32_t vertexCount,
                                         uint32_t faceCount, uint32_t candidates);

/* Optional timestamps: one is written at the start of each vkhCmd* function and one
 * after each stage (at ALL_COMMANDS), from query `count` on; names[i] is the stage that ends with
 * query i, null where a function starts. The caller resets the pool and provides `capacity` names;
 * recording stops to write when it is full. May be null. Needs timestampValidBits > 0. */
typedef struct VkhProfile {
  VkQueryPool pool;
  uint32_t capacity;
  uint32_t count;
  const char** names; /* static strings */
} VkhProfile;

/* Builds the BVH of B into `hierarchy->memory` and `more` (filled in by the caller, with the
 * ranges of VkhHierarchyRequirements) and sets hierarchy->faceCount and vertexCount. Reads the
 * mesh's buffers in compute shaders; writes the BVH and scratch (scratchSize bytes; it may lie in
 * what will be the workspace). The mesh's buffers are not needed afterwards. */
VKH_API void vkhCmdBuildHierarchy(VkhContext context, VkCommandBuffer commandBuffer,
                                  const VkhMesh* mesh, VkhHierarchy* hierarchy,
                                  const VkhMemory* scratch, VkhProfile* profile);

/* B has moved: takes its vertices from `mesh` again and fits the boxes to them, over the old order
 * of triangles; a few dispatches, no sort. The mesh has the faceCount and vertexCount of the build;
 * its indices are read again and should be the same faces in the same order. Reads the mesh's
 * buffers in compute shaders; reads and writes the BVH. A report after a refit is as true as
 * after a build: the certificate rests on the copy of B that the refit replaces. Faces that A
 * shares with B are found only where they have not moved since the build. Boxes overlap more the
 * further B is from the shape that it was built for, so that traversals take longer: build again
 * when a frame takes too long. */
VKH_API void vkhCmdRefitHierarchy(VkhContext context, VkCommandBuffer commandBuffer,
                                  const VkhMesh* mesh, const VkhHierarchy* hierarchy,
                                  VkhProfile* profile);

/* The options of a run. Zeros in all but `size` ask for the distance to the last bit that floats
 * have: set cullTolerance, say to 1e-6 of the diagonal of A's box. */
typedef struct VkhRunOptions {
  size_t size; /* sizeof(VkhRunOptions) */
  /* >= 0, in the coordinates' units: candidates within it of the lower bound are closed. Here and
   * below, NaN and negative numbers break a rule; if rules are not checked they stand for 0. */
  float cullTolerance;
  /* Use the vertices' low parts, and steer by 48-bit positions: if there are low parts, and for
   * tolerances under about 1e-6 of the coordinates' magnitude. The interval is certified either
   * way, for the vertices that this selects. */
  VkBool32 twoFloat;
  /* >= 0, in the coordinates' units; 0 if nothing is known. A value that the answer need not
   * resolve below, such as lower of h(b, a) when the larger of both directions is asked for:
   * candidates within cullTolerance of it are closed, too. The report stays true; upper then is
   * at least about knownLower + cullTolerance. Read by vkhCmdBegin and vkhCmdMoveRun. */
  float knownLower;
  /* Start from the run that `workspace` holds: its closest triangle of B for each vertex of A, and
   * its witness, moved along with A, as the first lower bound. For an A that has moved, with the
   * same counts, against a refitted (or the same) B. It must be the same range of memory; scratch
   * must not have overlapped it since. It only steers: after another mesh, a rebuilt B or garbage
   * the interval is just as true, but takes longer. Zero it for a first frame, and where a run must
   * repeat to the last bit. */
  VkBool32 warm;
  /* With a context of VKH_CONTEXT_COVERAGE; null with any other: 16 bytes a face of A,
   * usage STORAGE_BUFFER and TRANSFER_DST, the offset a multiple of 256 bytes. Written by compute
   * shaders and transfers: vkhCmdBegin clears it, the waves add what they close, vkhCmdWriteReport
   * adds what is open. It holds faceCount 64-bit integers (two little-endian words each), the part
   * of each face that has been closed or is finer than 2^-20, and faceCount more, the part that is
   * open, in 2^-40 of the face. After vkhCmdWriteReport both are 2^40 together, or 0 for a face
   * without a bound yet. */
  VkBuffer coverageBuffer;
  VkDeviceSize coverageOffset; /* bytes */
  /* VK_TRUE: if the workspace has no room for all the work of a wave, the run pauses: waves change
   * nothing, and VkhReport::wanted says for how many candidates it needs room, until vkhCmdMoveRun
   * gives it a larger workspace or lets it go on in the present one. VK_FALSE, or in a workspace of
   * VkhWorkspaceRequirements::maximum: candidates without room wait for a later wave, which takes
   * longer. Read by vkhCmdBegin and vkhCmdMoveRun. */
  VkBool32 pauseWhenFull;
  /* > 0, in the coordinates' units: the run only answers whether h(a, b) is within it. Candidates
   * within it are closed, and the first sample that is surely farther ends the run: waves after it
   * are empty. The report's status is then VKH_STATUS_WITHIN or
   * VKH_STATUS_BEYOND, both proven. Any other is undecided: the run goes on, or its budget or its
   * precision ended, or h is within about cullTolerance of the limit. The decision to end the run
   * relies on coordinates of order 1: if they are larger it may end at VKH_STATUS_PRECISION,
   * undecided, a float's error beyond the limit. 0: no limit. */
  float limit;
  /* 0, which stands for limit, or more than limit: lower must exceed it for VKH_STATUS_BEYOND. If
   * your limit is no float, set `limit` to it rounded down, and this to it rounded up. */
  float limitUp;
  uint32_t sortFrom; /* for VKH_SWITCH_SORT of vkhausdorff_experimental.h; else unused */
} VkhRunOptions;

/* One run: h(a, b). Give the same problem to vkhCmdBegin, vkhCmdAdvance and vkhCmdWriteReport, and
 * the same context; after the begin `b`, `workspace`, a's counts and the coverage buffer are read.
 * A later version may add to VkhRunOptions alone, which stands last for it. */
typedef struct VkhProblem {
  VkhMesh a;
  VkhHierarchy b;
  VkhMemory workspace;
  VkhRunOptions options;
} VkhProblem;

/* Starts a run: copies A into the workspace, queries each vertex of A, finds the first lower bound,
 * and records the first wave, which bounds A's faces: all of them if the workspace has room, and
 * none yet in a run whose tolerance is under 1e-9 of the coordinates, which may have a base to
 * move. Reads a's buffers and the BVH in compute shaders, writes the workspace. After it the
 * workspace holds the run, and a's buffers are not needed. */
VKH_API void vkhCmdBegin(VkhContext context, VkCommandBuffer commandBuffer,
                         const VkhProblem* problem, VkhProfile* profile);

/* Records `waves` waves: each refines what is undecided and narrows the interval. A wave after the
 * end costs a few empty dispatches, so more than are needed may be recorded: a frame's budget is a
 * number of waves. A wave after the lower bound has risen far above VkhReport::base, which
 * distances are kept above, measures the witness again and refines nothing. A command buffer of
 * waves alone, submitted again, goes on where the run stands; one that starts with vkhCmdBegin does
 * the run again. Reads the BVH, reads and writes the workspace. */
VKH_API void vkhCmdAdvance(VkhContext context, VkCommandBuffer commandBuffer,
                           const VkhProblem* problem, uint32_t waves, VkhProfile* profile);

/* Between two waves: the run goes on in `workspace`, as a rule a larger one, at least as large as
 * its own and apart from it, and problem->workspace becomes that; or it goes on in its own range,
 * if `workspace` is that. Any other range changes nothing, and problem->workspace stays. From now
 * on pauseWhenFull and knownLower of problem->options hold. Reads the old workspace and writes the
 * new one in transfers; once they have run, the old one is free. */
VKH_API void vkhCmdMoveRun(VkhContext context, VkCommandBuffer commandBuffer, VkhProblem* problem,
                           const VkhMemory* workspace, VkhProfile* profile);

typedef enum VkhStatus {
  VKH_STATUS_RUNNING = 0, /* candidates are left: advance further, or take the interval as it is */
  VKH_STATUS_DECIDED = 1, /* none is left: upper - lower is at most cullTolerance and rounding */
  VKH_STATUS_PRECISION = 2, /* none is left, but some could not be decided in float32 */
  VKH_STATUS_MEMORY = 3,    /* no room for some, and none could wait: their u is in upper */
  VKH_STATUS_WITHIN = 4,    /* with VkhRunOptions::limit: upper is at most that */
  VKH_STATUS_BEYOND = 5,    /* with VkhRunOptions::limit: lower is more than limit and limitUp */
  /* A or B is no mesh, and nothing is known: lower 0, upper infinite. This is always found if a
   * count is 0 or above 2^28, a buffer is null, a stride is under 12 or makes more than 8 GiB, a
   * stride or offset is no multiple of what it must be, an index type is unknown, or the options'
   * `size` is of no known version; if a refit has other counts than the build; and if VkhProblem::b
   * is a copy that was made before the build. With VKH_CONTEXT_CHECK_INPUT the content of the
   * buffers counts, too. witnessFaceA and witnessFaceB are then the least face of A and of B that
   * is at fault; 0xffffffff: none is; 0xfffffffe: the VkhMesh is, or b. */
  VKH_STATUS_INPUT = 6
} VkhStatus;

/* The output of vkhCmdWriteReport: sizeof(VkhReport) bytes of 4-byte words, in the device's byte
 * order, no padding. Your shader reads it by vkhausdorff_report.glsl, which lies beside this header
 * and has the same struct, for a scalar or std430 block. Lengths are in the coordinates' units. */
typedef struct VkhReport {
  float lower; /* certified: lower <= h(A, B) */
  float upper; /* certified: h(A, B) <= upper; 3e38 while faces of A wait for their first bound */
  /* The same interval with more bits than two float32 near h have: certified, base + lowerAbove <=
   * h(A, B) <= base + upperAbove, the sums taken exactly (in double). */
  float base, lowerAbove, upperAbove;
  uint32_t status;          /* VkhStatus */
  uint32_t waves;           /* that ran, vkhCmdBegin's among them: none runs after the end */
  uint32_t remaining;       /* candidates still open */
  uint32_t wanted;          /* > 0: it pauses, and needs vkhGetWorkspaceSize for `wanted` */
  float witnessPosition[3]; /* the point of A that proves `lower`, rounded */
  uint32_t witnessFaceA;
  uint32_t witnessFaceB;             /* the face of B closest to it */
  uint32_t witnessBarycentric[2];    /* of the face's second and third corner, in units of 2^-20 */
  uint32_t witnessBarycentricLow[2]; /* to be added, in units of 2^-40: VKH_CONTEXT_FINE */
} VkhReport;

/* Certifies the witness against every triangle of B and writes the report at `offset` (a multiple
 * of 256 bytes) of `buffer` (usage STORAGE_BUFFER; TRANSFER_SRC if you copy it), in COMPUTE_SHADER
 * with SHADER_STORAGE_WRITE: your next shader can read it without the host. Costs a pass over B's
 * triangles. The run can be advanced further afterwards. */
VKH_API void vkhCmdWriteReport(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, VkBuffer buffer, VkDeviceSize offset,
                               VkhProfile* profile);

enum { VKH_MAX_WAVE_RECORDS = 64, VKH_MAX_CULLS = 16 };

typedef struct VkhWaveRecord {
  uint32_t parents, candidates, queries, survivors, deferred;
  float lower, upper; /* as they steer the run; not certified */
} VkhWaveRecord;

/* A run's counts, for tuning: 4-byte words without padding, as VkhReport.
 * Nothing is certified here. */
typedef struct VkhStatistics {
  uint32_t certified; /* 0: a part of the run was recorded with VKH_SWITCH_UNCERTIFIED */
  uint32_t culled[VKH_MAX_CULLS]; /* by exact, u1, u2, ha, u3, u4, lower raised, precision */
  uint32_t candidateTotal;
  uint32_t queryTotal;
  uint32_t peakFrontier;
  VkhWaveRecord waveRecords[VKH_MAX_WAVE_RECORDS]; /* wave w in w % VKH_MAX_WAVE_RECORDS */
} VkhStatistics;

/* Copies the run's counts so far to `offset` (a multiple of 4 bytes) of `buffer` (usage
 * TRANSFER_DST), in ALL_TRANSFER with TRANSFER_WRITE: put a barrier from there to your use of it.
 * Zeros if nothing was built. It runs no kernel, and the run does not change. */
VKH_API void vkhCmdWriteStatistics(VkhContext context, VkCommandBuffer commandBuffer,
                                   const VkhProblem* problem, VkBuffer buffer, VkDeviceSize offset,
                                   VkhProfile* profile);

/* A cell: a triangle within a face of A. Its corners are in barycentric coordinates of the face,
 * that of the face's second corner and that of its third, in units of 2^-20, their sum at most
 * 2^20: six integers of 21 bits from the lowest bit of corners[0] up, two a corner. */
typedef struct VkhCell {
  uint32_t corners[4];
  uint32_t face;  /* of A */
  uint32_t start; /* VkhCellBounds::start of a cell near it, for speed; or 0xffffffff */
} VkhCell;

/* d(x, B) for the points x of a cell, in the coordinates' units. Every bound is certified, as
 * VkhReport::lower is, and off by about 1e-6 of the distance and of the size of what is near. A
 * cell that is split gets narrower with the square of its size where surfaces are smooth. lower and
 * upper are affine functions of x, by their values at the corners: so the mean is at least that of
 * lower, and the share of the cell that is within a distance lies between theirs. */
typedef struct VkhCellBounds {
  float lower[3], upper[3]; /* lower(x) <= d(x, B) <= upper(x); lower may be negative */
  float highest;            /* d(x, B) <= highest */
  float reached;            /* some x has d(x, B) >= reached: with highest, the greatest value */
  float meanUpper;          /* >= the mean of d(x, B); at most that of upper */
  float squareUpper;        /* >= the mean of its square */
  uint32_t cornerFaces[3];  /* of B: near its corners; they steer, and nothing rests on them */
  uint32_t faceB;           /* of B: near its middle; the same */
  uint32_t start;           /* for cells near this one */
} VkhCellBounds;

typedef struct VkhCells {
  VkBuffer cellBuffer; /* VkhCell[count]; null: faces of A, `first` and those after it */
  VkDeviceSize cellOffset;
  uint32_t first, count; /* count: at least 1; a range is at most maxStorageBufferRange */
  VkBuffer boundsBuffer; /* VkhCellBounds[count] */
  VkDeviceSize boundsOffset;
} VkhCells;

/* Bounds of d(x, B) over cells of A: for a picture, for statistics, for choosing what to refine.
 * Needs a context of VKH_CONTEXT_CELLS; valid from vkhCmdBegin on, as long as the workspace holds
 * the run. The run does not change. A cell's result does not depend on the others. If a report
 * would be of VKH_STATUS_INPUT, bounds are NaN, and faces and starts 0xffffffff. Buffers: usage
 * STORAGE_BUFFER, offsets multiples of 256 bytes; read and written in COMPUTE_SHADER. */
VKH_API void vkhCmdBoundCells(VkhContext context, VkCommandBuffer commandBuffer,
                              const VkhProblem* problem, const VkhCells* cells,
                              VkhProfile* profile);

/* A survey finds how far each face of A is from B: cells that tile A's faces are bounded as by
 * vkhCmdBoundCells, and the cells that leave a face's error open are split, wave by wave. The
 * device plans: nothing is read back. In one command buffer, or in those of several frames:
 *     vkhCmdBegin, vkhCmdAdvance     as for h; a few waves, or none, are enough, and for these a
 *                                    workspace of VkhWorkspaceRequirements::compact
 *     vkhCmdBeginSurvey              once, and again when A or B has moved
 *     vkhCmdAdvanceSurvey            as many waves as the frame has time for; or none
 *     vkhCmdWriteSurveyFaces         the errors, for the shader that draws A
 *     vkhCmdWriteSurvey              its status
 * Needs a context of VKH_CONTEXT_CELLS. The run does not change, and may advance in between: the
 * survey only needs its BVH and the copy of A in its workspace. A survey of an unknown `size` is
 * ignored. h lies between the largest `reached` and the largest `highest` of all faces, and so in
 * what that interval has in common with the run's report. */
typedef struct VkhSurvey {
  size_t size; /* sizeof(VkhSurvey) */
  /* vkhGetSurveySize bytes; usage STORAGE_BUFFER, TRANSFER_SRC, TRANSFER_DST, no INDIRECT_BUFFER.
   * No other survey may use it at the same time; others may after it. */
  VkhMemory memory;
  /* The number of cells that it has room for: at least A's faces, at most vkhGetSurveyCapacity. A
   * split needs room for three more, and finished cells keep theirs. Four times A's faces suffice
   * for one wave that splits all; a sphere of 2,000 faces took 11 times as many for errors to 1e-4
   * of its radius. */
  uint32_t capacity;
  /* A face's cells are split while its `highest` exceeds its `reached` by more than this, in the
   * coordinates' units. 0: as far as float32 resolves, which takes more room than most devices
   * have. A thousandth of the diagonal is enough for a colour. */
  float faceWidth;
  /* > 0: a face is also done once it is known to be within this, or not to be. 0: no limit. */
  float faceLimit;
} VkhSurvey;

/* The most cells that the device's bindings reach. */
VKH_API uint32_t vkhGetSurveyCapacity(VkhContext context);
/* Bytes: some 115 a cell, and 16 a face of A. */
VKH_API VkDeviceSize vkhGetSurveySize(VkhContext context, uint32_t faceCount, uint32_t capacity);

/* Makes each face of A a cell, and bounds them all. Reads the BVH and the workspace, writes the
 * survey's memory. */
VKH_API void vkhCmdBeginSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, const VkhSurvey* survey,
                               VkhProfile* profile);

/* Records `waves` waves: each splits into four the cells that keep their face from its width, the
 * widest first if there is no room for all, and bounds the parts. A wave after the end is empty.
 * Errors of faces only get narrower. */
VKH_API void vkhCmdAdvanceSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                                 const VkhProblem* problem, const VkhSurvey* survey, uint32_t waves,
                                 VkhProfile* profile);

/* The output of vkhCmdWriteSurvey: 4-byte words without padding, as VkhReport; it is in
 * vkhausdorff_report.glsl, too. */
typedef struct VkhSurveyReport {
  /* VKH_STATUS_RUNNING: a wave would split some cells. DECIDED: each face's error is known to
   * faceWidth, or decided by faceLimit. PRECISION: to that, or as far as float32 resolves. MEMORY:
   * there is no room to split any. INPUT: as in the report of the run; nothing is known. */
  uint32_t status;
  uint32_t waves; /* that have split cells */
  uint32_t cells;
  uint32_t open; /* cells that are in the way of their face's width and may be split */
} VkhSurveyReport;

/* Writes the report at `offset` (a multiple of 4 bytes) of `buffer` (usage TRANSFER_DST, and what
 * you read it by), in ALL_TRANSFER with TRANSFER_WRITE (in a barrier of Vulkan 1.0: TRANSFER): put
 * a barrier from there to your use of it; one serves the report and the faces. */
VKH_API void vkhCmdWriteSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, const VkhSurvey* survey, VkBuffer buffer,
                               VkDeviceSize offset, VkhProfile* profile);

/* Writes the errors of A's faces, in the order of its faces, at `offset` (a multiple of 4 bytes) of
 * `buffer` (usage TRANSFER_DST, and STORAGE_BUFFER for a shader): float[2 * faceCount], in the
 * coordinates' units. The first faceCount are `reached`: some point of the face is at least this
 * far from B. The rest are `highest`: no point of the face is farther. Certified, as
 * VkhReport::lower and upper are; NaN if the report would be of VKH_STATUS_INPUT. A fragment
 * shader finds its face's at gl_PrimitiveID and faceCount + gl_PrimitiveID, if one draw has A's
 * faces in their order; gl_PrimitiveID needs the device's feature geometryShader. Written in
 * ALL_TRANSFER with TRANSFER_WRITE: put a barrier from there to your use, such as FRAGMENT_SHADER
 * with SHADER_STORAGE_READ; before the next frame writes them again, wait for that stage by your
 * barrier to COMPUTE_SHADER, as for a report. */
VKH_API void vkhCmdWriteSurveyFaces(VkhContext context, VkCommandBuffer commandBuffer,
                                    const VkhProblem* problem, const VkhSurvey* survey,
                                    VkBuffer buffer, VkDeviceSize offset, VkhProfile* profile);

/* A point as an exact sum of two float32 a coordinate, the second at most half an ulp of the first:
 * 48 bits. Coordinates are finite and up to 2^15. */
typedef struct VkhPoint {
  float high[3], low[3];
} VkhPoint;

/* d, the distance of a point from B, in the coordinates' units: certified, as VkhReport::lower is,
 * base + lowerAbove <= d <= base + upperAbove, the sums taken exactly (in double). lowerAbove may
 * be less than -base: d is never under 0; it is -3e38 where a driver ended the loops of the search
 * early (lavapipe does after 65,535 turns), which leaves an upper end that is true but may be wide.
 * As a rule the width is 48 bits of the point, and of what of B is as near. Where more than 1024
 * triangles of B are equally near in float32, the lower end is off by about 1e-6 of d and of their
 * size; where more than 65,536 are, as from the centre of a fine sphere, it may be far below d. */
typedef struct VkhClosestFace {
  float base, lowerAbove, upperAbove;
  uint32_t face; /* of B: a point of it is no farther than the upper end */
} VkhClosestFace;

typedef struct VkhClosestQuery {
  VkBuffer pointBuffer; /* VkhPoint[count] */
  VkDeviceSize pointOffset;
  uint32_t count;         /* at least 1; a range is at most maxStorageBufferRange */
  VkBool32 twoFloat;      /* B was built with low parts: use them */
  VkBuffer closestBuffer; /* VkhClosestFace[count] */
  VkDeviceSize closestOffset;
} VkhClosestQuery;

/* Finds the face of B that is closest to each of some points. Needs a context of
 * VKH_CONTEXT_CLOSEST, and no run: B alone. A point's result does not depend on the others. If B is
 * no mesh, ends are NaN and faces 0xffffffff. Buffers: usage STORAGE_BUFFER, offsets multiples of
 * 256 bytes; read and written in COMPUTE_SHADER. */
VKH_API void vkhCmdFindClosest(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhHierarchy* b, const VkhClosestQuery* query,
                               VkhProfile* profile);

/* The work for one pair, in the order of the members; each part may be left out. A task whose
 * `size` the library does not know is ignored. */
typedef struct VkhTask {
  size_t size; /* sizeof(VkhTask), in every task */
  /* B's BVH first. With `scratch`, as vkhCmdBuildHierarchy into problem->b, whose
   * counts are set; without, as vkhCmdRefitHierarchy. Null: it is left as it is. */
  const VkhMesh* mesh;
  const VkhMemory* scratch;
  VkhProblem* problem;
  VkBool32 begin; /* as vkhCmdBegin */
  uint32_t waves; /* as vkhCmdAdvance; may be 0 */
  VkBuffer reportBuffer;
  VkDeviceSize reportOffset; /* as vkhCmdWriteReport; a null buffer: none */
  VkBuffer statisticsBuffer;
  VkDeviceSize statisticsOffset; /* as vkhCmdWriteStatistics; a null buffer: none */
} VkhTask;

/* Records the tasks side by side: each does what the functions above would do one after the other,
 * to the last bit of its report, but one barrier serves the same step of all. A pair
 * of some 10,000 faces leaves most of a large GPU idle: 80 pairs, 16 at a time, take half of what
 * they take one after the other (58 and 30 ms on an H200). All go through as many waves as the
 * longest task needs, so give tasks of similar size.
 *   Tasks run at the same time on the device: no other task may use what one writes (workspace,
 * scratch, report, coverage, a BVH that it builds or refits). A task's scratch may lie in its own
 * workspace; a BVH that none of them builds or refits may serve many. Host memory is about
 * 15 kB a task and 2 to 4 kB a wave of it, or twice that, while it records. Without it, tasks are
 * recorded one after the other. Timestamps: for one task, or tasks one after the other, as the
 * functions above write them, with one null for all; for several one stage, "tasks". */
VKH_API void vkhCmdRunTasks(VkhContext context, VkCommandBuffer commandBuffer, uint32_t taskCount,
                            const VkhTask* tasks, VkhProfile* profile);

#ifdef __cplusplus
}
#endif
#endif
