// Writes points near a wavy torus, and the torus, without any library: for a machine that has a
// compiler alone. One LAS unit is 2^-16.
//
//   c++ -O2 -std=c++20 -o cloud cloud.cpp && ./cloud POINTS
//
// b.ply: 1,000,000 faces, binary; pts.ply: binary floats; pts.las: LAS 1.2, point format 0.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

using Point = std::array<double, 3>;

// xorshift64 (Marsaglia, 2003): the same points everywhere but for sin and cos.
class Random {
 public:
  double next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_ = 88172645463325252U;
};

Point on_torus(double u, double v) {
  constexpr double kTurn = 6.283185307179586;
  const double angle = kTurn * u, around = kTurn * v;
  const double r = 30 + 3 * std::sin(9 * angle) * std::cos(7 * around);
  const double out = 100 + r * std::cos(around);
  return {out * std::cos(angle), out * std::sin(angle), r * std::sin(around)};
}

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

void put_floats(std::string& to, const Point& p) {
  for (const double x : p) put(to, static_cast<float>(x));
}

std::string ply_head(uint64_t vertices) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n";
}

void write_torus() {
  constexpr uint32_t kRound = 1000, kAcross = 500;
  std::string text = ply_head(kRound * kAcross) + "element face " +
                     std::to_string(2 * kRound * kAcross) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (uint32_t i = 0; i < kRound; ++i) {
    for (uint32_t j = 0; j < kAcross; ++j)
      put_floats(text, on_torus(double{1} * i / kRound, double{1} * j / kAcross));
  }
  const auto at = [](uint32_t i, uint32_t j) { return i % kRound * kAcross + j % kAcross; };
  const auto put_face = [&](uint32_t a, uint32_t b, uint32_t c) {
    put(text, uint8_t{3});
    for (const uint32_t corner : {a, b, c}) put(text, corner);
  };
  for (uint32_t i = 0; i < kRound; ++i) {
    for (uint32_t j = 0; j < kAcross; ++j) {
      put_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      put_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  std::ofstream("b.ply", std::ios::binary) << text;
}

constexpr double kStep = 0x1p-16;
constexpr Point kOrigin = {-200, -200, -50};

std::string las_head(uint32_t points) {
  std::string head(227, '\0');
  const auto put_at = [&](size_t at, auto value) {
    head.replace(at, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
  };
  head.replace(0, 4, "LASF");
  head[24] = 1;
  head[25] = 2;
  put_at(94, uint16_t{227});  // the header's bytes
  put_at(96, uint32_t{227});  // the first point's byte
  put_at(105, uint16_t{20});  // a point's bytes
  put_at(107, points);
  for (size_t i = 0; i < 3; ++i) {
    put_at(131 + 8 * i, kStep);
    put_at(155 + 8 * i, kOrigin[i]);
  }
  return head;
}

void put_las(std::string& to, const Point& p) {
  for (size_t i = 0; i < 3; ++i)
    put(to, static_cast<int32_t>(std::lround((p[i] - kOrigin[i]) / kStep)));
  to.append(8, '\0');
}

void write_points(uint64_t count) {
  std::ofstream ply("pts.ply", std::ios::binary), las("pts.las", std::ios::binary);
  ply << ply_head(count) << "end_header\n";
  las << las_head(static_cast<uint32_t>(count));
  Random random;
  std::string floats, rows;
  for (uint64_t i = 0; i < count; ++i) {
    const double v = random.next(), u = random.next();
    Point p = on_torus(u, v);
    for (double& x : p) x += 0.2 * (random.next() + random.next() + random.next() - 1.5);
    put_floats(floats, p);
    put_las(rows, p);
    if (floats.size() < size_t{1} << 24 && i + 1 < count) continue;
    ply << floats;
    las << rows;
    floats.clear();
    rows.clear();
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  write_torus();
  write_points(std::strtoull(words[1], nullptr, 10));
}
