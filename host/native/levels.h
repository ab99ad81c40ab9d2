// The levels of a run: split, query and bound all open candidates, and again.
#pragma once

#include <vector>

#include "host/native/candidate.h"
#include "host/native/native.h"

namespace vkh::native {

/// The state between two levels. Work on it is cut into pieces that do not depend on the number of
/// threads, and each piece leaves its own results, which are joined in order: so do no bits.
class Levels {
 public:
  /// `tolerance`: how far above the best sample candidates are closed, in the frame.
  Levels(const Problem& problem, double tolerance, const NativeOptions& options);

  void start();    ///< A's vertices, and then its faces whole
  void advance();  ///< one level
  bool is_over() const { return open_.empty(); }

  const Gain& total() const { return total_; }
  double largest_open() const;
  uint32_t count() const { return levels_; }
  size_t peak() const { return peak_; }

 private:
  struct Piece {
    Gain gain;
    std::vector<Split> splits;
    std::vector<Candidate> open;
  };
  template <class Work>
  std::vector<Piece> in_pieces(size_t count, size_t size, const Work& work);

  double threshold() const { return total_.best.distance + tolerance_; }
  void query_vertices(Piece& piece, size_t begin, size_t end);
  void bound_face(Piece& piece, uint32_t f) const;
  uint32_t choose_split(const Candidate& c, const Face& face) const;
  void split(Piece& piece, uint32_t number) const;
  void bound_children(Piece& piece, const Split& s) const;
  void take_over(const std::vector<Piece>& pieces);
  std::vector<Candidate> waiting();

  const Problem& problem_;
  double tolerance_;
  NativeOptions options_;
  std::vector<Nearest> of_vertex_;
  std::vector<Candidate> open_;
  Gain total_;
  uint32_t levels_ = 0;
  size_t peak_ = 0;
};

}  // namespace vkh::native
