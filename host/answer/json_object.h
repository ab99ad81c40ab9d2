// Answers as JSON that is parsed, for programs of this project that look into it.
#pragma once

#include <string>

#include "host/base/parse_json.h"
#include "vkhausdorff/answer.h"

namespace vkh {

inline constexpr const char* kAnswerSchema = "vkhausdorff.answer/2";

inline Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// The answer of a document that is parsed, as answer_from_json().
Answer answer_from(const Json& json);

/// Writes an error in place of an answer of this schema.
std::string failure_json(const Failure& failure, const char* schema);

}  // namespace vkh
