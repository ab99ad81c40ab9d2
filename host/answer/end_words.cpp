#include "host/answer/end_words.h"

#include <array>

namespace vkh {
namespace {

constexpr const char* kMoreTime = "; ask for more --time";
constexpr const char* kStopped = "; it was interrupted";
constexpr const char* kTimeOnPage = "the time that was set is over";
constexpr const char* kMemoryOnPage = "there was no memory for more";
constexpr const char* kStoppedOnPage = "the measurement was stopped";

template <class End>
struct EndRow {
  End end;
  EndWords words;
};

constexpr std::array<EndRow<Status>, 8> kSearchEnds{{
    {Status::kClosed, {"the interval meets the tolerance", nullptr, nullptr}},
    {Status::kPrecision,
     {"what is left cannot be decided in this arithmetic", "; no smaller --tol helps", nullptr}},
    {Status::kTime, {"the time budget ended", kMoreTime, kTimeOnPage}},
    {Status::kWaves,
     {"the wave budget ended", "; ask for more --waves", "the effort that was set is used up"}},
    {Status::kMemory,
     {"the memory was too small for what had to be refined", "; ask for more --memory",
      kMemoryOnPage}},
    {Status::kCancelled, {"it was interrupted", kStopped, kStoppedOnPage}},
    {Status::kPruned,
     {"it exceeds a lower bound that was known by no more than the tolerance", nullptr, nullptr}},
    {Status::kLimit, {"the search stopped once the verdict was certain", nullptr, nullptr}},
}};

// A survey that has used its effort did what was set: page_view.cpp says so beside the figures.
constexpr const char* kNoMore = "; no more --effort decides it";
constexpr std::array<EndRow<SurveyEnd>, 6> kSurveyEnds{{
    {SurveyEnd::kMet, {"no split narrows it more", kNoMore, nullptr}},
    {SurveyEnd::kBits, {"no split narrows it more", kNoMore, nullptr}},
    {SurveyEnd::kEffort, {"its effort was used", "; ask for more --effort", nullptr}},
    {SurveyEnd::kTime, {"its time ended", kMoreTime, kTimeOnPage}},
    {SurveyEnd::kCancelled, {"it was interrupted", kStopped, kStoppedOnPage}},
    {SurveyEnd::kMemory,
     {"there was no memory for it", "; there was no memory for more", kMemoryOnPage}},
}};

template <class Rows, class End>
constexpr bool are_in_order(const Rows& rows, End last) {
  for (size_t i = 0; i < rows.size(); ++i) {
    if (static_cast<size_t>(rows[i].end) != i) return false;
  }
  return rows.size() == static_cast<size_t>(last) + 1;
}
static_assert(are_in_order(kSearchEnds, Status::kLimit));
static_assert(are_in_order(kSurveyEnds, SurveyEnd::kMemory));

}  // namespace

const EndWords& end_words(Status status) { return kSearchEnds[static_cast<size_t>(status)].words; }

const EndWords& end_words(SurveyEnd end) { return kSurveyEnds[static_cast<size_t>(end)].words; }

}  // namespace vkh
