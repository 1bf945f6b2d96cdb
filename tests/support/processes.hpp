#pragma once
// Processes that a test has started, or whose program has.
#include <sys/types.h>

#include <fstream>
#include <string>

namespace test {

/// Whether the process has ended. One that nobody has waited for stays as a zombie.
inline bool is_gone(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return !(in >> number >> name >> state) || state == "Z" || state == "X";
}

}  // namespace test
