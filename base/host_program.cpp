#include "base/host_program.hpp"

#include <fmt/format.h>

#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "base/text.hpp"

namespace base {

namespace {

namespace process = boost::process;

// A file without a name, gone with the object. A program reads and writes it at its own pace.
class Scratch {
 public:
  Scratch() : file_(std::tmpfile(), &std::fclose) { check(file_ != nullptr); }
  explicit Scratch(const std::string& text) : Scratch() {
    check(std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size());
    check(std::fflush(file_.get()) == 0);
    std::rewind(file_.get());
  }

  std::FILE* get() const { return file_.get(); }

  std::string read() const {
    std::rewind(file_.get());
    std::string text;
    char part[1 << 16];
    while (const auto found = std::fread(part, 1, sizeof part, file_.get()))
      text.append(part, found);
    return text;
  }

 private:
  static void check(bool holds) {
    if (!holds) throw std::system_error(errno, std::generic_category(), "a temporary file");
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace

std::string run_program(const HostProgram& program) {
  const auto path = process::search_path(program.name);
  if (path.empty())
    throw std::runtime_error(
        fmt::format("{}: drawing needs the program {}, which was not found: {}", program.purpose,
                    program.name, program.remedy));
  const Scratch input(program.input), output, errors;
  process::child child(process::exe = path, process::args = program.arguments,
                       (process::std_in < input.get()), (process::std_out > output.get()),
                       (process::std_err > errors.get()));
  child.wait();
  if (child.exit_code() != 0)
    throw std::runtime_error(fmt::format("{}: {} failed (exit code {}): {}", program.purpose,
                                         program.name, child.exit_code(), trim(errors.read())));
  return output.read();
}

}  // namespace base
