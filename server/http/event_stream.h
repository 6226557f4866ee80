#pragma once

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

// Answers with the subscription as Server-Sent Events ("id: <id>:<seq>", "data: <envelope>") until
// either side ends it. When nothing was sent for site.keep_alive, a comment line keeps the proxies
// between from closing the connection. `only_head`: of a HEAD.
Awaitable<void> serve_event_stream(Transport stream, const Request& request, EventStream events,
                                   const Site& site, bool only_head);

}  // namespace armloom
