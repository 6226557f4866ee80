#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/model/cell.h"

namespace armloom {

// A record of the store: the text of an object that expires at a time (ms since 1970).
[[nodiscard]] std::string text_with_expiry(const std::string& text, std::int64_t expires_ms);
// Takes the time out of the record. Returns nullopt if there is none.
[[nodiscard]] std::optional<std::int64_t> take_expiry(std::string& record);

// Records of the store: an object where a step of a job has put it.
[[nodiscard]] std::string text_of_place(const HeldView& place);
// Returns nullopt if the text is no such record, but a client's object. Problems: a record that
// cannot be read. The shape of a mesh is taken from the cell's object of that name.
[[nodiscard]] Result<std::optional<HeldView>> read_place(std::string_view text, const Cell& cell);

}  // namespace armloom
