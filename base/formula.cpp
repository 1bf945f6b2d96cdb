#include "base/formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/text.hpp"

namespace base {

namespace {

constexpr std::string_view NAME_CHARACTERS =
    "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

// Refuses unknown functions by name, because muParser only reports an unexpected parenthesis.
void check_functions(const mu::Parser& parser, std::string_view text, const std::string& place) {
  std::vector<std::string> known;
  for (const auto& [name, function] : parser.GetFunDef()) known.push_back(name);
  for (auto open = text.find('('); open != text.npos; open = text.find('(', open + 1)) {
    const auto before = trim(text.substr(0, open));
    const std::string name(before.substr(before.find_last_not_of(NAME_CHARACTERS) + 1));
    if (!Formula::is_name(name) || std::ranges::find(known, name) != known.end()) continue;
    refuse(place, "unknown function \"{}\"{}", name, suggest(name, known));
  }
}

// True if the text contains a single =, which muParser would read as an assignment.
bool has_assignment(const std::string& text) {
  for (auto at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    const bool compares = at > 0 && std::string_view("<>!").find(text[at - 1]) != std::string::npos;
    const bool equals = at + 1 < text.size() && text[at + 1] == '=';
    if (!compares && !equals) return true;
    if (equals) ++at;
  }
  return false;
}

}  // namespace

struct Formula::Parser {
  mu::Parser parser;
  std::vector<double> values;  // muParser keeps pointers to these
};

Formula::Formula(const std::string& text, std::string place)
    : place_(std::move(place)), parser_(std::make_unique<Parser>()) {
  require(text.size() <= MAX_BYTES, place_, "found an expression of {} bytes, expected at most {}",
          text.size(), MAX_BYTES);
  auto refuse = [&](const std::string& what) {
    base::refuse(place_, "found \"{}\", expected an expression: {}", text, what);
  };
  if (has_assignment(text)) refuse("found \"=\", expected \"==\" for a comparison");
  mu::Parser& parser = parser_->parser;
  parser.DefineNameChars(std::string(NAME_CHARACTERS).c_str());
  parser.DefineFun("floor", [](double x) { return std::floor(x); });
  parser.DefineFun("ceil", [](double x) { return std::ceil(x); });
  check_functions(parser, text, place_);
  try {
    parser.SetExpr(text);
    for (const auto& [name, ignored] : parser.GetUsedVar()) {
      if (!is_name(name)) refuse(fmt::format("\"{}\" is not a name", name));
      variables_.push_back(name);
    }
    parser_->values.resize(variables_.size());
    for (std::size_t i = 0; i < variables_.size(); ++i)
      parser.DefineVar(variables_[i], &parser_->values[i]);
    parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    refuse(error.GetMsg());
  }
  if (parser.GetNumResults() != 1) refuse("a comma outside of a function");
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::eval(std::span<const double> values) const {
  check_equal("values of a formula", values.size(), variables_.size());
  std::ranges::copy(values, parser_->values.begin());
  return parser_->parser.Eval();
}

bool Formula::is_name(const std::string& text) {
  return !text.empty() && text.find_first_not_of(NAME_CHARACTERS) == std::string::npos &&
         std::string_view("0123456789.").find(text[0]) == std::string::npos;
}

}  // namespace base
