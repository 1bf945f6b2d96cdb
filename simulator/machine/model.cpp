#include "simulator/machine/model.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace machine {

namespace {

double get(const Model& model, const NamedNumbers& numbers, std::string_view section,
           std::string_view name) {
  const auto found = numbers.find(name);
  if (found == numbers.end())
    throw base::BadInput(fmt::format("model {}: {}.{} is missing", model.name, section, name));
  return found->second;
}

std::string show(const Entry& e) {
  return e.formula.empty() ? to_text(e.value) : fmt::format("{} = {}", to_text(e.value), e.formula);
}

std::string row(const Entry& e) {
  const std::string formula = e.formula.empty() ? "" : fmt::format(" = {}; ", e.formula);
  return fmt::format("{:<28} {:>12} {:<8} {:<11} {}{}\n", e.key, to_text(e.value), e.unit,
                     to_string(e.provenance), formula, e.source);
}

const Entry* find(const Model& model, std::string_view key) {
  const auto found = std::ranges::find(model.entries, key, &Entry::key);
  return found == model.entries.end() ? nullptr : &*found;
}

}  // namespace

std::string_view to_string(Provenance provenance) {
  constexpr std::string_view names[] = {"datasheet", "thesis", "calibrated", "assumed"};
  return names[static_cast<int>(provenance)];
}

std::uint64_t get_bytes(const Model& model, std::string_view name) {
  return static_cast<std::uint64_t>(get(model, model.bytes, "bytes", name));
}

Cycles get_instruction(const Model& model, std::string_view name) {
  return {std::llround(get(model, model.instruction, "instruction", name))};
}

Cycles get_operation(const Model& model, std::string_view name) {
  return {std::llround(get(model, model.operation, "operation", name))};
}

Cycles get_compiled(const Model& model, std::string_view name) {
  const auto cycles = static_cast<double>(get_operation(model, name).value);
  return {std::llround(cycles * get(model, model.scale, "scale", "router"))};
}

std::string to_text(double value) {
  return value >= 1 && value == std::floor(value) ? fmt::format("{:.0f}", value)
                                                  : fmt::format("{:g}", value);
}

std::string describe(const Model& model) {
  std::string text = fmt::format("model {}\n", model.name);
  for (const auto& e : model.entries) text += row(e);
  return text;
}

std::string describe_difference(const Model& a, const Model& b) {
  std::string text = fmt::format("{:<28} {:<28} {}\n", "entry", a.name, b.name);
  std::size_t same = 0;
  for (const auto& e : a.entries) {
    const Entry* other = find(b, e.key);
    if (other && other->value == e.value && other->formula == e.formula &&
        other->provenance == e.provenance && other->source == e.source) {
      ++same;
      continue;
    }
    const bool numbers_differ = !other || show(e) != show(*other);
    const auto cell = [&](const Entry* x) {
      if (!x) return std::string("-");
      return numbers_differ ? fmt::format("{} {}", show(*x), x->unit)
                            : fmt::format("{}: {}", to_string(x->provenance), x->source);
    };
    text += fmt::format("{:<28} {:<28} {}\n", e.key, cell(&e), cell(other));
  }
  for (const auto& e : b.entries)
    if (!find(a, e.key)) text += fmt::format("{:<28} {:<28} {} {}\n", e.key, "-", show(e), e.unit);
  return text + fmt::format("{} other entries are the same\n", same);
}

OperationCosts::OperationCosts(const Model& model, std::string_view kernel,
                               std::span<const std::string_view> names) {
  const double scale = get(model, model.scale, "scale", kernel);
  for (auto name : names) cycles_.push_back(get(model, model.operation, "operation", name) * scale);
}

Cycles OperationCosts::operator()(std::span<const std::uint64_t> counts) const {
  base::check_equal("operations counted", counts.size(), cycles_.size());
  double cycles = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    cycles += static_cast<double>(counts[i]) * cycles_[i];
  return {std::llround(cycles)};
}

void OperationCosts::replace_from(std::size_t first, const OperationCosts& other) {
  base::check_equal("operations", other.cycles_.size(), cycles_.size());
  for (std::size_t i = first; i < cycles_.size(); ++i) cycles_[i] = other.cycles_[i];
}

}  // namespace machine
