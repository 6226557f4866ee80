#pragma once

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

// Responds with the subscription as Server-Sent Events ("id: <id>:<seq>", "data: <envelope>") until
// either side ends it. After each silence of site.keep_alive, sends a comment line, so that proxies
// do not close the connection. `only_head`: for HEAD.
Awaitable<void> serve_event_stream(Transport stream, const Request& request, EventStream events,
                                   const Site& site, bool only_head);

}  // namespace armloom
