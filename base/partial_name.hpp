#pragma once
// Hidden names for files and folders while they are written: ".NAME.partial-HOST-PID". Hosts may
// share a folder, and each knows only its own processes. A "-" in the host's name is doubled;
// otherwise "node" with process 12-3 would look like "node-12" with process 3.
#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace base {

/// This host's name.
std::string host_name();

/// The name that a process of a host uses: ".NAME.KIND-HOST-PID".
std::string make_partial_name(std::string_view name, std::string_view kind, pid_t process,
                              std::string_view host = host_name());

/// The process id in a name of this kind if `host` made it. Text after the id and a "-" is ignored.
std::optional<pid_t> find_maker(std::string_view partial_name, std::string_view kind,
                                std::string_view host = host_name());

/// True if the process no longer exists.
bool is_dead(pid_t process);

}  // namespace base
