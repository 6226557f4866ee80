#include "server/codec/rfc3339.h"

#include <chrono>
#include <cstdio>
#include <ctime>

namespace armloom {
namespace {

// Reads a time piece by piece from the front of a text. After the first mismatch, are_all() returns
// false.
class TimeText {
 public:
  explicit TimeText(std::string_view text) : text_(text) {}

  int digits(std::size_t count) {
    int number = 0;
    for (std::size_t i = 0; i < count; ++i) number = 10 * number + digit();
    return number;
  }
  // Reads one of the `wanted` characters and returns it.
  char one_of(std::string_view wanted) {
    const char found = text_.empty() ? '\0' : text_.front();
    is_right_ = is_right_ && !text_.empty() && wanted.find(found) != std::string_view::npos;
    if (is_right_) text_.remove_prefix(1);
    return found;
  }
  // Reads an optional fraction, ".125".
  int milliseconds() {
    if (text_.empty() || text_.front() != '.') return 0;
    int sum = 0;
    for (int of_each = (one_of("."), 100); is_right_; of_each /= 10) {
      sum += of_each * digit();
      if (text_.empty() || text_.front() < '0' || text_.front() > '9') break;
    }
    return sum;
  }
  [[nodiscard]] bool are_all() const { return is_right_ && text_.empty(); }

 private:
  int digit() { return one_of("0123456789") - '0'; }
  std::string_view text_;
  bool is_right_ = true;
};

}  // namespace

std::string rfc3339(std::int64_t since_1970_ms) {
  using std::chrono::milliseconds;
  const auto seconds = std::chrono::floor<std::chrono::seconds>(milliseconds(since_1970_ms));
  const std::time_t whole = seconds.count();
  std::tm parts{};
  gmtime_r(&whole, &parts);
  char date[32];
  char text[48];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text, sizeof text, "%s.%03dZ", date,
                static_cast<int>(since_1970_ms - milliseconds(seconds).count()));
  return text;
}

std::optional<std::int64_t> read_rfc3339(std::string_view text) {
  using namespace std::chrono;
  TimeText parts(text);
  const year y{parts.digits(4)};
  parts.one_of("-");
  const month m{static_cast<unsigned>(parts.digits(2))};
  parts.one_of("-");
  const day d{static_cast<unsigned>(parts.digits(2))};
  parts.one_of("Tt ");
  const int h = parts.digits(2);
  parts.one_of(":");
  const int min = parts.digits(2);
  parts.one_of(":");
  const int s = parts.digits(2);
  const int ms = parts.milliseconds();
  const char sign = parts.one_of("Zz+-");
  minutes offset{};
  if (sign == '+' || sign == '-') {
    const hours whole{parts.digits(2)};
    parts.one_of(":");
    const minutes rest{parts.digits(2)};
    if (whole > hours(23) || rest > minutes(59)) return std::nullopt;
    offset = sign == '+' ? whole + rest : -(whole + rest);
  }
  const year_month_day date{y, m, d};
  if (!parts.are_all() || !date.ok() || h > 23 || min > 59 || s > 60) return std::nullopt;
  const auto wall =
      sys_days(date) + hours(h) + minutes(min) + seconds(s) + milliseconds(ms) - offset;
  return time_point_cast<milliseconds>(wall).time_since_epoch().count();
}

}  // namespace armloom
