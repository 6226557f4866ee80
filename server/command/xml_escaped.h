#pragma once

#include <string>

namespace armloom {

// Escapes text for XML, also for use between double quotes. Control characters, which XML 1.0 does
// not allow, become '?'.
[[nodiscard]] std::string xml_escaped(const std::string& text);

}  // namespace armloom
