// Every struct, limit and code that the host and the GPU both see. Scalar layout on both sides; the
// build checks each offset against the compiled SPIR-V, so that a change on one side only does not
// compile.
#ifndef VKH_SHADERS_GPU_TYPES_H
#define VKH_SHADERS_GPU_TYPES_H

#ifdef __cplusplus
#include <cstdint>
namespace vkh::gpu {
using uint = uint32_t;
struct vec2 {
  float x, y;
};
struct vec3 {
  float x, y, z;
};
struct uvec3 {
  uint x, y, z;
};
struct uvec4 {
  uint x, y, z, w;
};
#define VKH_CONST inline constexpr
#else
#define VKH_CONST const
#endif

// ---- limits and codes
// -------------------------------------------------------------------------------------------

VKH_CONST uint kNone = 0xffffffffu;  // no triangle, no face, no point

// A dyadic barycentric is an integer in [0, kBaryOne]; kBaryOne is 1. 20 halvings, so two of them
// fit 42 bits.
VKH_CONST uint kBaryBits = 20u;
VKH_CONST uint kBaryOne = 1u << kBaryBits;

VKH_CONST uint kGroupSize =
    64u;  // invocations of a workgroup, one item each, unless a kernel states otherwise
VKH_CONST uint kMaxGroupsX =
    32768u;  // a larger dispatch continues on y (portable limit: 65,535 an axis)
// Invocations of query: one query each, or one for all if a wave has few queries.
VKH_CONST uint kQueryGroup = 64u;
// The points of its queries.
VKH_CONST uint kAskPoints = 0u;         // the wave's new points
VKH_CONST uint kAskCentroids = 1u;      // the centroids of its survivors
VKH_CONST uint kAskVertices = 2u;       // of A, in plain floats
VKH_CONST uint kAskVerticesAgain = 3u;  // to 48 bits above the base
VKH_CONST uint kGroupTraversalQueries =
    1u
    << 12;  // at most this many are few: 2^12 and 2^13 are alike on an H200, 2^11 and 2^14 slower
// The same for vertices of A, whose traversals have no start triangle: there a group's is long,
// too.
VKH_CONST uint kGroupTraversalVertices = 1u << 11;
// Boxes of a level that a group holds; more: each alone.
VKH_CONST uint kGroupTraversalBoxes = 512u;
VKH_CONST uint kLeafTriangles = 4u;      // a subtree of at most this many triangles is a leaf
VKH_CONST uint kLeafFlag = 0x80000000u;  // Node::child: leaf; bits 28..30 hold its triangle count -
                                         // 1, bits 0..27 the first
VKH_CONST uint kNarrowestSubgroup = 4u;  // width on a CPU with vectors of 128 bits
VKH_CONST uint kWidestSubgroup = 128u;   // the lanes of a ballot
// bvh_box: its workgroup, and faces of an invocation.
VKH_CONST uint kBoxGroup = 256u;
VKH_CONST uint kBoxFaces = 4u;
// Boxes of runs of triangles: level l + 1 of the pyramid joins kPyramidFan neighbours of level l.
VKH_CONST uint kPyramidFan = 16u;
// Items of a level whose boxes a workgroup joins: two levels of the pyramid, and between them the
// levels over four boxes each, which only bvh_refit reads.
VKH_CONST uint kRun = 256u;
VKH_CONST uint kMaxTriangles = 1u << 28;
// Depth of the BVH: a prefix of the 60-bit key (30 Morton bits, then 30 index bits) grows by at
// least one bit a level.
VKH_CONST uint kStackDepth = 60u;

// Switches (specialisation constant 0): their only list. A set bit switches the part on.
//   X(constant, bit, api, name): VKH_SWITCH_<api> in vkhausdorff_experimental.h; name: what the
// command line, JSON and Python call it.
#define VKH_SWITCHES(X)                                                                           \
  X(kUseCentroid, 0u, CENTROID, centroid) /* query the centroid, use its closest triangle */      \
  X(kUseParentSamples, 1u, PARENT_SAMPLES, parent_samples) /* the parent's six points', too */    \
  X(kUseToleranceCull, 2u, TOLERANCE_CULL, tolerance_cull) /* cull at lower + tolerance */        \
  X(kUseThin, 3u, THIN, thin) /* bisect longest edges twice where q(T) < kThinQuality */          \
  X(kUsePairs, 4u, PAIRS, u3) /* u3 over every pair of known triangles */                         \
  X(kUseU4, 5u, U4, u4)       /* the point-point bisector */                                      \
  X(kUseWarmStart, 6u, WARM_START, warm_start) /* queries start from the parent's triangles */    \
  X(kUseGroupWalk, 8u, GROUP_WALK, group_walk) /* few queries: a workgroup for each one */        \
  X(kUseSharedFaces, 9u, SHARED_FACES, shared_faces) /* faces of A that B has are closed */       \
  X(kUseSort, 11u, SORT, sort)                       /* sort the frontier before it is refined */ \
  X(kUsePacket, 12u, PACKET, packet) /* one traversal for a candidate's new points */             \
  X(kUseDefer, 13u, DEFER, defer)    /* candidates that there is no room to refine wait */        \
  X(kUseLargestFirst, 14u, LARGEST_FIRST, largest_first) /* the largest u are refined first */    \
  X(kUsePaperU3, 15u, U3_PAPER, u3_paper)                /* u3 as the paper has it */             \
  X(kUseSplitTwice, 16u, SPLIT_TWICE, split_twice) /* few candidates are split twice in a wave */
#define VKH_SWITCH(constant, bit, api, name) VKH_CONST uint constant = 1u << (bit);
VKH_SWITCHES(VKH_SWITCH)
#undef VKH_SWITCH
// These are no parts of the method: a record of what was closed (base/coverage.glsl); bounds in
// plain floats, by which NOTHING IS CERTIFIED.
VKH_CONST uint kUseCoverage = 1u << 7;
VKH_CONST uint kUseUncertified = 1u << 10;
// A candidate whose barycentric bits run out becomes a root of its own (wave/subroot.glsl).
VKH_CONST uint kUseSubroots = 1u << 18;
#ifdef __cplusplus
// These add kernels, and are in no other kernel's code: their bits are left out of kSwitches, so
// that a driver which has compiled a kernel for one context has it for the next.
// Cells can be bounded after the run (report/cell_bounds.comp).
VKH_CONST uint kUseField = 1u << 17;
// Meshes are checked on the device (bvh/mesh_check.comp).
VKH_CONST uint kUseInputCheck = 1u << 19;
// Points can be asked for their closest faces (report/closest_faces.comp).
VKH_CONST uint kUseClosest = 1u << 20;
VKH_CONST uint kAddsKernels = kUseField | kUseInputCheck | kUseClosest;
#endif
// The most subroots: a quarter of the frontier's capacity, but at most this many. Most runs have
// tens.
VKH_CONST uint kMostSubroots = 1u << 14;

VKH_CONST uint kUseFilter = kUseCentroid | kUsePaperU3;  // either brings in wave_filter
VKH_CONST uint kUseBesides = kUseU4 | kUsePaperU3;       // either brings in paper_bound
// If any of these is on, a wave is more than two dispatches (is_fused in stages.h).
VKH_CONST uint kUseApart = kUseFilter | kUseBesides | kUsePacket | kUseSort;
// All parts that can be combined; no device's default (VKH_SWITCH_DEFAULT_*).
VKH_CONST uint kUseAll = kUseCentroid | kUseParentSamples | kUseToleranceCull | kUseThin |
                         kUsePairs | kUseU4 | kUseWarmStart | kUseGroupWalk | kUseSharedFaces |
                         kUseDefer | kUseSplitTwice;

VKH_CONST float kThinQuality = 0.25f;       // altitude over longest edge: docs/method.md, eq. 3
VKH_CONST float kPaperThinQuality = 0.06f;  // where the frontier may be sorted, as the paper has it

// The reasons for closing a candidate on a device; host/native/candidate.h has the processor's.
// Control::culled counts each; the name is what JSON and Python have. wave_bound closes by those up
// to kCullLowerRaised, so a new bound stands before it.
#define VKH_CULLS(X)                                                                      \
  X(kCullExact, 0u, exact)                                                                \
  X(kCullU1, 1u, u1)                                                                      \
  X(kCullU2, 2u, u2)                                                                      \
  X(kCullHa, 3u, ha)                                                                      \
  X(kCullU3, 4u, u3)                                                                      \
  X(kCullU4, 5u, u4)                                                                      \
  X(kCullLowerRaised, 6u, lower_raised) /* later, because lower had risen past their u */ \
  X(kCullPrecision, 7u, precision)      /* nothing finer can be decided */
#define VKH_CULL(constant, value, name) VKH_CONST uint constant = value;
VKH_CULLS(VKH_CULL)
#undef VKH_CULL
VKH_CONST uint kCullCount = kCullPrecision + 1u;  // it stays the last
VKH_CONST uint kMostCulls = 16u;                  // room for them in what the host reads

// Control::maximum: running maxima of non-negative floats, kept as their bits so that atomicMax
// orders them. Distances are above Control::base.
VKH_CONST uint kMaxLower = 0u;   // largest distance of a sample, not yet certified: it only steers
VKH_CONST uint kMaxClosed = 1u;  // largest u of a culled candidate
VKH_CONST uint kMaxFrontier = 2u;  // largest u in the frontier being read
VKH_CONST uint kMaxNext = 3u;      // largest u in the frontier being written
VKH_CONST uint kMaxSpilled = 4u;   // largest u of candidates that do not fit or cannot be refined
VKH_CONST uint kMaxVertex =
    5u;  // largest distance of a vertex of A, in plain floats: sets the base
VKH_CONST uint kMaxCount = 6u;

// Control::count: stream lengths.
VKH_CONST uint kCountFrontier = 0u;   // candidates being read
VKH_CONST uint kCountNext = 1u;       // candidates being written
VKH_CONST uint kCountSurvivors = 2u;  // candidates past the filter in this wave
VKH_CONST uint kCountRefined = 3u;  // if some are deferred: the refined ones that have their place,
VKH_CONST uint kCountDeferred = 4u;  // and deferred ones
VKH_CONST uint kCountCount = 5u;

// Radix sort: 8-bit digits; a block is what one workgroup of kSortGroup invocations sorts at a
// time, kSortRounds keys each, or down to kFewestSortRounds (SortPush).
VKH_CONST uint kSortGroup = 256u;
VKH_CONST uint kSortRounds = 8u;
VKH_CONST uint kFewestSortRounds = 2u;
VKH_CONST uint kSortBlock = kSortGroup * kSortRounds;
VKH_CONST uint kSortDigits = 256u;
// Up to this many faces, 24 bits of their codes tell faces apart well enough: the lowest 6 bits are
// 0, and the sort skips them.
VKH_CONST uint kFewFaces = 1u << 16;
VKH_CONST uint kFewFacesFirstBit = 6u;
// Up to this many blocks, sort_scatter sums the counts itself, which saves a dispatch per pass.
VKH_CONST uint kSortFewBlocks = 64u;

// The frontier's sort key: defer | mode | morton30 (docs/method.md, eq. 4).
VKH_CONST uint kKeyDeferred = 0x80000000u;
VKH_CONST uint kKeyThin = 0x40000000u;
// Frontiers of fewer candidates are not sorted unless a run sets another number. An H200 gains
// nothing by sorting (80 pairs, from 1, 2^12, 2^14, 2^16, 2^18: 134, 128, 124, 121, 120 ms; 91
// without the switch, whose dispatches cost even if they are empty).
VKH_CONST uint kSortFrom = 1u << 14;

// Candidates that stay free in the frontier unless a single one is refined. Candidates with the
// smallest u are refined first, of equal u the smallest in area: so a candidate's children come
// next, and a frontier with no more room than this is traversed depth first. A candidate has at
// most kBaryBits generations below it, each of which leaves three more than it takes: 3 * 20
// places; twice as many if there are subroots.
VKH_CONST uint kReserve = 64u;

VKH_CONST uint kSelectDigits = 256u;  // of a key, if a plan selects: 8 bits

// The distance of a witness that must be measured again.
VKH_CONST float kUnmeasured = 3.0e38f;

// wave_subdivide: invocations per candidate in the GPU profile, and if it is split twice.
VKH_CONST uint kSplitLanes = 4u;
VKH_CONST uint kSplitTwiceLanes = 16u;
// Up to this many candidates are split twice: a wave of few candidates takes as long as its chain
// of steps, so half as many waves are worth twice the work. Measured on an H200
// (docs/log/measurements.md).
VKH_CONST uint kSplitTwiceParents = 8192u;

// wave_bound: children that one workgroup of kGroupSize bounds together; fewer if a wave is small,
// so that it fills the device. Measured on an H200 (docs/log/measurements.md).
VKH_CONST uint kFewestChildren = 8u;
VKH_CONST uint kBoundGroups = 640u;  // workgroups to start before each takes more

VKH_CONST uint kMaxOffers =
    64u;  // samples of a wave that may become the witness (wave/witness.glsl)

VKH_CONST uint kMaxWaveRecords = 64u;

// cell_bounds: triangles of B that are examined for one cell before boxes stand for the rest.
VKH_CONST uint kCellTriangles = 128u;
// CellPush::given.
VKH_CONST uint kFacesOfA = 0u;
VKH_CONST uint kGivenCells = 1u;
VKH_CONST uint kSurveyCells = 2u;  // the new cells of a survey, at their places

// A survey's cells (shaders/survey). Edges of a tally, distances of a score; a score's bins, 8 an
// octave; cells of a block, which are split in order.
VKH_CONST uint kSurveyEdges = 256u;
VKH_CONST uint kSurveyOpen = 64u;
VKH_CONST uint kScoreBins = 2048u;
VKH_CONST uint kSurveyBlock = 1024u;
// Workgroups of a kernel that goes over all cells, at most.
VKH_CONST uint kSurveyGroups = 1024u;
// SurveyTable::sums: for each edge, the area of the cells that it cuts, and of the cells for which
// it is the first edge that they lie within; the part that surely is within it, and the part that
// may be.
VKH_CONST uint kSurelyPart = 0u;
VKH_CONST uint kSurelyWhole = kSurveyEdges;
VKH_CONST uint kPerhapsPart = 2u * kSurveyEdges;
VKH_CONST uint kPerhapsWhole = 3u * kSurveyEdges;
VKH_CONST uint kMeanLower = 4u * kSurveyEdges;
VKH_CONST uint kMeanUpper = kMeanLower + 1u;
VKH_CONST uint kSquareLower = kMeanLower + 2u;
VKH_CONST uint kSquareUpper = kMeanLower + 3u;
VKH_CONST uint kSurveySums = kMeanLower + 4u;
// The class of a survey's cell: the side of B on which it lies, or why it has none.
VKH_CONST uint kClassUnseen = 0u;  // it was not looked at since it was made
VKH_CONST uint kClassOver = 1u;    // in front of B's faces
VKH_CONST uint kClassUnder = 2u;
VKH_CONST uint kClassMeets = 3u;       // it meets B, or is nearer than its bounds tell
VKH_CONST uint kClassEdge = 4u;        // faces that may be closest somewhere on it do not agree
VKH_CONST uint kClassDegenerate = 5u;  // a segment or a point may be closest
VKH_CONST uint kClassTwoSided = 6u;    // a face may be closest that lies on an opposite one
VKH_CONST uint kClassMany = 7u;        // more faces may be closest than are looked at
// Or whether B's normals were compared with A's there.
VKH_CONST uint kClassCompared = 8u;
VKH_CONST uint kAllClasses = 0x1ffu;  // a set of classes has a bit for each
// Kinds of faces of B, for sides.
VKH_CONST uint kFaceCovered = 1u;   // a segment or a point of other faces
VKH_CONST uint kFaceBare = 2u;      // a segment or a point that is of no other face
VKH_CONST uint kFaceTwoSided = 4u;  // another face has the same corners in the opposite order
// closest_faces: triangles of B that are examined for one point before boxes stand for the rest,
// and how many of them to 48 bits.
VKH_CONST uint kClosestTriangles = 1u << 16;
VKH_CONST uint kClosestSharp = 1u << 10;
// ClosestFace::lower_above if a driver ended the search early: there is no lower bound.
VKH_CONST float kSearchEnded = -3.0e38f;

// A mesh's fault is kNone, its least face that is no triangle, or this: its VkhMesh describes no
// mesh, which is known at recording.
VKH_CONST uint kFaultLayout = 0xfffffffeu;
// Largest coordinate that the error analysis covers, as the bits of a float: 2^15.
VKH_CONST uint kLargestCoordinate = 0x47000000u;

// The state of a vertex of A from seed_faces: 0 if no face uses it.
VKH_CONST uint kVertexUsed = 1u;
VKH_CONST uint kVertexOnB = 2u;  // + a triangle that it is a corner of

// Status of the report: the only list; VKH_STATUS_<api's> in vkhausdorff.h.
#define VKH_STATUSES(X)                                                                         \
  X(kStatusRunning, 0u, RUNNING)     /* candidates are left: advance, or take what there is */  \
  X(kStatusDecided, 1u, DECIDED)     /* none is left */                                         \
  X(kStatusPrecision, 2u, PRECISION) /* none, but some closed at a u above the tolerance */     \
  X(kStatusMemory, 3u, MEMORY) /* candidates were spilled: nothing could wait, or be refined */ \
  X(kStatusWithin, 4u, WITHIN) /* with a limit: upper <= limit */                               \
  X(kStatusBeyond, 5u, BEYOND) /* with a limit: lower > limit_up; in control, nearly surely */  \
  X(kStatusInput, 6u, INPUT)   /* in the report: an input is no mesh, nothing is known */
#define VKH_STATUS(constant, value, api) VKH_CONST uint constant = value;
VKH_STATUSES(VKH_STATUS)
#undef VKH_STATUS

// ---- structs
// ----------------------------------------------------------------------------------------------------

// An inner node of the binary tree over B's triangles: references to its children, and the
// triangles that it covers, [first, last].
struct Branch {
  uint child0, child1;
  uint first, last;
};

// A child of a node: its box and the reference to it. kNone, with an empty box: no child.
struct Child4 {
  vec3 lo;
  uint child;
  vec3 hi;
  uint spare;
};

// The node that a traversal reads: a branch's grandchildren, or children that are leaves. A
// traversal of four boxes at a time is half as long as one of two. 128 bytes, eight aligned 16-byte
// loads.
struct Node {
  Child4 child[4];
};

// A triangle of B in Morton order, 48 bytes (three aligned 16-byte loads).
struct Triangle {
  vec3 a;
  uint face;  // of B, as given
  vec3 b;
  uint spare0;
  vec3 c;
  uint spare1;
};

// A vertex as an unevaluated sum hi + lo, about 48 bits per coordinate; lo is 0 if the caller gave
// none.
struct Vertex {
  vec3 hi;
  vec3 lo;
};

// The low parts of a Triangle's corners.
struct TriangleLow {
  vec3 a, b, c;
};

// A sub-triangle of A that is still undecided: 36 bytes.
struct Candidate {
  uvec4 corners;  // three dyadic barycentric pairs, see math/dyadic.h
  uint root;      // face of A
  uvec3 nearest;  // closest triangle of B found for each corner
  float upper;    // u: h(candidate, B) <= Control::base + upper, rounding included
};

// A refined candidate in its wave.
struct Split {
  uint code;          // math/dyadic.h; kSplitNone where it ends here
  uint child_splits;  // if it is split twice: the codes of its four children, 5 bits each;
                      // kChildSplitNone
  uint parent;        // its slot in the half of the frontier being read
};

// One closest-point query: in, a position and triangles to start from; out, the closest triangle
// found.
struct Point {
  vec3 position;  // with position_lo; a fused query does not write them
  uint nearest;   // in: start triangle or kNone; out: closest triangle
  vec3 position_lo;
  float distance;  // above Control::base, at least 0; negative: not to be queried
};

struct Dispatch {
  uint x, y, z;
};

struct WaveRecord {
  uint parents, candidates, queries, survivors, deferred;
  float lower, upper;
};

// The sample with the largest distance so far.
struct Witness {
  vec3 position;   // as rounded to float32; the sample proper is at (root, j, k)
  float distance;  // above Control::base; steering value
  uint root;       // face of A
  uint j, k;       // dyadic barycentrics of its second and third corner
  uint nearest;    // triangle of B
};

// A sample that may become the witness, in words, for atomics.
struct Offer {
  uint key;
  uint x, y, z;  // Witness::position, as bits
  uint root, j, k;
  uint nearest;
};

struct Control {
  uint count[5];            // kCount*
  uint maximum[6];          // kMax*
  uint culled[kMostCulls];  // kCull*
  uint input_fault;         // of A: kNone, a face, kFaultLayout
  uint parity;              // which half of the frontier is being read
  uint wave;                // while the run goes on, the planned one is counted
  uint status;              // kStatus*
  uint root_cursor;         // faces of A before this one were admitted
  uint roots;               // faces of A admitted in this wave
  uint deferred;            // candidates that stay as they are in this wave
  uint parents;             // candidates that it refines
  uint select_key;  // where some are deferred, those with a smaller or the same key are refined:
  uint select_tie;  // wave/candidate.glsl
  uint select_largest;  // in this wave the largest u come first
  uint sort_from;       // frontiers of fewer candidates are not sorted
  uint sorted;          // this wave's is
  uint split_twice;     // this wave splits its candidates twice
  uint measuring;       // this wave only measures its witness above a new base
  uint spilled;         // candidates that could neither be refined nor wait
  uint subroots;        // candidates that became roots, or would have, had there been room
  uint pauses;          // a wave without room for all waits for a larger workspace
  uint wanted;          // such a wave waits: places that each half should have; else 0
  uint seed_witness;    // 3 * face + corner of A where the first witness is; kNone
  // The wave's samples that are at a new lower bound: the smallest of their keys, and the samples
  // that had it when they were offered.
  uint offer_key;
  uint offer_count;
  Offer offers[64];  // kMaxOffers
  float cull_tolerance;
  float known_lower;  // candidates near it are closed as if it were a sample's distance
  float limit;        // > 0: the run only answers whether h is within it
  float limit_up;     // at least that: a sample beyond is farther than this
  float base;         // distances of the run are kept above it
  // The old base less the new one, in two floats: the shift of the frontier being read. 0 except in
  // the wave that follows a change of base.
  float rebase_hi, rebase_lo;
  uint certified;  // 0: a wave of the run, or its begin, was in plain floats
  uint two_float;  // the meshes have low parts
  uint tight;      // samples are compared to 48 bits
  Witness witness;
  uint capacity;    // of each half of the frontier
  uint face_count;  // of A
  // From here on as in VkhStatistics, to which they are copied.
  uint candidate_total;
  uint query_total;
  uint peak_frontier;
  WaveRecord waves[64];  // kMaxWaveRecords; wave w is in waves[w % kMaxWaveRecords]
};

struct Box {
  vec3 lo;
  vec3 hi;
};

// The box that the middles of B's faces' boxes lie in: floats as ordered bits (math/morton.h). Six
// minima, so that one fill makes it empty.
struct CentroidBox {
  uint lo[3];
  uint minus_hi[3];
};

// VkhReport in vkhausdorff.h is this struct word by word; api.cpp asserts its size and offsets.
struct Report {
  float lower;  // certified: lower <= h(A,B) for the coordinates in the buffers
  float upper;  // certified: h(A,B) <= upper
  // The same, with more bits: base + lower_above <= h(A,B) <= base + upper_above.
  float base, lower_above, upper_above;
  uint status;
  uint wave;
  uint remaining;     // candidates left, faces of A not yet admitted included
  uint wanted;        // places in each half of the frontier that the paused run asks for; else 0
  vec3 witness;       // as rounded to float32
  uint witness_root;  // face of A
  uint witness_face;  // of B, as given
  uint witness_j, witness_k;          // dyadic barycentrics of the face's second and third corner
  uint witness_low_j, witness_low_k;  // 20 more bits of them
};

// A sub-triangle of a face of A whose distances are bounded, in words.
struct Cell {
  uvec4 corners;  // as Candidate::corners
  uint face;      // of A
  uint start;     // a triangle of B to start from, as CellBounds has it; kNone
};

// d(x, B) over a cell, each bound certified.
struct CellBounds {
  // Affine functions by their values at its corners: the former is not above d(x, B), the latter
  // not below it. The former may be negative.
  float lower_a, lower_b, lower_c;
  float upper_a, upper_b, upper_c;
  float highest;                // >= d(x, B) for every x of it
  float reached;                // some x of it is at least this far
  float mean_upper;             // >= the mean
  float square_upper;           // >= the mean of the square
  uint face_a, face_b, face_c;  // of B, as given: near its corners
  uint face;                    // of B, as given: near the cell's middle
  uint triangle;                // the same in the BVH's order
};

// The triangles of B near a cell's corners, in the BVH's order; kNone where none is known. They
// steer.
struct CornerTriangles {
  uint a, b, c;
};

// How A's normal agrees with those of B's closest faces, over a cell: the mean of |cos| of the
// angle between them lies in [least, most], and the share on which they agree in [sure, may].
struct CellAgreement {
  float least, most;
  float sure, may;
};

// A face's unit normal. Corners of one number lie at one place, as they were given.
struct FaceNormal {
  vec3 along;
  float off;      // the exact normal is at most this far from it; 1: the face has none
  uvec3 corners;  // of a face of B
};

// An integer of 64 bits.
struct Wide {
  uint low, high;
};

// A distance that is only known to lie between two floats.
struct SurveyEdge {
  float down, up;
};

// The host's questions to a survey's cells. The edges ascend, in both members.
struct SurveyPlan {
  uint edge_count, open_count;
  uint moments;  // 1: a tally adds up means and mean squares, too
  // 1: areas count where normals agree, means are of cosines, and cells whose distances are known
  // score, too.
  uint of_normals;
  float of_whole;      // 1 over the weight of all faces
  float mean, square;  // what a width of the mean, and of the mean square, scores; 0: nothing
  uint classes;        // of the cells that a tally counts
  float far;           // the first of them that reaches it is wanted
  // Cells of these classes have a mean that scores, and those of these may be on either side.
  uint mean_classes, either_side;
  // A map scores a cell by its width over `map_step`, if it has more than `map_area` of the area or
  // an edge longer than `map_length`, and is not all farther than `map_most`. 0: there is no map.
  float map_step, map_area, map_length, map_most;
  // A cell is in the way of its face where it has points that may be farther than `face_within`,
  // and by more than `face_tolerance` than what the face is known to reach, unless that is more
  // than `face_beyond`. 0: faces have no goal.
  // `face_within` is of cells without a side, of those over B, and of those under it.
  uint faces;
  float face_tolerance, face_beyond;
  float face_within[3];
  SurveyEdge most;                 // a distance beyond it counts as 0 in means and mean squares
  SurveyEdge edges[kSurveyEdges];  // of the tally
  SurveyEdge open[kSurveyOpen];    // area that is undecided there scores
  float shares[kSurveyOpen];       // by this factor,
  uint open_classes[kSurveyOpen];  // on cells of these classes
};

// The answer of a survey's cells: sums of weights, and of weighted values over the largest one.
struct SurveyTable {
  Wide sums[kSurveySums];
  uint highest;     // the largest distance from above, as bits
  uint not_lowest;  // the least one from below: the bits' complement
  uint reached;     // some point of a cell that counts is this far: bits
  uint not_far;     // the complement of the first cell that reaches SurveyPlan::far; 0: none does
};

// The number of cells above a key, and with the key, of a block or of all blocks before it.
struct SurveyCounts {
  uint above, ties;
};

// The state of a survey, whose first members are VkhSurveyReport, and what its last wave has split.
struct SurveyWave {
  uint status;  // kStatus*
  uint waves;   // that have split cells
  uint cells;
  uint open;   // cells that a split may help
  uint live;   // cells before the split,
  uint key;    // cells with a larger key were split,
  uint ties;   // and this many cells with this key
  uint above;  // the number of cells with a larger key
  uint parts;  // of each: 2 or 4, the first in its place; 1: A's faces are the cells
  uint fresh;  // cells without bounds of their own: all parts, or A's faces
};

// The face of B closest to a point, and d(point, B): base + lower_above <= d <= base + upper_above.
struct ClosestFace {
  float base, lower_above, upper_above;
  uint face;  // as given
};

// A part of a face of A as a 64-bit integer: 2^40 is the whole.
struct Area {
  uint lo, hi;
};

// self_test: a device's operands and its results (host/app/self_test.cpp judges).
struct SelfTestQuestion {
  float a, b;
  uint bits;  // of a normal float
};

struct SelfTestAnswer {
  float sum, difference, product, quotient, root;  // a + b, a - b, a b, a / b, sqrt(|a|)
  float sum_hi, sum_lo, product_hi, product_lo;    // two_sum, two_product
  uint bits;                                       // as given, by way of a float
  float larger, smaller;
  uint subgroup;  // number of the invocation's subgroup, in order of arrival
  float highest;  // |a| in the subgroup
  uint keepers;   // invocations of the subgroup with a > b,
  uint rank;      // and how many of them come before this one
};

// Results of each subgroup operation that a kernel uses, over the invocations in `ballot`, which
// ran one piece of code together.
struct SelfTestGroup {
  uvec4 ballot;
  uint subgroup, lane;
  uint first;                   // the lowest lane, by subgroupBroadcastFirst,
  uint first_lane;              // and by first_lane (base/subgroup.glsl)
  uint elected;                 // 1 for one of them
  uint members;                 // their number,
  uint rank;                    // and the number of them before this one
  uint sum;                     // of their items + 1, up to this one
  uint shuffled;                // the item of the first
  float least, highest;         // of a
  vec3 all_least, all_highest;  // of (a, b, -a)
};

// The same item's results, in three kinds of control flow.
struct SelfTestGroups {
  SelfTestGroup whole;   // all of the subgroup
  SelfTestGroup branch;  // those with a > b in one branch, the others in the other
  SelfTestGroup loop;    // in the last turn of a loop of (bits & 3) + 1 turns
};

// The operands of the composed expressions (doctor/composed.h): two-floats, 2^-30 <= |x| and the
// bases near the length of u and the quotient of reach by the length of scaled(w), or 0.
struct SelfTestOperands {
  vec3 u_hi, u_lo, v_hi, v_lo, w_hi, w_lo;
  float x, y;
  float reach_hi, reach_lo;  // > 0
  float norm_base, quotient_base;
};

struct SelfTestComposed {
  vec3 difference_hi, difference_lo;    // u - v
  vec3 combination_hi, combination_lo;  // u + x v + y w
  float dot_hi, dot_lo;                 // u . v
  vec3 coarse;                          // u - v in one float
  float norm, norm_above;               // >= |u|, and >= |u| - norm_base
  float quotient, quotient_above;  // <= reach_hi / |x|, and <= reach / |scaled(w)| - quotient_base
};

struct SelfTestTotals {
  uint highest, lowest;  // |a| of all, as bits
  uint items, subgroups;
};

// ---- push constants
// ---------------------------------------------------------------------------------------------

// mesh_load and mesh_check: one mesh from the caller's buffers into packed ones.
struct LoadPush {
  uint vertex_word;   // start of the first position, in 4-byte words
  uint stride_words;  // between positions
  uint vertex_count;
  uint index_half;   // start of the first index, in 2-byte units
  uint index_count;  // 3 * faces
  uint index_is_16bit;
  uint has_low;     // low parts are given,
  uint low_word;    // and start here, with the same stride
  uint fault_word;  // only mesh_check: the word that it writes
};

struct CountPush {
  uint count;
};

// report_write
struct ReportPush {
  uint count;     // triangles of B
  uint is_built;  // 0: B has no BVH, and no run was recorded
};

struct MortonPush {
  uint count;      // of faces
  uint block;      // keys of a block of the sort whose first digits are counted here; 0: none
  uint first_bit;  // of that digit
};

// The levels above one of the pyramid: bvh_pyramid, and over the triangles bvh_leaves and bvh_move.
struct PyramidPush {
  uint from;      // start of that level in `boxes`; unused if it is the triangles
  uint count;     // of its boxes, or of triangles
  uint quads;     // start of the boxes over four of it each
  uint sixteens;  // start of those over sixteen
};

// bvh_refit
struct RefitPush {
  uint count;   // of triangles
  uint ranked;  // `ranks` gives the places of nodes, not their branches
  uint quads;   // start of the boxes over four of them in `boxes`; those over sixteen start at 0
};

struct SortPush {
  uint shift;   // of the digit in the key
  uint rounds;  // keys per invocation; fewer than kSortRounds if blocks remain few
  uint count;   // of keys; kNone if a buffer has it
  // The number of this pass, and of the passes that have counts of their own in `counts`, if passes
  // count for each other, sort_scatter for the one after it. Otherwise 0 of 1.
  uint pass;
  uint passes;
};

// seed_faces
struct FacesPush {
  uint face_count;      // of A
  uint triangle_count;  // of B
};

// cell_bounds
struct CellPush {
  uint count;           // of cells
  uint given;           // kFacesOfA, kGivenCells or kSurveyCells
  uint first;           // the first of the faces of A, or of the survey's new cells
  uint face_count;      // of A
  uint triangle_count;  // of B
};

// survey_begin
struct SurveyBeginPush {
  uint faces;
  float farthest;  // no distance is above it
};

// survey_score and survey_tally
struct SurveyPush {
  uint first, end;  // the cells from the first one to the one before the end
  uint groups;      // of the dispatch
  int unit;         // distances are below 2^(unit - 127),
  int square_unit;  // and their squares below 2^(square_unit - 127)
};

// survey_sides
struct SurveySidesPush {
  uint first, end;      // the cells from the first one to the one before the end
  uint face_count;      // of A
  uint triangle_count;  // of B
  float above;          // cells that are nowhere farther from B are left out
  float near;           // a part of a cell that is nearer needs no side
  float moved;          // A's and B's vertices may be this far from where they are stored, together
  uint is_solid;        // B winds `front` times round all points in front of it,
  int front;            // and one time more or less round all others
};

// survey_normals
struct SurveyNormalsPush {
  uint first, end;             // the cells from the first one to the one before the end
  uint face_count;             // of A
  uint triangle_count;         // of B
  float moved;                 // both meshes' vertices together may be this far off their places
  float limit_down, limit_up;  // normals agree from this cosine on
};

// survey_faces
struct SurveyFacesPush {
  uint classes;  // of the cells that count
  uint reached;  // 1: what their points reach is wanted, 0: what none exceeds
};

// survey_choose
struct SurveyChoosePush {
  uint capacity;  // cells that there is room for
  uint most;      // cells that a wave may split
  uint splits;    // 0: nothing is chosen; the wave only finds the survey's status
};

// closest_faces
struct ClosestPush {
  uint count;           // of points
  uint triangle_count;  // of B; 0: it was not built
  uint two_float;       // B has low parts
};

// query: the points. If these are A's vertices, `warm` adds the present witness behind them: the
// last run's or, after a plan that has moved the base, this one's.
struct QueryPush {
  uint asked;           // kAsk*
  uint triangle_count;  // of B
  uint vertex_count;    // of A
  uint warm;            // start from the last run's closest triangles
};

struct BeginPush {
  uint capacity;
  uint face_count;
  float cull_tolerance;
  float known_lower;
  float limit, limit_up;
  uint two_float;
  uint warm;  // the last run's witness is kept
  uint sort_from;
  uint pauses;
  uint input_fault;  // of A, as far as it is known at recording
};

#ifdef __cplusplus
}  // namespace vkh::gpu
#endif
#endif
