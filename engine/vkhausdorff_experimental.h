/* VkHausdorff, interfaces without a contract yet: parts of the method by switches, and surveys by
 * plans of the caller. Any version may change what is here.
 *
 * Parts of the method by switches: for ablations, for the comparison with the paper,
 * and to measure what the certificate costs. Renderers need nothing of this:
 * VkhContextCreateInfo::switches 0 selects what pays on the device.
 *
 * The interval is true without any of the parts, except with VKH_SWITCH_UNCERTIFIED. */
#ifndef VKHAUSDORFF_EXPERIMENTAL_H
#define VKHAUSDORFF_EXPERIMENTAL_H

#include "vkhausdorff.h"

/* For VkhContextCreateInfo::switches. These bits do not overlap VkhContextFlagBits. */
typedef enum VkhSwitchBits {
  VKH_SWITCH_CENTROID = 1,       /* the triangle closest to a candidate's centroid, in ha and u3 */
  VKH_SWITCH_PARENT_SAMPLES = 2, /* the triangles closest to the parent's six points, too */
  VKH_SWITCH_TOLERANCE_CULL = 4, /* cull at lower + tolerance instead of lower */
  VKH_SWITCH_THIN = 8,           /* double longest-edge bisection of thin candidates */
  VKH_SWITCH_PAIRS = 16,         /* u3, the pairwise split bound */
  VKH_SWITCH_U4 = 32,            /* u4, the point-point bisector bound */
  VKH_SWITCH_WARM_START = 64,    /* start queries from the parent's known triangles */
  VKH_SWITCH_GROUP_WALK = 256,   /* few queries: a workgroup traverses for each; GPU profile */
  VKH_SWITCH_SHARED_FACES = 512, /* faces of A that B has are closed: h(A, A) is 0 at once */
  /* Plain floats: NOTHING IS CERTIFIED, and no report says so; to measure what the certificate
   * costs. */
  VKH_SWITCH_UNCERTIFIED = 1024,
  /* Parts of the paper's method that this one omits, or has in another form. */
  VKH_SWITCH_SORT = 2048,   /* sort the frontier by Morton codes before it is refined */
  VKH_SWITCH_PACKET = 4096, /* one traversal for a candidate's three new points */
  VKH_SWITCH_DEFER = 8192,  /* excess candidates wait; off: they end the run as VKH_STATUS_MEMORY */
  VKH_SWITCH_LARGEST_FIRST = 16384, /* candidates with the largest u are refined first */
  VKH_SWITCH_U3_PAPER = 32768,      /* u3 by one bisector, or by midpoints and centroid */
  /* Few candidates are split twice in a wave, unless CENTROID, PACKET or U3_PAPER is on. */
  VKH_SWITCH_SPLIT_TWICE = 65536,
  VKH_SWITCH_NONE = 1 << 30, /* switches nothing: the empty set, which 0 is not */
  /* The meaning of 0 for each kind of device. Fewer candidates are worth a query on a CPU; on a
   * GPU, a chain of short steps, more candidates at once are cheaper than another step. */
  VKH_SWITCH_DEFAULT_NARROW = 1 + 2 + 4 + 8 + 16 + 64 + 512 + 8192,
  VKH_SWITCH_DEFAULT_WIDE = 4 + 8 + 16 + 64 + 256 + 512 + 8192 + 65536
} VkhSwitchBits;

#ifdef __cplusplus
extern "C" {
#endif

/* Surveys by plans of the caller: for figures, maps, sides and normals. The caller says how cells
 * score, and chooses by the counts of scores which are split. The structs that its buffers hold are
 * those of shaders/gpu_types.h, SurveyPlan and SurveyTable. Calls need what vkhCmdBeginSurvey
 * needs; they are recorded in their order, and each waits for the one before it.
 * VkhSurvey::faceWidth and faceLimit are not used. Offsets are multiples of 256 bytes. Results are
 * written in ALL_TRANSFER with TRANSFER_WRITE. */

typedef struct VkhSurveyCells {
  VkBuffer weightBuffer; /* an integer of 64 bits for each face of A, all together under 2^62;
                          * usage TRANSFER_SRC. Null: none; tallies and scores need them */
  VkDeviceSize weightOffset;
  float farthest; /* no distance is above it; FLT_MAX, if nothing is known */
} VkhSurveyCells;
/* Makes each face of A a cell, without bounds, for vkhCmdBoundSurvey. */
VKH_API void vkhCmdBeginSurveyCells(VkhContext context, VkCommandBuffer commandBuffer,
                                    const VkhProblem* problem, const VkhSurvey* survey,
                                    const VkhSurveyCells* cells);

typedef struct VkhSurveyScore {
  uint32_t first, count; /* of the cells */
  VkBuffer planBuffer;   /* SurveyPlan; usage TRANSFER_SRC */
  VkDeviceSize planOffset;
  VkBuffer histogramBuffer; /* uint32_t[2048], how many cells each bin has; usage TRANSFER_DST */
  VkDeviceSize histogramOffset;
} VkhSurveyScore;
/* Scores cells. The bits of a score above the 20 lowest are the cell's bin; bin 0 counts cells that
 * keep their face open although no split helps. All cells must be scored before any is split. */
VKH_API void vkhCmdScoreSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, const VkhSurvey* survey,
                               const VkhSurveyScore* score);

typedef struct VkhSurveySplit {
  uint32_t cells; /* that there are */
  uint32_t bin;   /* cells of larger bins are split: `above` cells, */
  uint32_t ties;  /* and the first `ties` cells of this bin, */
  uint32_t above;
  uint32_t parts; /* into halves, 2, or halves of halves, 4. There must be room for all parts but
                   * the first, and no more than a quarter of the capacity is split */
} VkhSurveySplit;
VKH_API void vkhCmdSplitSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, const VkhSurvey* survey,
                               const VkhSurveySplit* split);

typedef struct VkhSurveyBound {
  uint32_t first, count; /* of the new cells: the parts of split cells, or A's faces */
} VkhSurveyBound;
/* Bounds new cells, which may be several calls' work. */
VKH_API void vkhCmdBoundSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, const VkhSurvey* survey,
                               const VkhSurveyBound* bound, VkhProfile* profile);

typedef struct VkhSurveyTally {
  uint32_t first, count; /* of the cells */
  int32_t unit;          /* every distance is below 2^(unit - 127) */
  VkBuffer planBuffer;
  VkDeviceSize planOffset;
  VkBuffer tableBuffer; /* SurveyTable; usage TRANSFER_DST */
  VkDeviceSize tableOffset;
} VkhSurveyTally;
VKH_API void vkhCmdTallySurvey(VkhContext context, VkCommandBuffer commandBuffer,
                               const VkhProblem* problem, const VkhSurvey* survey,
                               const VkhSurveyTally* tally);

typedef struct VkhSurveySides {
  uint32_t first, count; /* of the cells */
  float above;           /* cells that are nowhere farther from B are left out */
  float near;            /* a part of a cell that is nearer needs no side; 0: all of it does */
  float moved;         /* both meshes' vertices together may be this far off their stored places */
  VkBool32 isSolid;    /* B bounds a solid: it winds `front` times round all that is in front of */
  int32_t front;       /* its faces, and one time more or less round all other points off it */
  VkBuffer kindBuffer; /* uint32_t[faces of B]: kFaceCovered and so on; usage STORAGE_BUFFER */
  VkDeviceSize kindOffset;
} VkhSurveySides;
/* Finds on which side of B cells lie that have no side yet. It becomes their class, which their
 * parts inherit. A side holds for all positions of the vertices that `moved` allows. */
VKH_API void vkhCmdFindSurveySides(VkhContext context, VkCommandBuffer commandBuffer,
                                   const VkhProblem* problem, const VkhSurvey* survey,
                                   const VkhSurveySides* sides);

typedef struct VkhSurveyNormals {
  uint32_t first, count; /* of the cells */
  float moved; /* both meshes' vertices together may be this far off their stored places */
  float limitDown, limitUp; /* normals agree from a cosine between them on */
  VkBuffer normalBuffer;    /* FaceNormal[faces of A and of B]; usage STORAGE_BUFFER */
  VkDeviceSize normalOffset;
} VkhSurveyNormals;
/* Compares A's normal with those of B's closest faces, on cells where that was not done: for
 * tallies and scores with SurveyPlan::of_normals. It replaces the cells' class. */
VKH_API void vkhCmdFindSurveyNormals(VkhContext context, VkCommandBuffer commandBuffer,
                                     const VkhProblem* problem, const VkhSurvey* survey,
                                     const VkhSurveyNormals* normals);

typedef struct VkhSurveyFaces {
  uint32_t cells;          /* that there are */
  uint32_t reachedClasses; /* a bit for each class of cells; UINT32_MAX: all */
  uint32_t highestClasses;
  VkBuffer buffer; /* float[2 * faceCount]: some point of the face's cells is at least so far; then,
                    * of each face, none is farther; 0: it has no such cell; usage TRANSFER_DST */
  VkDeviceSize offset;
} VkhSurveyFaces;
/* Writes the error of each face, as vkhCmdWriteSurveyFaces does, by the cells of some classes. */
VKH_API void vkhCmdFindSurveyFaces(VkhContext context, VkCommandBuffer commandBuffer,
                                   const VkhProblem* problem, const VkhSurvey* survey,
                                   const VkhSurveyFaces* faces);

typedef struct VkhSurveyRead {
  uint32_t first, count; /* of the cells */
  VkBuffer cellBuffer;   /* VkhCell[count]; usage TRANSFER_DST, as the others */
  VkDeviceSize cellOffset;
  VkBuffer boundsBuffer; /* VkhCellBounds[count] */
  VkDeviceSize boundsOffset;
  VkBuffer classBuffer; /* uint32_t[count] */
  VkDeviceSize classOffset;
} VkhSurveyRead;
VKH_API void vkhCmdReadSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                              const VkhProblem* problem, const VkhSurvey* survey,
                              const VkhSurveyRead* read);

typedef struct VkhSurveyWrite {
  uint32_t first, count; /* of the cells */
  VkBuffer
      boundsBuffer; /* VkhCellBounds[count], which the caller has narrowed; usage TRANSFER_SRC */
  VkDeviceSize boundsOffset;
} VkhSurveyWrite;
VKH_API void vkhCmdNarrowSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                                const VkhProblem* problem, const VkhSurvey* survey,
                                const VkhSurveyWrite* write);

/* Copies a survey of `cells` cells to one with more room, which replaces it. */
VKH_API void vkhCmdMoveSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                              const VkhProblem* problem, const VkhSurvey* from, const VkhSurvey* to,
                              uint32_t cells);

#ifdef __cplusplus
}
#endif
#endif
