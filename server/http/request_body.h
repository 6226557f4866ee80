#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/parser.hpp>
#include <cstdint>
#include <string>

#include "server/http/error_code.h"
#include "server/http/memory_budget.h"

namespace armloom {

// A body for Beast's parser that allocates as bytes arrive. Fails with not_enough_memory if the
// budget of all bodies is exhausted.
struct RequestBody {
  struct value_type {
    std::string text;
    MemoryBudget::Charge charge;
  };

  class reader {
   public:
    template <bool isRequest, class Fields>
    reader(boost::beast::http::header<isRequest, Fields>&, value_type& body) : body_(body) {}
    void init(const boost::optional<std::uint64_t>&, ErrorCode& ec) { ec = {}; }
    template <class Buffers>
    std::size_t put(const Buffers& buffers, ErrorCode& ec) {
      const std::size_t size = boost::asio::buffer_size(buffers);
      if (!body_.charge.grow_to(body_.text.size() + size)) {
        ec = make_error_code(boost::system::errc::not_enough_memory);
        return 0;
      }
      const std::size_t at = body_.text.size();
      body_.text.resize(at + size);
      boost::asio::buffer_copy(boost::asio::buffer(body_.text.data() + at, size), buffers);
      ec = {};
      return size;
    }
    void finish(ErrorCode& ec) { ec = {}; }

   private:
    value_type& body_;
  };
};

using RequestParser = boost::beast::http::request_parser<RequestBody>;

}  // namespace armloom
