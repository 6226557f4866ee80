#include "server/messages/mesh_address.h"

#include <cctype>
#include <cstdint>
#include <cstdio>
#include <filesystem>

namespace armloom {

std::string mesh_name(const std::string& path) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : path) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return digits + extension;
}

std::string mesh_address(const std::string& path) {
  return kApiPrefix + (kMeshFolder + mesh_name(path));
}

}  // namespace armloom
