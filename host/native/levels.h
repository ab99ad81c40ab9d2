// The levels of a run: split, query and bound all open candidates, and again.
#pragma once

#include <vector>

#include "host/base/thread_pool.h"
#include "host/native/candidate.h"
#include "host/native/native.h"

namespace vkh::native {

/// Decides which candidates need no refining: within the tolerance of the best sample or of a known
/// lower bound, or within a limit. In the frame.
struct Goal {
  double tolerance;
  double known_lower;
  double within;  ///< 0 or less: no limit
};

/// While a level is joined a candidate is there twice, and vectors grow ahead of their need.
constexpr size_t kBytesOfCandidate = 3 * sizeof(Candidate);

/// The state between two levels. Work on it is cut into pieces that do not depend on the number of
/// threads, and each piece leaves its own results, which are joined in order. So no bit of a result
/// depends on it either. Functions that call `keep_going` throw Interrupted if it returns false,
/// and leave a true state.
class Levels {
 public:
  Levels(const Problem& problem, const Goal& goal, const NativeOptions& options,
         std::function<bool()> keep_going);

  void ask_vertices();  ///< first: of A
  void bound_faces();   ///< next, the first level: A's faces whole
  void advance();       ///< one level more
  bool is_over() const { return levels_ > 0 && open_.empty(); }

  const Gain& total() const { return total_; }
  double upper() const { return upper_; }  ///< of all that is closed or open
  uint32_t count() const { return levels_; }
  size_t open() const { return open_.size(); }
  size_t peak() const { return peak_; }
  size_t threads() const { return pool_.threads(); }
  bool has_given_up() const { return given_up_ >= 0; }
  std::vector<uint64_t> areas() const;  ///< NativeReport::areas

 private:
  /// A part of a face that was closed.
  struct Closed {
    uint32_t face;
    uint64_t area;
  };
  struct Piece {
    Gain gain;
    std::vector<Closed> closed;  // where areas are asked for
    std::vector<Split> splits;
    std::vector<Candidate> open;
  };
  template <class Work>
  std::vector<Piece> in_pieces(size_t count, size_t size, const Work& work);

  double threshold() const;
  void close(Piece& piece, uint32_t face, const Bary3& at, double upper, Close by) const;
  void query_vertices(Piece& piece, size_t begin, size_t end);
  void bound_face(Piece& piece, uint32_t f) const;
  uint32_t choose_split(const Candidate& c, const Face& face) const;
  void split(Piece& piece, uint32_t number) const;
  void bound_children(Piece& piece, const Split& s) const;
  void join_pieces(const std::vector<Piece>& pieces);
  void end_level();
  void give_up();
  size_t choose_refined();

  const Problem& problem_;
  const Goal goal_;
  const size_t most_;  // candidates
  const ThreadPool pool_;
  std::vector<Nearest> of_vertex_;
  std::vector<Candidate> open_;
  std::vector<uint64_t> closed_areas_;  // of each face; empty where they are not asked for
  Gain total_;
  double upper_ = std::numeric_limits<double>::infinity();
  double given_up_ = -1;  // the largest u that was
  uint32_t levels_ = 0;
  size_t peak_ = 0;
};

}  // namespace vkh::native
