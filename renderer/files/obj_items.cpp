#include "renderer/files/obj_items.hpp"

#include "base/text.hpp"
#include "renderer/files/text/statements.hpp"

namespace renderer {

namespace {

constexpr double UNREADABLE = std::numeric_limits<double>::quiet_NaN();

class ItemReader {
 public:
  ItemReader(std::string_view text, const std::string& name, LeftOut& left_out)
      : tokens_(text, name, nullptr, Tokens::Lines::joined), left_out_(left_out) {}

  ObjItems read() {
    while (tokens_.begin_line()) read_statement(base::to_lower(tokens_.take()));
    left_out_.add("colours of vertices", "", colours_);
    left_out_.add("weights of vertices", "", weights_);
    return std::move(items_);
  }

 private:
  void read_statement(const std::string& name) {
    if (name == "v")
      read_item(items_.points, "vertices", [&] { return take_point(); }, {UNREADABLE, 0, 0});
    else if (name == "vn")
      read_item(items_.normals, "normals", [&] { return take_normal(); }, {UNREADABLE, 0, 0});
    else if (name == "vt")
      read_item(items_.coordinates, "texture coordinates", [&] { return take_coordinate(); },
                {UNREADABLE, 0});
    else if (name == "mtllib")
      items_.libraries.push_back({tokens_.line(), tokens_.take_rest()});
    else
      tokens_.take_rest();
  }

  template <class Item, class Take>
  void read_item(std::vector<Item>& list, const char* kind, const Take& take,
                 const Item& unreadable) {
    try {
      list.push_back(take());
    } catch (const base::BadInput& bad) {
      list.push_back(unreadable);
      left_out_.add(kind, bad.what());
      if (items_.problem.empty()) items_.problem = bad.what();
    }
    tokens_.skip_line();
  }

  // Takes a vertex. A weight (one number), a colour (three or four numbers) or both may follow.
  Vec take_point() {
    const Vec point = tokens_.take_vec("a vertex");
    if (!tokens_.continues()) return point;
    const auto weight = parse_number(tokens_.take());
    if (tokens_.continues())
      ++colours_;
    else if (weight != 1)
      ++weights_;
    return point;
  }

  Vec take_normal() {
    const Vec normal = tokens_.take_vec("a normal");
    return length(normal) > 0 ? normal : Vec{UNREADABLE, 0, 0};
  }

  // Takes a texture coordinate: one or two numbers. A third number may follow.
  Corner take_coordinate() {
    const auto take = [&] {
      return tokens_.take_number("a texture coordinate", -MAX_COORDINATE, MAX_COORDINATE);
    };
    const double u = take();
    return {u, tokens_.continues() ? take() : 0};
  }

  Tokens tokens_;
  LeftOut& left_out_;
  ObjItems items_;
  std::size_t colours_ = 0, weights_ = 0;
};

}  // namespace

ObjItems read_items(std::string_view text, const std::string& name, LeftOut& left_out) {
  return ItemReader(text, name, left_out).read();
}

}  // namespace renderer
