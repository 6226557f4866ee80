#pragma once

#include <filesystem>

namespace armloom {

// Makes new names in the folder survive a power cut. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace armloom
