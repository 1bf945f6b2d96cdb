#include "experiments/laboratory/points/speedups.hpp"

#include <algorithm>

#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {

namespace {

bool is_base(const Table& table, const std::vector<Value>& base, const std::vector<Value>& row,
             std::size_t processors) {
  const Value one = std::int64_t{1};
  for (std::size_t c = 0; c < table.axes; ++c)
    if (base[c] != (c == processors ? one : row[c])) return false;
  return true;
}

}  // namespace

bool is_complete_row(const Table& table, const std::vector<Value>& row) {
  const auto column = table.find("ended");
  return !column || row[*column] == Value("done") || row[*column] == Value("saturated");
}

void add_speedups(Table& table, const std::string& processors) {
  const auto axis = table.find(processors), time = table.find("time_s");
  const auto speedup = table.find("speedup"), efficiency = table.find("efficiency");
  if (!axis || *axis >= table.axes || !time || !speedup || !efficiency) return;
  for (auto& row : table.rows) {
    if (row[*speedup] != Value()) continue;
    const auto base = std::ranges::find_if(
        table.rows, [&](const auto& other) { return is_base(table, other, row, *axis); });
    if (base == table.rows.end() || !is_complete_row(table, *base) || !is_complete_row(table, row))
      continue;
    const double s = *as_number((*base)[*time]) / *as_number(row[*time]);
    row[*speedup] = s;
    row[*efficiency] = s / *as_number(row[*axis]);
  }
}

void add_serial_fractions(Table& table, const std::string& processors) {
  const auto axis = table.find(processors), speedup = table.find("speedup");
  for (const auto& [name, law] : {std::pair("serial_karp_flatt", &karp_flatt),
                                  std::pair("serial_gustafson", &serial_gustafson)}) {
    const auto column = table.find(name);
    if (!column || !axis || !speedup) return;
    for (auto& row : table.rows) {
      const auto n = as_number(row[*axis]), s = as_number(row[*speedup]);
      if (const auto serial = n && s ? law(*n, *s) : std::nullopt) row[*column] = *serial;
    }
  }
}

}  // namespace laboratory
