#include "server/messages/recording.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<RecordingList> recording_list_format() {
  static const auto file = named("RecordingFile", "",
                                 object<RecordingFileView>({
                                     output_only("name", &RecordingFileView::name, text()),
                                     output_only("bytes", &RecordingFileView::bytes, count()),
                                 }));
  static const auto recording = named(
      "Recording", "Recording of one server session.",
      object<RecordingView>({
          output_only("name", &RecordingView::name, text(),
                      "Name of the folder; `data` if the recording is in the data folder itself"),
          output_only("begun_at", &RecordingView::begun_at, nullable(text()),
                      "Start of the session: RFC 3339, UTC; null if unknown"),
          output_only("written_at", &RecordingView::written_at, text(),
                      "Last write: RFC 3339, UTC"),
          output_only("running", &RecordingView::is_running, flag(),
                      "true while the recording is being written"),
          output_only("has_states", &RecordingView::has_states, flag(),
                      "true if the recording has joint positions (`serve --record`)"),
          output_only("files", &RecordingView::files, list(file), "Files that GET returns"),
      }));
  static const auto format = named(
      "RecordingList", "",
      object<RecordingList>({
          output_only("kept", &RecordingList::is_kept, flag(),
                      "true if this server records (`--data`)"),
          output_only("recordings", &RecordingList::recordings, list(recording), "Newest first"),
      }));
  return format;
}

}  // namespace armloom
