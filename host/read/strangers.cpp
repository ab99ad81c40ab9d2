#include "host/read/strangers.h"

#include <algorithm>
#include <array>

#include "host/read/file_mesh_builder.h"

namespace vkh {
namespace {

enum class Holds {
  kSurfaces,
  kPoints,  ///< points that are read where points are asked for
  kScans,   ///< points in a format that is not read
  kVoxels,
  kPath,
  kMesh
};

struct Format {
  std::string_view name;  ///< with its article
  Holds holds;
  std::string_view extensions;  ///< each between blanks
};

constexpr std::array<Format, 31> kFormats = {{
    {"a STEP file", Holds::kSurfaces, " .step .stp .p21 "},
    {"an IGES file", Holds::kSurfaces, " .iges .igs "},
    {"a Parasolid file", Holds::kSurfaces, " .x_t .x_b .xmt_txt .xmt_bin "},
    {"an ACIS file", Holds::kSurfaces, " .sat .sab "},
    {"an Open CASCADE file", Holds::kSurfaces, " .brep .brp "},
    {"a JT file", Holds::kSurfaces, " .jt "},
    {"a CAD program's file", Holds::kSurfaces,
     " .sldprt .sldasm .catpart .catproduct .ipt .iam .prt .asm .par .psm .f3d "},
    {"a FreeCAD file", Holds::kSurfaces, " .fcstd "},
    {"a Rhino file", Holds::kSurfaces, " .3dm "},
    {"an AutoCAD file", Holds::kSurfaces, " .dwg .dxf "},
    {"a LAS file", Holds::kPoints, " .las "},
    {"a text", Holds::kPoints, " .xyz .pts .asc "},
    {"a LAZ file", Holds::kScans, " .laz "},
    {"an E57 file", Holds::kScans, " .e57 "},
    {"a PCD file", Holds::kScans, " .pcd "},
    {"a PTX file", Holds::kScans, " .ptx "},
    {"a scanner's file", Holds::kScans, " .rcp .rcs .fls .fws "},
    {"a DICOM file", Holds::kVoxels, " .dcm "},
    {"a NIfTI file", Holds::kVoxels, " .nii "},
    {"a volume", Holds::kVoxels, " .mha .mhd .nrrd .vti "},
    {"G-code", Holds::kPath, " .gcode "},
    {"an FBX file", Holds::kMesh, " .fbx "},
    {"a COLLADA file", Holds::kMesh, " .dae "},
    {"a Blender file", Holds::kMesh, " .blend "},
    {"an AMF file", Holds::kMesh, " .amf "},
    {"a VTK file", Holds::kMesh, " .vtk .vtp .vtu "},
    {"a VRML or X3D file", Holds::kMesh, " .wrl .vrml .x3d "},
    {"a USD file", Holds::kMesh, " .usd .usda .usdc .usdz "},
    {"a Gmsh file", Holds::kMesh, " .msh "},
    {"a finite-element model", Holds::kMesh, " .mesh .meshb .nas .bdf .inp .unv "},
    {"a mesh of another program", Holds::kMesh, " .3ds .ctm .drc .lwo .abc "},
}};

/// The beginnings of formats whose files often have a wrong extension or none, and the right
/// extension.
struct Beginning {
  std::string_view bytes, extension;
};
constexpr std::array<Beginning, 12> kBeginnings = {{{"ISO-10303-21", ".step"},
                                                    {"3D Geometry File Format", ".3dm"},
                                                    {"AC10", ".dwg"},
                                                    {"LASF", ".las"},
                                                    {"ASTM-E57", ".e57"},
                                                    {"# .PCD", ".pcd"},
                                                    {"Kaydara FBX Binary", ".fbx"},
                                                    {"BLENDER", ".blend"},
                                                    {"# vtk DataFile", ".vtk"},
                                                    {"#VRML", ".wrl"},
                                                    {"PXR-USDC", ".usdc"},
                                                    {"$MeshFormat", ".msh"}}};

constexpr const char* kExports = "STL, OBJ, PLY, OFF, glTF or 3MF";

Stranger described(const Format& format) {
  const std::string name(format.name), as = std::string(" as ") + kExports;
  switch (format.holds) {
    case Holds::kSurfaces:
      return {name + " (CAD geometry, no plain triangles)", "a mesh: export the part" + as};
    case Holds::kPoints:
      return {name + " (points, no faces)", kAMesh};
    case Holds::kScans:
      return {name + " of points, which is not read",
              "the points as PLY, LAS or XYZ, with --points; or a mesh of them" + as};
    case Holds::kVoxels:
      return {name + " (voxels, no faces)", "a mesh: export the segmented surface" + as};
    case Holds::kPath:
      return {name + " (a tool's path, no faces)", "the mesh that it was made from"};
    case Holds::kMesh:
      break;
  }
  return {name + ", which is not read", "the mesh exported" + as};
}

// Recognises COLLADA's root element, or a web page's, behind a declaration and comments.
Stranger stranger_in_xml(std::string_view head) {
  if (head.find("<COLLADA") != std::string_view::npos) return stranger_by_extension(".dae");
  for (const std::string_view page : {"<!DOCTYPE html", "<!doctype html", "<html", "<HTML"}) {
    if (head.find(page) != std::string_view::npos)
      return {"a web page", "the file that it leads to"};
  }
  return {};
}

}  // namespace

Stranger stranger_by_content(std::string_view head) {
  for (const Beginning& beginning : kBeginnings) {
    if (head.starts_with(beginning.bytes)) return stranger_by_extension(beginning.extension);
  }
  const size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  return head.substr(first).starts_with('<') ? stranger_in_xml(head) : Stranger();
}

Stranger stranger_by_extension(std::string_view extension) {
  if (extension.empty()) return {};
  const std::string word = " " + std::string(extension) + " ";
  for (const Format& format : kFormats) {
    if (format.extensions.find(word) != std::string_view::npos) return described(format);
  }
  return {};
}

}  // namespace vkh
