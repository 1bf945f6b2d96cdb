#pragma once
// What a formula may name at a point of an experiment.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

// Columns of the results ("bytes", "latency_s"), the numbers that the file gives to keys
// ("image.width"), the numbers of the machine model ("link.one_way_rate"). Of a column of texts
// there is "topology_is_line": 1 where its text is "line", else 0; what no name can hold is spelled
// _, so that "mesh:4x4" is topology_is_mesh_4x4. Later: the names of [let].
class Variables {
 public:
  Variables(const Point& point, const machine::Model& model);
  // The row of this point. An empty cell is not a number.
  void add_row(const Table& table, const std::vector<Value>& row);
  // Throws base::BadInput, beginning with `place`, if there is one of this name.
  void add(const std::string& name, double value, const std::string& place);

  // Throws base::BadInput, beginning with `place`, for an unknown name, with the nearest,
  // and for a column of texts, with how to compare it.
  double get(const std::string& name, const std::string& place) const;
  // For all names of a formula.
  std::vector<double> get_all(const std::vector<std::string>& names,
                              const std::string& place) const;

 private:
  std::optional<double> compare_text(const std::string& name) const;

  std::map<std::string, double, std::less<>> numbers_;
  std::map<std::string, std::string, std::less<>> texts_;
};

}  // namespace laboratory
