#include "renderer/radiosity/files/mtl.hpp"

#include <fmt/format.h>

#include "renderer/files/nff_statements.hpp"
#include "renderer/radiosity/files/statement.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

constexpr int MIRROR = 3, MAX_ILLUM = 10;

struct Draft {
  Material material;
  Rgb specular;
  int line;
};

void read_statement(renderer::Tokens& tokens, std::vector<Draft>& drafts) {
  const std::string name = tokens.take();
  Statement s(tokens);
  if (name == "newmtl") {
    drafts.push_back({{}, {}, s.line()});
    drafts.back().material.name = s.take_word("a name");
    return s.end();
  }
  const bool known = name == "Kd" || name == "Ks" || name == "Ke" || name == "illum";
  if (!known) return s.skip();
  if (drafts.empty()) s.fail(fmt::format("found '{}', expected 'newmtl' before it", name));
  Material& m = drafts.back().material;
  if (name == "illum")
    m.mirror = s.take_count("illum", 0, MAX_ILLUM) == MIRROR;
  else
    (name == "Kd"   ? m.reflectance
     : name == "Ks" ? drafts.back().specular
                    : m.emission) = s.take_rgb(name);
  s.end();
}

}  // namespace

void read_mtl(std::istream& in, const std::string& name, std::vector<Material>& materials) {
  renderer::Tokens tokens(in, name);
  std::vector<Draft> drafts;
  while (!tokens.peek().empty()) read_statement(tokens, drafts);
  for (Draft& draft : drafts) {
    Material& m = draft.material;
    if (m.mirror) m.reflectance = draft.specular;
    at_line(tokens, draft.line, [&] { check_material(m); });
    for (const Material& other : materials)
      if (other.name == m.name)
        tokens.fail(draft.line, fmt::format("found a second material {}, expected another name",
                                            renderer::quote(m.name)));
    materials.push_back(m);
  }
}

}  // namespace radiosity
