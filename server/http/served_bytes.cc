#include "server/http/served_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "server/http/entity_tag.h"

namespace armloom {
namespace {

constexpr int kStoredLevel = 6;  // for bytes that are compressed once

}  // namespace

std::string gzipped(const std::string& bytes, int level) {
  static constexpr int kGzip = 15 + 16;  // the largest window; a gzip header instead of zlib's
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("zlib cannot start compressing");
  }
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int ended = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (ended != Z_STREAM_END) throw std::runtime_error("zlib cannot finish compressing");
  return out;
}

namespace {

// A coding such as "gzip;q=0.5": name, and whether its weight is above zero.
struct Coding {
  std::string name;
  bool wanted = true;
};
Coding coding_of(std::string_view text) {
  std::string small;
  for (const char c : text) {
    if (c != ' ' && c != '\t') {
      small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  const std::size_t weight = small.find(";q=");
  const bool zero = weight != small.npos && small.find_first_not_of("0.", weight + 3) == small.npos;
  return {small.substr(0, small.find(';')), !zero};
}

}  // namespace

ServedBytes served(std::string bytes, bool text) {
  ServedBytes result;
  result.tag = tag_of(bytes);
  result.plain = std::make_shared<const std::string>(std::move(bytes));
  if (text && result.plain->size() >= kPackFrom) {
    std::string packed = gzipped(*result.plain, kStoredLevel);
    packed.shrink_to_fit();
    if (packed.size() < result.plain->size()) {
      result.packed = std::make_shared<const std::string>(std::move(packed));
    }
  }
  return result;
}

bool accepts_gzip(std::string_view accept_encoding) {
  bool any = false;
  while (!accept_encoding.empty()) {
    const std::string_view one = accept_encoding.substr(0, accept_encoding.find(','));
    accept_encoding.remove_prefix(std::min(accept_encoding.size(), one.size() + 1));
    const Coding coding = coding_of(one);
    if (coding.name == "gzip" || coding.name == "x-gzip") return coding.wanted;
    if (coding.name == "*") any = coding.wanted;
  }
  return any;
}

Response answer_bytes(const Request& request, const ServedBytes& bytes, std::string content_type) {
  const bool pack = bytes.packed && accepts_gzip(request.accept_encoding);
  Response response;
  response.content_type = std::move(content_type);
  response.shared = pack ? bytes.packed : bytes.plain;
  response.headers.emplace_back("ETag", '"' + bytes.tag + (pack ? "-gzip\"" : "\""));
  if (bytes.packed) response.headers.emplace_back("Vary", "Accept-Encoding");
  if (pack) response.headers.emplace_back("Content-Encoding", "gzip");
  return response;
}

}  // namespace armloom
