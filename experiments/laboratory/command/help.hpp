// The layout of --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace laboratory {

/// Layout of a command's help. CLI11's own layout differs between its versions. It also differs
/// between runs, since CLI11 lists some options in the order of their addresses.
class Help : public CLI::FormatterBase {
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace laboratory
