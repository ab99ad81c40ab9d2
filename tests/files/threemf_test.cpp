// 3MF: the items that the build places are read, each decimal correctly rounded, and no object with
// another shape than its triangles passes for them.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "host/read/readers.h"
#include "tests/files/stored_zip.h"
#include "tests/support/error_line.h"
#include "tests/support/program.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/error.h"

using namespace vkh;
using namespace vkh::test;

namespace {

ReadMesh parse(const std::string& bytes, const ReadLimits& limits = {}) {
  return parse_mesh({.name = "test.3mf", .bytes = bytes, .limits = limits});
}

std::string refusal(const std::string& bytes, const ReadLimits& limits = {}) {
  try {
    parse(bytes, limits);
  } catch (const InputError& error) {
    check_error_line(error.what(), "test.3mf");
    return error.what();
  }
  return "it was read";
}

void check_refused(const std::string& bytes, const std::string& says) {
  const std::string said = refusal(bytes);
  CAPTURE(says);
  CAPTURE(said);
  CHECK(said.find(says) != std::string::npos);
}

ReadMesh all_of(const std::string& bytes) { return parse(bytes, {.bodies = Bodies::kAll}); }

const std::string kIncluded = "bodies: included, though not printed as body: ";

std::string item(const std::string& id, const std::string& transform = "") {
  return "<item objectid=\"" + id + "\"" +
         (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>";
}

std::string component(const std::string& id, const std::string& transform = "") {
  return "<component objectid=\"" + id + "\"" +
         (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>";
}

std::string components(const std::string& inside) {
  return "<components>" + inside + "</components>";
}

const std::string kOne = object_of("1", kTriangleMesh);

}  // namespace

#ifdef VKH_HAS_3MF
TEST_CASE("an object in the build, its decimals as doubles") {
  const ReadMesh mesh = parse(package_of(model_of(kOne, item("1"))));
  CHECK(mesh.vertices == std::vector<glm::dvec3>{{0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(mesh.faces == std::vector<glm::uvec3>{{0, 1, 2}});
  CHECK(mesh.delta == 0);
  CHECK(mesh.unit == "mm");
}

TEST_CASE("A is converted to B's unit where both files say theirs" *
          doctest::test_suite("program")) {
  const std::string inches = package_of(model_of(kOne, item("1"), "unit=\"inch\""));
  const std::string a = write_file("a.3mf", package_of(model_of(kOne, item("1")))),
                    b = write_file("b.3mf", inches);
  const Outcome differ = run({"distance", a, b, "--json"}),
                same = run({"distance", a, a, "--json"});
  CHECK(differ.exit_code == 0);
  const auto json = nlohmann::json::parse(differ.out);
  CHECK(differ.out.find("A was converted from mm to in, in which B is") != std::string::npos);
  CHECK(json["transform"]["factor"] == nlohmann::json({5, 127}));
  CHECK(json["interval"]["unit"] == "in");
  // The far corner is one unit long: an inch, beside a millimetre in inches.
  CHECK(json["directions"][0]["witness"]["to"]["point"] != nullptr);
  CHECK(json["interval"]["upper"].get<double>() < 0.1);
  CHECK(same.out.find("converted") == std::string::npos);
}

TEST_CASE("units are kept") {
  const std::pair<const char*, const char*> units[] = {{"micron", "um"},     {"millimeter", "mm"},
                                                       {"centimeter", "cm"}, {"inch", "in"},
                                                       {"foot", "ft"},       {"meter", "m"}};
  for (const auto& [name, unit] : units) {
    const std::string attributes = std::string("unit=\"") + name + "\"";
    CHECK(parse(package_of(model_of(kOne, item("1"), attributes))).unit == unit);
  }
  CHECK(parse(package_of(model_of(kOne, item("1"), ""))).unit == "mm");
  check_refused(package_of(model_of(kOne, item("1"), "unit=\"league\"")), "the unit 'league'");
}

TEST_CASE("items and components are placed, and the delta bounds how well") {
  const std::string turn = "0 1 0 -1 0 0 0 0 1 10 20 30";  // rows for points that stand before them
  const std::string grow = "0.3 0 0 0 0.3 0 0 0 0.3 0.1 0 0";
  const std::string two = object_of("2", components(component("1", turn) + component("1")));
  const ReadMesh mesh = parse(package_of(model_of(kOne + two, item("2", grow) + item("1"))));
  REQUIRE(mesh.faces.size() == 3);
  CHECK(mesh.vertices[6] == glm::dvec3(0.1, 0, 0));
  CHECK(mesh.delta > 0);
  CHECK(mesh.delta < 1e-13);
  // (0.1, 0, 0) turned is (10, 20.1, 30).
  const Rational x = Rational(0.3) * 10 + Rational(0.1), y = Rational(0.3) * (20 + Rational(0.1)),
                 z = Rational(0.3) * 30;
  const Rational off[] = {x - Rational(mesh.vertices[0].x), y - Rational(mesh.vertices[0].y),
                          z - Rational(mesh.vertices[0].z)};
  CHECK(off[0] * off[0] + off[1] * off[1] + off[2] * off[2] <=
        Rational(mesh.delta) * Rational(mesh.delta));
  const ReadMesh moved = parse(package_of(model_of(kOne, item("1", "1 0 0 0 1 0 0 0 1 0 0 5"))));
  CHECK(moved.vertices[1] == glm::dvec3(1, 0, 5));
}

TEST_CASE("mirrors of items and components turn faces round") {
  const std::string plain = "1 0 0 0 1 0 0 0 1 0 0 0", mirror = "-1 0 0 0 1 0 0 0 1 10 0 0",
                    turn = "0 -1 0 1 0 0 0 0 1 0 0 0", swap = "0 1 0 1 0 0 0 0 1 0 0 0";
  const auto sign_of = [&](const std::string& by) { return by == mirror || by == swap ? -1 : 1; };
  for (const std::string& of_item : {plain, mirror, turn, swap}) {
    for (const std::string& outer : {plain, mirror, turn, swap}) {
      for (const std::string& inner : {plain, mirror, turn, swap}) {
        const std::string objects = kOne + object_of("2", components(component("1", inner))) +
                                    object_of("3", components(component("2", outer)));
        const Mesh mesh = parse(package_of(model_of(objects, item("3", of_item))));
        const bool is_mirrored = sign_of(of_item) * sign_of(outer) * sign_of(inner) < 0;
        CHECK(mesh.faces[0] == (is_mirrored ? UVec3(0, 2, 1) : UVec3(0, 1, 2)));
      }
    }
  }
}

TEST_CASE("objects of other parts, by the production extension") {
  const std::string production =
      "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
      "requiredextensions=\"p\"";
  const std::string other =
      model_of(object_of("1", kTriangleMesh) + object_of("5", components(component("1"))), "");
  const std::string use = "<component p:path=\"/3D/other.model\" objectid=\"5\"/>";
  const std::string root =
      model_of(object_of("5", components(use)),
               item("5") + "<item p:path=\"/3D/other.model\" objectid=\"1\"/>", production);
  CHECK(parse(package_of(root, {{"3D/other.model", other}})).faces.size() == 2);
  check_refused(package_of(root), "part '3D/other.model': it is not in the archive");
  const std::string back = model_of(
      object_of("5", components("<component p:path=\"/3D/3dmodel.model\" objectid=\"5\"/>")), "",
      production);
  check_refused(package_of(root, {{"3D/other.model", back}}), "a path to another part");
}

TEST_CASE("components are no cycles, and doubling them without faces takes no time") {
  check_refused(package_of(model_of(object_of("1", components(component("1"))), item("1"))),
                "object 1 stands behind its use");
  check_refused(package_of(model_of(object_of("1", components(component("2"))) +
                                        object_of("2", components(component("1"))),
                                    item("1"))),
                "object 2 stands behind its use");
  for (const bool has_face : {false, true}) {
    std::string objects = object_of("1", has_face ? kTriangleMesh : "<mesh/>");
    for (int i = 2; i <= 60; ++i) {
      const std::string before = std::to_string(i - 1);
      objects += object_of(std::to_string(i), components(component(before) + component(before)));
    }
    const std::string said = refusal(package_of(model_of(objects, item("60"))));
    CAPTURE(said);
    CHECK(said.find(has_face ? "faces, each object at each place" : "without a face") !=
          std::string::npos);
  }
  std::string chain = kOne;
  for (int i = 2; i <= 400; ++i)
    chain += object_of(std::to_string(i), components(component(std::to_string(i - 1))));
  check_refused(package_of(model_of(chain, item("400"))), "256 levels deep");
  CHECK(parse(package_of(model_of(chain, item("200")))).faces.size() == 1);
}

TEST_CASE("what has another shape than its triangles is refused by name") {
  const std::string beams =
      "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/"
      "2017/02\"";
  check_refused(package_of(model_of(kOne, item("1"), beams + " requiredextensions=\"b\"")),
                "the extension 'beamlattice/2017/02' is required");
  std::string lattice = kTriangleMesh;
  lattice.insert(lattice.find("</mesh>"), "<b:beamlattice/>");
  check_refused(package_of(model_of(object_of("1", lattice), item("1"), beams)), "'beamlattice'");
  const std::string slices =
      "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\"";
  check_refused(package_of(model_of(object_of("1", kTriangleMesh, "s:slicestackid=\"3\""),
                                    item("1"), slices)),
                "an object with slices");
  check_refused(package_of(model_of(object_of("1", kTriangleMesh, "type=\"odd\""), item("1"))),
                "an object of type 'odd'");
  check_refused(package_of(model_of(kOne + object_of("2", "<x:voxels xmlns:x=\"urn:x\"/>"),
                                    item("2") + item("1"))),
                "object 2 has a shape that is not read, 'voxels'");
  check_refused(package_of(model_of(kOne + object_of("2", "<x:voxels xmlns:x=\"urn:x\"/>") +
                                        object_of("3", components(component("2") + component("1"))),
                                    item("3"))),
                "object 3 has a shape that is not read, 'voxels'");
}

TEST_CASE("what is no body is left out, and counted by name") {
  const std::string two = kOne + object_of("2", kTriangleMesh, "type=\"support\"");
  const ReadMesh support = parse(package_of(model_of(two, item("1") + item("2"))));
  CHECK(support.faces.size() == 1);
  CHECK(lines_of(support.notes) ==
        std::vector<std::string>{"bodies: left out: 1 support object (1 face)"});
  check_refused(package_of(model_of(two, item("2"))),
                "it has no bodies, only 1 support object (1 face)");
  const ReadMesh printed = parse(package_of(model_of(
      kOne,
      item("1") + "<item objectid=\"1\" printable=\"0\" transform=\"1 0 0 0 1 0 0 0 1 9 9 9\"/>")));
  CHECK(printed.faces.size() == 1);
  CHECK(lines_of(printed.notes) ==
        std::vector<std::string>{"bodies: left out: 1 unprinted item (1 face)"});
}

TEST_CASE("surfaces and other objects are no bodies") {
  for (const std::string type : {"surface", "other"}) {
    const std::string two = kOne + object_of("2", kTriangleMesh, "type=\"" + type + "\"");
    const std::string both = package_of(model_of(two, item("1") + item("2")));
    const std::string list = "1 " + type + " object (1 face)";
    CHECK(parse(both).faces.size() == 1);
    CHECK(lines_of(parse(both).notes) == std::vector<std::string>{"bodies: left out: " + list});
    CHECK(all_of(both).faces.size() == 2);
    CHECK(lines_of(all_of(both).notes) == std::vector<std::string>{kIncluded + list});
    check_refused(package_of(model_of(two, item("2"))), "it has no bodies, only " + list);
  }
}

TEST_CASE("--bodies all measures what is no body, as it lies, and counts it by name") {
  const std::string two = kOne + object_of("2", kTriangleMesh, "type=\"support\"");
  const std::string away =
      "<item objectid=\"1\" printable=\"0\" transform=\"1 0 0 0 1 0 0 0 1 9 9 9\"/>";
  const ReadMesh mesh = all_of(package_of(model_of(two, item("1") + item("2") + away)));
  REQUIRE(mesh.faces.size() == 3);
  CHECK(mesh.vertices[7] == glm::dvec3(10, 9, 9));
  CHECK(
      lines_of(mesh.notes) ==
      std::vector<std::string>{kIncluded + "1 support object (1 face), 1 unprinted item (1 face)"});
  CHECK(all_of(package_of(model_of(two, item("2")))).faces.size() == 1);
  // Objects inside one that is no body are not counted again.
  const std::string three =
      two + object_of("3", components(component("2") + component("1")), "type=\"solidsupport\"");
  CHECK(lines_of(all_of(package_of(model_of(three, item("3")))).notes) ==
        std::vector<std::string>{kIncluded + "1 support object (2 faces)"});
  // A shape that is not read is refused for any purpose.
  const std::string voxels = object_of("2", "<x:voxels xmlns:x=\"urn:x\"/>", "type=\"support\"");
  const std::string package = package_of(model_of(kOne + voxels, item("1") + item("2")));
  CHECK(parse(package).faces.size() == 1);
  CHECK(refusal(package, {.bodies = Bodies::kAll}).find("has a shape that is not read, 'voxels'") !=
        std::string::npos);
}

TEST_CASE("uses of what is left out take neither time nor room") {
  std::string objects = object_of("1", kTriangleMesh, "type=\"support\"");
  for (int i = 2; i <= 31; ++i) {
    const std::string before = component(std::to_string(i - 1));
    objects += object_of(std::to_string(i), components(before + before));
  }
  const std::string bytes =
      package_of(model_of(objects + object_of("99", kTriangleMesh), item("99") + item("31")));
  const ReadMesh mesh = parse(bytes, {.max_input_bytes = bytes.size()});
  CHECK(mesh.faces.size() == 1);
  CHECK(
      lines_of(mesh.notes) ==
      std::vector<std::string>{"bodies: left out: 1073741824 support objects (1073741824 faces)"});
}

TEST_CASE("Cura's meshes for infill and supports are no bodies") {
  const auto with = [](const std::string& key, const std::string& value) {
    const std::string settings = "<metadatagroup><metadata name=\"cura:" + key +
                                 "\" type=\"xs:string\">" + value + "</metadata></metadatagroup>";
    return parse(package_of(
        model_of(kOne + object_of("2", settings + kTriangleMesh), item("1") + item("2"))));
  };
  CHECK(lines_of(with("infill_mesh", "True").notes) ==
        std::vector<std::string>{"bodies: left out: 1 modifier (1 face)"});
  CHECK(with("cutting_mesh", "True").faces.size() == 1);
  CHECK(with("support_mesh", "True").faces.size() == 1);
  CHECK(lines_of(with("anti_overhang_mesh", "True").notes) ==
        std::vector<std::string>{"bodies: left out: 1 support blocker (1 face)"});
  CHECK(with("infill_mesh", "False").faces.size() == 2);
  CHECK(with("layer_height", "1").faces.size() == 2);
}

/// PrusaSlicer's: one mesh of two volumes, a face each, the second of some type.
std::string with_volume(const std::string& metadata, const std::string& ids = "\"1\" lastid=\"1\"",
                        const std::string& program = "Slic3r_PE") {
  std::string mesh = kTriangleMesh;
  mesh.insert(mesh.find("</triangles>"), "<triangle v1=\"2\" v2=\"1\" v3=\"0\"/>");
  return package_of(
      model_of(object_of("1", mesh), item("1")),
      {{"Metadata/" + program + "_model.config",
        "<config><object id=\"1\"><metadata type=\"object\" key=\"modifier\" "
        "value=\"1\"/><volume firstid=\"0\" lastid=\"0\"><metadata key=\"volume_type\" "
        "value=\"ModelPart\"/></volume><volume firstid=" +
            ids + ">" + metadata + "</volume></object></config>"}});
}

TEST_CASE("an item is printed unless printable is 0 or false") {
  for (const auto& [value, count] :
       std::vector<std::pair<std::string, size_t>>{{"0", 1}, {"false", 1}, {"1", 2}, {"true", 2}}) {
    const std::string second = "<item objectid=\"1\" printable=\"" + value + "\"/>";
    CHECK(parse(package_of(model_of(kOne, item("1") + second))).faces.size() == count);
  }
}

TEST_CASE("PrusaSlicer's modifiers are no bodies, and a negative volume is refused") {
  const auto type = [](const std::string& name) {
    return with_volume("<metadata key=\"volume_type\" value=\"" + name + "\"/>");
  };
  CHECK(parse(type("ModelPart")).faces.size() == 2);
  for (const auto& [name, says] :
       std::vector<std::pair<std::string, std::string>>{{"ParameterModifier", "modifier"},
                                                        {"SupportBlocker", "support blocker"},
                                                        {"SupportEnforcer", "support enforcer"}}) {
    const ReadMesh mesh = parse(type(name));
    CHECK(mesh.faces == std::vector<glm::uvec3>{{0, 1, 2}});
    CHECK(lines_of(mesh.notes) ==
          std::vector<std::string>{"bodies: left out: 1 " + says + " (1 face)"});
    CHECK(all_of(type(name)).faces == std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 0}});
    CHECK(lines_of(all_of(type(name)).notes) ==
          std::vector<std::string>{kIncluded + "1 " + says + " (1 face)"});
  }
  CHECK(parse(with_volume("<metadata key=\"modifier\" value=\"1\"/>")).faces.size() == 1);
  check_refused(type("NegativeVolume"), "object 1 has a negative volume");
  check_refused(type("NegativeVolume"), "or --bodies all, which measures everything as it lies");
  CHECK(lines_of(all_of(type("NegativeVolume")).notes) ==
        std::vector<std::string>{kIncluded + "1 negative volume (1 face)"});
  check_refused(type("Novelty"), "a volume of type 'Novelty'");
  check_refused(with_volume("", "\"0\" lastid=\"1\""), "volumes of object 1 overlap at face 0");
  check_refused(with_volume("", "\"x\" lastid=\"1\""), "firstid is 'x'");
  check_refused(with_volume("", "\"2\" lastid=\"1\""), "a volume of faces 2 to 1");
}

TEST_CASE("relatives of PrusaSlicer keep volumes in files of their own, or in all of them") {
  const std::string modifier = "<metadata key=\"volume_type\" value=\"1\"/>";
  for (const char* program : {"SuperSlicer", "Slic3r"})
    CHECK(parse(with_volume(modifier, "\"1\" lastid=\"1\"", program)).faces.size() == 1);
  std::string mesh = kTriangleMesh;
  mesh.insert(mesh.find("</triangles>"), "<triangle v1=\"2\" v2=\"1\" v3=\"0\"/>");
  const std::string config = "<config><object id=\"1\"><volume firstid=\"1\" lastid=\"1\">" +
                             modifier + "</volume></object></config>";
  Parts configs;
  for (const char* program : {"Slic3r", "Slic3r_PE", "SuperSlicer"})
    configs.emplace_back("Metadata/" + std::string(program) + "_model.config", config);
  CHECK(lines_of(parse(package_of(model_of(object_of("1", mesh), item("1")), configs)).notes) ==
        std::vector<std::string>{"bodies: left out: 1 modifier (1 face)"});
}

TEST_CASE("Bambu Studio's parts have their kinds beside the model") {
  const auto with = [](const std::string& subtype) {
    const std::string both =
        object_of("3", components(component("1") + component("2", "1 0 0 0 1 0 0 0 1 9 9 9")));
    return package_of(model_of(kOne + object_of("2", kTriangleMesh) + both, item("3")),
                      {{"Metadata/model_settings.config",
                        "<config><object id=\"3\"><part id=\"1\" subtype=\"normal_part\"/><part "
                        "id=\"2\" subtype=\"" +
                            subtype + "\"/></object></config>"}});
  };
  CHECK(parse(with("normal_part")).faces.size() == 2);
  CHECK(lines_of(parse(with("modifier_part")).notes) ==
        std::vector<std::string>{"bodies: left out: 1 modifier (1 face)"});
  CHECK(parse(with("support_blocker")).faces.size() == 1);
  check_refused(with("negative_part"), "object 2 has a negative volume");
  CHECK(all_of(with("negative_part")).vertices.size() == 6);
  CHECK(lines_of(all_of(with("negative_part")).notes) ==
        std::vector<std::string>{kIncluded + "1 negative volume (1 face)"});
  check_refused(with("novel_part"), "a volume of type 'novel_part'");
}

TEST_CASE("names of parts are URIs, or as they are written") {
  const std::string model = model_of(kOne, item("1"));
  for (const auto& [target, file] : std::vector<std::pair<std::string, std::string>>{
           {"/3D/my%20model.model", "3D/my model.model"},
           {"./3D/3dmodel.model", "3D/3dmodel.model"},
           {"/3D/x/../m.model", "3D/m.model"},
           {"/3D/100%.model", "3D/100%.model"},
           {"/3D/a%20b.model", "3D/a%20b.model"}}) {
    std::string relations = kRelations;
    relations.replace(relations.find("/3D/3dmodel.model"), 17, target);
    CHECK(parse(stored_zip({{"_rels/.rels", relations}, {file, model}})).faces.size() == 1);
  }
}

TEST_CASE("models that are none are refused in one line") {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string model = model_of(kOne, item("1"));
    const size_t at = model.find(from);
    REQUIRE(at != std::string::npos);
    return package_of(model.replace(at, from.size(), to));
  };
  check_refused(with("x=\"0.1\"", ""), "line 1 of '/3D/3dmodel.model': there is no x");
  check_refused(with("0.1", "0,1"), "x is '0,1'");
  check_refused(with("0.1", "inf"), "x is 'inf'");
  check_refused(with("0.1", "1e999"), "x is '1e999'");
  CHECK(parse(with("0.1", " .5e1\n")).vertices[0].x == 5);
  check_refused(with("v3=\"2\"", "v3=\"3\""), "index 3 of 3 positions in object 1");
  check_refused(with("v3=\"2\"", "v3=\"-1\""), "v3 is '-1'");
  check_refused(with("objectid=\"1\"", "objectid=\"7\""), "object 7 is not there");
  check_refused(with("<item objectid=\"1\"/>", ""), "without a face");
  check_refused(with("<item", "<item transform=\"1 0 0 0 1 0 0 0 1 0 0\""), "twelve numbers");
  check_refused(with("<item", "<item transform=\"1 0 0 0 1 0 0 0 1 0 0 0 0\""), "twelve");
  check_refused(with("</mesh>", "</mesh><mesh/>"), "an object of two shapes");
  check_refused(with("</resources>", kOne + "</resources>"), "two objects 1");
  check_refused(with("<model", "<!DOCTYPE model [<!ENTITY a \"b\">]><model"), "a document type");
  check_refused(with("core/2015/02", "core/2099/01"), "the root is ");
  check_refused(with("</model>", ""), "line 1 of '/3D/3dmodel.model': ");
  check_refused(
      with("<resources>", "<metadata name=\"" + std::string(300'000, 'x') + "\"/><resources>"),
      "a tag of more than 262144 bytes");
  const std::string good = package_of(model_of(kOne, item("1")));
  check_refused(good.substr(0, good.size() - 30), "a zip archive that cannot be opened");
  check_refused("PK\x03\x04", "a zip archive that cannot be opened");
  std::string damaged = good;
  damaged[damaged.find("0.1")] = '7';
  check_refused(damaged, "it is damaged");
  check_refused(stored_zip({{"a.txt", "text"}}), "part '_rels/.rels': it is not in the archive");
  check_refused(stored_zip({{"_rels/.rels", "<Relationships/>"}}), "names 0 root models");
}

TEST_CASE("what is unpacked is held against the limit, and not kept") {
  std::string model = model_of(kOne, item("1"));
  model.insert(model.find("<resources>"), std::string(3'000'000, ' '));
  const std::string bytes = package_of(model);
  CHECK(parse(bytes).faces.size() == 1);
  CHECK(refusal(bytes, {.max_input_bytes = 2'900'000}).find("beyond the limit") !=
        std::string::npos);
}
#else
TEST_CASE("without libzip and expat a 3MF file is refused by their names") {
  check_refused(package_of(model_of(kOne, item("1"))), "libzip-dev and libexpat1-dev");
}
#endif
