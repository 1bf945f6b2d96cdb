#pragma once
// Help topics: sections of the experiment file and related subjects, each with an example.
#include <string>
#include <vector>

namespace laboratory {

struct Topic {
  std::string name;     ///< name of the topic, such as "plot"
  std::string about;    ///< description in one line
  std::string text;     ///< explanation, broken into lines; "" for none
  std::string example;  ///< an experiment file of 3 to 8 lines
};

/// The topics in alphabetical order. A topic with the name of a section has the description of this
/// section.
const std::vector<Topic>& topics();

/// Formats the description, explanation and example of the topic `word`, and one line for each key
/// with this section or name. Returns "" if there is neither a topic nor a key. Leaves out the keys
/// of the program `word`.
std::string describe_topic(const std::string& word);

/// Formats a heading and one line for each topic.
std::string list_topics();

/// The names nearest to an unknown topic: the most similar of `known`, and topics that mention the
/// word. Empty if there are none.
std::vector<std::string> find_near_topics(const std::string& word,
                                          const std::vector<std::string>& known);

}  // namespace laboratory
