// The JSON of a glTF document, by nlohmann's parser: event by event, so that nothing is kept that
// does not matter for shape. (tinygltf 2.7 ends in SIGSEGV on 200 kB of nested brackets, and takes
// 566 MB for 3 MB of empty nodes.)
#include <array>
#include <bitset>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/read/gltf_json_text.h"
#include "host/read/gltf_members.h"

namespace vkh::gltf {
namespace {

/// The number of a name among names; the last stands for any other.
template <class T, size_t kCount>
T named(const std::array<std::string_view, kCount>& names, std::string_view name) {
  return static_cast<T>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Implements nlohmann's SAX interface, with its names. Throws InputError if the document is at
/// fault.
class Handler {
 public:
  Handler(const MeshSource& source, const GltfJsonText& text) : source_(source), text_(text) {}
  Model model;

  bool null() { return other(); }
  bool boolean(bool value);
  bool number_integer(int64_t value) { return number(static_cast<double>(value), std::nullopt); }
  bool number_unsigned(uint64_t value) { return number(static_cast<double>(value), value); }
  bool number_float(double value, const std::string& text);
  bool string(std::string& value);
  bool binary(nlohmann::json::binary_t& /*value*/) { return other(); }
  bool start_object(size_t /*size*/);
  bool end_object();
  bool start_array(size_t /*size*/);
  bool end_array();
  bool key(std::string& key);
  bool parse_error(size_t /*at*/, const std::string& /*token*/,
                   const nlohmann::json::exception& /*error*/) {
    return false;
  }

  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    reject(source_.name, "byte " + std::to_string(text_.offset()), what, expected);
  }
  void finish() const;

 private:
  /// An object that is open, and the member whose value comes.
  struct Frame {
    Is is = Is::kRoot;
    const Member* member = nullptr;  ///< null: one that does not matter
    bool in_array = false;
    std::bitset<kMemberCount> seen;
  };

  Frame& top() { return frames_[depth_ - 1]; }
  const Frame& top() const { return frames_[depth_ - 1]; }
  bool is_skipped() const {
    if (depth_ == 0) fail("no object", "a glTF document");
    return skipped_ > 0 || top().member == nullptr;
  }
  bool other();
  bool number(double value, std::optional<uint64_t> whole);
  void begin(Is is);
  void end(Is is);
  void end_primitive();
  void end_numbers();
  void take_number(double value, std::optional<uint64_t> whole);
  void take_text(std::string_view value);
  void take_version(std::string_view version, bool is_least) const;
  [[noreturn]] void fail_type() const {
    fail("'" + std::string(top().member->key) + "' of another type", "what glTF 2.0 has there");
  }
  bool has(std::string_view key) const {
    return top().seen[static_cast<size_t>(member_of(top().is, key) - std::begin(kMembers))];
  }
  void require(bool holds, const char* what) const {
    if (!holds) fail(what, "what glTF 2.0 requires");
  }

  const MeshSource& source_;
  const GltfJsonText& text_;
  std::array<Frame, 8> frames_;  // objects that matter lie five deep at most
  size_t depth_ = 0, skipped_ = 0;
  uint32_t count_ = 0;  // numbers in the array that is open
};

bool Handler::key(std::string& key) {
  if (skipped_ > 0) return true;
  Frame& frame = top();
  frame.member = member_of(frame.is, key);
  if (frame.member == nullptr) return true;
  const auto number = static_cast<size_t>(frame.member - std::begin(kMembers));
  if (frame.seen[number]) fail("'" + key + "' a second time", "each member of an object once");
  frame.seen[number] = true;
  return true;
}

bool Handler::other() {
  if (!is_skipped()) fail_type();
  return true;
}

bool Handler::boolean(bool value) {
  if (is_skipped()) return true;
  if (top().member->holds != Holds::kBool) fail_type();
  top().member->take(model, value ? 1 : 0);
  return true;
}

bool Handler::number_float(double value, const std::string& text) {
  parse_number(text, value);  // correctly rounded, which the parser's own function need not be
  const bool is_whole = value >= 0 && value < 0x1p53 && value == std::floor(value);
  return number(value, is_whole ? std::optional(static_cast<uint64_t>(value)) : std::nullopt);
}

bool Handler::number(double value, std::optional<uint64_t> whole) {
  if (is_skipped()) return true;
  const Member& member = *top().member;
  if (member.holds == Holds::kNumbers && top().in_array) {
    take_number(value, whole);
    return true;
  }
  if (member.holds != Holds::kIndex && member.holds != Holds::kSize) fail_type();
  if (!whole || (member.holds == Holds::kIndex && *whole >= kNone)) {
    fail("'" + std::string(member.key) + "' is no number of elements or bytes",
         "a whole number from 0 on");
  }
  member.take(model, *whole);
  return true;
}

bool Handler::string(std::string& value) {
  if (is_skipped()) return true;
  const Holds holds = top().member->holds;
  if (holds == Holds::kStrings && top().in_array) {
    if (is_read(value)) return true;
    fail(vkh::quoted(value) + " is required, which is not read", "a file that does without");
  }
  if (holds != Holds::kString) fail_type();
  take_text(value);
  return true;
}

bool Handler::start_object(size_t /*size*/) {
  if (depth_ > 0) {
    if (is_skipped()) {
      ++skipped_;
      return true;
    }
    const Frame& frame = top();
    if (frame.is == Is::kRoot && frame.member->holds == Holds::kObjects && !frame.in_array)
      fail("'" + std::string(frame.member->key) + "' is an object, as in glTF 1.0", "glTF 2.0");
    if (frame.member->holds != (frame.in_array ? Holds::kObjects : Holds::kObject)) fail_type();
  }
  const Is is = depth_ == 0 ? Is::kRoot : top().member->object;
  frames_[depth_++] = {.is = is, .member = nullptr, .in_array = false, .seen = {}};
  begin(is);
  return true;
}

bool Handler::end_object() {
  if (skipped_ > 0) {
    --skipped_;
    return true;
  }
  end(top().is);
  --depth_;
  return true;
}

bool Handler::start_array(size_t /*size*/) {
  if (is_skipped()) {
    ++skipped_;
    return true;
  }
  if (top().in_array || top().member->holds < Holds::kObjects) fail_type();
  top().in_array = true;
  count_ = 0;
  return true;
}

bool Handler::end_array() {
  if (skipped_ > 0) {
    --skipped_;
    return true;
  }
  if (top().member->holds == Holds::kNumbers) end_numbers();
  top().in_array = false;
  return true;
}

void Handler::begin(Is is) {
  check_going(source_.name, source_.limits);
  Model& m = model;
  switch (is) {
    case Is::kAnimation:
      m.has_animations = true;
      break;
    case Is::kScene:
      m.scenes.push_back(kNone);
      break;
    case Is::kNode:
      m.nodes.push_back(kNone);
      break;
    case Is::kInstancing:
      detail_of_last(m).instances = true;
      break;
    case Is::kMesh:
      m.meshes.push_back({.primitives = {static_cast<uint32_t>(m.primitives.size()), 0}});
      break;
    case Is::kPrimitive:
      m.primitives.emplace_back();
      ++m.meshes.back().primitives.count;
      break;
    case Is::kTarget:
      m.primitives.back().has_targets = true;
      break;
    case Is::kDraco:
      m.primitives.back().is_draco = true;
      break;
    case Is::kAccessor:
      m.accessors.emplace_back();
      break;
    case Is::kSparse:
      m.accessors.back().sparse = static_cast<uint32_t>(m.sparses.size());
      m.sparses.emplace_back();
      break;
    case Is::kView:
      m.views.emplace_back();
      break;
    case Is::kMeshopt:
      m.views.back().packed = static_cast<uint32_t>(m.packed.size());
      m.packed.emplace_back();
      break;
    case Is::kBuffer:
      m.buffers.emplace_back();
      break;
    default:
      break;
  }
}

// Checks the members that have to be there, so that an entry is never larger than its text by more
// than a factor.
void Handler::end(Is is) {
  switch (is) {
    case Is::kMesh:
      return require(has("primitives") && model.meshes.back().primitives.count +
                                                  model.meshes.back().line_count +
                                                  model.meshes.back().placeless_count >
                                              0,
                     "a mesh without primitives");
    case Is::kPrimitive:
      return end_primitive();
    case Is::kAsset:
      return require(has("version"), "an asset without version");
    case Is::kAccessor:
      return require(model.accessors.back().count > 0 && model.accessors.back().component != 0 &&
                         model.accessors.back().width != 0,
                     "an accessor without count, componentType or type");
    case Is::kSparse:
      return require(model.sparses.back().count > 0 && model.sparses.back().indices.view != kNone &&
                         model.sparses.back().values.view != kNone,
                     "a sparse accessor without count, indices or values");
    case Is::kView:
      return require(model.views.back().buffer != kNone && model.views.back().length > 0,
                     "a buffer view without buffer or byteLength");
    case Is::kMeshopt:
      return require(model.packed.back().buffer != kNone && model.packed.back().count > 0 &&
                         model.packed.back().stride > 0,
                     "meshopt compression without buffer, count or byteStride");
    case Is::kBuffer:
      return require(model.buffers.back().length > 0, "a buffer without byteLength");
    default:
      return;
  }
}

void Handler::end_primitive() {
  require(has("attributes"), "a primitive without attributes");
  const Primitive& primitive = model.primitives.back();
  MeshEntry& mesh = model.meshes.back();
  const bool is_placeless = primitive.position == kNone && !primitive.is_draco;
  if (primitive.mode >= 4 && !is_placeless) return;
  ++(primitive.mode < 4 ? mesh.line_count : mesh.placeless_count);
  model.primitives.pop_back();
  --mesh.primitives.count;
}

void Handler::take_number(double value, std::optional<uint64_t> whole) {
  Model& m = model;
  switch (top().member->numbers) {
    case Numbers::kRoots:
    case Numbers::kChildren:
      if (!whole || *whole >= kNone) fail("a node's number is none", "a whole number from 0 on");
      m.indices.push_back(narrow(*whole));
      break;
    case Numbers::kNodeWeights:
      detail_of_last(m).has_weights = true;
      detail_of_last(m).has_morph_weight |= value != 0;
      break;
    case Numbers::kMeshWeights:
      m.meshes.back().has_morph_weight |= value != 0;
      break;
    default:
      m.numbers.push_back(value);
  }
  ++count_;
}

void Handler::end_numbers() {
  Model& m = model;
  const auto part = [&](uint32_t NodePlacing::*where, uint32_t expected) {
    if (count_ != expected) {
      fail("'" + std::string(top().member->key) + "' of " + counted(count_, "number"),
           std::to_string(expected) + " numbers");
    }
    placing_of_last(m).*where = static_cast<uint32_t>(m.numbers.size()) - expected;
  };
  const Range indices = {static_cast<uint32_t>(m.indices.size()) - count_, count_};
  switch (top().member->numbers) {
    case Numbers::kRoots:
      m.scenes.back() = static_cast<uint32_t>(m.roots.size());
      m.roots.push_back(indices);
      break;
    case Numbers::kChildren:
      if (count_ > 0) detail_of_last(m).children = indices;
      break;
    case Numbers::kTranslation:
      return part(&NodePlacing::translation, 3);
    case Numbers::kRotation:
      return part(&NodePlacing::rotation, 4);
    case Numbers::kScale:
      return part(&NodePlacing::scale, 3);
    case Numbers::kMatrix:
      return part(&NodePlacing::matrix, 16);
    default:
      break;
  }
}

void Handler::take_text(std::string_view value) {
  const Member& member = *top().member;
  switch (member.of) {
    case Is::kAsset:
      return take_version(value, member.key == "minVersion");
    case Is::kAccessor:
      model.accessors.back().width = value == "SCALAR" ? 1 : value == "VEC3" ? 3 : 255;
      return;
    case Is::kBuffer:
      model.buffers.back().uri = text_.last_string();
      return;
    default:
      break;
  }
  Packed& packed = model.packed.back();
  if (member.key == "mode") {
    packed.packing = named<Packing, 3>({"ATTRIBUTES", "TRIANGLES", "INDICES"}, value);
  } else {
    packed.filter = named<Filter, 4>({"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}, value);
  }
}

void Handler::take_version(std::string_view version, bool is_least) const {
  if (is_least ? version == "2.0" : version.starts_with("2.")) return;
  fail((is_least ? "asset.minVersion " : "asset.version ") + vkh::quoted(version), "glTF 2.0");
}

void Handler::finish() const {
  if (!frames_[0].seen[0]) fail("the document has no asset", "a glTF 2.0 document");
}

}  // namespace

Model read_model(const MeshSource& source, std::string_view json) {
  GltfJsonText text(json);
  Handler handler(source, text);
  const bool is_whole = nlohmann::json::sax_parse(JsonIterator(text), JsonIterator(), &handler);
  if (text.is_too_long()) handler.fail("a number of too many digits", "numbers of at most 2048");
  if (!is_whole) handler.fail("this is no JSON", "a glTF document");
  handler.finish();
  return std::move(handler.model);
}

std::string place_of(const char* list, size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

}  // namespace vkh::gltf
