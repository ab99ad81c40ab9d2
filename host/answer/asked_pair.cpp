#include "host/answer/asked_pair.h"

#include <utility>

namespace vkh {

AskedPair::AskedPair(Question question)
    : question_(std::move(question)), answer_(unread_answer(question_)) {}

void AskedPair::name(size_t mesh, const std::string& path, InputHashes hashes) {
  Input& input = answer_.inputs.at(mesh);
  input.path = path;
  input.sha256 = std::move(hashes.sha256);
  input.files = std::move(hashes.files);
}

ReadMesh& AskedPair::movable_a() {
  if (own_a_ == nullptr) a_ = own_a_ = std::make_shared<ReadMesh>(*a_);
  return *own_a_;
}

void AskedPair::take(std::shared_ptr<ReadMesh> a, ShapedMesh b) {
  own_a_ = a;
  take(std::shared_ptr<const ReadMesh>(std::move(a)), std::move(b));
}

void AskedPair::take(std::shared_ptr<const ReadMesh> a, ShapedMesh b) {
  a_ = std::move(a);
  b_ = std::move(b);
  const bool is_to_move = !question_.align && is_placed(question_, *a_, *b_.mesh);
  if (is_to_move) place_a(question_, movable_a(), *b_.mesh);
  if (!question_.align) begin_answer();
  check_sides(question_, *a_, *b_.mesh);
}

void AskedPair::fit(Solver& solver, const Observer& observer, const PreparedMesh* b) {
  if (!question_.align) return;
  fit_a(question_, solver, observer, {movable_a(), *b_.mesh, b});
  begin_answer();
}

// A length that cannot be resolved must not cost the names and hashes.
void AskedPair::begin_answer() {
  Answer known = answer_;
  vkh::begin_answer(question_, {a_, shape_of(*a_)}, b_, known);
  for (size_t i = 0; i < known.inputs.size(); ++i) {
    Input &named = answer_.inputs[i], &input = known.inputs[i];
    if (!named.path.empty()) input.path = std::move(named.path);
    input.sha256 = std::move(named.sha256);
    input.files = std::move(named.files);
  }
  answer_ = std::move(known);
}

// From the search on they stay as they are.
AskedMeshes AskedPair::meshes(const PreparedMesh* b) {
  return {*a_, *b_.mesh, b, question_.asks_for_survey() ? &kept_ : nullptr};
}

void AskedPair::solve(std::span<Solver* const> solvers, const Observer& observer,
                      const PreparedMesh* b) {
  vkh::solve(question_, solvers, meshes(b), observer, answer_);
}

void AskedPair::take(StreamResult&& result) { take_reports(question_, std::move(result), answer_); }

void AskedPair::finish(Solver& solver, const Observer& observer, const PreparedMesh* b) {
  vkh::finish(question_, solver, meshes(b), observer, answer_);
}

}  // namespace vkh
