#include "tools/bench/manifest.h"

#include <fstream>
#include <map>
#include <stdexcept>

namespace vkh::bench {
namespace {

// One line of CSV; a quoted field may hold commas.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

std::vector<Row> read_manifest(const std::filesystem::path& manifest, const Choice& choice) {
  std::ifstream file(manifest);
  if (!file) throw std::runtime_error(manifest.string() + ": cannot be opened");
  std::string line;
  std::getline(file, line);
  std::map<std::string, size_t> column;
  const std::vector<std::string> names = fields_of(line);
  for (size_t i = 0; i < names.size(); ++i) column[names[i]] = i;
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> f = fields_of(line);
    Row row{.pair = f.at(column.at("pair")),
            .family = column.contains("family") ? f.at(column.at("family")) : "",
            .file_a = manifest.parent_path() / f.at(column.at("file_a")),
            .file_b = manifest.parent_path() / f.at(column.at("file_b")),
            .faces_a = std::stoull(f.at(column.at("faces_a")))};
    if (row.faces_a <= choice.max_faces && row.pair.find(choice.filter) != std::string::npos)
      rows.push_back(row);
  }
  return rows;
}

}  // namespace vkh::bench
