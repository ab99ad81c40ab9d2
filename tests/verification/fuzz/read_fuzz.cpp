// Fuzzes a reader: for any bytes it gives a valid mesh or one line that names the error, in
// six times the memory of the larger of file and mesh. --reader=NAME selects the reader; tools/fuzz
// runs it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "host/read/readers.h"
#include "tests/files/stored_zip.h"
#include "tests/verification/fuzz/allocations.h"
#include "tests/verification/fuzz/fuzz_target.h"
#include "tests/verification/fuzz/mesh_mutator.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/note.h"

namespace {

using namespace vkh;
using namespace vkh::test;

// A 3MF file's model part and, behind a zero byte, a slicer's file beside it; the parts of a zip
// archive are libzip's work, and `any` tests them.
ReadMesh parse_3mf_model(const MeshSource& model) {
  const std::string_view bytes = model.bytes;
  const size_t end = std::min(bytes.find('\0'), bytes.size());
  Parts others;
  if (end < bytes.size()) {
    const std::string config(bytes.substr(end + 1));
    const bool is_bambu = config.find("<part") != std::string::npos;
    others.emplace_back(
        is_bambu ? "Metadata/model_settings.config" : "Metadata/Slic3r_PE_model.config", config);
  }
  const std::string package = package_of(std::string(bytes.substr(0, end)), others);
  MeshSource source = model;
  source.bytes = package;
  return parse_3mf(source);
}

struct Reader {
  std::string_view name;
  const char* file;  ///< its extension decides if the content cannot
  ReadMesh (*parse)(const MeshSource&);
  MutateFile mutate;
};

// The content decides for `any`, as in read_mesh.
constexpr Reader kReaders[] = {{"any", "fuzz", parse_mesh, mutate_any},
                               {"gltf", "fuzz.gltf", parse_gltf, mutate_gltf},
                               {"glb", "fuzz.glb", parse_gltf, mutate_glb},
                               {"3mf", "fuzz.3mf", parse_3mf_model, mutate_xml},
                               {"obj", "fuzz.obj", parse_obj, mutate_text},
                               {"off", "fuzz.off", parse_off, mutate_off},
                               {"ply-ascii", "fuzz.ply", parse_ply, mutate_ply},
                               {"ply-binary", "fuzz.ply", parse_ply, mutate_ply},
                               {"stl-ascii", "fuzz.stl", parse_stl, mutate_text},
                               {"stl-binary", "fuzz.stl", parse_stl, mutate_stl},
                               {"las", "fuzz.las", parse_las, mutate_las},
                               {"xyz", "fuzz.xyz", parse_xyz, mutate_text}};
const Reader* g_reader = &kReaders[0];

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "read_fuzz: not so: %s\n", what);
  std::abort();
}

void require_valid(const ReadMesh& mesh) {
  require(!mesh.faces.empty() && mesh.counts.faces == mesh.faces.size(), "faces are counted");
  require(mesh.counts.vertices == mesh.vertices.size(), "vertices are counted");
  require(mesh.counts.degenerate <= mesh.faces.size(), "no more degenerate faces than faces");
  require(mesh.counts.duplicate < mesh.faces.size(), "the first of equal faces is no duplicate");
  std::vector<bool> used(mesh.vertices.size());
  for (const glm::uvec3& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      require(face[i] < used.size(), "indices are in range");
      used[face[i]] = true;
    }
  }
  require(std::find(used.begin(), used.end(), false) == used.end(), "every vertex is used");
  for (const glm::dvec3& p : mesh.vertices) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "finite coordinates");
  }
  for (const std::string& note : lines_of(mesh.notes)) {
    require(note.find('\n') == std::string::npos, "a note is one line");
    require(code_named(note.substr(0, note.find(": "))).has_value(), "a note begins with its code");
  }
}

void require_error_line(const std::string& line) {
  require(line.starts_with(g_reader->file), "an error names the file");
  require(line.find("; expected ") != std::string::npos, "an error says what was expected");
  require(line.size() < 400, "an error is short");
  for (const char c : line) require(static_cast<unsigned char>(c) >= 0x20, "an error is one line");
}

uint64_t bytes_of(const ReadMesh& mesh) {
  return mesh_bytes(mesh.counts.vertices + mesh.counts.unreferenced, mesh.counts.faces);
}

// Bytes that do not grow with the input, the same as in read_cost_test; libzip and expat take 130
// kB for the least package. In a package, a tag of up to 256 kB may be packed into next to nothing.
size_t constant_of(const MeshSource& source) {
  if (g_reader->parse == parse_3mf_model) return 256 << 10;
  return source.bytes.starts_with("PK") ? 2 << 20 : 64 << 10;
}

// The mesh of a refused file could have had 12 bytes for each byte of the file.
void read_counted(const MeshSource& source, ReadMesh& mesh, bool& accepted) {
  uint64_t larger = 12 * source.bytes.size();
  const AllocationCount count;
  try {
    mesh = g_reader->parse(source);
    accepted = true;
    larger = std::max<uint64_t>(source.bytes.size(), bytes_of(mesh));
  } catch (const InputError& error) {
    require_error_line(error.what());
  }
  require(count.peak() <= static_cast<int64_t>(6 * larger + constant_of(source)),
          "memory stays within six times the larger");
}

// A limit that the mesh just meets changes nothing, and one byte less refuses it.
void check_limit(const MeshSource& source, const ReadMesh& mesh) {
  MeshSource limited = source;
  limited.limits.max_input_bytes = bytes_of(mesh) - 1;
  try {
    g_reader->parse(limited);
    require(false, "a limit below the mesh's bytes is refused");
  } catch (const InputError& error) {
    require(std::string_view(error.what()).find("beyond the limit") != std::string_view::npos,
            "the refusal names the limit");
  }
}

bool same_bits(const glm::dvec3& p, const glm::dvec3& q) {
  return std::memcmp(&p, &q, sizeof(p)) == 0;
}

bool same(const ReadMesh& a, const ReadMesh& b) {
  const auto counts = [](const MeshCounts& c) {
    return std::array{c.unreferenced, c.degenerate, c.duplicate, c.polygons};
  };
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                    same_bits) &&
         a.faces == b.faces && a.file_faces.runs() == b.file_faces.runs() && a.notes == b.notes &&
         counts(a.counts) == counts(b.counts);
}

/// The mesh, or the error line.
std::string read(const MeshSource& source, ReadMesh& mesh) {
  try {
    mesh = g_reader->parse(source);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// Blocks of any size give what one gives.
void check_blocks(const MeshSource& source) {
  ReadMesh whole, joined;
  MeshSource by_blocks = source;
  by_blocks.limits = {.threads = 1, .block_bytes = 1 + source.bytes.size() % 61};
  require(read(source, whole) == read(by_blocks, joined), "blocks give the same error");
  require(same(whole, joined), "blocks give the same mesh");
}

// Requires that all of a scene has no less than its solid part; null: that was refused.
void check_bodies(const MeshSource& source, const ReadMesh* solid) {
  MeshSource whole = source;
  whole.limits.bodies = Bodies::kAll;
  ReadMesh mesh;
  bool accepted = false;
  read_counted(whole, mesh, accepted);
  if (!accepted) return;
  require_valid(mesh);
  require(solid == nullptr || mesh.faces.size() >= solid->faces.size(),
          "all is no less than solid");
}

// Requires points of a file that is read as such, and a mesh's faces to be refused then.
void check_points(const MeshSource& source, const ReadMesh* surface) {
  MeshSource alone = source;
  alone.limits.points = true;
  ReadMesh mesh;
  bool accepted = false;
  read_counted(alone, mesh, accepted);
  if (!accepted) return;
  require_valid(mesh);
  require(mesh.are_points && mesh.faces.size() == mesh.vertices.size(), "points are faces");
  require(surface == nullptr || surface->are_points, "a file is a mesh or points, not both");
}

// The files beneath a document are found, or the document is refused; none is opened.
void check_files(const MeshSource& source) {
  if (g_reader->parse != parse_gltf) return;
  MeshSource placed = source;
  placed.folder = "no such folder";
  try {
    for (const FileBeneath& file : files_of_gltf(placed))
      require(!file.name.empty() && file.path.empty(), "a file beneath has a name alone");
  } catch (const InputError& error) {
    require_error_line(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--reader=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (!word.starts_with(kOption)) continue;
    const auto* const found = std::find_if(
        std::begin(kReaders), std::end(kReaders),
        [&](const Reader& reader) { return reader.name == word.substr(kOption.size()); });
    if (found == std::end(kReaders)) {
      std::fprintf(stderr, "read_fuzz: no reader '%s'\n", word.data() + kOption.size());
      std::exit(2);
    }
    g_reader = found;
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const MeshSource source{.name = g_reader->file,
                          .bytes = {reinterpret_cast<const char*>(data), size}};
  ReadMesh mesh;
  bool accepted = false;
  read_counted(source, mesh, accepted);
  if (size % 2 == 0) check_blocks(source);  // for speed
  check_files(source);
  const bool is_scene = g_reader->parse == parse_gltf || g_reader->parse == parse_3mf_model;
  if (is_scene && size % 2 == 1) check_bodies(source, accepted ? &mesh : nullptr);  // for speed
  if (!is_scene && size % 2 == 1) check_points(source, accepted ? &mesh : nullptr);
  if (!accepted) return 0;
  require_valid(mesh);
  if (size % 4 == 0) {  // for speed
    check_limit(source, mesh);
    require(same(mesh, g_reader->parse(source)), "a file is read alike twice");
  }
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  return g_reader->mutate(data, size, max_size, seed);
}
