#pragma once

#include "server/store/database.h"

namespace armloom {

inline constexpr const char* kStoreFile = "armloom.db";  // in the data folder

// Makes the tables, or brings those of an older version of the program to this one's, one version
// after the other, each whole or not at all. Throws SqlFault; std::runtime_error where the file is
// another program's, or a newer version's.
void bring_up_to_date(Database& database);

// Throws std::runtime_error with what SQLite finds wrong with the file, SqlFault where it cannot
// even be read.
void check_whole(const Database& database);

}  // namespace armloom
