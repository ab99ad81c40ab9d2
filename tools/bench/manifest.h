// Pairs of mesh files to time, from a CSV with a header: pair,file_a,file_b,faces_a,...
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vkh::bench {

struct Row {
  std::string pair, family;
  std::filesystem::path file_a, file_b;  ///< beside the manifest
  uint64_t faces_a = 0;
};

struct Choice {
  std::string filter;  ///< part of the pair's name
  uint64_t max_faces = UINT64_MAX;
};

std::vector<Row> read_manifest(const std::filesystem::path& manifest, const Choice& choice);

}  // namespace vkh::bench
