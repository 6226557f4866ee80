#include "server/recording/csv_text.h"

#include <charconv>
#include <cmath>

namespace armloom {
namespace {

constexpr std::int64_t kNano = 1'000'000'000;

}  // namespace

void append_fraction(std::string& out, std::int64_t billionths, int decimals) {
  char text[32];
  char* at = text;
  if (billionths < 0) {
    *at++ = '-';
    billionths = -billionths;
  }
  at = std::to_chars(at, text + sizeof text, billionths / kNano).ptr;
  *at++ = '.';
  std::int64_t rest = billionths % kNano;
  std::int64_t unit = kNano / 10;
  for (int i = 0; i < decimals; ++i, unit /= 10) {
    *at++ = static_cast<char>('0' + rest / unit);
    rest %= unit;
  }
  out.append(text, static_cast<std::size_t>(at - text));
}

void append_seconds(std::string& out, TimePoint time) {
  const std::int64_t nano = time.time_since_epoch().count();
  append_fraction(out, nano, nano % 1'000'000 == 0 ? 3 : 9);
}

std::vector<std::string_view> split_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> read_number(std::string_view field) {
  double number = 0.0;
  const char* end = field.data() + field.size();
  const auto [stop, ec] = std::from_chars(field.data(), end, number);
  const bool finite = ec == std::errc{} && stop == end && std::isfinite(number);
  return finite && std::abs(number) <= 9e8 ? std::optional(number) : std::nullopt;
}

}  // namespace armloom
