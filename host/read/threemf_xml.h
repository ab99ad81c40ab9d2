// A part's XML, element by element, by expat.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "host/read/threemf_package.h"

namespace vkh::threemf {

/// An element's attributes, by name. One of another namespace is "URI|name".
class Attributes {
 public:
  explicit Attributes(const char** pairs) : pairs_(pairs) {}
  /// The value, or null if there is none.
  const char* find(std::string_view name) const;

 private:
  const char** pairs_;
};

/// The reader of a part. Names of elements are "URI|name".
class XmlReader {
 public:
  virtual ~XmlReader() = default;
  virtual void open(std::string_view name, const Attributes& attributes) = 0;
  virtual void close(std::string_view name) = 0;
  /// Called with the text between tags, in pieces.
  virtual void text(std::string_view /*piece*/) {}
  /// Called with a prefix of a namespace, before the element that declares it.
  virtual void declare(std::string_view /*prefix*/, std::string_view /*uri*/) {}

  size_t line = 1;  ///< line of the text that is being read
};

/// Throws what the reader throws, and rejects text that is no XML, has a document type (entities
/// are the bombs of XML) or a tag of more than a quarter of a megabyte.
void read_xml(const MeshSource& source, Package& package, const std::string& part,
              XmlReader& reader);

/// Returns "part '3D/3dmodel.model', line 7"... the file's line first, as errors have it.
std::string place_in(const std::string& part, size_t line);

}  // namespace vkh::threemf
