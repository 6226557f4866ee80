#include "server/messages/who.h"

#include <algorithm>
#include <string_view>

#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"

namespace armloom {
namespace {

// The characters that \s matches in a JSON Schema pattern, without control characters.
constexpr std::string_view kWhiteSpace[] = {
    " ",  // U+0020, U+00A0, U+1680, U+2000 to U+200A,
          // U+2028, U+2029, U+202F, U+205F, U+3000, U+FEFF
    "\xc2\xa0", "\xe1\x9a\x80", "\xe2\x80\x80", "\xe2\x80\x81", "\xe2\x80\x82", "\xe2\x80\x83",
    "\xe2\x80\x84", "\xe2\x80\x85", "\xe2\x80\x86", "\xe2\x80\x87", "\xe2\x80\x88", "\xe2\x80\x89",
    "\xe2\x80\x8a", "\xe2\x80\xa8", "\xe2\x80\xa9", "\xe2\x80\xaf", "\xe2\x81\x9f", "\xe3\x80\x80",
    "\xef\xbb\xbf"};

bool is_blank(std::string_view text) {
  while (!text.empty()) {
    const auto found = std::ranges::find_if(
        kWhiteSpace, [&](std::string_view space) { return text.starts_with(space); });
    if (found == std::end(kWhiteSpace)) return false;
    text.remove_prefix(found->size());
  }
  return true;
}

bool is_who(std::string_view text) {
  return text.empty() || (is_job_name(text) && !is_blank(text));
}

}  // namespace

FormatPtr<std::string> who_format() {
  return formats::text(
      {is_who,
       "bad-name",
       "\"who\" must have at most 256 characters, no control characters, and not only white space",
       {{"maxLength", kJobNameMax}, {"pattern", R"(^([^\u0000-\u001f]*\S[^\u0000-\u001f]*)?$)"}}});
}

}  // namespace armloom
