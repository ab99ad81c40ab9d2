#include "host/read/threemf_model.h"

#include <algorithm>
#include <optional>

#include "host/base/blanks.h"
#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/threemf_xml.h"

namespace vkh::threemf {
namespace {

constexpr std::string_view kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view kProduction =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
constexpr std::string_view kPath =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";
// The mesh of an object with slices may be a mere box around them (the consortium's samples).
constexpr std::string_view kSlices =
    "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07|slicestackid";
constexpr std::string_view kModelRelation =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
// Namespaces that a file may require: the core, production (objects in other parts), materials
// (colours of faces) and triangle sets (names of faces).
constexpr std::array<std::string_view, 4> kKnown = {
    kCore, kProduction, "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"};

// A namespace without the common beginning of all 3MF namespaces.
std::string_view short_name(std::string_view uri) {
  constexpr std::string_view kCommon = "3dmanufacturing/";
  const size_t at = uri.find(kCommon);
  return at == std::string_view::npos ? uri : uri.substr(at + kCommon.size());
}

/// Finds the root model part.
class Relations : public XmlReader {
 public:
  std::vector<std::string> targets;
  void open(std::string_view name, const Attributes& attributes) override {
    const char* type = attributes.find("Type");
    const char* to = attributes.find("Target");
    if (!name.ends_with("|Relationship") || type == nullptr || to == nullptr) return;
    if (type == kModelRelation) targets.emplace_back(to);
  }
  void close(std::string_view /*name*/) override {}
};

/// Reads one model part.
class Part : public XmlReader {
 public:
  Part(const MeshSource& source, Model& model, uint32_t number)
      : source_(source), model_(model), part_(number) {}

  void open(std::string_view name, const Attributes& attributes) override;
  void close(std::string_view name) override;
  void text(std::string_view piece) override {
    if (skipped_ > 0 || depth_ == 0 || way_[depth_ - 1] != In::kMetadata) return;
    constexpr size_t kLongest = 16;
    value_ += piece.substr(0, kLongest - std::min(kLongest, value_.size()));
  }
  void declare(std::string_view prefix, std::string_view uri) override {
    if (depth_ == 0) namespaces_.emplace_back(prefix, uri);
  }

 private:
  /// The place where the element that is open stands.
  enum class In {
    kNothing,
    kModel,
    kResources,
    kObject,
    kMesh,
    kVertices,
    kTriangles,
    kComponents,
    kGroup,
    kMetadata,
    kBuild
  };
  struct Step {
    In from;
    std::string_view name;
    In to;
  };
  static constexpr Step kSteps[] = {
      {In::kNothing, "model", In::kModel},        {In::kModel, "resources", In::kResources},
      {In::kModel, "build", In::kBuild},          {In::kResources, "object", In::kObject},
      {In::kObject, "mesh", In::kMesh},           {In::kMesh, "vertices", In::kVertices},
      {In::kMesh, "triangles", In::kTriangles},   {In::kObject, "components", In::kComponents},
      {In::kObject, "metadatagroup", In::kGroup}, {In::kGroup, "metadata", In::kMetadata}};

  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    reject(source_.name, place_in(model_.parts[part_], line), what, expected);
  }
  const char* required(const Attributes& attributes, const char* name) const {
    const char* value = attributes.find(name);
    if (value == nullptr) fail("there is no " + std::string(name), "what 3MF requires");
    return value;
  }
  template <class T>
  T number(const Attributes& attributes, const char* name) const {
    const std::string_view text = trimmed(required(attributes, name));
    T value{};
    if (!parse_number(text, value))
      fail(std::string(name) + " is " + vkh::quoted(text), "a number");
    return value;
  }
  void open_model(const Attributes& attributes);
  void open_object(const Attributes& attributes);
  void close_object();
  void close_metadata();
  void add_row(std::string_view name, const Attributes& attributes);
  void add_triangle(const Attributes& attributes);
  void refuse_foreign(std::string_view name) const;
  Use use(const Attributes& attributes);
  uint32_t part_of(const char* path);
  Object& object() { return model_.objects.back(); }

  const MeshSource& source_;
  Model& model_;
  uint32_t part_;
  std::vector<std::pair<std::string, std::string>> namespaces_;  // namespaces of the root element
  std::array<In, 8> way_{};
  size_t depth_ = 0, skipped_ = 0;
  std::string key_, value_;  // for the metadata that is open
};

// Refuses shapes that are no triangles, in any namespace, and in a place that matters.
void Part::refuse_foreign(std::string_view name) const {
  for (const std::string_view shape : {"beamlattice", "displacementmesh", "levelset", "booleans"}) {
    if (name.ends_with(std::string("|") + std::string(shape)))
      fail(vkh::quoted(shape) + ", which is not read", "objects of triangles alone");
  }
}

void Part::open(std::string_view name, const Attributes& attributes) {
  if (skipped_ > 0) {
    ++skipped_;
    return;
  }
  const In from = depth_ == 0 ? In::kNothing : way_[depth_ - 1];
  const bool is_core = name.starts_with(kCore) && name.substr(kCore.size()).starts_with('|');
  const std::string_view local = is_core ? name.substr(kCore.size() + 1) : "";
  if (depth_ == 0 && local != "model")
    fail("the root is " + vkh::quoted(short_name(name)), "'core/2015/02|model', which 3MF has");
  const auto* const step = std::find_if(std::begin(kSteps), std::end(kSteps), [&](const Step& s) {
    return s.from == from && s.name == local;
  });
  if (step == std::end(kSteps)) {
    skipped_ = 1;
    if (!is_core && from == In::kObject) object().foreign = name.substr(name.rfind('|') + 1);
    is_core ? add_row(local, attributes) : refuse_foreign(name);
    return;
  }
  way_[depth_++] = step->to;
  if (step->to == In::kModel) open_model(attributes);
  if (step->to == In::kObject) open_object(attributes);
  if (step->to == In::kMetadata) {
    key_ = required(attributes, "name");
    value_.clear();
  }
  if (step->to == In::kMesh || step->to == In::kComponents) {
    if (object().has_shape) fail("an object of two shapes", "a mesh, or components");
    object().has_shape = true;
  }
}

void Part::close(std::string_view /*name*/) {
  if (skipped_ > 0) {
    --skipped_;
    return;
  }
  const In closed = way_[--depth_];
  if (closed == In::kObject) close_object();
  if (closed == In::kMetadata) close_metadata();
}

// Handles Cura's settings of an object: "cura:infill_mesh" is True.
void Part::close_metadata() {
  const std::string_view key = std::string_view(key_).substr(key_.rfind(':') + 1);
  const std::string_view value = trimmed(value_);
  if (value != "True" && value != "true" && value != "1") return;
  if (key == "infill_mesh" || key == "cutting_mesh") object().role = Role::kModifier;
  if (key == "support_mesh") object().role = Role::kEnforcer;
  if (key == "anti_overhang_mesh") object().role = Role::kBlocker;
}

void Part::open_model(const Attributes& attributes) {
  constexpr std::array<std::array<std::string_view, 2>, 6> kUnits = {{{"micron", "um"},
                                                                      {"millimeter", "mm"},
                                                                      {"centimeter", "cm"},
                                                                      {"inch", "in"},
                                                                      {"foot", "ft"},
                                                                      {"meter", "m"}}};
  const char* given = attributes.find("unit");
  const std::string_view unit = given == nullptr ? "millimeter" : trimmed(given);
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& pair) { return pair[0] == unit; });
  if (found == kUnits.end()) fail("the unit " + vkh::quoted(unit), "micron to meter, inch or foot");
  if (part_ == 0) model_.unit = (*found)[1];
  if (part_ != 0 && model_.unit != (*found)[1])
    fail("the unit " + vkh::quoted(unit) + " in a part", "that of the root");
  const char* needed = attributes.find("requiredextensions");
  std::string_view rest = needed == nullptr ? "" : needed;
  while (!(rest = trimmed(rest)).empty()) {
    const std::string_view prefix = rest.substr(0, rest.find_first_of(" \t\r\n"));
    rest.remove_prefix(prefix.size());
    const auto uri = std::find_if(namespaces_.begin(), namespaces_.end(),
                                  [&](const auto& pair) { return pair.first == prefix; });
    const bool is_known = uri != namespaces_.end() &&
                          std::find(kKnown.begin(), kKnown.end(), uri->second) != kKnown.end();
    if (is_known) continue;
    const std::string name = uri == namespaces_.end() ? std::string(prefix) : uri->second;
    fail("the extension " + vkh::quoted(short_name(name)) + " is required, which is not read",
         "a file that does without");
  }
}

void Part::open_object(const Attributes& attributes) {
  const auto id = number<uint32_t>(attributes, "id");
  if (attributes.find(kSlices) != nullptr)
    fail("an object with slices, which are not read", "objects of triangles alone");
  const char* type = attributes.find("type");
  const std::string_view kind = type == nullptr ? "model" : type;
  constexpr std::pair<std::string_view, Role> kKinds[] = {{"model", Role::kBody},
                                                          {"solidsupport", Role::kSupport},
                                                          {"support", Role::kSupport},
                                                          {"surface", Role::kSurface},
                                                          {"other", Role::kOther}};
  const auto* const found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                         [&](const auto& pair) { return pair.first == kind; });
  if (found == std::end(kKinds))
    fail("an object of type " + vkh::quoted(kind),
         "model, solidsupport, support, surface or other");
  model_.objects.push_back({.part = part_,
                            .id = id,
                            .vertices = {model_.vertices.size(), model_.vertices.size()},
                            .faces = {model_.faces.size(), model_.faces.size()},
                            .components = {model_.components.size(), model_.components.size()},
                            .role = found->second,
                            .foreign = {}});
}

void Part::close_object() {
  Object& o = object();
  o.vertices.end = model_.vertices.size();
  o.faces.end = model_.faces.size();
  o.components.end = model_.components.size();
  const size_t count = o.vertices.end - o.vertices.begin;
  for (size_t f = o.faces.begin; f < o.faces.end; ++f) {
    const glm::uvec3& face = model_.faces[f];
    const uint32_t greatest = std::max({face.x, face.y, face.z});
    if (greatest < count) continue;
    fail("index " + std::to_string(greatest) + " of " + counted(count, "position") + " in object " +
             std::to_string(o.id),
         "indices below that count");
  }
}

void Part::add_row(std::string_view name, const Attributes& attributes) {
  switch (way_[depth_ - 1]) {
    case In::kVertices:
      if (name != "vertex") return;
      model_.vertices.emplace_back(number<double>(attributes, "x"), number<double>(attributes, "y"),
                                   number<double>(attributes, "z"));
      return;
    case In::kTriangles:
      if (name == "triangle") add_triangle(attributes);
      return;
    case In::kComponents:
      if (name == "component") model_.components.push_back(use(attributes));
      return;
    case In::kBuild:
      if (name == "item" && part_ == 0) model_.items.push_back(use(attributes));
      return;
    default:
      return;
  }
}

void Part::add_triangle(const Attributes& attributes) {
  const auto i = number<uint32_t>(attributes, "v1"), j = number<uint32_t>(attributes, "v2"),
             k = number<uint32_t>(attributes, "v3");
  model_.faces.emplace_back(i, j, k);
}

uint32_t Part::part_of(const char* path) {
  if (path == nullptr) return part_;
  if (part_ != 0) fail("a path to another part in a part", "paths in the root alone");
  const auto found = std::find(model_.parts.begin(), model_.parts.end(), path);
  if (found == model_.parts.end()) {
    constexpr size_t kMostParts = 4096;
    if (model_.parts.size() == kMostParts) fail("too many parts", "4096 or fewer");
    model_.parts.emplace_back(path);
    return static_cast<uint32_t>(model_.parts.size() - 1);
  }
  return static_cast<uint32_t>(found - model_.parts.begin());
}

Use Part::use(const Attributes& attributes) {
  Use out{.part = part_of(attributes.find(kPath)),
          .id = number<uint32_t>(attributes, "objectid"),
          .transform = kNone,
          .line = line};
  const char* printable = attributes.find("printable");
  const std::string_view printed = printable == nullptr ? "1" : trimmed(printable);
  out.is_printed = printed != "0" && printed != "false";
  const char* text = attributes.find("transform");
  if (text == nullptr) return out;
  std::array<double, 12> numbers{};
  std::string_view rest = trimmed(text);
  for (double& x : numbers) {
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
    if (!parse_number(word, x)) fail("the transform's " + vkh::quoted(word), "twelve numbers");
    rest = trimmed(rest.substr(word.size()));
  }
  if (!rest.empty()) fail("a transform of more than twelve numbers", "twelve numbers");
  out.transform = static_cast<uint32_t>(model_.transforms.size());
  model_.transforms.push_back(numbers);
  return out;
}

// Sorts the objects so that each stands behind the objects that it refers to, and the root's
// objects last.
void order(const MeshSource& source, Model& model) {
  const auto key = [&](uint32_t i) {
    return std::pair(model.objects[i].part, model.objects[i].id);
  };
  model.by_id.resize(model.objects.size());
  for (uint32_t i = 0; i < model.by_id.size(); ++i) model.by_id[i] = i;
  std::sort(model.by_id.begin(), model.by_id.end(),
            [&](uint32_t i, uint32_t j) { return key(i) < key(j); });
  for (size_t i = 1; i < model.by_id.size(); ++i) {
    if (key(model.by_id[i - 1]) != key(model.by_id[i])) continue;
    reject(source.name, "byte 0", "two objects " + std::to_string(key(model.by_id[i]).second),
           "one of each id");
  }
}

}  // namespace

uint32_t Model::find(const MeshSource& source, const Use& use, uint32_t user) const {
  const auto wanted = std::pair(use.part, use.id);
  const auto found =
      std::lower_bound(by_id.begin(), by_id.end(), wanted, [&](uint32_t i, const auto& other) {
        return std::pair(objects[i].part, objects[i].id) < other;
      });
  const bool is_there =
      found != by_id.end() && std::pair(objects[*found].part, objects[*found].id) == wanted;
  // Only the root uses other parts, and none uses the root.
  const bool is_before = user == kNone || objects[user].part != use.part;
  if (is_there && (is_before || *found < user)) return *found;
  reject(
      source.name, "line " + std::to_string(use.line),
      "object " + std::to_string(use.id) + (is_there ? " stands behind its use" : " is not there"),
      "an object that stands before");
}

Model read_model(const MeshSource& source, Package& package) {
  Relations relations;
  read_xml(source, package, "_rels/.rels", relations);
  if (relations.targets.size() != 1) {
    reject(source.name, "byte 0",
           "the archive names " + counted(relations.targets.size(), "root model"), "one");
  }
  Model model;
  model.parts = std::move(relations.targets);
  for (uint32_t part = 0; part < model.parts.size(); ++part) {
    Part reader(source, model, part);
    read_xml(source, package, model.parts[part], reader);
  }
  order(source, model);
  return model;
}

// The map of a use. Rows of the file's matrix are columns of ours: its points stand before the
// matrix.
scene::Affine map_of(const Model& model, const Use& use) {
  if (use.transform == kNone) return {};
  scene::Affine::Rows rows{};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) rows[r][c] = model.transforms[use.transform][3 * c + r];
  }
  return scene::affine_of(rows);
}

}  // namespace vkh::threemf
