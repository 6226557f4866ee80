#include "server/messages/audit.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<AuditPage> audit_page_format() {
  static const auto entry =
      named("AuditEntry", "That someone did, or was not let do, something.",
            object<AuditRecord>({
                told("at", &AuditRecord::at, text(), "When it was answered: RFC 3339, UTC"),
                told("who", &AuditRecord::who, nullable(text()),
                     "The token's name; null: none was shown, or none is asked for"),
                told("from", &AuditRecord::from, text(), "The address that it came from"),
                told("method", &AuditRecord::method, text()),
                told("path", &AuditRecord::path, text()),
                told("status", &AuditRecord::status, integer(100, 599), "Of the answer"),
            }));
  static const auto format =
      named("AuditPage", "",
            object<AuditPage>({
                told("entries", &AuditPage::entries, list(entry), "Newest first"),
                told("damaged", &AuditPage::damaged, count(),
                     "So many between these are not as they were written, and left out"),
                told("next_cursor", &AuditPage::next_cursor, nullable(text()),
                     "For ?cursor=; null on the last page"),
            }));
  return format;
}

}  // namespace armloom
