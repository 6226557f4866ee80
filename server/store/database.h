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

// What SQLite could not do, and why. Thrown within this folder only; who uses the store gets
// values.
class SqlFault : public std::runtime_error {
 public:
  static constexpr int kNoAccess = 8;  // SQLITE_READONLY

  SqlFault(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
  [[nodiscard]] bool is_full() const;       // no space left, or a quota
  [[nodiscard]] bool is_corrupt() const;    // what is there is no database, or not whole
  [[nodiscard]] bool is_of_access() const;  // it cannot be read or written, whatever is there

 private:
  int code_;
};

// A prepared statement. Parameters and columns are counted from one and from zero, as SQLite does.
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

  // To the next row; false: there is none, and the statement can be bound and run again.
  [[nodiscard]] bool step();
  // Runs one that gives no rows.
  void run();
  // Gives up the rows that were not read.
  void reset();

  [[nodiscard]] std::int64_t number(int column) const;
  [[nodiscard]] std::optional<std::int64_t> maybe_number(int column) const;
  [[nodiscard]] std::string text(int column) const;  // null: empty
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
  enum class Access { read, write, make };  // make: to write one that is not there
  // `vfs`: SQLite's name of the file system that it goes through; empty: the system's.
  Database(const std::filesystem::path& file, Access access, const std::string& vfs = {});

  // Kept: when this is closed as the last connection, the log stays as it is. Else, as at first, it
  // goes into the file and is deleted.
  void keep_log(bool is_kept);
  // Opened for writing all the same: the system does not let it be written.
  [[nodiscard]] bool is_read_only() const;
  // Makes checksum(...) known to the statements of this connection: of any values, by which one
  // that has become another one is seen.
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

// Rolled back unless commit() has succeeded.
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
