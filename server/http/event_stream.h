#pragma once

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

// Sends the subscription's messages as Server-Sent Events ("id: <id>:<seq>", "data: <envelope>")
// until either side ends the stream. If nothing was sent for site.keep_alive, sends a comment line,
// so that proxies do not close the connection. `only_head`: sends only the header (for HEAD).
Awaitable<void> serve_event_stream(Transport stream, const Request& request, EventStream events,
                                   const Site& site, bool only_head);

}  // namespace armloom
