#include "renderer/files/beside.hpp"

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"

namespace renderer {

std::string_view cut_comment(std::string_view text) {
  const auto is_blank = [&](std::size_t at) {
    return at >= text.size() || text[at] == ' ' || text[at] == '\t';
  };
  for (auto at = text.find('#'); at != text.npos; at = text.find('#', at + 1))
    if (is_blank(at - 1) && is_blank(at + 1)) return base::trim(text.substr(0, at));
  return text;
}

std::optional<std::string> find_beside(const std::string& name, std::string_view text) {
  const auto folder = std::filesystem::path(name).parent_path();
  for (std::string_view part : {text, cut_comment(text)}) {
    if (part.size() > 2 && part.starts_with('"') && part.ends_with('"'))
      part = part.substr(1, part.size() - 2);
    std::string with_slashes(part);
    std::ranges::replace(with_slashes, '\\', '/');
    for (const auto& file : {std::string(part), with_slashes}) {
      const auto path = folder / file;
      std::error_code ignored;
      if (!file.empty() && std::filesystem::is_regular_file(path, ignored)) return path.string();
    }
  }
  return {};
}

}  // namespace renderer
