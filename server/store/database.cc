#include "server/store/database.h"

#include <sqlite3.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <iterator>
#include <system_error>

namespace armloom {
namespace {

constexpr int kBusy_ms = 5000;  // time limit while another process reads, such as `armloom history`

SqlFault fault_of(sqlite3* database, int code) {
  std::string text = database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code);
  if (const int error = database != nullptr ? sqlite3_system_errno(database) : 0; error != 0) {
    text += " (" + std::generic_category().message(error) + ")";
  }
  return {code, text};
}

// Computes the CRC-32 over the type and the bytes of each value. Numbers are taken as decimal
// digits.
void checksum(sqlite3_context* context, int count, sqlite3_value** values) {
  uLong sum = crc32(0, nullptr, 0);
  for (int i = 0; i < count; ++i) {
    const auto type = static_cast<Bytef>('0' + sqlite3_value_type(values[i]));
    sum = crc32(sum, &type, 1);
    const auto* text = sqlite3_value_text(values[i]);
    const int size = sqlite3_value_bytes(values[i]);
    if (text != nullptr) sum = crc32(sum, text, static_cast<uInt>(size));
  }
  sqlite3_result_int64(context, static_cast<sqlite3_int64>(sum));
}

// Returns an SQLite URI for reading (https://sqlite.org/uri.html). A reader of a WAL database
// normally creates files in the folder. If the folder is read-only (a copy, a mount) and has no
// log, no process writes the file. The file is then opened as immutable.
std::string uri_to_read(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    if (c == '%' || c == '?' || c == '#') {
      uri += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
    } else {
      uri += c;
    }
  }
  std::error_code ec;
  const bool is_ahead = std::filesystem::exists(file.string() + "-wal", ec);
  const bool lies_still = !is_ahead && ::access(file.parent_path().c_str(), W_OK) != 0;
  return uri + (lies_still ? "?immutable=1" : "");
}

}  // namespace

bool SqlFault::is_full() const { return (code_ & 0xff) == SQLITE_FULL; }
bool SqlFault::is_corrupt() const {
  return (code_ & 0xff) == SQLITE_CORRUPT || (code_ & 0xff) == SQLITE_NOTADB;
}
static_assert(SqlFault::kNoAccess == SQLITE_READONLY);
bool SqlFault::is_of_access() const {
  constexpr int kCodes[] = {SQLITE_CANTOPEN, SQLITE_READONLY, SQLITE_IOERR, SQLITE_PERM,
                            SQLITE_BUSY};
  return std::ranges::find(kCodes, code_ & 0xff) != std::end(kCodes);
}

Statement::Statement(sqlite3* database, std::string_view sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(database, sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  statement_.reset(statement);
  check(code);
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Statement::check(int code) const {
  if (code != SQLITE_OK && code != SQLITE_DONE && code != SQLITE_ROW) {
    throw fault_of(database_, code);
  }
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view text) {
  check(sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int parameter, std::optional<std::int64_t> value) {
  if (value) return bind(parameter, *value);
  check(sqlite3_bind_null(statement_.get(), parameter));
  return *this;
}

Statement& Statement::bind(int parameter, std::optional<std::string_view> text) {
  if (text) return bind(parameter, *text);
  check(sqlite3_bind_null(statement_.get(), parameter));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) {
    reset();
    return false;
  }
  const SqlFault fault = fault_of(database_, code);
  reset();
  throw fault;
}

void Statement::run() {
  while (step()) {
  }
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

std::int64_t Statement::number(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::optional<std::int64_t> Statement::maybe_number(int column) const {
  return is_null(column) ? std::nullopt : std::optional(number(column));
}

std::string Statement::text(int column) const {
  const auto* bytes = sqlite3_column_text(statement_.get(), column);
  if (bytes == nullptr) return {};
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return {reinterpret_cast<const char*>(bytes), size};
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

Database::Database(const std::filesystem::path& file, Access access, const std::string& vfs) {
  const int flags = access == Access::read    ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI
                    : access == Access::write ? SQLITE_OPEN_READWRITE
                                              : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* database = nullptr;
  const std::string name = access == Access::read ? uri_to_read(file) : file.string();
  const int code =
      sqlite3_open_v2(name.c_str(), &database, flags, vfs.empty() ? nullptr : vfs.c_str());
  database_.reset(database);
  if (code != SQLITE_OK) throw fault_of(database, code);
  sqlite3_extended_result_codes(database, 1);
  sqlite3_busy_timeout(database, kBusy_ms);
}

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

void Database::keep_log(bool is_kept) {
  const int code = sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE,
                                     is_kept ? 1 : 0, nullptr);
  if (code != SQLITE_OK) throw fault_of(database_.get(), code);
}

bool Database::is_read_only() const { return sqlite3_db_readonly(database_.get(), "main") == 1; }

void Database::know_checksum() {
  const int code = sqlite3_create_function_v2(database_.get(), "checksum", -1,
                                              SQLITE_UTF8 | SQLITE_DETERMINISTIC, nullptr, checksum,
                                              nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throw fault_of(database_.get(), code);
}

void Database::run(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throw fault_of(database_.get(), code);
}

std::int64_t Database::number(std::string_view sql) const {
  Statement statement = prepare(sql);
  return statement.step() ? statement.number(0) : 0;
}

std::string Database::text(std::string_view sql) const {
  Statement statement = prepare(sql);
  return statement.step() ? statement.text(0) : std::string();
}

Transaction::~Transaction() {
  if (!is_open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const SqlFault&) {  // SQLite has already rolled back, for example on a full disk
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  is_open_ = false;
}

}  // namespace armloom
