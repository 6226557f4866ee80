#pragma once

#include <string>

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/request_head.h"
#include "server/http/transport.h"

namespace armloom {

// Accepts the upgrade and sends the subscription's messages until either side ends it, with the
// close reason if the subscription has one. Ignores messages of the client.
Awaitable<void> serve_websocket(Transport stream, RequestHeader upgrade, std::string request_id,
                                EventStream events, const Site& site);

}  // namespace armloom
