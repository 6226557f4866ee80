#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace armloom {

// An SQLite error. Thrown within this folder only: callers of the store get errors as return
// values.
class SqlFault : public std::runtime_error {
 public:
  static constexpr int kNoAccess = 8;  // SQLITE_READONLY

  SqlFault(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
  [[nodiscard]] bool is_full() const;       // disk or quota
  [[nodiscard]] bool is_corrupt() const;    // not a database, or damaged
  [[nodiscard]] bool is_of_access() const;  // cannot be opened, read or written

 private:
  int code_;
};

// A prepared statement. Parameters count from one and columns from zero, as in SQLite.
class Statement {
 public:
  Statement(sqlite3* database, std::string_view sql);

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, std::string_view text);  // copied
  Statement& bind(int parameter, std::optional<std::int64_t> value);
  Statement& bind(int parameter, std::optional<std::string_view> text);
  template <class... Values>
  Statement& bind_all(const Values&... values) {
    int parameter = 0;
    (bind(++parameter, values), ...);
    return *this;
  }

  // Moves to the next row. Returns false after the last row; the statement can then run again.
  [[nodiscard]] bool step();
  void run();
  void reset();

  [[nodiscard]] std::int64_t number(int column) const;
  [[nodiscard]] std::optional<std::int64_t> maybe_number(int column) const;
  [[nodiscard]] std::string text(int column) const;  // "" for NULL
  [[nodiscard]] bool is_null(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int code) const;
  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

// A connection to a database file. Used by one thread at a time.
class Database {
 public:
  enum class Access { read, write, make };  // make: write a new file
  // `vfs`: name of an SQLite VFS (file system layer); "" for the default.
  Database(const std::filesystem::path& file, Access access, const std::string& vfs = {});

  // Sets whether closing the last connection keeps the write-ahead log. By default, closing writes
  // the log into the database file and deletes the log.
  void keep_log(bool is_kept);
  // Returns true if the system prevents writing to a database opened for writing.
  [[nodiscard]] bool is_read_only() const;
  // Adds an SQL function checksum(...) of any values, to detect damaged rows.
  void know_checksum();
  void run(const std::string& sql);  // one or more statements without rows
  [[nodiscard]] Statement prepare(std::string_view sql) const { return {database_.get(), sql}; }
  [[nodiscard]] std::int64_t number(std::string_view sql) const;  // first column of the first row
  [[nodiscard]] std::string text(std::string_view sql) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
};

// Rolls back unless commit() has succeeded.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {
    database_.run("BEGIN IMMEDIATE");
  }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool is_open_ = true;
};

}  // namespace armloom
