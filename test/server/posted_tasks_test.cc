#include "server/http/posted_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <thread>
#include <vector>

namespace armloom {
namespace {

constexpr std::size_t kTasks = 500;

void take_a_while() {
  const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(100);
  while (std::chrono::steady_clock::now() < until) std::this_thread::yield();
}

TEST(PostedTasks, LetSocketsRunBetweenTasks) {
  asio::io_context io{1};
  PostedTasks posted(io);
  asio::local::stream_protocol::socket ours(io), peers(io);
  asio::local::connect_pair(ours, peers);
  std::size_t done = 0, done_when_read = 0;
  std::array<char, 4> text{};
  ours.async_receive(asio::buffer(text), [&](ErrorCode, std::size_t) { done_when_read = done; });
  posted.post([&] { peers.send(asio::buffer("stop", 4)); });
  for (std::size_t i = 0; i < kTasks; ++i) {
    posted.post([&] {
      take_a_while();
      ++done;
    });
  }
  io.run();
  EXPECT_EQ(done, kTasks);
  EXPECT_EQ(std::string(text.data(), text.size()), "stop");
  EXPECT_LT(done_when_read, kTasks) << "it waited for all that was posted";
}

TEST(PostedTasks, RunInOrderOfPosting) {
  asio::io_context io{1};
  PostedTasks posted(io);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < kTasks; ++i) {
    posted.post([&, i] {
      if (i == 0) posted.post([&] { order.push_back(kTasks); });
      take_a_while();
      order.push_back(i);
    });
  }
  io.run();
  EXPECT_EQ(order.size(), kTasks + 1);
  EXPECT_TRUE(std::ranges::is_sorted(order));
}

}  // namespace
}  // namespace armloom
