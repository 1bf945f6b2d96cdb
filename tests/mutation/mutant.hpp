#pragma once
// Selects one of the mutants that are compiled into the program (see sites.py). Every source
// includes this header before anything else.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

namespace mutation {

constexpr int UNKNOWN = -1, NONE = 0, MOST = 1 << 20;

inline constinit int active = UNKNOWN;
// one flag for each mutant, in a file that all processes of a test share
inline constinit char* reached = nullptr;

inline void load() {
  const char* number = std::getenv("TLAB_MUTANT");
  active = number ? std::atoi(number) : NONE;
  if (const char* path = std::getenv("TLAB_REACHED")) {
    const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0 || ftruncate(file, MOST) != 0) return;
    void* map = mmap(nullptr, MOST, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (map != MAP_FAILED) reached = static_cast<char*>(map);
  }
}

}  // namespace mutation

/// True if the mutant with this number is active. Always false in constant expressions.
constexpr bool is_mutant(int number) {
  if (std::is_constant_evaluated()) return false;
  if (mutation::active == mutation::UNKNOWN) mutation::load();
  if (mutation::reached) mutation::reached[number] = 1;
  return mutation::active == number;
}
