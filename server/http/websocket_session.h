#pragma once

#include <string>

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/request_head.h"
#include "server/http/transport.h"

namespace armloom {

// Accepts the upgrade and sends the subscription's messages until either side ends it. Ignores
// client messages. Closes with the subscription's reason, if any.
Awaitable<void> serve_websocket(Transport stream, RequestHeader upgrade, std::string request_id,
                                EventStream events, const Site& site);

}  // namespace armloom
