#include "renderer/files/text/left_out.hpp"

#include <fmt/format.h>

namespace renderer {

void LeftOut::count(const std::string& kind, const std::string& remark, std::size_t times,
                    bool is_replaced) {
  if (times == 0) return;
  Kind& known = kinds_[kind];
  known.count += times;
  known.is_replaced = is_replaced;
  if (known.remark.empty()) known.remark = remark;
}

template <class IsListed>
std::string LeftOut::list(const IsListed& is_listed) const {
  std::string text;
  for (const auto& [name, kind] : kinds_)
    if (is_listed(kind))
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, kind.count);
  return text;
}

std::string LeftOut::describe() const {
  return list([](const Kind& kind) { return !kind.is_replaced; });
}

std::vector<std::string> LeftOut::describe_remarks() const {
  std::vector<std::string> sentences;
  for (const auto& [name, kind] : kinds_)
    if (!kind.remark.empty())
      sentences.push_back(fmt::format("{}; {}{} ({})", kind.remark,
                                      kind.is_replaced ? "" : "left out ", name, kind.count));
  return sentences;
}

std::vector<std::string> LeftOut::describe_all(const std::string& name) const {
  auto sentences = describe_remarks();
  const auto others = list([](const Kind& kind) { return kind.remark.empty(); });
  if (!others.empty()) sentences.push_back(fmt::format("{}: left out {}", name, others));
  return sentences;
}

}  // namespace renderer
