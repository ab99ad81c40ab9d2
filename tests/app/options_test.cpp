// The options table: a value means the same on the command line and in a list, and each value that
// an answer depends on has a key of its own.
#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "host/answer/options_table.h"
#include "host/answer/rules.h"
#include "host/answer/steps.h"
#include "host/app/arguments.h"
#include "host/app/program.h"
#include "vkhausdorff/error.h"

using namespace vkh;

namespace {

/// Two values of an option, as they are typed; of a flag one without a text.
std::vector<std::string> samples_of(const Option& option) {
  switch (option.kind) {
    case Kind::kFlag:
      return {""};
    case Kind::kText:
    case Kind::kFile:
    case Kind::kInput:
    case Kind::kFolder:
      return {"one", "two"};
    case Kind::kUnit:
      return {"mm", "in"};
    case Kind::kLength:
      return {"0.1mm", "0.2mm"};
    case Kind::kLengths:
      return {"0.1mm,0.3mm", "0.2mm,0.3mm"};
    case Kind::kTolerance:
      return {"1e-4", "0.1mm"};
    case Kind::kNames:
    case Kind::kChoice:
      return {option.choices.front(), option.choices.back()};
    case Kind::kShare:
      return {"99%", "0.98"};
    case Kind::kPercentile:
      return {"90", "80%"};
    case Kind::kAngle:
      return {"10deg", "20"};
    case Kind::kSize:
      return {"1MiB", "2000"};
    case Kind::kTime:
      return {"1s", "2min"};
    case Kind::kCount:
    case Kind::kNumber:
      return {"3", "7"};
    case Kind::kPart:
      return {"0/2", "1/2"};
  }
  return {};
}

/// The request of a batch's command line, before its rules.
Request typed(const std::vector<std::string>& more) {
  std::vector<std::string> words{"batch", "list.csv", "--out", "out.jsonl"};
  words.insert(words.end(), more.begin(), more.end());
  Program program;
  program.app().parse(std::vector<std::string>(words.rbegin(), words.rend()));
  return program.asked();
}

Request typed(const Option& option, const std::string& text) {
  const std::string name = std::string("--") + option.name;
  return option.kind == Kind::kFlag ? typed({name}) : typed({name, text});
}

}  // namespace

TEST_CASE("each value of a batch's option has a key of its own, or the row says why not") {
  const std::string none = key_text(typed(std::vector<std::string>()));
  size_t apart = 0;
  for (const Option& option : options()) {
    const Use* use = use_of(option, kBatch);
    if (use == nullptr || use->required) continue;
    CAPTURE(option.name);
    std::set<std::string> keys{none};
    const std::vector<std::string> samples = samples_of(option);
    for (const std::string& text : samples) keys.insert(key_text(typed(option, text)));
    if (*option.unlike != '\0') {
      CHECK(keys.size() == 1);
      continue;
    }
    const bool has_default = option.kind == Kind::kChoice && option.name == std::string("bodies");
    CHECK(keys.size() == samples.size() + (has_default ? 0 : 1));
    ++apart;
  }
  CHECK(apart >= 25);
}

TEST_CASE("a column means what its option does") {
  size_t columns = 0;
  for (const Option& option : options()) {
    if (!option.is_column) continue;
    CAPTURE(option.name);
    ++columns;
    for (const std::string& text : samples_of(option)) {
      const std::string cell = option.kind == Kind::kFlag ? "TRUE" : text;
      Request row = typed(std::vector<std::string>());
      put(option, {column_name(option), std::span(&cell, 1)}, row);
      CHECK(key_text(row) == key_text(typed(option, text)));
    }
  }
  CHECK(columns == 10);
}

TEST_CASE("a flag that is turned off is as one that is not there") {
  const std::string none = key_text(typed(std::vector<std::string>()));
  for (const Option& option : options()) {
    const bool is_plain = option.kind == Kind::kFlag && *option.shape == '\0';
    if (!is_plain || use_of(option, kBatch) == nullptr) continue;
    CAPTURE(option.name);
    const Request off = typed({std::string("--") + option.name + "=false"});
    CHECK(key_text(off) == none);
    CHECK(!off.has(option.name));
    const std::string cell = "no";
    Request row = typed({std::string("--") + option.name});
    CHECK(row.has(option.name));
    put(option, {column_name(option), std::span(&cell, 1)}, row);
    CHECK(key_text(row) == none);
    CHECK(!row.has(option.name));
  }
}

TEST_CASE("few options have a setter of their own") {
  size_t own = 0;
  std::set<std::string> names;
  for (const Option& option : options()) {
    const Own* rule = std::get_if<Own>(&option.target);
    own += rule != nullptr ? 1 : 0;
    const bool is_in_keys = option.is_column || use_of(option, kBatch) != nullptr;
    if (rule != nullptr && rule->text == nullptr && is_in_keys)
      CHECK_MESSAGE(*option.unlike != '\0', option.name);
    CHECK_MESSAGE(names.insert(option.name).second, option.name);
  }
  CHECK(own <= 10);
}

TEST_CASE("a wrong value names the option as its outlet does") {
  for (const Option& option : options()) {
    const bool takes_any = option.kind == Kind::kFlag || option.kind == Kind::kText ||
                           option.kind == Kind::kFile || option.kind == Kind::kInput ||
                           option.kind == Kind::kFolder || option.has_others;
    if (takes_any) continue;
    for (const std::string& said : {with_dashes(option.name), column_name(option)}) {
      CAPTURE(said);
      const std::string wrong = "no value";
      Request asked;
      std::string message;
      try {
        put(option, {said, std::span(&wrong, 1)}, asked);
      } catch (const UsageError& error) {
        message = error.what();
      }
      CHECK(message.starts_with(said));
    }
  }
}

TEST_CASE("a rule names options as its outlet does") {
  Request asked;
  asked.command = kPython;
  asked.given = {"scale"};
  const auto message = [&](const Naming& naming) {
    try {
      check_together(asked, naming);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message(with_dashes) == "--scale: allows a --transform to stretch A; there is none");
  CHECK(message([](std::string_view option) { return std::string(option); }) ==
        "scale: allows a transform to stretch A; there is none");
}

namespace {

template <class Act>
std::string refusal(const Act& act) {
  try {
    act();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

namespace {

/// Returns the question that this value of an option asks, or nothing where it is refused.
std::optional<Question> asked_with(const char* name, const std::string& text, Outlet outlet) {
  Request asked;
  const std::string message = refusal([&] {
    put(*option_of(name), {name, std::span(&text, 1), outlet}, asked);
  });
  return message.empty() ? std::optional(asked.question) : std::nullopt;
}

}  // namespace

TEST_CASE("a number alone means what its outlet says: a length") {
  for (const Outlet outlet : {Outlet::kTyped, Outlet::kPythonText}) {
    CHECK(!asked_with("max", "0.25", outlet));
    CHECK(!asked_with("max-distance", "0.25", outlet));
    CHECK(!asked_with("bands", "0.25", outlet));
  }
  const std::optional<Question> number = asked_with("max", "0.25", Outlet::kPythonNumber);
  REQUIRE(number);
  CHECK(number->max->of == Length::Of::kFiles);
  CHECK(number->max->number == 0.25);
  CHECK(number->max->is_double);
  CHECK(asked_with("max-distance", "0.25", Outlet::kPythonNumber)->max_distance->is_double);
  CHECK(asked_with("bands", "0.25", Outlet::kPythonNumber)->bands.front().is_double);
  for (const char* wrong : {"0", "-1", "+1,-1", "inf", "1abs", ""})
    CHECK_MESSAGE(!asked_with("max", wrong, Outlet::kPythonNumber), wrong);
}

TEST_CASE("arrays have no unit") {
  CHECK(asked_with("max", "0.1mm", Outlet::kTyped)->max->of == Length::Of::kUnit);
  CHECK(!asked_with("max", "0.1mm", Outlet::kPythonText));
  CHECK(asked_with("max", "0.1abs", Outlet::kPythonText)->max->of == Length::Of::kFiles);
}

TEST_CASE("a number alone means what its outlet says: a tolerance, a time") {
  CHECK(!asked_with("tol", "0.01", Outlet::kTyped));
  for (const Outlet outlet : {Outlet::kPythonText, Outlet::kPythonNumber}) {
    const std::optional<Question> asked = asked_with("tol", "0.01", outlet);
    REQUIRE(asked);
    CHECK(asked->tolerance.of == Length::Of::kDiagonal);
    CHECK(asked->tolerance.is_double == (outlet == Outlet::kPythonNumber));
  }
  CHECK(asked_with("time", "0", Outlet::kPythonNumber)->budget.time_limit_s == 0);
  CHECK(asked_with("time", "inf", Outlet::kPythonNumber));
  CHECK(!asked_with("time", "-1", Outlet::kPythonNumber));
  CHECK(!asked_with("time", "0", Outlet::kTyped));
}

TEST_CASE("a rule of questions is the same for a command line, a row of a list and C++") {
  const std::string rule = ": figures are of both directions and no verdict: leave out ";
  const Words words{"batch", "list.csv", "--out", "out.jsonl", "--metrics"};
  Words more = words;
  more.insert(more.end(), {"--max", "1mm"});
  CHECK(refusal([&] { (void)understand(more); }).starts_with("--metrics" + rule + "--max"));
  Request row = understand(words).asked;
  CHECK(refusal([&] { (void)unread_answer(row.question); }).empty());
  const std::string cell = "1mm";
  put(*option_of("max"), {"max", std::span(&cell, 1)}, row);
  CHECK(refusal([&] { (void)unread_answer(row.question); }).starts_with("--metrics" + rule));
  row.question.words.clear();
  CHECK(refusal([&] { (void)unread_answer(row.question); }).starts_with("metrics" + rule + "max"));
}

TEST_CASE("an empty value behind the sign never takes the next word") {
  for (const Option& option : options()) {
    if (use_of(option, kDistance) == nullptr) continue;
    const std::string word = with_dashes(option.name) + "=";
    const std::string message = refusal([&] {
      (void)understand({"distance", "a", "b", word, "1"});
    });
    CHECK_MESSAGE(message.starts_with(word + "'': expected "), message);
  }
}
