#include "experiments/laboratory/points/read_json.hpp"

#include <vector>

namespace laboratory {
namespace {

using nlohmann::ordered_json;

// Takes the parser's events. A list or object under way is the last element of the one around it,
// which therefore stays where it is in memory.
class Reader : public nlohmann::json_sax<ordered_json> {
 public:
  ordered_json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(ordered_json::object()); }
  bool start_array(std::size_t) override { return open(ordered_json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    name_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&,
                   const nlohmann::detail::exception& error) override {
    throw dynamic_cast<const ordered_json::parse_error&>(error);
  }

 private:
  bool add(ordered_json value) {
    place(std::move(value));
    return true;
  }
  bool open(ordered_json value) {
    open_.push_back(place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }
  ordered_json* place(ordered_json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    ordered_json& around = *open_.back();
    if (around.is_array()) {
      around.push_back(std::move(value));
      return &around.back();
    }
    append_member(around, std::move(name_), std::move(value));
    return &around.get_ref<ordered_json::object_t&>().back().second;
  }

  ordered_json root_;
  std::vector<ordered_json*> open_;
  std::string name_;
};

}  // namespace

nlohmann::ordered_json read_json(const std::string& text) {
  Reader reader;
  ordered_json::sax_parse(text, &reader);
  return reader.take();
}

void append_member(nlohmann::ordered_json& object, std::string name, nlohmann::ordered_json value) {
  if (object.is_null()) object = ordered_json::object();
  auto& members = object.get_ref<ordered_json::object_t&>();
  // As a vector: the map looks for the name first.
  static_cast<ordered_json::object_t::Container&>(members).emplace_back(std::move(name),
                                                                        std::move(value));
}

}  // namespace laboratory
