#pragma once

#include <boost/system/error_code.hpp>

namespace armloom {

using ErrorCode = boost::system::error_code;

}  // namespace armloom
