#pragma once
// JSON with large objects, in time that grows with its length alone.

#include <nlohmann/json.hpp>
#include <string>

namespace laboratory {

/// Parses as ordered_json::parse does, which before it adds a member looks through all that an
/// object has: minutes for the links of the largest machines. Of members of one name, which no
/// record has, the first is found. Throws nlohmann::json::parse_error.
nlohmann::ordered_json read_json(const std::string& text);

/// Appends a member to an object, or makes one of null; the name must be new.
void append_member(nlohmann::ordered_json& object, std::string name, nlohmann::ordered_json value);

}  // namespace laboratory
