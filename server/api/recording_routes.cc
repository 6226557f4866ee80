#include <functional>
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

// Writes all states measured so far to the recording's files, then runs `look` on a worker thread.
void look_aside(const ApiParts& parts, std::function<void()> look) {
  if (parts.recording == nullptr) return parts.aside(std::move(look));
  ask(
      parts,
      [recording = parts.recording](Executive&) {
        recording->catch_up_states();
        return true;
      },
      [&parts, look = std::move(look)](bool) { parts.aside(look); });
}

void get_recordings(Call call) {
  const ApiParts& parts = call.parts;
  look_aside(parts, [&parts, &files = call.recordings, respond = std::move(call.respond)] {
    parts.post([list = std::make_shared<RecordingList>(files.list()), respond] {
      respond(answer(200, recording_list_format(), *list));
    });
  });
}

// Returns a body that is read in pieces on a worker thread, because disks are slow.
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

Response answer_of(const ApiParts& parts, const std::string& save_as,
                   RecordingFiles::Opened opened) {
  Response response{200, "application/octet-stream"};
  response.headers = {{"Content-Disposition", "attachment; filename=\"" + save_as + "\""},
                      {"Cache-Control", "no-store"}};
  response.pieces = body_of(parts, std::move(opened));
  return response;
}

void get_recording_file(Call call) {
  const ApiParts& parts = call.parts;
  const std::string name = call.arguments[0], file = call.arguments[1];
  look_aside(parts, [&parts, &files = call.recordings, name, file, respond = call.respond] {
    auto found =
        std::make_shared<tl::expected<RecordingFiles::Opened, NoFile>>(files.open(name, file));
    parts.post([&parts, found, name, file, respond] {
      if (*found) return respond(answer_of(parts, name + "-" + file, std::move(**found)));
      respond(found->error() == NoFile::busy ? refusal_response(too_many_files())
                                             : no_such_file(name + "/" + file));
    });
  });
}

}  // namespace

std::vector<Route> recording_routes() {
  Route list{.method = "GET",
             .path = api_path("/recordings"),
             .id = "listRecordings",
             .tag = "recordings",
             .summary = "List the recordings in the server's data folder"};
  list.text =
      "Each session with `--data` writes one recording. `--keep-recordings`, "
      "`--keep-recording-days` and `--keep-recording-mb` bound how many are kept.";
  list.outcomes = {outcome(200, "All recordings", recording_list_format())};
  list.run = get_recordings;
  Route file{.method = "GET",
             .path = api_path("/recordings/{name}/{file}"),
             .id = "getRecordingFile",
             .tag = "recordings",
             .summary = "Download a file of a recording"};
  file.text =
      "Returns one of the listed files, for `armloom audit`, `armloom replay` and the dashboard. "
      "`inputs.jsonl` and `jobs.json` contain the requests of clients but no tokens or keys, so "
      "every role may read them. A file of a recording in progress is returned up to its last "
      "complete line; `jobs.json` is then incomplete. 503 if too many files are being read.";
  file.outcomes = {{200,
                    "The file",
                    {{"application/octet-stream", {{"type", "string"}, {"format", "binary"}}}}}};
  file.refuses = {404};
  file.run = get_recording_file;
  return {list, file};
}

}  // namespace armloom
