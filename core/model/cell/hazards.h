#pragma once

#include <string_view>

namespace armloom {

// Returns true for warnings (by Problem::slug) of a cell in which arms may hit something that the
// checks do not see.
[[nodiscard]] bool is_hazard(std::string_view slug);

}  // namespace armloom
