// A binary PLY's body on several threads. Rows of one length are found by multiplication. Rows with
// lists are first taken to be as long as the element's first one: right for meshes of triangles
// alone, or of quads. If they are not, one thread goes from list to list, and the others parse
// behind it.
#include <algorithm>
#include <atomic>
#include <optional>

#include "host/base/reject.h"
#include "host/read/ply_header.h"
#include "host/read/source.h"

namespace vkh::ply {
namespace {

[[noreturn]] void refuse(const MeshSource& source) {
  reject(source.name, "byte 0", "a body that is not read by blocks", "another");
}

template <class Stored, std::endian kOrder>
int64_t integer_at(const char* at) {
  return static_cast<int64_t>(load<Stored, kOrder>(at));
}

// NOLINTBEGIN(bugprone-branch-clone): each branch is of another type
/// Calls use(T()) with the stored type.
template <class F>
auto with_type(Scalar type, const F& use) {
  switch (type) {
    case Scalar::kInt8:
      return use(int8_t());
    case Scalar::kUint8:
      return use(uint8_t());
    case Scalar::kInt16:
      return use(int16_t());
    case Scalar::kUint16:
      return use(uint16_t());
    case Scalar::kInt32:
      return use(int32_t());
    case Scalar::kUint32:
      return use(uint32_t());
    case Scalar::kFloat:
      return use(float());
    default:
      return use(double());
  }
}
// NOLINTEND(bugprone-branch-clone)

/// Consecutive rows, and their place in the file and the mesh.
struct RowBlock {
  uint64_t row = 0;       ///< the first
  uint64_t at = 0;        ///< its byte
  uint64_t triangle = 0;  ///< its first triangle; only in the face element
};

/// The blocks of an element, and where the last one ends.
using PlyBlocks = std::vector<RowBlock>;

template <std::endian kOrder>
class BlockReader {
 public:
  BlockReader(const Header& header, const Layout& layout, const MeshSource& source)
      : header_(header),
        layout_(layout),
        source_(source),
        pool_(pool_of(source)),
        windows_(source),
        block_bytes_(block_bytes_of(source)) {}

  ReadMesh read(uint64_t body_begin) {
    FileMeshBuilder(source_).check_room(layout_.vertex->count, layout_.face_count());
    uint64_t at = body_begin;
    const Element* last = nullptr;
    for (const Element& element : header_.elements) {
      if (element.count == 0) continue;
      at = read_element(element, at);
      last = &element;
    }
    FileMeshBuilder builder(source_, std::move(vertices_), std::move(faces_));
    builder.count_faces(polygons_, short_faces_, file_faces_, 0);
    constexpr uint64_t kMostRest = uint64_t{1} << 20;
    const uint64_t size = source_.size();
    if (size - at > kMostRest) refuse(source_);
    check_rest(Windows::Window(windows_).read(at, size), at, last, builder);
    return std::move(builder).finish("byte 0");
  }

 private:
  /// Returns where the element ends.
  uint64_t read_element(const Element& element, uint64_t begin) {
    if (&element == layout_.vertex) return read_vertices(begin);
    if (&element == layout_.face) return read_faces(begin);
    if (&element == layout_.strips) refuse(source_);
    if (const uint64_t bytes = fixed_row_bytes(element)) {
      check_end(begin, element.count, bytes);
      return begin + element.count * bytes;
    }
    return walk(element, begin).back().at;
  }

  /// The bytes of a row; 0 if a row holds a list.
  static uint64_t fixed_row_bytes(const Element& element) {
    uint64_t bytes = 0;
    for (const Property& property : element.properties) {
      if (property.list_count) return 0;
      bytes += size_of(property.type);
    }
    return bytes;
  }

  void check_end(uint64_t begin, uint64_t count, uint64_t row_bytes) const {
    if (count > (source_.size() - begin) / row_bytes) refuse(source_);
  }

  uint64_t rows_of_block(uint64_t row_bytes) const {
    return std::max<uint64_t>(1, block_bytes_ / row_bytes);
  }

  uint64_t read_vertices(uint64_t begin) {
    const Element& element = *layout_.vertex;
    const uint64_t row_bytes = fixed_row_bytes(element);
    if (row_bytes == 0) refuse(source_);
    check_end(begin, element.count, row_bytes);
    resize_together(pool_, vertices_, element.count);
    const uint64_t rows = rows_of_block(row_bytes);
    pool_.for_each((element.count + rows - 1) / rows, [&](size_t i) {
      const uint64_t first = i * rows, count = std::min(rows, element.count - first);
      const uint64_t at = begin + first * row_bytes;
      Windows::Window window(windows_);
      const std::string_view bytes = window.read(at, at + count * row_bytes);
      for (int axis = 0; axis < 3; ++axis) copy_axis(axis, bytes, row_bytes, &vertices_[first]);
      count_read(source_, bytes.size());
    });
    return begin + element.count * row_bytes;
  }

  void copy_axis(int axis, std::string_view bytes, uint64_t row_bytes, glm::dvec3* out) const {
    const std::vector<Property>& properties = layout_.vertex->properties;
    const size_t property = layout_.axes[static_cast<size_t>(axis)];
    uint64_t offset = 0;
    for (size_t i = 0; i < property; ++i) offset += size_of(properties[i].type);
    with_type(properties[property].type, [&](auto stored) {
      for (uint64_t at = offset; at < bytes.size(); at += row_bytes, ++out)
        (*out)[axis] = static_cast<double>(load<decltype(stored), kOrder>(bytes.data() + at));
    });
  }

  uint64_t read_faces(uint64_t begin) {
    if (const std::optional<PlyBlocks> even = even_blocks(begin)) {
      try {
        return read_face_blocks(*even);
      } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): then the rows differ
      }
    }
    return read_face_blocks(walk(*layout_.face, begin));
  }

  // Blocks as if all rows were like the first. Returns nothing if the file is too short for that.
  std::optional<PlyBlocks> even_blocks(uint64_t begin) {
    const Element& element = *layout_.face;
    uint64_t triangles = 0;
    Walker first(*this, begin);
    const uint64_t row_bytes = first.skip_row(element, &triangles) - begin;
    if (element.count > (source_.size() - begin) / row_bytes) return std::nullopt;
    const uint64_t rows = rows_of_block(row_bytes);
    PlyBlocks blocks;
    for (uint64_t row = 0; row < element.count; row += rows)
      blocks.push_back({row, begin + row * row_bytes, row * triangles});
    blocks.push_back({element.count, begin + element.count * row_bytes, element.count * triangles});
    return blocks;
  }

  PlyBlocks walk(const Element& element, uint64_t begin) {
    PlyBlocks blocks = {{.row = 0, .at = begin}};
    Walker walker(*this, begin);
    uint64_t triangles = 0, at = begin;
    for (uint64_t row = 0; row < element.count; ++row) {
      if (at - blocks.back().at >= block_bytes_) {
        blocks.push_back({row, at, triangles});
        pool_.check_going();
      }
      at = walker.skip_row(element, &element == layout_.face ? &triangles : nullptr);
    }
    blocks.push_back({element.count, at, triangles});
    return blocks;
  }

  /// Goes from list to list.
  class Walker {
   public:
    Walker(BlockReader& reader, uint64_t at)
        : reader_(reader), window_(reader.windows_), at_(at), begin_(at) {}

    /// Returns where the row ends, and adds the triangles of its polygon.
    uint64_t skip_row(const Element& element, uint64_t* triangles) {
      for (size_t i = 0; i < element.properties.size(); ++i) {
        const Property& property = element.properties[i];
        uint64_t count = 1;
        if (property.list_count) {
          count = list_count(*property.list_count);
          const bool is_polygon = triangles != nullptr && i == reader_.layout_.corners;
          if (is_polygon && count > 2) *triangles += count - 2;
        }
        const uint64_t left = reader_.source_.size() - at_;
        if (count > left / size_of(property.type)) refuse(reader_.source_);
        at_ += count * size_of(property.type);
      }
      return at_;
    }

   private:
    uint64_t list_count(Scalar type) {
      const uint64_t size = size_of(type), end = reader_.source_.size();
      if (size > end - at_) refuse(reader_.source_);
      if (at_ + size > begin_ + bytes_.size()) {
        begin_ = at_;
        bytes_ = window_.read(at_, std::min(end, at_ + std::max(reader_.block_bytes_, size_t{8})));
      }
      const char* const stored = bytes_.data() + (at_ - begin_);
      at_ += size;
      const int64_t count =
          with_type(type, [&](auto t) { return integer_at<decltype(t), kOrder>(stored); });
      if (count < 0) refuse(reader_.source_);
      return static_cast<uint64_t>(count);
    }

    BlockReader& reader_;
    Windows::Window window_;
    uint64_t at_, begin_;
    std::string_view bytes_;
  };

  uint64_t read_face_blocks(const PlyBlocks& blocks) {
    const uint64_t triangles = blocks.back().triangle;
    FileMeshBuilder(source_).check_room(layout_.vertex->count, triangles);
    if (faces_.size() != triangles) {
      faces_ = {};
      resize_together(pool_, faces_, triangles);
    }
    polygons_ = short_faces_ = 0;
    std::vector<FileFaces> of_blocks(blocks.size() - 1);
    pool_.for_each(blocks.size() - 1, [&](size_t i) {
      Windows::Window window(windows_);
      FaceRows rows(*this, window.read(blocks[i].at, blocks[i + 1].at));
      rows.begin = rows.out = faces_.data() + blocks[i].triangle;
      rows.end = faces_.data() + blocks[i + 1].triangle;
      uint64_t row = rows.read_triangles(blocks[i].row, blocks[i + 1].row);
      for (; row < blocks[i + 1].row; ++row) rows.read_row();
      rows.check_end();
      count_read(source_, blocks[i + 1].at - blocks[i].at);
      polygons_ += rows.polygons;
      short_faces_ += rows.short_faces;
      of_blocks[i] = std::move(rows.file_faces);
    });
    file_faces_ = {};
    for (size_t i = 0; i < of_blocks.size(); ++i)
      file_faces_.append(of_blocks[i], blocks[i].triangle);
    return blocks.back().at;
  }

  /// The rows of one block: bytes, and the triangles that they have to fill.
  struct FaceRows {
    FaceRows(const BlockReader& r, std::string_view bytes)
        : reader(r), at(bytes.data()), stop(bytes.data() + bytes.size()) {}

    /// Reads triangles whose rows hold nothing else, as most files have them, until a row differs.
    /// Returns the first row that is left.
    uint64_t read_triangles(uint64_t row, uint64_t stop_row) {
      const std::vector<Property>& properties = reader.layout_.face->properties;
      const Property& corners = properties[reader.layout_.corners];
      if (properties.size() > 1 || size_of(*corners.list_count) != 1) return row;
      return with_type(corners.type, [&](auto t) {
        constexpr ptrdiff_t kBytes = 1 + 3 * sizeof(t);
        for (; row < stop_row && stop - at >= kBytes && out != end && *at == 3; ++row) {
          ++at;
          fan<decltype(t)>(3);
          at += kBytes - 1;
        }
        return row;
      });
    }

    void read_row() {
      const std::vector<Property>& properties = reader.layout_.face->properties;
      for (size_t i = 0; i < properties.size(); ++i) {
        const Property& property = properties[i];
        const uint64_t count = property.list_count ? list_count(*property.list_count) : 1;
        if (count > static_cast<uint64_t>(stop - at) / size_of(property.type))
          refuse(reader.source_);
        if (i == reader.layout_.corners) read_polygon(property.type, count);
        at += count * size_of(property.type);
      }
    }

    // Checks again, since another process may write to the file.
    void check_end() const {
      if (at != stop || out != end) refuse(reader.source_);
    }

    uint64_t list_count(Scalar type) {
      if (size_of(type) > static_cast<uint64_t>(stop - at)) refuse(reader.source_);
      const char* const stored = at;
      at += size_of(type);
      const int64_t count =
          with_type(type, [&](auto t) { return integer_at<decltype(t), kOrder>(stored); });
      if (count < 0) refuse(reader.source_);
      return static_cast<uint64_t>(count);
    }

    void read_polygon(Scalar type, uint64_t count) {
      if (count == 0 || (count > 2 && count - 2 > static_cast<uint64_t>(end - out)))
        refuse(reader.source_);
      if (count != 3) note_other(count);
      with_type(type, [&](auto t) { fan<decltype(t)>(count); });
    }

    // Notes a face that is no triangle.
    void note_other(uint64_t count) {
      ++(count > 3 ? polygons : short_faces);
      file_faces.add(static_cast<size_t>(out - begin), count > 3 ? count - 2 : 0);
    }

    template <class Index>
    void fan(uint64_t count) {
      uint32_t first = 0, before = 0;
      for (uint64_t i = 0; i < count; ++i) {
        const int64_t index = integer_at<Index, kOrder>(at + i * sizeof(Index));
        if (index < 0 || static_cast<uint64_t>(index) >= reader.layout_.vertex->count)
          refuse(reader.source_);
        const auto corner = static_cast<uint32_t>(index);
        if (i == 0) first = corner;
        if (i > 1) *out++ = {first, before, corner};
        before = corner;
      }
    }

    const BlockReader& reader;
    const char* at;
    const char* stop;
    const glm::uvec3* begin = nullptr;
    glm::uvec3* out = nullptr;
    glm::uvec3* end = nullptr;
    uint64_t polygons = 0, short_faces = 0;
    FileFaces file_faces;
  };

  const Header& header_;
  const Layout& layout_;
  const MeshSource& source_;
  ThreadPool pool_;
  Windows windows_;
  size_t block_bytes_;
  std::vector<glm::dvec3> vertices_;
  std::vector<glm::uvec3> faces_;
  std::atomic<uint64_t> polygons_ = 0, short_faces_ = 0;
  FileFaces file_faces_;
};

}  // namespace

ReadMesh read_binary_by_blocks(const Header& header, const MeshSource& source,
                               uint64_t body_begin) {
  const Layout layout = layout_of(header, source);
  if (header.encoding == Encoding::kBig)
    return BlockReader<std::endian::big>(header, layout, source).read(body_begin);
  return BlockReader<std::endian::little>(header, layout, source).read(body_begin);
}

}  // namespace vkh::ply
