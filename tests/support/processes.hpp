#pragma once
// Processes that a test, or the program that it tests, has started.
#include <sys/types.h>

#include <fstream>
#include <string>

namespace test {

/// True if the process has ended. A process that nobody has waited for still exists as a zombie.
inline bool is_gone(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return !(in >> number >> name >> state) || state == "Z" || state == "X";
}

}  // namespace test
