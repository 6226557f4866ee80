#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "server/store/database.h"

namespace armloom {

inline constexpr const char* kStoreFile = "armloom.db";  // in the data folder

// The value of `sum` in an intact row (Database::know_checksum).
inline constexpr const char* kSumOfJob =
    "checksum(job.number, job.id, job.state, job.has_ended, job.may_have_moved, job.submitted_ms, "
    "job.ended_ms, job.arms, job.view, job.digest, job.request_key, job.request_digest, "
    "job.request_place)";
inline constexpr const char* kSumOfBody = "checksum(body.number, body.text, body.amended)";
inline constexpr const char* kSumOfAlert =
    "checksum(alert.number, alert.id, alert.at_ms, alert.level, alert.text, alert.who, "
    "alert.acknowledged_ms)";
inline constexpr const char* kSumOfAudit =
    "checksum(audit.number, audit.at_ms, audit.who, audit.peer, audit.method, audit.path, "
    "audit.status)";
inline constexpr const char* kSumOfStop = "checksum(stopped_arm.name)";
inline constexpr const char* kSumOfObject =
    "checksum(scene_object.number, scene_object.name, scene_object.text)";
inline constexpr const char* kSumOfRequest =
    "checksum(request.key, request.place, request.digest, request.job)";

// Creates a store with empty tables under another name, then renames it: thus a file in this place,
// even an empty file, has held jobs. `vfs` as in Database. Throws SqlFault, std::system_error.
void make_store(const std::filesystem::path& file, const std::string& vfs);

// Checks that this version of Armloom wrote the file. Throws SqlFault, or std::runtime_error if the
// file is another program's, an older or newer version's, or has lost its tables.
void check_version(const Database& database);
// Checks the version and the integrity of the whole file. Throws like check_version.
void check_store(const Database& database);

}  // namespace armloom
