// Layout of the text that --help prints.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace laboratory {

/// Layout of a command's help. CLI11's own layout differs between its versions, and even between
/// runs, since CLI11 lists some options in the order of their memory addresses.
class Help : public CLI::FormatterBase {
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace laboratory
