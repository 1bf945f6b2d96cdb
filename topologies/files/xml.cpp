#include "topologies/files/xml.hpp"

#include <expat.h>

#include <memory>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace topologies {
namespace {

// Expat puts this character between the namespace and the name. Neither of them contains it.
constexpr char SEPARATOR = '\n';

// State of the parser, with the elements read so far.
struct Reading {
  XML_Parser parser;
  int depth;                          // levels of elements to keep; deeper elements are omitted
  int level = 0;                      // number of open elements
  std::vector<XmlElement> open = {};  // the open elements to keep, the root first
  XmlElement root = {};
  std::string skipped = {};  // name of an entity that Expat cannot resolve
};

// Expat 2.9 deprecates XML_GetCurrentLineNumber in favour of XML_GetCurrentLineNumber64.
template <typename Parser>
int line_of(Parser parser) {
  if constexpr (requires { XML_GetCurrentLineNumber64(parser); })
    return static_cast<int>(XML_GetCurrentLineNumber64(parser));
  else
    return static_cast<int>(XML_GetCurrentLineNumber(parser));
}

void begin_element(void* data, const XML_Char* name, const XML_Char** attributes) {
  auto& reading = *static_cast<Reading*>(data);
  if (++reading.level > reading.depth) return;
  XmlElement element;
  element.line = line_of(reading.parser);
  element.name = name;
  if (const auto end = element.name.find(SEPARATOR); end != std::string::npos) {
    element.space = element.name.substr(0, end);
    element.name.erase(0, end + 1);
  }
  for (; *attributes != nullptr; attributes += 2)
    if (std::string_view(attributes[0]).find(SEPARATOR) == std::string_view::npos)
      element.attributes.emplace_back(attributes[0], attributes[1]);
  reading.open.push_back(std::move(element));
}

void end_element(void* data, const XML_Char*) {
  auto& reading = *static_cast<Reading*>(data);
  if (reading.level-- > reading.depth) return;
  auto element = std::move(reading.open.back());
  reading.open.pop_back();
  element.text = std::string(base::trim(element.text));
  if (reading.open.empty())
    reading.root = std::move(element);
  else
    reading.open.back().children.push_back(std::move(element));
}

void add_text(void* data, const XML_Char* text, int length) {
  auto& reading = *static_cast<Reading*>(data);
  if (reading.level <= reading.depth)
    reading.open.back().text.append(text, static_cast<std::size_t>(length));
}

void skip_entity(void* data, const XML_Char* name, int) {
  auto& reading = *static_cast<Reading*>(data);
  reading.skipped = name;
  XML_StopParser(reading.parser, XML_FALSE);
}

}  // namespace

std::string XmlElement::attribute(std::string_view key) const {
  for (const auto& [name, value] : attributes)
    if (name == key) return value;
  return "";
}

XmlElement read_xml(const std::string& text, int depth, const std::string& file) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreateNS(nullptr, SEPARATOR), XML_ParserFree);
  Reading reading{parser.get(), depth};
  XML_SetUserData(parser.get(), &reading);
  XML_SetElementHandler(parser.get(), begin_element, end_element);
  XML_SetCharacterDataHandler(parser.get(), add_text);
  XML_SetSkippedEntityHandler(parser.get(), skip_entity);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) ==
      XML_STATUS_OK)
    return std::move(reading.root);
  const auto place = fmt::format("{}: line {}", file, line_of(parser.get()));
  if (!reading.skipped.empty())
    base::refuse(place, "malformed XML: the entity {} is not defined in this file",
                 base::quote(reading.skipped));
  base::refuse(place, "malformed XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get())));
}

}  // namespace topologies
