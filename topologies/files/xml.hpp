#pragma once
// Elements of an XML file, read with Expat.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace topologies {

/// An element. `name` is without its prefix; `space` is the address of its namespace, or "" if it
/// has none.
struct XmlElement {
  std::string space, name;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< only those without prefix
  std::string text;  ///< all text that is directly in the element, trimmed
  std::vector<XmlElement> children;
  int line = 0;  ///< of its start tag

  /// The value of the attribute `key`; "" if it is missing.
  std::string attribute(std::string_view key) const;
};

/// The root element of a text, with its elements down to `depth` levels; omits deeper ones. Throws
/// BadInput with the line if the text is not well-formed, has a prefix that is bound to no
/// namespace, refers to an entity in another file, or has an encoding other than UTF-8, UTF-16,
/// ISO-8859-1 and US-ASCII. `file` is for messages.
XmlElement read_xml(const std::string& text, int depth, const std::string& file);

}  // namespace topologies
