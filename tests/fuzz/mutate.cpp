#include "tests/fuzz/mutate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace fuzz {
namespace {

using base::Random;

// Numbers at or beyond limits that readers check.
constexpr std::string_view NUMBERS[] = {"0",
                                        "-0",
                                        "1",
                                        "-1",
                                        "2",
                                        "3",
                                        "4",
                                        "7",
                                        "255",
                                        "256",
                                        "1000",
                                        "16384",
                                        "16385",
                                        "65535",
                                        "65536",
                                        "2147483647",
                                        "2147483648",
                                        "-2147483648",
                                        "-2147483649",
                                        "4294967296",
                                        "9007199254740993",
                                        "9223372036854775807",
                                        "9223372036854775808",
                                        "-9223372036854775808",
                                        "18446744073709551615",
                                        "18446744073709551616",
                                        "0.5",
                                        "0.1",
                                        "-0.25",
                                        "1e-9",
                                        "1e9",
                                        "1e15",
                                        "1.0000001e15",
                                        "1e-320",
                                        "1e308",
                                        "-1e308",
                                        "1e309",
                                        "1e-400",
                                        "nan",
                                        "inf",
                                        "-inf",
                                        "0x10",
                                        "1_000",
                                        "1.",
                                        ".5",
                                        "1e",
                                        "+1",
                                        "00"};

constexpr std::string_view BYTES[] = {{"\0", 1},
                                      "\n",
                                      "\r",
                                      "\r\n",
                                      "\t",
                                      " ",
                                      "\"",
                                      "'",
                                      "#",
                                      "{",
                                      "}",
                                      "[",
                                      "]",
                                      "(",
                                      ")",
                                      "<",
                                      ">",
                                      "/",
                                      "\\",
                                      "=",
                                      ",",
                                      ";",
                                      ":",
                                      ".",
                                      "-",
                                      "--",
                                      "->",
                                      "@",
                                      "%",
                                      "&",
                                      "*",
                                      "^",
                                      "\x7f",
                                      "\x80",
                                      "\xff",
                                      "\xc3\xa9",
                                      "\xc3",
                                      "_",
                                      "$",
                                      "!",
                                      "?",
                                      "|",
                                      "\xef\xbb\xbf",
                                      "&lt;",
                                      "\xe2\x80\xa8"};

bool is_word_byte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}
bool is_number_byte(char c) { return (c >= '0' && c <= '9') || c == '.'; }

struct Span {
  std::size_t at, size;
};

template <class Is>
std::vector<Span> find_spans(std::string_view text, Is is) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    while (i < text.size() && is(text[i])) ++i;
    if (i > begin)
      spans.push_back({begin, i - begin});
    else
      ++i;
  }
  return spans;
}

// Finds the lines of a text, including the characters that end them.
std::vector<Span> find_lines(std::string_view text) {
  std::vector<Span> lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size() - 1) + 1;
    lines.push_back({at, end - at});
    at = end;
  }
  return lines;
}

template <class List>
const auto& choose(const List& list, Random& random) {
  return list[static_cast<std::size_t>(random.below(static_cast<int>(std::size(list))))];
}

std::size_t below(std::size_t n, Random& random) {
  return static_cast<std::size_t>(random.below(static_cast<int>(n)));
}

// Chooses a random part of the text. Short parts are more probable.
Span choose_part(std::string_view text, Random& random) {
  const auto at = below(text.size() + 1, random);
  const auto most = std::min<std::size_t>(text.size() - at, std::size_t{1} << random.below(11));
  return {at, below(most + 1, random)};
}

using Change = void (*)(std::string& text, const Corpus& corpus, Random& random);

void flip_bit(std::string& text, const Corpus&, Random& random) {
  if (text.empty()) return;
  char& byte = text[below(text.size(), random)];
  byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1u << random.below(8)));
}

void put_bytes(std::string& text, const Corpus&, Random& random) {
  const auto at = below(text.size() + 1, random);
  text.replace(at, static_cast<std::size_t>(random.below(2)), choose(BYTES, random));
}

void take_out(std::string& text, const Corpus&, Random& random) {
  const Span part = choose_part(text, random);
  text.erase(part.at, part.size);
}

void take_out_line(std::string& text, const Corpus&, Random& random) {
  const auto lines = find_lines(text);
  if (lines.empty()) return;
  const Span line = choose(lines, random);
  text.erase(line.at, line.size);
}

void double_part(std::string& text, const Corpus&, Random& random) {
  const Span part = choose_part(text, random);
  text.insert(below(text.size() + 1, random), text.substr(part.at, part.size));
}

void double_line(std::string& text, const Corpus&, Random& random) {
  const auto lines = find_lines(text);
  if (lines.empty()) return;
  const Span from = choose(lines, random), to = choose(lines, random);
  text.insert(to.at, text.substr(from.at, from.size));
}

void exchange_lines(std::string& text, const Corpus&, Random& random) {
  const auto lines = find_lines(text);
  if (lines.size() < 2) return;
  auto a = below(lines.size(), random), b = below(lines.size(), random);
  if (a > b) std::swap(a, b);
  if (a == b) return;
  const auto first = text.substr(lines[a].at, lines[a].size);
  const auto second = text.substr(lines[b].at, lines[b].size);
  text.replace(lines[b].at, lines[b].size, first);
  text.replace(lines[a].at, lines[a].size, second);
}

void repeat_part(std::string& text, const Corpus&, Random& random) {
  const Span part = choose_part(text, random);
  const std::string one = text.substr(part.at, std::min<std::size_t>(part.size, 64));
  std::string many;
  for (int times = 1 << random.below(13); times > 0 && many.size() < MAX_BYTES; --times)
    many += one;
  text.insert(part.at, many);
}

void put_in_part(std::string& text, const Corpus& corpus, Random& random) {
  const std::string& other = choose(corpus.texts, random);
  const Span part = choose_part(other, random);
  text.insert(below(text.size() + 1, random), other, part.at, part.size);
}

void put_in_line(std::string& text, const Corpus& corpus, Random& random) {
  const std::string& other = choose(corpus.texts, random);
  const auto lines = find_lines(text);
  const Span line = choose(find_lines(other), random);
  text.insert(lines.empty() ? 0 : choose(lines, random).at, other, line.at, line.size);
}

void end_as_other(std::string& text, const Corpus& corpus, Random& random) {
  const std::string& other = choose(corpus.texts, random);
  text.resize(below(text.size() + 1, random));
  text += other.substr(below(other.size() + 1, random));
}

void cut_off(std::string& text, const Corpus&, Random& random) {
  text.resize(below(text.size() + 1, random));
}

void change_number(std::string& text, const Corpus&, Random& random) {
  const auto numbers = find_spans(text, is_number_byte);
  if (numbers.empty()) return;
  const Span number = choose(numbers, random);
  std::string other{choose(NUMBERS, random)};
  if (random.below(3) == 0)
    other = text.substr(choose(numbers, random).at, number.size);
  else if (random.below(3) == 0)
    other = fmt::format("{}", random.below(20) - 4);
  text.replace(number.at, number.size, other);
}

void change_word(std::string& text, const Corpus& corpus, Random& random) {
  const auto words = find_spans(text, is_word_byte);
  if (words.empty() || corpus.words.empty()) return;
  const Span word = choose(words, random);
  text.replace(word.at, word.size, choose(corpus.words, random));
}

constexpr Change CHANGES[] = {
    flip_bit,      put_bytes,      take_out,    take_out_line, double_part,   double_line,
    repeat_part,   exchange_lines, put_in_part, put_in_line,   cut_off,       end_as_other,
    change_number, change_number,  change_word, change_word,   change_number, change_word};

}  // namespace

Corpus make_corpus(std::vector<std::string> texts) {
  std::set<std::string> words;
  for (const auto& text : texts)
    for (const Span& span : find_spans(text, is_word_byte))
      words.insert(text.substr(span.at, span.size));
  return {std::move(texts), {words.begin(), words.end()}};
}

std::string mutate(const Corpus& corpus, Random& random) {
  std::string text = choose(corpus.texts, random);
  // few changes, because each one makes it more probable that the text is refused early
  int changes = random.below(4);
  if (random.below(8) == 0) changes = random.below(13);
  for (; changes > 0; --changes) {
    choose(CHANGES, random)(text, corpus, random);
    if (text.size() > MAX_BYTES) text.resize(MAX_BYTES);
  }
  return text;
}

}  // namespace fuzz
