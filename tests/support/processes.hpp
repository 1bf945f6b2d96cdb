#pragma once
// Processes that a test, or the program under test, has started.
#include <sys/types.h>

#include <fstream>
#include <string>

namespace test {

/// True if the process has ended. A process that was not waited for remains as a zombie.
inline bool is_gone(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return !(in >> number >> name >> state) || state == "Z" || state == "X";
}

}  // namespace test
