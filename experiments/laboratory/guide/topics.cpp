#include "experiments/laboratory/guide/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>

#include "base/message.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/guide/keys.hpp"
#include "experiments/laboratory/guide/template_files.hpp"

namespace laboratory {
namespace {

// Removes and returns the first line.
std::string take_line(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size() - 1);
  const std::string line(text.substr(0, end));
  text.remove_prefix(end + 1);
  return line;
}

// Reads a file of topics/: lines of comment, then the example. Without `about`, the first line is
// the description.
Topic read_topic(std::string_view path, std::string_view text, const std::string& about) {
  Topic topic{std::string(path.substr(0, path.find('.'))), about, "", ""};
  while (text.starts_with("# ")) {
    const auto line = take_line(text).substr(2);
    if (topic.about.empty())
      topic.about = line;
    else
      topic.text += line + "\n";
  }
  topic.example = text;
  return topic;
}

const Topic* find_topic(const std::string& name) {
  const auto found = std::ranges::find(topics(), name, &Topic::name);
  return found == topics().end() ? nullptr : &*found;
}

}  // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = [] {
    std::vector<Topic> made;
    const auto declared = settings();
    for (const auto& [path, text] : TOPIC_FILES) {
      const auto section =
          std::ranges::find(declared, path.substr(0, path.find('.')), &Setting::key);
      made.push_back(read_topic(path, text, section == declared.end() ? "" : section->help));
    }
    return made;
  }();
  return all;
}

std::string describe_topic(const std::string& word) {
  std::string text;
  if (const auto* topic = find_topic(word))
    text = fmt::format("{}\n{}\nExample:\n\n{}", topic->about, topic->text, topic->example);
  const auto keys = describe_keys_of(word);
  if (!keys.empty()) text += fmt::format("{}Keys:\n{}", text.empty() ? "" : "\n", keys);
  return text;
}

std::string list_topics() {
  std::string text = "Topics (tlab help TOPIC):\n";
  for (const auto& topic : topics()) text += fmt::format("  {:<27} {}\n", topic.name, topic.about);
  return text;
}

std::vector<std::string> find_near_topics(const std::string& word,
                                          const std::vector<std::string>& known) {
  constexpr std::size_t SHORTEST_WORD = 3;
  std::vector<std::string> near;
  if (const auto similar = base::find_similar(word, known)) near.push_back(*similar);
  if (word.size() < SHORTEST_WORD) return near;
  for (const auto& topic : topics())
    if (boost::icontains(topic.about + "\n" + topic.text, word) &&
        std::ranges::find(near, topic.name) == near.end())
      near.push_back(topic.name);
  return near;
}

}  // namespace laboratory
