#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "server/store/database.h"

namespace armloom {

inline constexpr const char* kStoreFile = "armloom.db";  // in the data folder

// SQL expressions for the value of `sum` in an intact row of each table (Database::know_checksum).
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
inline constexpr const char* kSumOfSpeed = "checksum(speed_override.arm, speed_override.text)";
inline constexpr const char* kSumOfObject =
    "checksum(scene_object.number, scene_object.name, scene_object.text)";
inline constexpr const char* kSumOfRequest =
    "checksum(request.key, request.place, request.digest, request.job)";

// Creates a store with empty tables under another name, then renames it to `file`. So a file at
// this path was once a complete store, even if it is empty now. `vfs`: see Database. Throws
// SqlFault, std::system_error.
void make_store(const std::filesystem::path& file, const std::string& vfs);

// Checks that this version of Armloom, or an earlier one whose tables upgrade() extends, wrote the
// file. Throws SqlFault, or std::runtime_error if another program or another version of Armloom
// wrote the file, or if its tables are lost.
void check_version(const Database& database);
// Adds the tables that a file of an earlier version lacks. Precondition: check_version().
void upgrade(Database& database);
// Checks the version and the integrity of the whole file. Throws the same exceptions as
// check_version().
void check_store(const Database& database);

}  // namespace armloom
