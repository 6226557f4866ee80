// Log-in for browsers. Programs send the token with each request.
#include <string>
#include <utility>

#include "server/api/openapi.h"
#include "server/api/route.h"
#include "server/http/security_headers.h"
#include "server/http/served_bytes.h"
#include "server/messages/session.h"

namespace armloom {
namespace {

Session session_of(Guard& guard, const std::optional<std::string>& token) {
  const auto caller = guard.caller(token);
  Session session{guard.asks(), std::nullopt, std::nullopt};
  if (caller && guard.asks()) session.name = caller->name;
  if (caller) session.role = caller->role;
  return session;
}

// Makes a cookie that is hidden from scripts and not sent from pages of other sites.
std::string cookie(const Guard& guard, const std::string& token, const char* more) {
  return std::string(kTokenCookie) + "=" + token + "; Path=/; HttpOnly; SameSite=Strict" +
         (guard.is_tls() ? "; Secure" : "") + more;
}

bool may_stand_in_a_cookie(const std::string& token) {
  return !token.empty() &&
         token.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz_") == token.npos;
}

void get_session(Call call) {
  call.respond(answer(200, session_format(), session_of(call.parts.guard, call.request.token)));
}

void log_in(Call call) {
  const auto enter = [&parts = call.parts, respond = call.respond](const LogIn& read) {
    const Session session = session_of(parts.guard, read.token);
    if (!session.role || (session.auth_required && !may_stand_in_a_cookie(read.token))) {
      return respond(refusal_response(
          {401,
           "not-authenticated",
           "the token is unknown or was revoked: get a new one from `armloom token add`",
           "/token",
           std::nullopt,
           {kHowToShowAToken}}));
    }
    Response response = answer(200, session_format(), session);
    if (session.auth_required) {
      response.headers.emplace_back("Set-Cookie", cookie(parts.guard, read.token, ""));
    }
    respond(std::move(response));
  };
  read_body(call.parts, call.request, call.respond, read_log_in_text, enter);
}

void log_out(Call call) {
  Response response{204, "", "", {}};
  response.headers.emplace_back("Set-Cookie", cookie(call.parts.guard, "", "; Max-Age=0"));
  call.respond(std::move(response));
}

Response login_page(const Request& request, const char* content_type, const ServedBytes& bytes) {
  Response response = answer_bytes(request, bytes, content_type);
  response.headers.emplace_back("Cache-Control", "no-cache");
  response.headers.emplace_back("Content-Security-Policy", std::string(kPagePolicy));
  return response;
}

void get_login(Call call) {
  static const ServedBytes bytes = served(std::string(login_html()), true);
  call.respond(login_page(call.request, "text/html; charset=utf-8", bytes));
}

void get_login_script(Call call) {
  static const ServedBytes bytes = served(std::string(login_js()), true);
  call.respond(login_page(call.request, "text/javascript; charset=utf-8", bytes));
}

Route of_session(const char* method, const char* path, const char* id, const char* summary,
                 void (*run)(Call)) {
  Route route{.method = method, .path = path, .id = id, .tag = "service", .summary = summary};
  route.role = std::nullopt;
  route.run = run;
  return route;
}

}  // namespace

std::vector<Route> session_routes() {
  Route get = of_session("GET", "", "getSession", "Get the caller's name and role", get_session);
  get.outcomes = {
      outcome(200, "The session of the token that the request carries", session_format())};
  Route enter = of_session("POST", "", "logIn", "Log in with a token", log_in);
  enter.text =
      "Checks the token and sets it as a cookie that scripts cannot read, for browsers. Programs "
      "send `Authorization: Bearer <token>` instead.";
  enter.reads = body(log_in_format(), {{"token", R"({"token": "armloom_0123456789abcdef"})"}});
  enter.outcomes = {outcome(200, "The token is valid and the cookie is set", session_format())};
  enter.refuses = {401, 422};
  enter.who = Who::commander;
  Route leave = of_session("DELETE", "", "logOut", "Log out", log_out);
  leave.outcomes = {{204, "The cookie is removed"}};
  leave.who = Who::commander;
  for (Route* route : {&get, &enter, &leave}) route->path = api_path("/session");
  Route login = of_session("GET", "/login", "loginPage", "Get the log-in page", get_login);
  login.outcomes = {{200, "A page", {{"text/html", {{"type", "string"}}}}}};
  Route script = of_session("GET", "/login.js", "loginScript", "Get the script of the log-in page",
                            get_login_script);
  script.outcomes = {{200, "A script", {{"text/javascript", {{"type", "string"}}}}}};
  return {get, enter, leave, login, script};
}

}  // namespace armloom
