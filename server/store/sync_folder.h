#pragma once

#include <filesystem>

namespace armloom {

// So that names that were given in it outlive a power cut. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace armloom
