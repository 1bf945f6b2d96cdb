// Shell completion of commands, options and names.
#include "experiments/laboratory/command/completion.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using test::TemporaryFolder;

std::string script_for(const std::string& shell) {
  const TemporaryFolder folder;
  const auto made = tlab(folder.path, {"completion", shell});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return made.out;
}

// Compares every option of every command with the command's help.
TEST(Completion, KnowsAllCommandsAndOptions) {
  const TemporaryFolder folder;
  const auto script = script_for("bash"), zsh = script_for("zsh"), fish = script_for("fish");
  const std::regex option("\n  (?:-[a-z],)?(--[a-z-]+)");
  for (const std::string command :
       {"topology", "render", "radiosity", "run", "live", "merge", "report", "verify", "compare",
        "model", "columns", "list", "help", "init", "completion"}) {
    auto help = tlab(folder.path, {command, "--help"}).out;
    help = help.substr(0, help.find("Examples:"));
    for (auto found = std::sregex_iterator(help.begin(), help.end(), option);
         found != std::sregex_iterator(); ++found) {
      const auto own = script.substr(script.find("      " + command + ") words=\""));
      EXPECT_NE(own.substr(0, own.find('\n')).find(found->str(1)), std::string::npos)
          << command << " " << found->str(1);
      EXPECT_NE(zsh.find("'" + found->str(1) + "["), std::string::npos) << command;
      EXPECT_NE(fish.find("-l " + found->str(1).substr(2)), std::string::npos) << command;
    }
    EXPECT_NE(fish.find(" -a " + command + " "), std::string::npos);
    EXPECT_NE(zsh.find("    '" + command + ":"), std::string::npos);
  }
  EXPECT_EQ(tlab(folder.path, {"completion", "tcsh"}).exit_code, 2);
}

// The completions that bash offers for the last, unfinished word of a line.
std::string complete(const std::filesystem::path& folder, const std::string& line) {
  std::ofstream(folder / "try.sh") << "source ./tlab.bash\nCOMP_WORDS=(" << line
                                   << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_tlab\n"
                                      "printf '%s\\n' \"${COMPREPLY[@]}\" > offered\n";
  const auto command = "cd '" + folder.string() + "' && bash try.sh";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return std::string(base::trim(base::read_text(folder / "offered")));
}

TEST(Completion, BashOffersWhatBeginsSo) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "tlab.bash") << script_for("bash");
  EXPECT_EQ(complete(folder.path, "tlab ver"), "verify");
  EXPECT_EQ(complete(folder.path, "tlab run --time"), "--timeline");
  EXPECT_EQ(complete(folder.path, "tlab merge try"), "try.sh") << "else files";
  std::ofstream(folder.path / "a b.toml");
  EXPECT_EQ(complete(folder.path, "tlab merge a"), "a b.toml") << "one name";
  std::ofstream(folder.path / "cut\nin two");
  EXPECT_EQ(complete(folder.path, "tlab merge cut"), "") << "no parts of a name";
}

// `help` is completed with commands, programs and topics. The built program lists them.
TEST(Completion, HelpOffersTopics) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(::test::in_build("tlab"), folder.path / "tlab");
  std::ofstream(folder.path / "tlab.bash") << "PATH=$PWD:$PATH\n" << script_for("bash");
  EXPECT_EQ(complete(folder.path, "tlab help pl"), "plot");
  EXPECT_EQ(complete(folder.path, "tlab help se"), "seed");
  EXPECT_EQ(complete(folder.path, "tlab help me"), "merge\nmessage\nmetrics");
  EXPECT_TRUE(contains(script_for("zsh"), "'*: :_tlab_names help'"));
  EXPECT_TRUE(contains(script_for("fish"), "-a '(tlab help --names 2>/dev/null)'"));
}

// A name is text, even if it looks like a command. The names come from a stand-in for tlab.
TEST(Completion, NoNameIsExecuted) {
  const TemporaryFolder folder;
  const auto names = folder.path / "names", owned = folder.path / "owned";
  write_file(names, "$(touch owned)\n`touch owned`\n$HOME\nplain name\n*\n");
  write_file(folder.path / "tlab", "#!/bin/sh\ncat '" + names.string() + "'\n");
  std::filesystem::permissions(folder.path / "tlab", std::filesystem::perms::owner_all);
  std::ofstream(folder.path / "tlab.bash") << "PATH=$PWD:$PATH\n" << script_for("bash");
  const auto offered = complete(folder.path, "tlab run ''");
  EXPECT_TRUE(contains(offered, "$(touch owned)\n`touch owned`\n$HOME\nplain name\n*")) << offered;
  EXPECT_EQ(complete(folder.path, "tlab run '$('"), "$(touch owned)");
  EXPECT_FALSE(std::filesystem::exists(owned));
  const auto run = [&](const std::string& shell, const std::string& script) {
    std::ofstream(folder.path / ("tlab." + shell)) << script_for(shell);
    std::ofstream(folder.path / "try") << script;
    const auto command = "cd '" + folder.path.string() + "' && PATH=$PWD:$PATH " + shell + " try";
    if (std::system(("command -v " + shell + " > /dev/null 2>&1").c_str()) != 0) return;
    EXPECT_EQ(std::system(command.c_str()), 0) << shell;
    EXPECT_TRUE(contains(read_file(folder.path / "offered"), "$(touch owned)")) << shell;
    EXPECT_FALSE(std::filesystem::exists(owned)) << shell;
  };
  run("fish", "source tlab.fish\ncomplete -C 'tlab run ' > offered\n");
  run("zsh",
      "compdef() { :; }\n_files() { :; }\ncompadd() { shift; print -rl -- \"$@\" > offered; }\n"
      "source ./tlab.zsh\n_tlab_names list experiments\n");
}

}  // namespace
}  // namespace laboratory
