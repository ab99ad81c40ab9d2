// LAS 1.0 to 1.5, point data formats 0 to 10 (ASPRS, LAS specifications 1.0, 1.4 R16 and 1.5 R00).
// A record begins with three integers: a coordinate is its integer times the header's scale, plus
// the header's offset. Points that are withheld, which the specification calls deleted, are left
// out and noted.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "host/base/reject.h"
#include "host/base/rounding.h"
#include "host/read/readers.h"
#include "vkhausdorff/note.h"

namespace vkh {
namespace las {
namespace {

/// The parts of the header that say where the points lie.
struct LasHeader {
  unsigned minor = 0;             ///< of version 1
  uint64_t begin = 0, count = 0;  ///< the byte of the first record; records
  uint64_t record_bytes = 0;
  unsigned format = 0;
  glm::dvec3 scale{}, offset{};
};

template <class T>
T at(std::string_view head, size_t offset) {
  return load<T>(head.data() + offset);
}

constexpr uint64_t kHeaderBytes = 227;    // of LAS 1.0 to 1.2; 1.3 adds 8 bytes
constexpr uint64_t kHeaderBytes14 = 375;  // of LAS 1.4; 1.5 adds 18 bytes of times
constexpr std::array<uint64_t, 11> kRecordBytes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

[[noreturn]] void refuse(const MeshSource& source, uint64_t byte, const std::string& what,
                         const std::string& expected) {
  reject(source.name, "byte " + std::to_string(byte), what, expected);
}

void check_version(const MeshSource& source, std::string_view head) {
  const unsigned major = at<uint8_t>(head, 24), minor = at<uint8_t>(head, 25);
  if (major != 1 || minor > 5)
    refuse(source, 24, "LAS " + std::to_string(major) + "." + std::to_string(minor),
           "LAS 1.0 to 1.5");
  const uint64_t least = minor >= 4 ? kHeaderBytes14 : kHeaderBytes;
  if (head.size() < least || at<uint16_t>(head, 94) < least)
    refuse(source, 94, "a header that ends early", "a whole LAS header");
}

unsigned format_of(const MeshSource& source, std::string_view head) {
  constexpr unsigned kCompressed = 0xc0;
  const unsigned format = at<uint8_t>(head, 104);
  if ((format & kCompressed) != 0)
    refuse(source, 104, "points compressed as LAZ, which is not read",
           "LAS: unpack the file, such as by laszip or las2las");
  if (format >= kRecordBytes.size())
    refuse(source, 104, "point data format " + std::to_string(format), "one of 0 to 10");
  return format;
}

// LAS counts in 64 bits from 1.4 on. Its count of 32 bits is for older readers, and may be 0.
uint64_t count_of(const MeshSource& source, std::string_view head) {
  const uint64_t old = at<uint32_t>(head, 107);
  if (at<uint8_t>(head, 25) < 4) return old;
  const auto count = at<uint64_t>(head, 247);
  if (old != 0 && old != count)
    refuse(source, 107,
           std::to_string(old) + " points, and " + std::to_string(count) + " at byte 247",
           "one count, or 0 here");
  return count;
}

void check_places(const MeshSource& source, const LasHeader& header) {
  for (int i = 0; i < 3; ++i) {
    const bool is_finite = std::isfinite(header.scale[i]) && std::isfinite(header.offset[i]);
    if (!is_finite || header.scale[i] == 0)
      refuse(source, 131 + 8 * static_cast<uint64_t>(i),
             "a scale or an offset that gives no coordinates", "finite numbers, and no scale of 0");
  }
}

// The bytes behind a header's end are none of it.
template <class T>
T field(std::string_view head, size_t offset) {
  const size_t end = std::min<size_t>(at<uint16_t>(head, 94), head.size());
  return offset + sizeof(T) > end ? T{} : at<T>(head, offset);
}

// Returns where the room for records ends: at the waveforms (1.3 on) or at the first extended
// record (1.4 on), which stand behind the points, or else with the file.
uint64_t end_of_records(std::string_view head, uint64_t begin, uint64_t size) {
  const unsigned minor = at<uint8_t>(head, 25);
  uint64_t end = size;
  const auto stop_at = [&](uint64_t byte) {
    if (byte >= begin && byte < end) end = byte;
  };
  if (minor >= 3) stop_at(field<uint64_t>(head, 227));
  if (minor >= 4 && field<uint32_t>(head, 243) > 0) stop_at(field<uint64_t>(head, 235));
  return end;
}

// In LAS 1.0 two bytes stand before the points. Some writers count them to the points.
void skip_signature(const MeshSource& source, LasHeader& header) {
  constexpr std::string_view kSignature = "\xdd\xcc";
  const uint64_t behind = header.begin + kSignature.size();
  if (header.minor > 0 || behind + header.count * header.record_bytes != source.size()) return;
  Windows windows(source);
  if (Windows::Window(windows).read(header.begin, behind) == kSignature) header.begin = behind;
}

// Refuses records that the header does not count, as well as missing ones: a part of the points
// must not pass for all.
void check_records(const MeshSource& source, std::string_view head, const LasHeader& header) {
  const uint64_t size = source.size(), begin = header.begin, bytes = header.record_bytes;
  const uint64_t byte = header.minor >= 4 ? 247 : 107;
  if (begin < at<uint16_t>(head, 94) || begin > size)
    refuse(source, 96, "points from byte " + std::to_string(begin) + " on",
           "a place behind the header, in a file that holds them");
  const uint64_t end = end_of_records(head, begin, size), room = (end - begin) / bytes;
  if (header.count == room) return;
  refuse(source, byte,
         counted(header.count, "point") + " announced, " + counted(room, "record") + " of " +
             counted(bytes, "byte") + " present",
         header.count > room ? "a file that holds them"
                             : "the count of all points: the header may be unfinished");
}

LasHeader read_las_header(const MeshSource& source) {
  const std::string head = head_of(source, kHeaderBytes14);
  if (head.size() < kHeaderBytes)
    refuse(source, head.size(), "the file ends", "a whole LAS header");
  check_version(source, head);
  LasHeader header{.minor = at<uint8_t>(head, 25),
                   .begin = at<uint32_t>(head, 96),
                   .count = count_of(source, head),
                   .record_bytes = at<uint16_t>(head, 105),
                   .format = format_of(source, head)};
  if (header.record_bytes < kRecordBytes[header.format])
    refuse(source, 105, "records of " + counted(header.record_bytes, "byte"),
           "at least " + std::to_string(kRecordBytes[header.format]) + " in this format");
  for (size_t i = 0; i < 3; ++i) {
    header.scale[static_cast<int>(i)] = at<double>(head, 131 + 8 * i);
    header.offset[static_cast<int>(i)] = at<double>(head, 155 + 8 * i);
  }
  check_places(source, header);
  skip_signature(source, header);
  check_records(source, head, header);
  if (header.count >= UINT32_MAX) refuse(source, 107, "too many points", "fewer than 2^32 - 1");
  return header;
}

// The flags came with LAS 1.1: in 1.0 the byte is a class of the user's.
bool is_withheld(const LasHeader& header, const char* record) {
  const auto flags = load<uint8_t>(record + 15);
  return header.minor > 0 && (flags & (header.format < 6 ? 0x80 : 0x04)) != 0;
}

/// The least and the largest integer of each axis.
struct Extremes {
  std::array<int32_t, 3> least{INT32_MAX, INT32_MAX, INT32_MAX},
      largest{INT32_MIN, INT32_MIN, INT32_MIN};

  void see(const Extremes& other) {
    for (size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], other.least[i]);
      largest[i] = std::max(largest[i], other.largest[i]);
    }
  }
  void see(size_t axis, int32_t number) {
    least[axis] = std::min(least[axis], number);
    largest[axis] = std::max(largest[axis], number);
  }
};

// Bounds how far a point is from n * scale + offset. With u = 2^-53, the product p is rounded by at
// most u |p| + 2^-1075 and the sum x by at most u |x|, since |exact| <= |rounded| (1 + u) and a sum
// of doubles has no underflow; the factor 1.01 covers (1 + u) and the roundings here, and 2^-1070
// the least numbers. Rounded products and sums do not turn the integers' order around, so that the
// extreme ones have the largest |p| and |x|.
double delta_of(const LasHeader& header, const Extremes& extremes) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  double length = 0;
  for (size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<glm::length_t>(i);
    double product = 0, place = 0;
    for (const int32_t number : {extremes.least[i], extremes.largest[i]}) {
      const double p = number * header.scale[axis];
      product = std::max(product, std::abs(p));
      place = std::max(place, std::abs(p + header.offset[axis]));
    }
    const double error = 1.01 * kUnit * (product + place) + 0x1p-1070;
    length = std::hypot(length, error);
  }
  return 1.01 * length;
}

/// Consecutive records. Their points are stored from the place of the first record on.
struct LasBlock {
  size_t points = 0;
  FileFaces file_faces;
  Extremes extremes;
  uint64_t withheld = 0;
};

/// The points of a file, and the facts collected about them.
struct LasPoints {
  std::vector<DVec3> points;
  LasBlock all;
};

LasBlock read_block(const LasHeader& header, std::string_view bytes, bool keeps_withheld,
                    DVec3* points) {
  LasBlock block;
  for (size_t at = 0; at < bytes.size(); at += header.record_bytes) {
    const char* const record = bytes.data() + at;
    if (is_withheld(header, record) && ++block.withheld > 0 && !keeps_withheld) {
      block.file_faces.add(block.points, 0);
      continue;
    }
    DVec3& point = points[block.points++];
    for (size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<glm::length_t>(i);
      const auto number = load<int32_t>(record + 4 * i);
      point[axis] = number * header.scale[axis] + header.offset[axis];
      block.extremes.see(i, number);
    }
  }
  return block;
}

// Closes the gaps that withheld points leave between blocks.
LasPoints joined(std::vector<DVec3> points, const std::vector<LasBlock>& blocks, uint64_t rows) {
  LasPoints read;
  size_t end = 0;
  for (size_t i = 0; i < blocks.size(); ++i) {
    const LasBlock& block = blocks[i];
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(i * rows);
    if (end != i * rows)
      std::copy(first, first + static_cast<std::ptrdiff_t>(block.points),
                points.begin() + static_cast<std::ptrdiff_t>(end));
    read.all.file_faces.append(block.file_faces, end);
    read.all.extremes.see(block.extremes);
    read.all.withheld += block.withheld;
    end += block.points;
  }
  points.resize(end);
  read.points = std::move(points);
  return read;
}

LasPoints read_points(const MeshSource& source, const LasHeader& header, const ThreadPool& pool) {
  Windows windows(source);
  const uint64_t rows = std::max<uint64_t>(1, block_bytes_of(source) / header.record_bytes);
  std::vector<LasBlock> blocks((header.count + rows - 1) / rows);
  std::vector<DVec3> points;
  resize_together(pool, points, header.count);
  pool.for_each(blocks.size(), [&](size_t i) {
    const uint64_t first = i * rows, count = std::min(rows, header.count - first);
    const uint64_t begin = header.begin + first * header.record_bytes;
    Windows::Window window(windows);
    const auto bytes = window.read(begin, begin + count * header.record_bytes);
    blocks[i] =
        read_block(header, bytes, source.limits.bodies == Bodies::kAll, points.data() + first);
    count_read(source, bytes.size());
  });
  return joined(std::move(points), blocks, rows);
}

ReadMesh read_las(const MeshSource& source) {
  const LasHeader header = read_las_header(source);
  FileMeshBuilder(source).check_room(header.count, header.count);
  const ThreadPool pool = pool_of(source);
  LasPoints read = read_points(source, header, pool);
  const LasBlock& all = read.all;
  if (read.points.empty())
    refuse(source, 107, all.withheld > 0 ? "no point that is not withheld" : "no point",
           "at least one point");
  ReadMesh mesh = make_points(source.name, std::move(read.points), pool);
  mesh.file_faces = all.file_faces;
  mesh.delta = delta_of(header, all.extremes);
  const bool keeps = source.limits.bodies == Bodies::kAll;
  if (all.withheld > 0)
    mesh.notes.push_back(
        note_of(NoteCode::kBodies,
                (keeps ? "included, though withheld: " : "left out as withheld: ") +
                    counted(all.withheld, "point"),
                {static_cast<double>(all.withheld), "points"}));
  return mesh;
}

}  // namespace
}  // namespace las

ReadMesh parse_las(const MeshSource& source) { return las::read_las(source); }

}  // namespace vkh
