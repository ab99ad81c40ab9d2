// Faces by the file's own numbers, and their limits: --face-max. Runs the real program,
// $VKH_PROGRAM.
#include "host/answer/face_limits.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/answer_line.h"
#include "tests/support/program.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace {

using nlohmann::json;
using namespace vkh::test;

/// A square of two triangles, at a height.
std::string square(const std::string& name, double z) {
  std::ostringstream obj;
  obj << "v 0 0 " << z << "\nv 1 0 " << z << "\nv 1 1 " << z << "\nv 0 1 " << z
      << "\nf 1 2 3\nf 1 3 4\n";
  return write_file(name, obj.str());
}
std::string square_b() { return square("faces_b.obj", 0.25); }

Outcome gate(const std::string& max, const Words& more) {
  return run(Words{"gate", square("faces_a.obj", 0), square_b(), "--max", max} + more);
}

/// Faces 0, 3 and 4 of the file are a quad 0.25 from square_b(), a triangle 1.5 from it, and one at
/// 0.25. The faces between have two corners: triangles 0 and 1, 2 and 3 are left.
std::string mixed() {
  return write_file("mixed.obj",
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1.75\nv 1 0 1.75\nv 1 1 1.75\n"
                    "f 1 2 3 4\nf 1 2\nf 2 3\nf 5 6 7\nf 1 2 3\n");
}

/// The limit of each triangle by a file of limits; 9 where it names none.
std::vector<double> limits_in(const std::string& name, const std::string& bytes,
                              const vkh::Mesh& mesh) {
  std::vector<double> limits;
  for (const vkh::Limit& limit :
       vkh::read_face_limits(write_file(name, bytes), mesh, {9, 9}, "mm", {1, 0}))
    limits.push_back(vkh::typed_length(limit));
  return limits;
}

std::string refusal(const std::string& name, const std::string& bytes, const vkh::Mesh& mesh) {
  try {
    limits_in(name, bytes, mesh);
  } catch (const vkh::InputError& error) {
    return error.what();
  }
  return "read";
}

/// A quad 0.25 from square_b(), and a triangle 1.5 from it, each with its max.
std::string ply_head(const std::string& encoding, const std::string& type) {
  return "ply\nformat " + encoding +
         " 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty uchar kind\nproperty list uchar uchar "
         "vertex_indices\nproperty " +
         type + " max\nend_header\n";
}
std::string ascii_ply(const std::string& quad, const std::string& triangle) {
  return ply_head("ascii", "float") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1.75\n1 0 1.75\n1 1 1.75\n" +
         "7 4 0 1 2 3 " + quad + "\n7 3 4 5 6 " + triangle + "\n";
}
std::string binary_ply(std::endian order, double quad, double triangle) {
  const bool is_big = order == std::endian::big;
  std::string bytes = ply_head(is_big ? "binary_big_endian" : "binary_little_endian", "double");
  const auto add = [&](auto value) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  };
  constexpr std::array<float, 21> kPoints = {0, 0, 0, 1,     0, 0, 1,     1, 0, 0,    1,
                                             0, 0, 0, 1.75f, 1, 0, 1.75f, 1, 1, 1.75f};
  for (const float x : kPoints) add(x);
  bytes += std::string("\7\4\0\1\2\3", 6);
  add(quad);
  bytes += "\7\3\4\5\6";
  add(triangle);
  return bytes;
}

}  // namespace

TEST_CASE("--face-max: each face its own limit") {
  const auto ask = [&](const std::string& rows, const std::string& max, const Words& more = {}) {
    return gate(max, Words{"--face-max", write_file("limits.csv", rows)} + more);
  };
  const Outcome pass = ask("# wide\n0,0.3\n", "0.26abs");
  CHECK(pass.exit_code == 0);
  // Its squares are far apart for their size.
  CHECK(pass.out.starts_with("PASS  if the inputs are right (the boxes"));
  CHECK(pass.out.find("): 2 of 2 faces of A are proven to be within their own limits") <
        pass.out.find('\n'));
  const Outcome fail = ask("1,0.2\n", "0.3abs", {"--json"});
  CHECK(fail.exit_code == 1);
  const json r = answer_in(fail.out);
  CHECK(r["verdict"] == "fail");
  CHECK(r["max"]["faces_a"]["faces"] == 2);
  if (!r["inputs"][0]["sha256"].is_null())
    CHECK(r["max"]["faces_a"]["sha256"] ==
          "a1e3546c2f757b8cffc9b41f001918f8653eb46bd5ba7805d02356f3de430d75");
  CHECK(r["directions"][0]["witness"]["from"]["face"] == 1);
  CHECK(r["words"].get<std::string>().find(" of A, limit of its face 0.2") != std::string::npos);
  CHECK(ask("0,8mm\n1,7mm\n", "1mm", {"--unit", "in"}).exit_code == 0);
  CHECK(ask("1,0.25\n", "0.3abs").exit_code == 3);
  CHECK(ask("1,0.3\n", "0.2abs", {"--symmetric"}).exit_code == 1);
  const Outcome back =
      gate("0.3abs", {"--symmetric", "--face-max-b", write_file("back.csv", "0,0.1\n")});
  CHECK(back.out.starts_with("FAIL  at least 0.2"));
  CHECK(back.out.find(" of B, limit of its face ") != std::string::npos);
  const Outcome refused = ask("2,0.3\n", "0.3abs");
  CHECK(refused.exit_code == 4);
  CHECK(refused.err.find("limits.csv: line ") != std::string::npos);
  const Outcome missing = gate("0.3abs", {"--face-max", "missing.csv"});
  CHECK(missing.exit_code == 4);
  CHECK(missing.err.find("missing.csv: no file to be read; expected") != std::string::npos);
  CHECK(gate("0.3abs", {"--face-max-b", "back.csv"}).exit_code == 2);
}

TEST_CASE("--face-max: a CSV of all ways to write it") {
  vkh::Mesh mesh;
  mesh.faces.resize(4);
  const auto limits = [&](const std::string& text) { return limits_in("ways.csv", text, mesh); };
  size_t ways = 0;
  for (const std::string mark : {"", "\xef\xbb\xbf"})
    for (const std::string heading : {"", "face,max", "Face, Max", "\"face\",\"max\""})
      for (const std::string separator : {",", ";", ", ", " ; ", ";\t"})
        for (const std::string end : {"\n", "\r\n", "\n\n", ",\n", ",,\r\n"})
          for (const std::string comment : {"", "# wide; as drawn, 1\n", "  # \"\n\n"})
            for (const bool is_quoted : {false, true})
              for (const bool has_last_end : {false, true}) {
                const char mark_of = separator.find(';') == std::string::npos ? ',' : ';';
                const auto cut = [&](std::string text) {
                  std::replace(text.begin(), text.end(), ',', mark_of);
                  return text;
                };
                const std::string three = is_quoted ? "\"3\"" : "3";
                std::string text = mark + comment;
                if (!heading.empty()) text += cut(heading + end);
                text += three + separator + (is_quoted ? "\"0.25mm\"" : "0.25mm") + cut(end);
                text += comment + "0" + separator + "1e-1" + (has_last_end ? cut(end) : "");
                ++ways;
                CAPTURE(text);
                CHECK(limits(text) == std::vector<double>{0.1, 9, 9, 0.25});
              }
  CHECK(ways == 2400);
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"face;max\n1;0,25\n", "line 2: '0,25'"},
           {"face,max\n1,0,25\n", "line 2: '0,25'"},
           {"face\tmax\n1\t2\n", "line 1: 'face\\x09max'"},
           {"max,face\n1,2\n", "line 1: 'max'; expected a face"},
           {"# a\nface;limit\n1;2\n", "line 2: 'face'; expected a face"},
           {"face;max\n\"1;2\n", "line 2: a quote does not end"},
           {"face;max\n4;2\n", "line 2: '4'; expected a face from 0 to 3"},
           {"-1,0.3\n", "line 1"},
           {"0\n", "line 1"},
           {"0,\n", "line 1"},
           {"0,0\n", "line 1"},
           {"0,-1\n", "line 1"},
           {"0,0.3,1\n", "line 1"},
           {"0,0.3\n0,0.3\n", "line 2"},
           {"x,0.3\n", "line 1"},
           {"0,0.3km\n", "line 1"},
           {std::string("\xff\xfe"
                        "0\0,\0001\0",
                        8),
            "byte 0: UTF-16 text"}}) {
    CAPTURE(text);
    CHECK(refusal("ways.csv", text, mesh).find("ways.csv: " + words) != std::string::npos);
  }
}

TEST_CASE("faces have the file's own numbers, before polygons are fanned") {
  const Outcome fail = run({"gate", mixed(), square_b(), "--max", "1abs"});
  CHECK(fail.exit_code == 1);
  CHECK(fail.out.starts_with("FAIL  at least 1."));
  CHECK(fail.out.find(") on face 3 of A, limit ") != std::string::npos);
  CHECK(fail.out.find("  witness    A face 3 at (") != std::string::npos);
  const json high = answer_in(run({"distance", square("high.obj", 1.7), mixed(), "--json"}).out);
  CHECK(high["directions"][0]["witness"]["to"]["face"] == 3);
}

TEST_CASE("answers of parts as one keep the file's numbers") {
  Words files;
  for (const std::string part : {"0/2", "1/2"}) {
    const Outcome one = run({"distance", mixed(), square_b(), "--json", "--part", part});
    files.push_back(write_file(part.substr(0, 1) + ".json", one.out));
  }
  const std::string merged = folder() / "merged.json";
  const Outcome outcome = run(Words{"merge"} + files + Words{"--out", merged});
  CHECK(outcome.exit_code == 0);
  const json all = json::parse(read_file(merged));
  CHECK(all["directions"][0]["witness"]["from"]["face"] == 3);
}

TEST_CASE("a limit of a polygon holds for all of it") {
  const auto ask = [](const std::string& rows, const char* max) {
    return run({"gate", mixed(), square_b(), "--max", max, "--face-max",
                write_file("mixed.csv", rows), "--json"});
  };
  const Outcome pass = ask("3,1.6\n", "0.3abs");
  CHECK(pass.exit_code == 0);
  const std::string words = answer_in(pass.out)["words"];
  CHECK(words.starts_with("PASS  "));
  CHECK(words.find("4 of 4 triangles") != std::string::npos);
  for (const int near : {0, 4}) {
    CAPTURE(near);
    const Outcome fail = ask(std::to_string(near) + ",0.2\n", "1.6abs");
    CHECK(fail.exit_code == 1);
    CHECK(answer_in(fail.out)["directions"][0]["witness"]["from"]["face"] == near);
  }
  const vkh::Mesh mesh = vkh::read_mesh(mixed());
  CHECK(limits_in("mixed.csv", "0,0.3\n1,0.001\n3,1.6\n", mesh) ==
        std::vector<double>{0.3, 0.3, 1.6, 9});
  CHECK(refusal("mixed.csv", "5,1\n", mesh).find("expected a face from 0 to 4") !=
        std::string::npos);
}

TEST_CASE("each triangle of a polygon has its limit") {
  // B is beneath only the quad's first triangle.
  const std::string half = write_file("half.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const std::string rows = write_file("quad.csv", "0,0.5\n");
  const Words pair = {"gate", mixed(), half, "--max", "10abs", "--face-max", rows};
  CHECK(run(pair).exit_code == 1);
}

TEST_CASE("--face-max takes the property max of a PLY's faces") {
  const std::string bytes = ascii_ply("0.3", "1.4"), a = write_file("limits.ply", bytes);
  const Outcome fail = run({"gate", a, square_b(), "--max", "9abs", "--face-max", a, "--json"});
  CHECK(fail.exit_code == 1);
  CHECK(answer_in(fail.out)["directions"][0]["witness"]["from"]["face"] == 1);

  const vkh::Mesh mesh = vkh::read_mesh(a);
  const std::vector<double> limits = {0.25, 0.25, 1.5};
  for (const std::string& same :
       {binary_ply(std::endian::little, 0.25, 1.5), binary_ply(std::endian::big, 0.25, 1.5),
        ascii_ply("0.25", "1.5"), "\xef\xbb\xbf" + ascii_ply("0.25", "1.5"),
        ascii_ply("0.25 7", "1.5 7")})
    CHECK(limits_in("limits.ply", same, mesh) == limits);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    CAPTURE(wrong);
    CHECK(refusal("limits.ply", binary_ply(std::endian::big, 0.3, wrong), mesh)
              .find("limits.ply: face 1: max is not positive") != std::string::npos);
  }
  CHECK(refusal("limits.ply", ascii_ply("0.3", "wide"), mesh).find("limits.ply: line ") !=
        std::string::npos);
}

TEST_CASE("a PLY without limits, or of other faces, is refused") {
  const std::string good = ascii_ply("1", "1");
  const std::string none =
      refusal("none.ply", std::string(good).replace(good.find(" max\n"), 5, " min\n"),
              vkh::read_mesh(write_file("good.ply", good)));
  CHECK(none.find("none.ply: line ") != std::string::npos);
  CHECK(none.find("'max'") != std::string::npos);
  CHECK(refusal("good.ply", good, vkh::read_mesh(mixed())).find("those of the mesh, 5") !=
        std::string::npos);
}
