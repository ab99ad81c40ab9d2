// Answers of parts as one: the accepted ones, and their result, to the last bit.
#include "host/answer/merge_parts.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "vkhausdorff/error.h"

namespace {

using namespace vkh;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Answer answer_of(uint64_t index, uint64_t count, double lower, double upper) {
  Answer answer;
  answer.command = "distance";
  answer.words = {"distance", "a.ply", "b.ply", "--part", std::to_string(index) + "/3", "--json"};
  answer.started = "2026-01-0" + std::to_string(9 - index) + "T00:00:00Z";
  answer.host = "host" + std::to_string(index);
  for (size_t i = 0; i < 2; ++i) {
    answer.inputs[i].path = i == 0 ? "a.ply" : "b.ply";
    answer.inputs[i].is_read = true;
    answer.inputs[i].sha256 = std::string(64, i == 0 ? 'a' : 'b');
  }
  answer.unit = "mm";
  answer.tolerance = {.requested = "0.01mm", .number = 0.01, .of = Length::Of::kUnit, .unit = "mm"};
  answer.part = PartOf{index, count};
  Report& r = answer.a_to_b;
  r.lower = lower;
  r.upper = upper;
  r.diagonal_a = 10;
  r.tolerance = 0x1p-6;
  r.has_witness = lower > 0;
  r.witness_a.face = 100 * index;
  r.candidates = 10;
  r.workspace_bytes = 7;
  r.culled = {{"exact", 3}, {"u1", 4}};
  r.device.name = "device " + std::to_string(index);
  answer.notes = {note_of(NoteCode::kDevices, "a note of all")};
  return answer;
}

WrittenAnswer written(const Answer& answer) {
  return {"parts.jsonl", "line " + std::to_string(answer.part ? answer.part->index + 1 : 9),
          Json::parse(to_json(answer))};
}

/// Closed together: [1, 1 + 2^-6], neither end of one part.
std::vector<WrittenAnswer> three() {
  return {written(answer_of(2, 3, 0.25, 1 + 0x1p-6)), written(answer_of(0, 3, 1, 1 + 0x1p-7)),
          written(answer_of(1, 3, 0.5, 0.5))};
}

std::string merged_text(const std::vector<WrittenAnswer>& parts) {
  return to_json(merge_parts(parts));
}

Json merged(const std::vector<WrittenAnswer>& parts) { return Json::parse(merged_text(parts)); }

void check_refused(const std::vector<WrittenAnswer>& parts, const std::string& why) {
  CAPTURE(why);
  try {
    merge_parts(parts);
    CHECK(false);
  } catch (const InputError& error) {
    const std::string text = error.what();
    CAPTURE(text);
    CHECK(text.starts_with("parts.jsonl: line "));
    CHECK(text.find(why) != std::string::npos);
    CHECK(text.find("; expected ") != std::string::npos);
    CHECK(text.find('\n') == std::string::npos);
  }
}

}  // namespace

TEST_CASE("the largest lower with its witness, the largest upper, bit by bit") {
  const Json all = merged(three());
  CHECK(all["interval"]["lower_hex"] == "0x1p+0");
  CHECK(all["interval"]["upper_hex"] == "0x1.04p+0");
  CHECK(all["status"] == "closed");
  CHECK(all["directions"][0]["status"] == "closed");
  CHECK(all["directions"][0]["witness"]["from"]["face"] == 0);
  CHECK(all["directions"][0]["counts"]["candidates"] == 30);
  CHECK(all["directions"][0]["counts"]["workspace_bytes"] == 7);
  CHECK(all["directions"][0]["culled"] == Json({{"exact", 9}, {"u1", 12}}));
  CHECK(all["parts"] == 3);
  CHECK(!all.contains("part"));
  CHECK(all["words"] ==
        "every point of A is within 1.0157 mm of B, and one point is at least 1 mm away (10.2 % "
        "of A's diagonal)");
  CHECK(all["device"]["name"] == "device 0");
  CHECK(all["more_devices"].size() == 2);
  REQUIRE(all["notes"].size() == 1);
  CHECK(all["notes"][0]["text"] == "a note of all");
  CHECK(all["arguments"] == Json({"distance", "a.ply", "b.ply", "--json"}));
  CHECK(all["started"] == "2026-01-07T00:00:00Z");
  CHECK(merged_text({written(answer_of(0, 1, 1, 1))}).find("\"parts\":1") != std::string::npos);
}

TEST_CASE("the order of the answers does not matter") {
  std::vector<WrittenAnswer> parts = three();
  const std::string one = merged_text(parts);
  std::swap(parts[0], parts[2]);
  CHECK(merged_text(parts) == one);
}

TEST_CASE("closed is decided by the exact width, whatever became of the parts") {
  std::vector<WrittenAnswer> parts = three();
  Answer wide = answer_of(2, 3, 0.25, std::nextafter(1 + 0x1p-6, 2.0));
  wide.a_to_b.status = Status::kPruned;
  wide.a_to_b.known_lower = 1 + 0x1p-20;
  parts[0] = written(wide);
  CHECK(merged(parts)["status"] == "pruned");  // by a value that no part here has shown
  wide.a_to_b.upper = 1 + 0x1p-6;
  parts[0] = written(wide);
  CHECK(merged(parts)["status"] == "closed");
  wide.a_to_b.upper = kInfinity;
  wide.a_to_b.status = Status::kTime;
  parts[0] = written(wide);
  const Json open = merged(parts);
  CHECK(open["status"] == "time");
  CHECK(open["interval"]["upper"].is_null());
  CHECK(open["interval"]["upper_hex"] == "inf");
  CHECK(open["words"].get<std::string>().starts_with("no bound was found yet"));
}

TEST_CASE("what was verified of all parts is verified of A") {
  std::vector<WrittenAnswer> parts;
  for (uint64_t i = 0; i < 2; ++i) {
    Answer answer = answer_of(i, 2, 1.0 + static_cast<double>(i), 2.01);
    answer.a_to_b.witness_check = WitnessCheck{1.5, 2, true};
    answer.a_to_b.coverage_check = CoverageCheck{.whole = 5, .closed = 1, .holds = i == 0};
    parts.push_back(written(answer));
  }
  const Json verified = merged(parts)["directions"][0]["verified"];
  CHECK(verified["witness"] == true);
  CHECK(verified["distance_lower_hex"] == "0x1.8p+0");
  CHECK(verified["coverage"] == false);
  CHECK(verified["faces"]["whole"] == 10);
  parts[0] = written(answer_of(0, 2, 1, 2.01));
  CHECK(!merged(parts)["directions"][0].contains("verified"));
}

TEST_CASE("all parts, each once, of one question") {
  std::vector<WrittenAnswer> parts = three();
  parts.pop_back();
  check_refused(parts, "without part 1");
  parts.push_back(parts[0]);
  check_refused(parts, "part 2 once more");
  check_refused({written(answer_of(1, 1000000000, 1, 1))}, "without part 0, 2, 3, 4, 5..");
  const auto spoilt = [&](const char* pointer, const Json& value) {
    std::vector<WrittenAnswer> all = three();
    all[2].json[Json::json_pointer(pointer)] = value;
    return all;
  };
  // The first line goes with these.
  const auto another = [&](const std::function<void(Answer&)>& change) {
    std::vector<WrittenAnswer> all = three();
    Answer last = answer_of(1, 3, 0.5, 0.5);
    change(last);
    all[2] = written(last);
    return all;
  };
  check_refused(another([](Answer& a) { a.unit.clear(); }), "another unit");
  check_refused(another([](Answer& a) { a.part->count = 4; }), "another number of parts");
  check_refused(another([](Answer& a) { a.part->index = 7; }), "a part that cannot be");
  check_refused(spoilt("/inputs/0/sha256", std::string(64, 'c')), "another A");
  check_refused(spoilt("/inputs/1/sha256", std::string(64, 'c')), "another B");
  check_refused(spoilt("/inputs/1/sha256", nullptr), "no SHA-256");
  check_refused(spoilt("/inputs/0/faces", 7), "another choice of --bodies");
  check_refused(spoilt("/inputs/1/notes", {"bodies: left out: 1 modifier (12 faces)"}),
                "another choice of --bodies");
  const Json note = {{"code", "bodies"}, {"text", "left out"}, {"value", nullptr},
                     {"unit", nullptr},  {"file", nullptr},    {"face", nullptr}};
  check_refused(spoilt("/inputs/1/notes", Json::array({note})), "another choice of --bodies");
  check_refused(spoilt("/tolerance/absolute", 0.5), "another tolerance");
  check_refused(spoilt("/version", "9.9"), "another version");
  check_refused(spoilt("/part/index", "x"), "expected an answer of 'distance --part'");
  check_refused(spoilt("/part/index", 1.9), "index 1.9 is no whole number");
  check_refused(spoilt("/part/index", 1.0), "index 1.0 is no whole number");
  check_refused(spoilt("/part/index", true), "index true is no whole number");
  check_refused(spoilt("/part/count", 3.5), "count 3.5 is no whole number");
  check_refused(spoilt("/part/count", -3), "count -3 is no whole number");
  check_refused(spoilt("/directions/0/counts/candidates", 9.5),
                "candidates 9.5 is no whole number");
  check_refused(spoilt("/directions/0/culled/u1", -1), "u1 -1 is no whole number");
  check_refused(spoilt("/directions/0/interval/upper_hex", "0x1.zp+0"), "upper_hex");
  check_refused(spoilt("/directions/0/interval/upper_hex", "-0x1p+0"), "upper_hex");
  check_refused(spoilt("/directions/0/interval/upper_hex", "0x1p-9"),
                "is another number than upper");
  check_refused(spoilt("/directions/0/interval/lower", 0.5000001), "is another number than lower");
  check_refused(spoilt("/interval/lower_hex", "0x1p-9"), "is another number than lower");
  check_refused(
      spoilt("/directions/0/interval",
             {{"lower", 0.5}, {"lower_hex", "0x1p-1"}, {"upper", 0.25}, {"upper_hex", "0x1p-2"}}),
      "lower end is above");
  check_refused(spoilt("/directions/0/status", "happy"), "status");
  check_refused(spoilt("/directions/0/witness", nullptr), "without a witness");
  check_refused(spoilt("/directions", Json::array()), "expected an answer");
  check_refused(spoilt("/part", 3), "expected an answer");
  check_refused(spoilt("/schema", "vkhausdorff.answer/1"),
                "the schema 'vkhausdorff.answer/1'; expected vkhausdorff.answer/2");
}

TEST_CASE("parts are of the same files, those beneath A and B, too") {
  const auto parts = [](const std::vector<FileHash>& first, const std::vector<FileHash>& second,
                        size_t input) {
    std::vector<WrittenAnswer> both;
    for (uint64_t i = 0; i < 2; ++i) {
      Answer answer = answer_of(i, 2, 1, 1);
      answer.inputs[input].files = i == 0 ? first : second;
      both.push_back(written(answer));
    }
    return both;
  };
  const FileHash one{"a.bin", std::string(64, '1')}, changed{"a.bin", std::string(64, '2')},
      other{"b.bin", std::string(64, '1')}, unknown{"a.bin", ""};
  for (const size_t input : {size_t{0}, size_t{1}}) {
    const std::string name = input == 0 ? "A" : "B";
    CHECK(merged(parts({one}, {one}, input))["inputs"][input]["files"][0]["path"] == "a.bin");
    check_refused(parts({one}, {changed}, input), "another file beneath " + name);
    check_refused(parts({one}, {other}, input), "another file beneath " + name);
    check_refused(parts({one}, {}, input), "another file beneath " + name);
    check_refused(parts({one}, {one, other}, input), "another file beneath " + name);
    check_refused(parts({unknown}, {unknown}, input), "no SHA-256");
  }
  std::vector<WrittenAnswer> old = parts({}, {}, 0);  // as before 0.2.0
  for (WrittenAnswer& part : old) part.json["inputs"][0].erase("files");
  check_refused(old, "no word on files that were read besides");
}

TEST_CASE("what is no part is none") {
  Answer whole = answer_of(0, 1, 1, 1);
  whole.part.reset();
  CHECK(!is_part(Json::parse(to_json(whole))));
  CHECK(is_part(written(answer_of(0, 1, 1, 1)).json));
  check_refused({written(whole)}, "no answer of a part");
  CHECK(!is_part(Json::array()));
}
