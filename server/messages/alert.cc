#include "server/messages/alert.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/rfc3339.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"
#include "server/messages/who.h"

namespace armloom {

using namespace formats;

FormatPtr<AlertList> alert_list_format() {
  using Seen = StoredAlert::Acknowledgement;
  static const auto seen =
      named("Acknowledgement", "",
            object<Seen>({
                told("who", &Seen::who, text(), "The token's name, or whoever said to be it"),
                told(
                    "at", [](const Seen& s) { return rfc3339(s.at_ms); }, text(), "RFC 3339, UTC"),
            }));
  static const auto alert = named(
      "KeptAlert", "What somebody has to see to, until somebody has.",
      object<StoredAlert>({
          told("id", &StoredAlert::id, text(), "`<stream>:<seq>` of the event that told it"),
          told(
              "at", [](const StoredAlert& a) { return rfc3339(a.at_ms); }, text(), "RFC 3339, UTC"),
          told("level", &StoredAlert::level, text(), "warning, error"),
          told("text", &StoredAlert::text, text()),
          told("acknowledged", &StoredAlert::acknowledged, nullable(seen), "null: by nobody yet"),
      }));
  static const auto format =
      named("AlertList", "",
            object<AlertList>({told("alerts", &AlertList::alerts, list(alert), "Newest first")}));
  return format;
}

FormatPtr<AlertsSeen> alerts_seen_format() {
  static const auto format = named(
      "AlertsSeen", "Somebody has seen to these alerts.",
      object<AlertsSeen>({
          required("ids", &AlertsSeen::ids, list(text()), "Of `GET /alerts`"),
          field("who", &AlertsSeen::who, who_format(),
                "Whoever does it; where tokens are asked for, the token's name counts instead"),
      }));
  return format;
}

Result<AlertsSeen> read_alerts_seen(std::string_view text) {
  return read_text(*alerts_seen_format(), text);
}

}  // namespace armloom
