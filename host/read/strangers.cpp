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
  std::string_view magic = {};  ///< the beginning of such files
};

constexpr std::array<Format, 43> kFormats = {{
    {"a STEP file", Holds::kSurfaces, " .step .stp .p21 ", "ISO-10303-21"},
    {"an IGES file", Holds::kSurfaces, " .iges .igs "},
    {"a Parasolid file", Holds::kSurfaces, " .x_t .x_b .xmt_txt .xmt_bin ",
     "**ABCDEFGHIJKLMNOPQRS"},
    {"an ACIS file", Holds::kSurfaces, " .sat .sab ", "ACIS BinaryFile"},
    {"an Open CASCADE file", Holds::kSurfaces, " .brep .brp ", "DBRep_DrawableShape"},
    {"a JT file", Holds::kSurfaces, " .jt "},
    {"a SolidWorks file", Holds::kSurfaces, " .sldprt .sldasm "},
    {"a CATIA file", Holds::kSurfaces, " .catpart .catproduct "},
    {"an Inventor file", Holds::kSurfaces, " .ipt .iam "},
    {"a file of NX, Creo or Solid Edge", Holds::kSurfaces, " .prt .asm .par .psm "},
    {"a Fusion file", Holds::kSurfaces, " .f3d "},
    {"a FreeCAD file", Holds::kSurfaces, " .fcstd "},
    {"a Rhino file", Holds::kSurfaces, " .3dm ", "3D Geometry File Format"},
    {"a DWG file", Holds::kSurfaces, " .dwg ", "AC10"},
    {"a DXF file", Holds::kSurfaces, " .dxf "},
    {"a LAS file", Holds::kPoints, " .las ", "LASF"},
    {"a text", Holds::kPoints, " .xyz .pts .asc "},
    {"a LAZ file", Holds::kScans, " .laz "},
    {"an E57 file", Holds::kScans, " .e57 ", "ASTM-E57"},
    {"a PCD file", Holds::kScans, " .pcd ", "# .PCD"},
    {"a PTX file", Holds::kScans, " .ptx "},
    {"a scanner's file", Holds::kScans, " .rcp .rcs .fls .fws "},
    {"a DICOM file", Holds::kVoxels, " .dcm "},
    {"a NIfTI file", Holds::kVoxels, " .nii "},
    {"a volume", Holds::kVoxels, " .mha .mhd .nrrd .vti ", "NRRD"},
    {"G-code", Holds::kPath, " .gcode "},
    {"an FBX file", Holds::kMesh, " .fbx ", "Kaydara FBX Binary"},
    {"a COLLADA file", Holds::kMesh, " .dae "},
    {"a 3DS file", Holds::kMesh, " .3ds "},
    {"a Blender file", Holds::kMesh, " .blend ", "BLENDER"},
    {"an AMF file", Holds::kMesh, " .amf "},
    {"a VTK file", Holds::kMesh, " .vtk .vtp .vtu ", "# vtk DataFile"},
    {"a VRML file", Holds::kMesh, " .wrl .vrml ", "#VRML"},
    {"an X3D file", Holds::kMesh, " .x3d "},
    {"a USD file", Holds::kMesh, " .usd .usdc .usdz ", "PXR-USDC"},
    {"a USD file", Holds::kMesh, " .usda ", "#usda"},
    {"an OpenCTM file", Holds::kMesh, " .ctm ", "OCTM"},
    {"a Gmsh file", Holds::kMesh, " .msh ", "$MeshFormat"},
    {"a Draco file", Holds::kMesh, " .drc ", "DRACO"},
    {"a LightWave file", Holds::kMesh, " .lwo "},
    {"an Alembic file", Holds::kMesh, " .abc ", "Ogawa"},
    {"a file of Medit or Ogre", Holds::kMesh, " .mesh .meshb ", "MeshVersionFormatted"},
    {"a finite-element model", Holds::kMesh, " .nas .bdf .inp .unv "},
}};

constexpr const char* kExports = "STL, OBJ, PLY, OFF, glTF or 3MF";

Stranger told(const Format& format) {
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

// Recognises a format in XML by its root element, behind a declaration and comments.
Stranger stranger_in_xml(std::string_view head) {
  struct Root {
    std::string_view begin, extension;
  };
  constexpr std::array<Root, 4> kRoots = {
      {{"<COLLADA", ".dae"}, {"<VTKFile", ".vtp"}, {"<X3D", ".x3d"}, {"<amf", ".amf"}}};
  for (const Root& root : kRoots) {
    if (head.find(root.begin) != std::string_view::npos)
      return stranger_by_extension(root.extension);
  }
  for (const std::string_view page : {"<!DOCTYPE html", "<!doctype html", "<html", "<HTML"}) {
    if (head.find(page) != std::string_view::npos)
      return {"a web page", "the file that it leads to"};
  }
  return {};
}

// Recognises lines of 80 columns, with a letter and a number at their ends.
bool is_iges(std::string_view head) {
  return head.size() >= 80 && head[72] == 'S' && head[79] == '1' &&
         head.substr(73, 6).find_first_not_of(" 0") == std::string_view::npos;
}

}  // namespace

Stranger stranger_by_content(std::string_view head) {
  for (const Format& format : kFormats) {
    if (!format.magic.empty() && head.starts_with(format.magic)) return told(format);
  }
  const size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  if (head.substr(first).starts_with('<')) return stranger_in_xml(head);
  return is_iges(head) ? stranger_by_extension(".iges") : Stranger();
}

Stranger stranger_by_extension(std::string_view extension) {
  if (extension.empty()) return {};
  const std::string word = " " + std::string(extension) + " ";
  for (const Format& format : kFormats) {
    if (format.extensions.find(word) != std::string_view::npos) return told(format);
  }
  return {};
}

}  // namespace vkh
