// The layout of --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace laboratory {

/// Lays the help of a command out. CLI11's own layout differs from version to version and, in part,
/// from run to run, since it lists options in the order of their addresses.
class Help : public CLI::FormatterBase {
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace laboratory
