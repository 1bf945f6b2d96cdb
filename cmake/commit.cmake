# Writes the current commit, for `tlab --version`, into FILE. Writes nothing if the sources are not in a clone
# of the repository. Touches FILE only if its content changes.
execute_process(COMMAND git -C ${SOURCE} rev-parse --show-toplevel
                OUTPUT_VARIABLE clone OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(clone STREQUAL SOURCE)
  execute_process(COMMAND git -C ${SOURCE} rev-parse --short HEAD
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit)
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(PREPEND commit "commit ")
  if(changes)
    string(APPEND commit ", with changes")
  endif()
endif()
configure_file(${SOURCE}/experiments/laboratory/host/commit.hpp.in ${FILE} @ONLY)
