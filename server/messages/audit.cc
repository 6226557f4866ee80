#include "server/messages/audit.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<AuditPage> audit_page_format() {
  static const auto entry = named(
      "AuditEntry", "A request that changed something or was refused.",
      object<AuditRecord>({
          told("at", &AuditRecord::at, text(), "Time of the answer: RFC 3339, UTC"),
          told("who", &AuditRecord::who, nullable(text()),
               "The token's name; null if the request had no valid token, or if no token is "
               "required"),
          told("from", &AuditRecord::from, text(), "IP address of the client"),
          told("method", &AuditRecord::method, text()),
          told("path", &AuditRecord::path, text()),
          told("status", &AuditRecord::status, integer(100, 599), "HTTP status of the answer"),
      }));
  static const auto format =
      named("AuditPage", "",
            object<AuditPage>({
                told("entries", &AuditPage::entries, list(entry), "Newest first"),
                told("damaged", &AuditPage::damaged, count(),
                     "Number of corrupt entries between these, left out"),
                told("next_cursor", &AuditPage::next_cursor, nullable(text()),
                     "Value for `?cursor=` to get the next page; null on the last page"),
            }));
  return format;
}

}  // namespace armloom
