#include "server/http/static_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
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

// The regular file that `relative` leads to inside `folder`, links followed; empty when there is
// none.
fs::path file_inside(const fs::path& folder, const fs::path& relative) {
  std::error_code ec;
  const fs::path root = fs::canonical(folder, ec);
  if (ec || has_hidden_part(relative)) return {};
  const fs::path file = fs::canonical(root / relative, ec);
  if (ec || !fs::is_regular_file(file, ec)) return {};
  const auto [end, unused] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return end == root.end() ? file : fs::path{};
}

}  // namespace

Response StaticFiles::answer(const Request& request) const {
  if (request.method == "OPTIONS") return Response{204, "", "", {{"Allow", "GET, HEAD, OPTIONS"}}};
  if (request.method != "GET") {
    return refuse_({405,
                    "method-not-allowed",
                    "files can only be read",
                    std::nullopt,
                    request.method,
                    {{"Allow", "GET, HEAD, OPTIONS"}}});
  }
  const std::string& path = request.target.path;
  const fs::path file = file_inside(folder_, path == "/" ? "index.html" : path.substr(1));
  std::ifstream in(file, std::ios::binary);
  if (file.empty() || !in) {
    const bool no_dashboard = path == "/";
    return refuse_({404, "not-found",
                    no_dashboard ? "the dashboard is not built; ./server/run builds it"
                                 : "nothing is served at " + path,
                    "request target", path});
  }
  Response response;
  response.content_type = type_of(file);
  response.body.assign(std::istreambuf_iterator<char>(in), {});
  response.headers.emplace_back("Content-Security-Policy", std::string(kPagePolicy));
  const bool hashed = path.starts_with("/assets/");
  response.headers.emplace_back("Cache-Control",
                                hashed ? "public, max-age=31536000, immutable" : "no-cache");
  return response;
}

}  // namespace armloom
