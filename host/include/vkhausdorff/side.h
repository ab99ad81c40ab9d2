// Words of sides: what a cell's side is, why it has none, and whether B has an inside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// The side of B, as its faces are oriented: over is in front of them.
enum class SurfaceSide : int8_t { kUnder = -1, kUnsigned = 0, kOver = 1 };

/// Whether B has an inside, or the first reason why it has none.
enum class Inside {
  kProven,     ///< closed, no two faces cross, and it winds round each point once or not at all
  kOpen,       ///< an edge has not as many faces on both sides
  kCrossing,   ///< two faces cross, or lie on each other
  kWinding,    ///< it winds round some point otherwise: shells in each other, or of both kinds
  kUndecided,  ///< no point was found beside some part of it at which that could be counted
};
const char* inside_name(Inside inside);  ///< "proven", "open", "crossing", "winding", "undecided"

/// How much of a closed B is inside out: its faces look inward, so that over means inside it.
enum class InsideOut : uint8_t {
  kNone,  ///< nothing, or B is open, or that was not decided
  kPart,  ///< some faces, as of one of several bodies
  kAll,   ///< all faces; where they cross, the volume that they enclose is negative
};
const char* inside_out_name(InsideOut how);  ///< "none", "part", "all"

/// An edge, and two faces that both use it in one direction, as no orientation would have them.
struct EdgeConflict {
  std::array<uint32_t, 2> vertices{}, faces{};
};

/// The number of edges that are no closed, oriented surface's.
struct EdgeCounts {
  uint64_t open = 0;       ///< edges with more faces in one direction than in the other
  uint64_t uneven = 0;     ///< open edges of three faces or more
  uint64_t conflicts = 0;  ///< edges of two faces, both in one direction
  std::optional<EdgeConflict> first = {};  ///< the first conflict
};

/// The reason why a cell has no side.
enum class Doubt : uint8_t {
  kNone,        ///< it has one
  kMeets,       ///< it meets B, or is nearer than the bounds of its distance tell
  kEdge,        ///< faces that may be closest somewhere on it do not agree: it is over an edge
  kDegenerate,  ///< a segment or a point may be closest
  kTwoSided,    ///< a face may be closest that lies on one of the opposite orientation
  kMany,        ///< more faces may be closest than were looked at
  kEnded,       ///< the survey was ended before the cell was looked at
};
constexpr size_t kDoubts = 7;
const char* doubt_name(Doubt doubt);  ///< "none", "meets", "edge", "degenerate", ...

struct CellSide {
  SurfaceSide side = SurfaceSide::kUnsigned;
  Doubt doubt = Doubt::kNone;
};

}  // namespace vkh
