#pragma once
// A cache folder for references: their computation takes longest.

#include <string>

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// trace_paths() for the room given as text, cached in a file of `folder`; the file is written if
/// it is missing. Its name is a hash of the text and of the parameters. An empty `folder` disables
/// the cache. Errors as trace_paths() and base::save_whole().
Reference find_reference(const std::string& text, const Room& room, const TracerParams& params,
                         const std::string& folder);

}  // namespace radiosity::reference
