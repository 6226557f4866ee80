#include "server/messages/recording.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<RecordingList> recording_list_format() {
  static const auto file = named("RecordingFile", "",
                                 object<RecordingFileView>({
                                     told("name", &RecordingFileView::name, text()),
                                     told("bytes", &RecordingFileView::bytes, count()),
                                 }));
  static const auto recording =
      named("Recording", "What one run of a server has written down.",
            object<RecordingView>({
                told("name", &RecordingView::name, text(),
                     "Of its folder; `data`: it stands in the data folder itself"),
                told("begun_at", &RecordingView::begun_at, nullable(text()),
                     "RFC 3339, UTC; null: not known"),
                told("written_at", &RecordingView::written_at, text(), "Last: RFC 3339, UTC"),
                told("running", &RecordingView::is_running, flag(), "It is being written"),
                told("has_states", &RecordingView::has_states, flag(),
                     "Whether joint positions are in it, which `serve` records with `--record`"),
                told("files", &RecordingView::files, list(file), "What GET hands out of it"),
            }));
  static const auto format =
      named("RecordingList", "",
            object<RecordingList>({
                told("kept", &RecordingList::is_kept, flag(),
                     "Whether this server records: without `--data` it does not"),
                told("recordings", &RecordingList::recordings, list(recording), "Newest first"),
            }));
  return format;
}

}  // namespace armloom
