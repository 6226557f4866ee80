#include "server/http/static_files.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "server/http/security_headers.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".webp", "image/webp"},
    {".ico", "image/x-icon"},
    {".woff", "font/woff"},
    {".woff2", "font/woff2"},
    {".ttf", "font/ttf"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".webmanifest", "application/manifest+json"},
    {".glb", "model/gltf-binary"},
}};

std::string_view type_of(const fs::path& file) {
  const std::string extension = file.extension().string();
  const auto it = std::find_if(kTypes.begin(), kTypes.end(),
                               [&](const auto& entry) { return entry.first == extension; });
  return it == kTypes.end() ? "application/octet-stream" : it->second;
}

bool has_hidden_part(const fs::path& relative) {
  return std::any_of(relative.begin(), relative.end(),
                     [](const fs::path& part) { return part.string().starts_with('.'); });
}

constexpr std::size_t kHeldMax = std::size_t{64} << 20U;

bool is_text(std::string_view type) {
  return type.starts_with("text/") || type.starts_with("application/json") ||
         type.starts_with("image/svg") || type == "application/wasm" ||
         type == "application/manifest+json" || type == "model/gltf-binary";
}

}  // namespace

StaticFiles::StaticFiles(fs::path folder, WriteRefusal refuse)
    : folder_(std::move(folder)), refuse_(std::move(refuse)) {
  std::error_code ec;
  const fs::recursive_directory_iterator end;
  for (fs::recursive_directory_iterator it(folder_, ec); !ec && it != end; it.increment(ec)) {
    (void)look_up(it->path().lexically_relative(folder_));  // errors are reported on request
  }
}

tl::expected<ServedBytes, NoFile> StaticFiles::look_up(const fs::path& relative) {
  std::error_code ec;
  const fs::path root = fs::canonical(folder_, ec);
  if (ec || relative.is_absolute() || has_hidden_part(relative)) {
    return tl::unexpected(NoFile::absent);
  }
  const auto file = OpenFile::open(root / relative, kHeldMax / 2);
  if (!file) return tl::unexpected(file.error());
  if (!file->is_inside(root)) return tl::unexpected(NoFile::absent);
  const auto known = held_.find(file->place());
  if (known != held_.end() && known->second.stamp == file->stamp()) return known->second.bytes;
  auto bytes = file->read();
  if (!bytes) return tl::unexpected(bytes.error());
  ServedBytes read = served(std::move(*bytes), is_text(type_of(relative)));
  const std::size_t size = read.plain->size() + (read.packed ? read.packed->size() : 0);
  if (known != held_.end() || held_bytes_ + size > kHeldMax) {
    held_.clear();  // the folder was probably rebuilt
    held_bytes_ = 0;
  }
  held_bytes_ += size;
  held_.emplace(file->place(), Held{file->stamp(), read});
  return read;
}

Response StaticFiles::not_served(const std::string& path, NoFile why) const {
  if (why == NoFile::busy) return refuse_(too_many_files());
  return refuse_({404, "not-found",
                  path == "/" ? "the dashboard is not built; ./server/run builds it"
                              : "nothing is served at " + path,
                  "request target", path});
}

Response StaticFiles::answer(const Request& request) {
  static constexpr const char* kAllow = "GET, HEAD, OPTIONS";
  if (request.method == "OPTIONS") return Response{204, "", "", {{"Allow", kAllow}}};
  if (request.method != "GET") {
    return refuse_({405,
                    "method-not-allowed",
                    "files can only be read",
                    std::nullopt,
                    request.method,
                    {{"Allow", kAllow}}});
  }
  const std::string& path = request.target.path;
  const fs::path relative = path == "/" ? "index.html" : path.substr(1);
  const auto bytes = look_up(relative);
  if (!bytes) return not_served(path, bytes.error());
  Response response = answer_bytes(request, *bytes, std::string(type_of(relative)));
  response.headers.emplace_back("Content-Security-Policy", std::string(kPagePolicy));
  const bool hashed = path.starts_with("/assets/");
  response.headers.emplace_back("Cache-Control",
                                hashed ? "public, max-age=31536000, immutable" : "no-cache");
  return response;
}

}  // namespace armloom
