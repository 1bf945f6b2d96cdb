#pragma once
// References that are kept in a folder: they take longest.

#include <string>

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// trace_paths() of the room that a text is; from a file of `folder`, where it is written when it
/// is not there yet. The file's name is a hash of the text and of the parameters. Nothing is kept
/// if the folder is "". Errors as trace_paths() and base::save_whole().
Reference find_reference(const std::string& text, const Room& room, const TracerParams& params,
                         const std::string& folder);

}  // namespace radiosity::reference
