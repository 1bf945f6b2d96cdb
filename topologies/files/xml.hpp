#pragma once
// Elements of an XML file, read with Expat.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace topologies {

/// Names have no prefix: `space` is the address of their namespace, "" without one.
struct XmlElement {
  std::string space, name;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< those without a prefix
  std::string text;  ///< all text that is directly in the element, trimmed
  std::vector<XmlElement> children;
  int line = 0;  ///< of its start tag

  /// The value of an attribute; "" without one.
  std::string attribute(std::string_view key) const;
};

/// The root element of a text, with its elements down to `depth` levels; leaves out deeper ones.
/// Throws BadInput with the line if the text is not well-formed, has a prefix that is bound to no
/// namespace, refers to an entity in another file, or has an encoding other than UTF-8, UTF-16,
/// ISO-8859-1 and US-ASCII. `file` is for messages.
XmlElement read_xml(const std::string& text, int depth, const std::string& file);

}  // namespace topologies
