#pragma once
// Conversion of drawings to PDF with Cairo.
#include <filesystem>
#include <string>

namespace laboratory {

/// Converts an SVG that tlab, gnuplot or Graphviz has drawn to a PDF of one page with the size of
/// the SVG. Texts stay texts, and their fonts are embedded. The PDF has no date, so that its bytes
/// depend only on the SVG, the version of Cairo, and the fonts. `name` is for messages. Throws
/// base::InvariantBroken for an element, path command or colour that such drawings do not contain,
/// and base::BadInput for malformed XML.
std::string svg_to_pdf(const std::string& svg, const std::string& name);

/// Writes NAME.svg and NAME.pdf into an existing folder.
void save_figure(const std::filesystem::path& folder, const std::string& name,
                 const std::string& svg);

}  // namespace laboratory
