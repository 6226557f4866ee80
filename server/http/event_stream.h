#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <string_view>

#include "server/http/asio.h"
#include "server/http/message.h"

namespace armloom {

// Makes a `Last-Event-ID: <stream>:<seq>` the `?stream=&since=` of the target: it is newer than
// what the address says, because a browser repeats the address when it comes back.
void resume_after(std::string_view last_event_id, Target& target);

// Answers with the feed as Server-Sent Events ("id: <stream>:<seq>", "data: <envelope>") until
// either side ends it. Pose frames only with `?poses=1`. When nothing was sent for site.keep_alive,
// a comment line keeps the proxies between from closing the connection.
asio::awaitable<void> serve_event_stream(boost::beast::tcp_stream stream, Target target,
                                         const Site& site);

}  // namespace armloom
