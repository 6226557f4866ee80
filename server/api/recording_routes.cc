// What runs of the server have written down, handed out.
#include <memory>
#include <utility>

#include "server/api/recording_files.h"
#include "server/api/route.h"

namespace armloom {
namespace {

Response no_such_file(const std::string& name) {
  return problem_response({Problem{ProblemKind::not_found, "no-such-recording-file",
                                   "request target", "no recording has the file " + name, name}});
}

void get_recordings(Call call) {
  const ApiParts& parts = call.parts;
  parts.aside([&parts, &files = call.recordings, respond = std::move(call.respond)] {
    parts.post([list = std::make_shared<RecordingList>(files.list()), respond] {
      respond(answer(200, recording_list_format(), *list));
    });
  });
}

// Each piece is read aside: who reads a large file from a slow disk holds up nobody.
PiecedBody body_of(const ApiParts& parts, RecordingFiles::Opened opened) {
  return {opened.size, [&parts, file = std::move(opened.file)](
                           std::uintmax_t from, std::size_t count, PiecedBody::Then then) {
            parts.aside([&parts, file, from, count, then = std::move(then)] {
              auto bytes = std::make_shared<tl::expected<std::string, NoFile>>(
                  file->read(static_cast<std::size_t>(from), count));
              parts.post([bytes, then] {
                then(*bytes ? std::optional(std::move(**bytes)) : std::nullopt);
              });
            });
          }};
}

void get_recording_file(Call call) {
  const ApiParts& parts = call.parts;
  const std::string name = call.arguments[0], file = call.arguments[1];
  const auto hand_out = [&parts, &files = call.recordings, name, file, respond = call.respond] {
    parts.aside([&parts, &files, name, file, respond] {
      auto found =
          std::make_shared<tl::expected<RecordingFiles::Opened, NoFile>>(files.open(name, file));
      parts.post([&parts, found, name, file, respond] {
        if (!*found && found->error() == NoFile::busy)
          return respond(refusal_response(too_many_files()));
        if (!*found) return respond(no_such_file(name + "/" + file));
        Response response{200, "application/octet-stream"};
        response.headers = {
            {"Content-Disposition", "attachment; filename=\"" + name + "-" + file + "\""},
            {"Cache-Control", "no-store"}};
        response.pieces = body_of(parts, std::move(**found));
        respond(std::move(response));
      });
    });
  };
  if (!call.recordings.is_running(name)) return hand_out();
  // What was measured until now, too.
  ask(
      parts,
      [recording = parts.recording](Executive&) {
        recording->catch_up_states();
        return true;
      },
      [hand_out](bool) { hand_out(); });
}

}  // namespace

std::vector<Route> recording_routes() {
  Route list{.method = "GET",
             .path = api_path("/recordings"),
             .id = "listRecordings",
             .tag = "recordings",
             .summary = "The recordings in the server's data folder"};
  list.text =
      "Each run with `--data` writes one; `--keep-recordings` and the like say how long they stay.";
  list.outcomes = {outcome(200, "All of them", recording_list_format())};
  list.run = get_recordings;
  Route file{.method = "GET",
             .path = api_path("/recordings/{name}/{file}"),
             .id = "getRecordingFile",
             .tag = "recordings",
             .summary = "A file of a recording"};
  file.text =
      "One of those that the list names, as it is on the disk: `armloom audit`, `armloom replay` "
      "and the dashboard read them. `inputs.jsonl` and `jobs.json` hold what clients asked for, "
      "as `GET /jobs/{id}/trajectory` tells it, and neither tokens nor keys: who may look at the "
      "cell may read them. Of the recording that is being written so much as there is, in whole "
      "lines; its `jobs.json` lacks its end. 503: too many are being read.";
  file.outcomes = {{200,
                    "The file",
                    {{"application/octet-stream", {{"type", "string"}, {"format", "binary"}}}}}};
  file.refuses = {404};
  file.run = get_recording_file;
  return {list, file};
}

}  // namespace armloom
