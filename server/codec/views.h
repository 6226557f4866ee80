#pragma once

#include <cstdint>
#include <string>

#include "core/executive/events.h"
#include "core/executive/executive.h"
#include "core/model/cell.h"
#include "server/codec/json_writer.h"
#include "server/codec/wall_clock.h"

namespace armloom {

// How what the executive tells is written as JSON (DESIGN.md section 5). `clock` is null in a
// simulated run: keys ending in `_at` are then absent.

void write(JsonWriter& out, const JobView& job, const WallClock* clock);
void write(JsonWriter& out, const ArmView& arm);
// A Verdict, as a whole object.
void write(JsonWriter& out, const CheckView& verdict);
// Its fields alone, so that others can stand beside them.
void write_fields(JsonWriter& out, const CheckView& verdict);

// The coordination diagram of two jobs, as a whole object.
void write(JsonWriter& out, const DiagramView& diagram);

// One envelope {"stream", "seq", "type", "t_s", "at", "data"}.
[[nodiscard]] std::string event_json(const Event& event, const std::string& stream,
                                     const WallClock* clock);

// The envelope that a new subscriber gets first. `gap`: events were lost since it was here last.
[[nodiscard]] std::string snapshot_json(const Snapshot& snapshot, const Cell& cell,
                                        const std::string& stream, double speed,
                                        const WallClock& clock, bool gap);

// A pose frame, without stream and seq; positions rounded to 1e-6.
[[nodiscard]] std::string state_json(const StateFrame& frame, const Cell& cell);

// The `stream` of a simulated run: a UUID (version 8) that follows from the seed.
[[nodiscard]] std::string stream_of_seed(std::uint64_t seed);
// The `stream` of a run of the server: a random UUID (version 4).
[[nodiscard]] std::string random_stream();

}  // namespace armloom
