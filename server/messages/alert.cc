#include "server/messages/alert.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/rfc3339.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/who.h"

namespace armloom {

using namespace formats;

FormatPtr<AlertList> alert_list_format() {
  using Seen = StoredAlert::Acknowledgement;
  static const auto seen = named(
      "Acknowledgement", "",
      object<Seen>({
          output_only(
              "who", &Seen::who, text(),
              "The token's name; without tokens, the name that the client gave, or its address"),
          output_only(
              "at", [](const Seen& s) { return rfc3339(s.at_ms); }, text(), "RFC 3339, UTC"),
      }));
  static const auto alert = named(
      "KeptAlert", "A warning or error, kept until it is acknowledged.",
      object<StoredAlert>({
          output_only("id", &StoredAlert::id, text(),
                      "`<stream>:<seq>` of the event that reported the alert"),
          output_only(
              "at", [](const StoredAlert& a) { return rfc3339(a.at_ms); }, text(), "RFC 3339, UTC"),
          output_only("level", &StoredAlert::level, text(), "`warning` or `error`"),
          output_only("text", &StoredAlert::text, text()),
          output_only("acknowledged", &StoredAlert::acknowledged, nullable(seen),
                      "null while nobody has acknowledged the alert"),
      }));
  static const auto format = named(
      "AlertList", "",
      object<AlertList>({output_only("alerts", &AlertList::alerts, list(alert), "Newest first")}));
  return format;
}

FormatPtr<AlertsSeen> alerts_seen_format() {
  static const auto format = named(
      "AlertsSeen", "Acknowledges these alerts.",
      object<AlertsSeen>({
          required("ids", &AlertsSeen::ids, list(text()), "Ids of alerts from `GET /alerts`"),
          field(
              "who", &AlertsSeen::who, who_format(),
              "Name of the person who acknowledges; with tokens, the token's name applies instead"),
      }));
  return format;
}

Result<AlertsSeen> read_alerts_seen(std::string_view text) {
  return read_text(*alerts_seen_format(), text);
}

}  // namespace armloom
