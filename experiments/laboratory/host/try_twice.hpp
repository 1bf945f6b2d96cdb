#pragma once
// For writing into a folder of results that other processes use too.
#include <system_error>

namespace laboratory {

// Another process may be exchanging the whole folder of results; it takes a moment. What finds no
// folder is done again, once.
template <class Write>
void try_twice(const Write& write) {
  try {
    write();
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    write();
  }
}

}  // namespace laboratory
