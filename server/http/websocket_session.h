#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "server/http/asio.h"
#include "server/http/message.h"

namespace armloom {

// Accepts the upgrade and sends what the feed has until either side ends it. What the client sends
// is read and ignored. A feed that says farewell is closed with that reason.
asio::awaitable<void> serve_websocket(
    boost::beast::tcp_stream stream,
    boost::beast::http::request<boost::beast::http::string_body> upgrade, EventStream events);

}  // namespace armloom
