#pragma once
// Counts the parts of a file that a reader or a converter ignores, by kind.

#include <map>
#include <string>
#include <vector>

namespace renderer {

class LeftOut {
 public:
  /// Counts ignored parts. `kind` is a plural, such as "spheres". `remark`, if not empty, states
  /// the place and the reason: "file:line: found ..., expected ...". Only the first remark of each
  /// kind is kept.
  void add(const std::string& kind, const std::string& remark = "", std::size_t times = 1) {
    count(kind, remark, times, false);
  }
  /// Counts parts that got a default value. `kind` is a plural, such as "faces in light grey".
  void replace(const std::string& kind, const std::string& remark, std::size_t times = 1) {
    count(kind, remark, times, true);
  }

  /// Lists the counts of ignored parts, such as "creases (2), spheres (1)"; "" if there are none.
  std::string describe() const;

  /// Returns one sentence for each kind that has a remark.
  std::vector<std::string> describe_remarks() const;

  /// Returns the sentences of describe_remarks(), and a sentence with the counts of all other
  /// kinds. `name` is the file's name.
  std::vector<std::string> describe_all(const std::string& name) const;

 private:
  struct Kind {
    std::size_t count = 0;
    bool is_replaced = false;
    std::string remark;  // the first remark of this kind
  };

  void count(const std::string& kind, const std::string& remark, std::size_t times,
             bool is_replaced);
  template <class IsListed>
  std::string list(const IsListed& is_listed) const;

  std::map<std::string, Kind> kinds_;
};

}  // namespace renderer
