/* VkHausdorff, parts of the method by switches: for ablations, for the comparison with the paper,
 * and to measure what the certificate costs. Renderers need nothing of this:
 * VkhContextCreateInfo::switches 0 selects what pays on the device. Any version may change what is
 * here.
 *
 * The interval is true without any of the parts, but for VKH_SWITCH_UNCERTIFIED. */
#ifndef VKHAUSDORFF_EXPERIMENTAL_H
#define VKHAUSDORFF_EXPERIMENTAL_H

#include "vkhausdorff.h"

/* For VkhContextCreateInfo::switches. Bits that VkhContextFlagBits has are none of these. */
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
  /* Plain floats: NOTHING IS CERTIFIED, and no report says so; to measure the price. */
  VKH_SWITCH_UNCERTIFIED = 1024,
  /* Parts of the paper's method that this one does without, or has in another form. */
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

#endif
