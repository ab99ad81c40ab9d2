#include "tools/pairs/ply_stream.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "vkhausdorff/error.h"

namespace vkh::pairs {
namespace {

constexpr size_t kBufferBytes = size_t{1} << 20;
constexpr uint64_t kFaceBytes = 13;

template <class T>
void append(std::vector<char>& rows, T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  rows.insert(rows.end(), bytes.begin(), bytes.end());
}

uint64_t vertex_bytes(const PlyShape& shape) { return shape.is_double ? 24 : 12; }

std::string header_of(const PlyShape& shape) {
  const std::string type = shape.is_double ? "property double " : "property float ";
  // Some readers know no unsigned index; none of ours needs it below 2^31 vertices.
  const char* index = shape.vertex_count > INT32_MAX ? "uint" : "int";
  return "ply\nformat binary_little_endian 1.0\nelement vertex " +
         std::to_string(shape.vertex_count) + "\n" + type + "x\n" + type + "y\n" + type +
         "z\nelement face " + std::to_string(shape.face_count) + "\nproperty list uchar " + index +
         " vertex_indices\nend_header\n";
}

}  // namespace

PlyStream::PlyStream(const std::string& path, const PlyShape& shape)
    : path_(path),
      shape_(shape),
      bytes_left_(shape.vertex_count * vertex_bytes(shape) + shape.face_count * kFaceBytes),
      file_(std::fopen(path.c_str(), "wb"), std::fclose) {
  if (!file_) refuse(std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // flushed blocks are large enough
  buffer_.reserve(kBufferBytes + vertex_bytes(shape_));
  const std::string header = header_of(shape);
  buffer_.assign(header.begin(), header.end());
}

PlyStream::~PlyStream() {
  if (is_finished_ || !file_) return;
  file_.reset();
  std::error_code none;  // we may remove neither a pipe nor a device
  if (std::filesystem::is_regular_file(path_, none)) std::filesystem::remove(path_, none);
}

void PlyStream::refuse(const char* what) const {
  throw OutputError("'" + path_ + "': cannot be written: " + what);
}

void PlyStream::flush() {
  errno = 0;
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size())
    refuse(std::strerror(errno));
  buffer_.clear();
}

void PlyStream::add_vertex(const glm::dvec3& position) {
  write_vertex(buffer_, position, shape_.is_double);
  bytes_left_ -= vertex_bytes(shape_);
  if (buffer_.size() >= kBufferBytes) flush();
}

void PlyStream::add_face(uint32_t i, uint32_t j, uint32_t k) {
  write_face(buffer_, i, j, k);
  bytes_left_ -= kFaceBytes;
  if (buffer_.size() >= kBufferBytes) flush();
}

void PlyStream::add_rows(const std::vector<char>& rows) {
  bytes_left_ -= rows.size();
  buffer_.insert(buffer_.end(), rows.begin(), rows.end());
  if (buffer_.size() >= kBufferBytes) flush();
}

void PlyStream::finish() {
  if (bytes_left_ != 0) throw std::logic_error(path_ + ": other rows than its header announces");
  flush();
  if (std::fclose(file_.release()) != 0) refuse(std::strerror(errno));
  is_finished_ = true;
}

void write_vertex(std::vector<char>& rows, const glm::dvec3& position, bool is_double) {
  for (int axis = 0; axis < 3; ++axis) {
    if (is_double)
      append(rows, position[axis]);
    else
      append(rows, static_cast<float>(position[axis]));
  }
}

void write_face(std::vector<char>& rows, uint32_t i, uint32_t j, uint32_t k) {
  rows.push_back(3);
  append(rows, i);
  append(rows, j);
  append(rows, k);
}

std::string summary(const std::string& path, const PlyShape& shape) {
  return path + ": " + std::to_string(shape.face_count) + " faces, " +
         std::to_string(shape.vertex_count) + " vertices, " +
         (shape.is_double ? "double" : "float") + " columns";
}

}  // namespace vkh::pairs
