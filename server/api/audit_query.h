#pragma once

#include <cstddef>

#include "core/base/problem.h"
#include "server/http/message.h"
#include "server/store/job_history.h"

namespace armloom {

// The query of GET /audit: ?who=&from=&method=&path=&status=&since=&before=&limit=&cursor=
struct AuditQuery {
  inline static constexpr std::size_t kLimit = 100;  // when none is given
  inline static constexpr std::size_t kLimitMax = 1000;

  AuditFilter filter = {};
  std::size_t limit = kLimit;
};

// Problems (invalid), one for each parameter that cannot be read.
[[nodiscard]] Result<AuditQuery> read_audit_query(const Target& target);

}  // namespace armloom
