#pragma once

#include <boost/beast/core/tcp_stream.hpp>

#include "server/http/asio.h"
#include "server/http/message.h"

namespace armloom {

// Answers with the feed as Server-Sent Events ("id: <id>:<seq>", "data: <envelope>") until either
// side ends it. When nothing was sent for site.keep_alive, a comment line keeps the proxies between
// from closing the connection.
asio::awaitable<void> serve_event_stream(boost::beast::tcp_stream stream, EventStream events,
                                         const Site& site);

}  // namespace armloom
