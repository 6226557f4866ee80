#pragma once

#include <filesystem>

namespace armloom {

// Syncs the folder, so that new files in it survive a power cut. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace armloom
