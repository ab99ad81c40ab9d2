#include "vkhausdorff/certificate.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "host/read/corners_hash.h"
#include "host/survey/certificate_bytes.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Bits of a sample's barycentrics; bits of one in a subroot.
constexpr unsigned kWitnessBits = 20, kMostWitnessBits = 40;

class Bytes {
 public:
  std::string text;

  void unsigned_number(uint64_t x, int bytes) { append_unsigned(text, x, bytes); }
  void number(double x) { unsigned_number(std::bit_cast<uint64_t>(x == 0 ? 0.0 : x), 8); }
  void count(uint64_t x) { append_count(text, x); }
  // Writes 64 digits as 32 bytes; no digits: as many zeros.
  void digest(const std::string& digits) {
    const auto value = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    for (size_t i = 0; i < 64; i += 2)
      text +=
          digits.empty() ? '\0' : static_cast<char>(16 * value(digits[i]) + value(digits[i + 1]));
  }
};

// The hash is of the corners as the file has them, even if the mesh was placed elsewhere.
std::string corners_digest(const Mesh& mesh) {
  std::string digits = mesh.placed ? mesh.placed->corners : sha256_of_corners(mesh);
  if (digits.empty()) throw OutputError("--certificate: this build cannot make SHA-256 hashes");
  return digits;
}

uint64_t in_units(double barycentric, unsigned bits) {
  return static_cast<uint64_t>(std::llround(std::ldexp(barycentric, static_cast<int>(bits))));
}

unsigned bits_of(const glm::dvec3& barycentric) {
  const auto is_coarse = [](double x) {
    const double units = std::ldexp(x, kWitnessBits);
    return units == std::floor(units);
  };
  return is_coarse(barycentric.y) && is_coarse(barycentric.z) ? kWitnessBits : kMostWitnessBits;
}

void add_triangulations(Bytes& out, const std::vector<Triangulation>& triangulations) {
  out.unsigned_number(triangulations.size(), 8);
  uint64_t next = 0;
  for (const Triangulation& one : triangulations) {
    out.count(one.face - next);
    next = one.face + 1;
    out.count(one.corners);
    out.count(static_cast<uint64_t>(one.axis));
    for (const UVec3& triangle : one.triangles) {
      for (int i = 0; i < 3; ++i) out.count(triangle[i]);
    }
  }
}

// A checker places the corners exactly, so that no rounding there counts.
double delta_of(const Mesh& mesh) { return mesh.placed ? mesh.placed->delta : mesh.delta; }

void add_placement(Bytes& out, const MeshTransform& placement) {
  out.number(placement.numerator);
  out.number(placement.denominator);
  out.unsigned_number(placement.matrix ? 1 : 0, 8);
  if (!placement.matrix) return;
  for (const auto& row : *placement.matrix) {
    for (const double entry : row) out.number(entry);
  }
}

// Writes how the file was read, and where it was put.
void add_description(Bytes& out, const Mesh& mesh) {
  out.unsigned_number(mesh.are_points ? 1 : 0, 4);
  out.unsigned_number(mesh.has_all_bodies ? 1 : 0, 4);
  out.number(mesh.polygons.ambiguity);
  out.unsigned_number(mesh.polygons.ambiguous_face, 8);
  add_placement(out, mesh.placed ? mesh.placed->by : MeshTransform{});
  add_triangulations(out, mesh.polygons.triangulations);
}

void add_direction(Bytes& out, const CertifiedDirection& direction) {
  const Report& r = direction.report;
  const bool has_witness = r.has_witness && r.lower > 0;
  const unsigned bits = bits_of(r.witness_a.barycentric);
  out.number(has_witness ? r.lower : 0);
  out.number(direction.proof.upper);
  out.unsigned_number(has_witness ? r.witness_a.face : 0, 4);
  out.unsigned_number(has_witness ? bits : 0, 4);
  out.unsigned_number(has_witness ? in_units(r.witness_a.barycentric.y, bits) : 0, 8);
  out.unsigned_number(has_witness ? in_units(r.witness_a.barycentric.z, bits) : 0, 8);
  out.text += direction.proof.blocks;
}

}  // namespace

std::string certificate_of(const CertifiedMesh& a, const CertifiedMesh& b,
                           const CertifiedDirection& a_to_b,
                           const std::optional<CertifiedDirection>& b_to_a) {
  if (a_to_b.proof.blocks.empty() || (b_to_a && b_to_a->proof.blocks.empty()))
    throw UsageError("a certificate needs the proof of each direction, as a prover makes it");
  Bytes out;
  out.text = "VHCERT02";
  out.unsigned_number(b_to_a ? 2 : 1, 4);
  out.unsigned_number(0, 4);
  for (const CertifiedMesh* one : {&a, &b}) out.unsigned_number(one->mesh.faces.size(), 8);
  for (const CertifiedMesh* one : {&a, &b}) out.number(delta_of(one->mesh));
  for (const CertifiedMesh* one : {&a, &b}) out.digest(one->sha256);
  for (const CertifiedMesh* one : {&a, &b}) out.digest(corners_digest(one->mesh));
  for (const CertifiedMesh* one : {&a, &b}) add_description(out, one->mesh);
  add_direction(out, a_to_b);
  if (b_to_a) add_direction(out, *b_to_a);
  return std::move(out.text);
}

}  // namespace vkh
