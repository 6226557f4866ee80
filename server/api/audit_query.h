#pragma once

#include <cstddef>

#include "server/api/query_format.h"
#include "server/store/job_history.h"

namespace armloom {

struct AuditQuery : AuditFilter {
  std::size_t limit = query::kPage;
};
[[nodiscard]] const QueryFormat<AuditQuery>& audit_query();

}  // namespace armloom
