#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "server/store/database.h"

namespace armloom {

inline constexpr const char* kStoreFile = "armloom.db";  // in the data folder

// What `sum` of a row is as long as the row is as it was written (Database::know_checksum).
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
inline constexpr std::int64_t kVersionWithSums = 5;     // of jobs
inline constexpr std::int64_t kVersionWithAllSums = 6;  // of alerts and the audit trail, too
inline constexpr std::int64_t kVersionWithRequests = 10;

// Makes a new file with tables and nothing in them. It is made beside its place and put there
// whole: whatever stands in that place has held jobs, also where it is empty. `vfs`: as Database
// has it. Throws SqlFault, std::system_error.
void make_store(const std::filesystem::path& file, const std::string& vfs);

// Looks the file through, then brings the tables of an older version of the program to this one's,
// all or nothing: where it throws the file is as it was. Throws SqlFault; std::runtime_error where
// the file is another program's, a newer version's, has lost its tables or is not whole.
void bring_up_to_date(Database& database);

}  // namespace armloom
