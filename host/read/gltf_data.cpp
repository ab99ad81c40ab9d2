#include "host/read/gltf_data.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "host/base/reject.h"
#include "host/base/system.h"
#include "host/read/gltf_unpack.h"

namespace vkh::gltf {
namespace {

namespace fs = std::filesystem;

enum Component : uint16_t {
  kByte = 5120,
  kUnsignedByte,
  kShort,
  kUnsignedShort,
  kUnsignedInt = 5125,
  kFloat
};

uint64_t bytes_of(uint16_t component) {
  switch (component) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

bool is_index(uint16_t component) {
  return component == kUnsignedByte || component == kUnsignedShort || component == kUnsignedInt;
}

uint32_t index_at(const char* at, uint16_t component) {
  if (component == kUnsignedInt) return load<uint32_t>(at);
  return component == kUnsignedShort ? load<uint16_t>(at) : load<uint8_t>(at);
}

double number_at(const char* at, uint16_t component) {
  switch (component) {
    case kByte:
      return load<int8_t>(at);
    case kUnsignedByte:
      return load<uint8_t>(at);
    case kShort:
      return load<int16_t>(at);
    case kUnsignedShort:
      return load<uint16_t>(at);
    default:
      return static_cast<double>(load<float>(at));
  }
}

// The specification's rule: the least of a signed type is -1, as is the one above it.
double normalised(double x, uint16_t component) {
  const double most = component == kByte           ? 127
                      : component == kUnsignedByte ? 255
                      : component == kShort        ? 32767
                                                   : 65535;
  return std::max(x / most, -1.0);
}

}  // namespace

// The row of a number, or its replacement.
const char* Column::row(uint64_t number, uint64_t width) const {
  uint32_t low = 0, high = sparse_count;
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    const uint32_t at =
        index_at(sparse_rows + middle * bytes_of(sparse_component), sparse_component);
    if (at == number) return sparse_values + middle * width;
    (at < number ? low : high) = at < number ? middle + 1 : middle;
  }
  return rows == nullptr ? nullptr : rows + number * stride;
}

uint32_t Column::index(uint64_t number) const {
  const char* at = row(number, bytes_of(component));
  return at == nullptr ? 0 : index_at(at, component);
}

glm::dvec3 Column::position(uint64_t number) const {
  const uint64_t width = bytes_of(component);
  const char* at = row(number, 3 * width);
  if (at == nullptr) return {0, 0, 0};
  glm::dvec3 p{};
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = number_at(at + static_cast<uint64_t>(axis) * width, component);
    if (is_normalized) p[axis] = normalised(p[axis], component);
  }
  return p;
}

void Data::fail(const std::string& place, const std::string& what,
                const std::string& expected) const {
  reject(source_.name, place, what, expected);
}

void Data::spend(uint64_t bytes, const std::string& place) {
  if (bytes >
      source_.limits.max_input_bytes - std::min(input_bytes_, source_.limits.max_input_bytes)) {
    fail(place,
         "it takes " + counted(bytes, "byte") + ", beyond the limit of " +
             counted(source_.limits.max_input_bytes, "byte") + " for all",
         "a smaller file, or a greater limit (--max-input)");
  }
  input_bytes_ += bytes;
  check_going(source_.name, source_.limits);
}

std::string_view Data::embedded(uint32_t number) {
  std::vector<char>& bytes = buffers_[number];
  if (!decode_base64(model_.buffers[number].uri, bytes)) {
    fail(place_of("buffers", number), "a data URI that is not whole base64",
         "data:application/octet-stream;base64,...");
  }
  return {bytes.data(), bytes.size()};
}

// Nothing outside the file's folder is opened, not even by a link.
NamedFile Data::file_of(uint32_t number) const {
  const std::vector<std::string> names = files_beneath(model_.buffers[number].uri);
  if (source_.folder.empty() || names.empty()) return {};
  std::error_code error;
  const auto is_there = [&](const std::string& file) {
    return fs::exists(path_of(source_.folder) / path_of(file), error);
  };
  const auto found = std::find_if(names.begin(), names.end(), is_there);
  NamedFile file{.name = found == names.end() ? names.front() : *found, .path = {}, .wrong = {}};
  const fs::path folder = fs::canonical(path_of(source_.folder), error);
  const fs::path path = fs::canonical(path_of(source_.folder) / path_of(file.name), error);
  if (error || !fs::is_regular_file(path, error)) {
    file.wrong = "there is no file " + vkh::quoted(file.name);
  } else if (std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first !=
             folder.end()) {
    file.wrong = vkh::quoted(file.name) + " leads elsewhere";
  } else {
    file.path = path;
  }
  return file;
}

std::string_view Data::external(uint32_t number) {
  const std::string place = place_of("buffers", number);
  const NamedFile file = file_of(number);
  if (file.name.empty()) {
    fail(place, "its data lie in " + vkh::quoted(model_.buffers[number].uri),
         "a file beneath the folder of this one");
  }
  const auto known = files_.find(file.name);
  if (known != files_.end()) {
    const std::vector<char>& bytes = buffers_[known->second];
    return {bytes.data(), bytes.size()};
  }
  if (!file.wrong.empty()) fail(place, file.wrong, "a file beneath the folder of this one");
  std::error_code error;
  const uint64_t size = fs::file_size(file.path, error), wanted = model_.buffers[number].length;
  if (error || size < wanted) {
    fail(place, vkh::quoted(file.name) + " is shorter than " + counted(wanted, "byte"),
         "all of byteLength");
  }
  spend(wanted, place);
  std::vector<char>& bytes = buffers_[number];
  bytes.resize(wanted);
  std::ifstream in(file.path, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(wanted)))
    fail(place, vkh::quoted(file.name) + " cannot be read", "a readable file");
  files_.emplace(file.name, number);
  return {bytes.data(), bytes.size()};
}

std::string_view Data::buffer(uint32_t number) {
  const std::string place = place_of("buffers", number);
  if (number >= model_.buffers.size()) fail(place, "there is none", "a buffer that is there");
  const BufferEntry& entry = model_.buffers[number];
  const auto kept = buffers_.find(number);
  std::string_view bytes;
  if (kept != buffers_.end()) {
    bytes = {kept->second.data(), kept->second.size()};
  } else if (is_data(entry.uri)) {
    bytes = embedded(number);
  } else if (!entry.uri.empty()) {
    bytes = external(number);
  } else if (number == 0 && !chunk_.empty()) {
    bytes = chunk_;
  } else {
    fail(place, "it has no data", "a uri, or a GLB with a binary chunk");
  }
  if (bytes.size() < entry.length) {
    fail(place, counted(bytes.size(), "byte") + " of " + std::to_string(entry.length),
         "all of byteLength");
  }
  return bytes.substr(0, entry.length);
}

std::string_view Data::part(uint32_t number, uint64_t offset, uint64_t length,
                            const std::string& place) {
  const std::string_view bytes = buffer(number);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail(place,
         counted(length, "byte") + " from " + std::to_string(offset) + " of " +
             counted(bytes.size(), "byte"),
         "bytes within the buffer");
  }
  return bytes.substr(offset, length);
}

std::string_view Data::unpacked(uint32_t number) {
  const auto kept = unpacked_.find(number);
  if (kept != unpacked_.end()) return {kept->second.data(), kept->second.size()};
  const std::string place = place_of("bufferViews", number);
  const Packed& packed = model_.packed[model_.views[number].packed];
  const std::string_view from = part(packed.buffer, packed.offset, packed.length, place);
  const char* wrong = unpack_problem(packed);
  if (wrong == nullptr && unpacked_bytes(packed) != model_.views[number].length)
    wrong = "count and byteStride differ from byteLength";
  if (wrong != nullptr) fail(place, wrong, "what meshopt compression allows");
  spend(unpacked_bytes(packed), place);
  std::vector<char>& out = unpacked_[number];
  if (!unpack(packed, from, out))
    fail(place, "its meshopt compression cannot be undone", "whole, compressed data");
  return {out.data(), out.size()};
}

Data::Slice Data::view(uint32_t number, const std::string& asked_by) {
  if (number >= model_.views.size()) {
    fail(asked_by, "buffer view " + std::to_string(number) + " is not there",
         "below " + std::to_string(model_.views.size()));
  }
  const View& entry = model_.views[number];
  if (entry.packed != kNone) return {unpacked(number), entry.stride};
  return {part(entry.buffer, entry.offset, entry.length, place_of("bufferViews", number)),
          entry.stride};
}

const Accessor& Data::accessor_of(uint32_t number) const {
  if (number >= model_.accessors.size())
    fail(place_of("accessors", number), "there is none", "an accessor that is there");
  return model_.accessors[number];
}

bool Data::has_data(uint32_t number) const {
  const Accessor& accessor = accessor_of(number);
  return accessor.view != kNone || accessor.sparse != kNone;
}

void Data::add_buffer_of_view(uint32_t number, std::set<uint32_t>& buffers) const {
  if (number >= model_.views.size()) return;
  const View& view = model_.views[number];
  const uint32_t buffer = view.packed == kNone ? view.buffer : model_.packed[view.packed].buffer;
  if (buffer < model_.buffers.size()) buffers.insert(buffer);
}

void Data::add_buffers(uint32_t number, std::set<uint32_t>& buffers) const {
  if (number >= model_.accessors.size()) return;
  const Accessor& accessor = model_.accessors[number];
  add_buffer_of_view(accessor.view, buffers);
  if (accessor.sparse == kNone) return;
  const Sparse& sparse = model_.sparses[accessor.sparse];
  add_buffer_of_view(sparse.indices.view, buffers);
  add_buffer_of_view(sparse.values.view, buffers);
}

Column Data::column(uint32_t number, uint32_t width, uint64_t row_bytes) {
  const Accessor& accessor = accessor_of(number);
  Column column{.stride = row_bytes,
                .count = accessor.count,
                .component = accessor.component,
                .is_normalized = accessor.is_normalized,
                .place = place_of("accessors", number)};
  if (accessor.width != width)
    fail(column.place, "it is of another type", width == 1 ? "SCALAR" : "VEC3");
  if (!has_data(number)) fail(column.place, "it has no data", "a bufferView or sparse values");
  if (accessor.view != kNone) {
    const Slice slice = view(accessor.view, column.place);
    if (slice.stride != 0) column.stride = slice.stride;
    // There is no overflow: a stride and a count have 32 bits, and the rest of the comparison is a
    // size.
    const uint64_t size = slice.bytes.size(), last = column.stride * (column.count - 1);
    if (column.stride < row_bytes || accessor.offset > size || last > size - accessor.offset ||
        row_bytes > size - accessor.offset - last) {
      fail(column.place, counted(column.count, "element") + " leave their buffer view",
           "elements within its " + counted(size, "byte"));
    }
    column.rows = slice.bytes.data() + accessor.offset;
  } else if (column.count >
             input_bytes_) {  // mostly zeros: no more elements than a file could hold
    fail(column.place, counted(column.count, "element") + " of zeros",
         "fewer than the file has bytes");
  }
  if (accessor.sparse != kNone) add_sparse(number, row_bytes, column);
  return column;
}

void Data::add_sparse(uint32_t number, uint64_t row_bytes, Column& column) {
  const Sparse& sparse = model_.sparses[model_.accessors[number].sparse];
  const uint64_t index_bytes = bytes_of(sparse.indices.component);
  if (!is_index(sparse.indices.component) || sparse.count > column.count)
    fail(column.place, "sparse indices of another type, or too many", "unsigned integers");
  const auto rows_of = [&](const SparsePart& part, uint64_t bytes) {
    const std::string_view found = view(part.view, column.place).bytes;
    if (part.offset > found.size() || sparse.count * bytes > found.size() - part.offset) {
      fail(column.place, "sparse elements leave their buffer view",
           "elements within its " + counted(found.size(), "byte"));
    }
    return found.data() + part.offset;
  };
  column.sparse_count = sparse.count;
  column.sparse_component = sparse.indices.component;
  column.sparse_rows = rows_of(sparse.indices, index_bytes);
  column.sparse_values = rows_of(sparse.values, row_bytes);
  is_ascending_.resize(model_.accessors.size());
  if (is_ascending_[number]) return;  // many primitives may have one accessor
  check_ascending(column);
  is_ascending_[number] = true;
}

void Data::check_ascending(const Column& column) const {
  const uint64_t bytes = bytes_of(column.sparse_component);
  uint64_t next = 0;
  for (uint64_t i = 0; i < column.sparse_count; ++i) {
    const uint32_t at = index_at(column.sparse_rows + i * bytes, column.sparse_component);
    if (at < next || at >= column.count) {
      fail(column.place, "sparse index " + std::to_string(at) + " is out of order or of range",
           "ascending indices below " + std::to_string(column.count));
    }
    next = uint64_t{at} + 1;
  }
}

Column Data::indices(uint32_t number) {
  const Accessor& accessor = accessor_of(number);
  if (!is_index(accessor.component) || accessor.is_normalized) {
    fail(place_of("accessors", number), "indices of another type",
         "unsigned integers of 8, 16 or 32 bits");
  }
  return column(number, 1, bytes_of(accessor.component));
}

Column Data::positions(uint32_t number) {
  const Accessor& accessor = accessor_of(number);
  const uint64_t bytes = bytes_of(accessor.component);
  const bool is_integer = bytes == 1 || bytes == 2;
  if (!is_integer && (accessor.component != kFloat || accessor.is_normalized)) {
    fail(place_of("accessors", number), "positions of another type",
         "float, or integers of 8 or 16 bits");
  }
  return column(number, 3, 3 * bytes);
}

}  // namespace vkh::gltf
