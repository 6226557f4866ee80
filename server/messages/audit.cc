#include "server/messages/audit.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<AuditPage> audit_page_format() {
  static const auto entry = named(
      "AuditEntry", "A request that changed something or was refused.",
      object<AuditRecord>({
          output_only("at", &AuditRecord::at, text(), "Time of the answer: RFC 3339, UTC"),
          output_only("who", &AuditRecord::who, nullable(text()),
                      "The token's name; null if the request had no valid token, or if no token is "
                      "required"),
          output_only("from", &AuditRecord::from, text(), "IP address of the client"),
          output_only("method", &AuditRecord::method, text()),
          output_only("path", &AuditRecord::path, text()),
          output_only("status", &AuditRecord::status, integer(100, 599),
                      "HTTP status of the answer"),
      }));
  static const auto format =
      named("AuditPage", "",
            object<AuditPage>({
                output_only("entries", &AuditPage::entries, list(entry), "Newest first"),
                output_only("damaged", &AuditPage::damaged, count(),
                            "Number of corrupt entries that were left out of this page"),
                output_only("next_cursor", &AuditPage::next_cursor, nullable(text()),
                            "Value for `?cursor=` to get the next page; null on the last page"),
            }));
  return format;
}

}  // namespace armloom
