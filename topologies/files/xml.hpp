#pragma once
// Elements of an XML file, read with Expat.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace topologies {

/// One element of an XML file. `name` has no prefix; `space` is the address of its namespace, or ""
/// if it has none.
struct XmlElement {
  std::string space, name;
  /// Names and values of the attributes that have no prefix.
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< the text directly inside the element, trimmed
  std::vector<XmlElement> children;
  int line = 0;  ///< line of the start tag, counted from 1

  /// The value of the attribute `key`; "" if it is missing.
  std::string attribute(std::string_view key) const;
};

/// Returns the root element of an XML text, with `depth` levels of elements; omits deeper ones.
/// Throws BadInput with the line if the text is not well-formed, uses an undeclared prefix, refers
/// to an entity in another file, or has an encoding other than UTF-8, UTF-16, ISO-8859-1 and
/// US-ASCII. `file` names the text in messages.
XmlElement read_xml(const std::string& text, int depth, const std::string& file);

}  // namespace topologies
