// Answers of every kind, with all members that each may have.
#pragma once

#include <vector>

#include "vkhausdorff/answer.h"

namespace vkh::test {

Answer distance_answer();
Answer both_directions();
/// `upper`: of its interval, whose lower end is 0.1.
Answer gate_answer(const char* limit, double within, double upper);
Answer by_face();
Answer surveyed();
Answer proven();

std::vector<Answer> all_kinds_of_answers();

}  // namespace vkh::test
