#pragma once

#include <string>

namespace armloom {

// Text as it stands in XML (SVG), also between double quotes. XML 1.0 has no way to write control
// characters: '?'.
[[nodiscard]] std::string xml_escaped(const std::string& text);

}  // namespace armloom
