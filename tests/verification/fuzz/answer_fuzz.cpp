// Fuzzes the readers of answers and of result lines: any JSON is refused with one line that says
// why, or read as an answer whose JSON is read back byte for byte. An input chooses one of the
// known kinds of answers and changes of its members, or is the text itself.
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "host/answer/json_object.h"
#include "host/answer/result.h"
#include "tests/support/answer_kinds.h"
#include "tests/verification/fuzz/fuzz_target.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "answer_fuzz: not so: %s\n", what);
  std::abort();
}

/// Takes numbers of the input from its beginning; zeros when it is used up.
class Choices {
 public:
  explicit Choices(std::string_view bytes) : bytes_(bytes) {}
  bool are_left() const { return !bytes_.empty(); }
  size_t below(size_t count) {
    size_t number = 0;
    for (size_t most = 1; most < count && are_left(); most <<= 8) {
      number = number << 8 | static_cast<unsigned char>(bytes_.front());
      bytes_.remove_prefix(1);
    }
    return count == 0 ? 0 : number % count;
  }

 private:
  std::string_view bytes_;
};

const std::vector<std::string>& documents() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> texts;
    for (const Answer& answer : test::all_kinds_of_answers()) {
      texts.push_back(to_json(answer));
      texts.push_back(to_line(result_of({"id", "key"}, answer)));
    }
    const Failure failure{.code = 4, .message = "a: bad", .file = "a", .place = "line 1"};
    texts.push_back(to_json(failure));
    texts.push_back(to_line(result_of({"id", ""}, failure, test::all_kinds_of_answers()[0])));
    return texts;
  }();
  return all;
}

void collect(Json& json, std::vector<Json*>& all) {
  all.push_back(&json);
  if (!json.is_structured()) return;
  for (Json& one : json) collect(one, all);
}

const std::vector<Json>& strangers() {
  static const std::vector<Json> all = {nullptr,
                                        true,
                                        false,
                                        -1,
                                        0,
                                        1,
                                        2,
                                        3,
                                        0.5,
                                        1.5,
                                        1e300,
                                        -0.0,
                                        "",
                                        "x",
                                        "inf",
                                        "a",
                                        "b",
                                        "0x0",
                                        "0x1p-3",
                                        "1%",
                                        "1mm",
                                        "met",
                                        "limit",
                                        Json::array(),
                                        Json::object(),
                                        uint64_t{1} << 63,
                                        "0.2.0",
                                        "-inf"};
  return all;
}

void change(Json& document, Choices& choices) {
  std::vector<Json*> values;
  collect(document, values);
  Json& at = *values[choices.below(values.size())];
  switch (choices.below(5)) {
    case 0:  // another value of the document
      at = Json(*values[choices.below(values.size())]);
      return;
    case 1:
      if (at.is_object() && !at.empty())
        at.erase(
            std::next(at.begin(), static_cast<std::ptrdiff_t>(choices.below(at.size()))).key());
      return;
    case 2:
      if (at.is_array() && !at.empty()) at.erase(choices.below(at.size()));
      return;
    case 3:
      if (at.is_array() && !at.empty()) at.push_back(Json(at[choices.below(at.size())]));
      return;
    default:
      at = strangers()[choices.below(strangers().size())];
  }
}

std::string text_of(std::string_view input) {
  constexpr char kItself = '{';
  if (input.starts_with(kItself)) return std::string(input);
  Choices choices(input);
  Json document = Json::parse(documents()[choices.below(documents().size())]);
  for (size_t left = 8; left > 0 && choices.are_left(); --left) change(document, choices);
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Whether `read` refuses the text, in one line.
template <class Read>
bool is_refused(const std::string& text, const Read& read) {
  try {
    read(text);
  } catch (const InputError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos, "an error is one line");
    return true;
  }
  return false;
}

void read_answer(const std::string& text) {
  const std::string again = to_json(answer_from_json(text));
  require(!is_refused(again,
                      [&](const std::string& one) {
                        require(to_json(answer_from_json(one)) == again,
                                "an answer is read back byte for byte");
                      }),
          "what was written is read");
}

void read_line(const std::string& text) {
  const Result result = read_result(text);
  const std::string again = to_line(result);
  if (!result.lacking.empty()) return;
  require(!is_refused(again,
                      [&](const std::string& one) {
                        require(to_line(read_result(one)) == again,
                                "a line is read back byte for byte");
                      }),
          "what was written is read");
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text = text_of({reinterpret_cast<const char*>(data), size});
  is_refused(text, read_answer);
  is_refused(text, read_line);
  is_refused(text, [](const std::string& one) { failure_from_json(one); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}
