#pragma once

#include <string>

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/request_head.h"
#include "server/http/transport.h"

namespace armloom {

// Accepts the upgrade and sends what the subscription has until either side ends it. What the
// client sends is read and ignored. A subscription that says why it closes is closed with that
// reason.
Awaitable<void> serve_websocket(Transport stream, RequestHeader upgrade, std::string request_id,
                                EventStream events, const Site& site);

}  // namespace armloom
