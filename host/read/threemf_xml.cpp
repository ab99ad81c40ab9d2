#include "host/read/threemf_xml.h"

#include <expat.h>

#include <cstring>
#include <exception>
#include <memory>

#include "host/base/reject.h"

namespace vkh::threemf {
namespace {

// Expat keeps a tag as a whole, and older versions look at it again with each piece.
constexpr uint64_t kLongestTag = 1 << 18;

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
using Parser = std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser>;

/// No exception may pass through expat, which is C: it is kept, and parsing is stopped.
struct Session {
  XML_Parser parser = nullptr;
  XmlReader* reader = nullptr;
  std::exception_ptr thrown;
  uint64_t seen = 0;  ///< the byte that the last event of any kind began at

  void note() {
    const XML_Index at = XML_GetCurrentByteIndex(parser);
    if (at > 0) seen = static_cast<uint64_t>(at);
  }

  template <class Call>
  void guard(const Call& call) {
    if (thrown) return;
    note();
    try {
      reader->line = XML_GetCurrentLineNumber(parser);
      call();
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }
};

Session& session_of(void* data) { return *static_cast<Session*>(data); }

void on_open(void* data, const char* name, const char** attributes) {
  Session& session = session_of(data);
  session.guard([&] { session.reader->open(name, Attributes(attributes)); });
}
void on_close(void* data, const char* name) {
  Session& session = session_of(data);
  session.guard([&] { session.reader->close(name); });
}
void on_namespace(void* data, const char* prefix, const char* uri) {
  Session& session = session_of(data);
  session.guard(
      [&] { session.reader->declare(prefix == nullptr ? "" : prefix, uri == nullptr ? "" : uri); });
}
void on_text(void* data, const char* text, int length) {
  Session& session = session_of(data);
  session.guard([&] { session.reader->text({text, static_cast<size_t>(length)}); });
}
// Notes comments and everything else that no reader uses.
void on_other(void* data, const char* /*text*/, int /*length*/) { session_of(data).note(); }
void on_doctype(void* data, const char* /*name*/, const char* /*system*/, const char* /*open*/,
                int /*has_subset*/) {
  Session& session = session_of(data);
  session.guard([] { throw std::invalid_argument("a document type, which 3MF forbids"); });
}

}  // namespace

const char* Attributes::find(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (name == *pair) return pair[1];
  }
  return nullptr;
}

std::string place_in(const std::string& part, size_t line) {
  return "line " + std::to_string(line) + " of " + vkh::quoted(part);
}

void read_xml(const MeshSource& source, Package& package, const std::string& part,
              XmlReader& reader) {
  const Parser parser(XML_ParserCreateNS(nullptr, '|'));
  if (!parser) throw std::bad_alloc();
  Session session{.parser = parser.get(), .reader = &reader, .thrown = {}};
  XML_SetUserData(parser.get(), &session);
  XML_SetElementHandler(parser.get(), on_open, on_close);
  XML_SetNamespaceDeclHandler(parser.get(), on_namespace, nullptr);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_doctype);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetDefaultHandler(parser.get(), on_other);
  uint64_t fed = 0;
  const auto fail = [&](const std::string& what) {
    reject(source.name, place_in(part, XML_GetCurrentLineNumber(parser.get())), what, "XML of 3MF");
  };
  const auto feed = [&](std::string_view piece, bool is_last) {
    const XML_Status status = XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()),
                                        is_last ? XML_TRUE : XML_FALSE);
    try {
      if (session.thrown) std::rethrow_exception(session.thrown);
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    }
    if (status != XML_STATUS_OK) fail(XML_ErrorString(XML_GetErrorCode(parser.get())));
    fed += piece.size();
    if (!is_last && fed - session.seen > kLongestTag)
      fail("a tag of more than " + counted(kLongestTag, "byte"));
  };
  package.read(part, [&](std::string_view piece) { feed(piece, false); });
  feed("", true);
}

}  // namespace vkh::threemf
