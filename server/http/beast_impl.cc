// Compiles the function bodies of asio and Beast (…_SEPARATE_COMPILATION).
// clang-format off: <utility> first, awaitable.hpp of Boost 1.74 forgets it
#include <boost/asio/impl/src.hpp>
#include <boost/asio/ssl/impl/src.hpp>
#include <boost/beast/src.hpp>
#include <utility>
// clang-format on
