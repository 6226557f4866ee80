#pragma once

#include <string>

namespace armloom {

// Escapes text for XML (SVG), also between double quotes. Control characters, which XML 1.0 cannot
// express, become '?'.
[[nodiscard]] std::string xml_escaped(const std::string& text);

}  // namespace armloom
