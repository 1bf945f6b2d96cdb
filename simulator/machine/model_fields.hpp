#pragma once
// Where the entries of a model file go.
#include "simulator/machine/model.hpp"

namespace machine {

/// Sets the model's fields and maps from its entries. Throws BadInput, naming `origin`, for a
/// missing entry or an impossible value.
void bind_entries(Model& model, std::string_view origin);

/// The unit that an entry must carry; empty for a key that no model has. Programs bring names of
/// their own: any key is valid in the sections instruction, operation, scale and bytes.
std::string unit_of(std::string_view key);
/// Whether the key is in such a section.
bool is_open_section(std::string_view key);
std::vector<std::string> field_keys();

}  // namespace machine
