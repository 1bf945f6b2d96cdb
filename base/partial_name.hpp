#pragma once
// Hidden names of files and folders that are being written: ".NAME.partial-HOST-PID". Hosts may
// share a folder, and each knows only its own processes. A "-" in the host's name is written twice,
// or process 12-3 of "node" could be of "node-12".
#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace base {

/// This host's name.
std::string host_name();

/// The name for a process of a host, ".NAME.KIND-HOST-PID".
std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process,
                              std::string_view host = host_name());

/// The process of the host that made a name of this kind, whatever follows its number after "-".
std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind,
                                std::string_view host = host_name());

/// Whether there is no such process any more.
bool is_dead(pid_t process);

}  // namespace base
