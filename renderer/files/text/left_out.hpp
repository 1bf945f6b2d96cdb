#pragma once
// Counter of the parts of a file that a reader or a conversion leaves out, by kind.

#include <map>
#include <string>
#include <vector>

namespace renderer {

class LeftOut {
 public:
  /// Counts parts that are left out. `kind` is a plural, such as "spheres". `remark`, if not empty,
  /// states the place and the reason: "file:line: found ..., expected ...". Only the first remark
  /// of a kind is kept.
  void add(const std::string& kind, const std::string& remark = "", std::size_t times = 1) {
    count(kind, remark, times, false);
  }
  /// Counts parts that get a default value, such as "faces in light grey".
  void replace(const std::string& kind, const std::string& remark, std::size_t times = 1) {
    count(kind, remark, times, true);
  }

  /// Formats the counts of parts left out: "creases (2), spheres (1)"; "" if there are none.
  std::string describe() const;

  /// One sentence for each kind that has a remark.
  std::vector<std::string> describe_remarks() const;

  /// The sentences of describe_remarks(), and one with the counts of the other kinds in the file
  /// `name`.
  std::vector<std::string> describe_all(const std::string& name) const;

 private:
  struct Kind {
    std::size_t count = 0;
    bool is_replaced = false;
    std::string remark;  // first remark
  };

  void count(const std::string& kind, const std::string& remark, std::size_t times,
             bool is_replaced);
  template <class IsListed>
  std::string list(const IsListed& is_listed) const;

  std::map<std::string, Kind> kinds_;
};

}  // namespace renderer
