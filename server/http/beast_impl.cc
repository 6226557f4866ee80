// The one place where the bodies of asio and Beast are compiled (…_SEPARATE_COMPILATION).
#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>
// clang-format off: first of all
#include <utility>
// clang-format on
