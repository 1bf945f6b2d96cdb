#include "renderer/files/obj_materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "renderer/files/beside.hpp"

namespace renderer {

namespace {

// Splits a text at blanks. The returned words point into the text.
std::vector<std::string_view> split_words(std::string_view text) {
  std::vector<std::string_view> words;
  for (;;) {
    text = base::trim(text);
    if (text.empty()) return words;
    words.push_back(text.substr(0, text.find_first_of(" \t")));
    text.remove_prefix(words.back().size());
  }
}

// The part of a text from the start of the word `first` to the end of the word `last`.
std::string_view span_words(std::string_view first, std::string_view last) {
  return {first.data(), static_cast<std::size_t>(last.data() + last.size() - first.data())};
}

}  // namespace

ObjMaterials::ObjMaterials(const std::string& name,
                           const std::vector<ObjItems::Libraries>& libraries, ObjTarget& target,
                           LeftOut& left_out)
    : target_(target), left_out_(left_out) {
  for (const auto& of_line : libraries) read_libraries(name, of_line);
}

// Reads the libraries that a line names. Blanks separate names, but may also be part of a name.
// From each word on, the longest name of an existing file counts.
void ObjMaterials::read_libraries(const std::string& name, const ObjItems::Libraries& libraries) {
  target_.line = libraries.line;
  const auto place = fmt::format("{}:{}", name, libraries.line);
  if (const auto whole = find_beside(name, libraries.files)) return read_library(*whole);
  const auto words = split_words(cut_comment(libraries.files));
  if (words.empty()) note_missing(place + ": found 'mtllib' without a name, expected a file");
  for (std::size_t i = 0; i < words.size();) {
    auto end = words.size();
    std::optional<std::string> path;
    while (end > i && !(path = find_beside(name, span_words(words[i], words[end - 1])))) --end;
    if (path) {
      read_library(*path);
      i = end;
      continue;
    }
    end = i + 1;
    while (end < words.size() && !base::to_lower(words[end - 1]).ends_with(".mtl")) ++end;
    note_missing(fmt::format("{}: found {}, expected the name of an existing file", place,
                             base::quote(span_words(words[i], words[end - 1]))));
    i = end;
  }
}

void ObjMaterials::read_library(const std::string& path) {
  if (std::ranges::find(libraries_, path) != libraries_.end()) return;
  libraries_.push_back(path);
  std::vector<MtlEntry> entries;
  try {
    entries = read_mtl(base::read_text(path), path, left_out_);
  } catch (const base::BadInput& bad) {
    return note_missing(bad.what());
  }
  target_.add_library(path);
  for (const MtlEntry& entry : entries) {
    const auto place = fmt::format("{}:{}", path, entry.line);
    const auto known = indices_.find(entry.material.name);
    if (known == indices_.end()) {
      at_place(place, [&] { add(entry); });
    } else if (materials_[known->second] != entry.material || maps_[known->second] != entry.map) {
      left_out_.add("materials",
                    fmt::format("{}: found a second material {}, expected another name", place,
                                base::quote(entry.material.name)));
    }
  }
}

void ObjMaterials::add(const MtlEntry& entry) {
  target_.add_material(entry.material);
  indices_[entry.material.name] = materials_.size();
  materials_.push_back(entry.material);
  maps_.push_back(entry.map);
}

void ObjMaterials::note_missing(const std::string& remark) {
  if (missing_++ == 0) missing_remark_ = remark;
}

std::optional<std::size_t> ObjMaterials::find(std::string_view text) const {
  const auto word = cut_comment(text);
  for (const auto& name : {text, word})
    if (const auto known = indices_.find(name); known != indices_.end()) return known->second;
  for (const auto& [name, index] : indices_)
    if (cut_comment(name) == text && !text.empty()) return index;
  return {};
}

std::size_t ObjMaterials::find_grey() {
  if (!grey_) {
    MtlEntry entry;
    entry.material.set_diffuse(LIGHT_GREY);
    entry.material.name = "light_grey";
    while (indices_.contains(entry.material.name)) entry.material.name += "_";
    grey_ = materials_.size();
    add(entry);
  }
  return *grey_;
}

std::string ObjMaterials::describe() const {
  constexpr std::size_t MOST = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(materials_.size(), MOST); ++i)
    if (grey_ != i)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", base::quote(materials_[i].name));
  return text.empty() ? "none" : text + (materials_.size() > MOST ? ", ..." : "");
}

}  // namespace renderer
