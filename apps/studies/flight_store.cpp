// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/flight_store.h"

#include "flyball/records/report.h"
#include "flyball/runtime/recorder.h"

#include <utility>

#include <sqlite3.h>

namespace flyball {
namespace {

/// Kept in SQLite's `user_version`. 0: of a tournament before sweeps, with `settings` and what
/// follows it missing.
constexpr int this_version = 1;

constexpr const char* schema = R"(
CREATE TABLE IF NOT EXISTS flights (
  world TEXT NOT NULL, policy TEXT NOT NULL, seed INTEGER NOT NULL, settings TEXT NOT NULL,
  mission TEXT NOT NULL, status TEXT NOT NULL, failure TEXT NOT NULL,
  mission_time_s REAL, energy_total_j REAL, battery_used_percent REAL, collisions INTEGER,
  replans INTEGER, hover_time_s REAL, mean_speed_m_s REAL, latency_p50_s REAL,
  summary TEXT NOT NULL, PRIMARY KEY (world, policy, seed, settings));
CREATE TABLE IF NOT EXISTS kernels (
  world TEXT NOT NULL, policy TEXT NOT NULL, seed INTEGER NOT NULL, settings TEXT NOT NULL,
  kernel TEXT NOT NULL, calls INTEGER, mission_ms_mean REAL, mission_ms_p95 REAL,
  PRIMARY KEY (world, policy, seed, settings, kernel));
CREATE TABLE IF NOT EXISTS quality (
  world TEXT NOT NULL, policy TEXT NOT NULL, seed INTEGER NOT NULL, settings TEXT NOT NULL,
  name TEXT NOT NULL, value REAL,
  PRIMARY KEY (world, policy, seed, settings, name));
PRAGMA user_version = 1;
)";

/// What an older version kept stays; its columns that it had not are NULL.
constexpr const char* takes_over_version_0 = R"(
INSERT INTO flights (world, policy, seed, settings, mission, status, failure, mission_time_s,
    energy_total_j, battery_used_percent, collisions, summary)
  SELECT world, policy, seed, '', mission, status, failure, mission_time_s,
    energy_total_j, battery_used_percent, collisions, summary FROM flights_0;
DROP TABLE flights_0;
)";

// The kernels and figures of a flight that is replaced go, too: the new one may have others.
constexpr const char* copies_all_of_other = R"(
DELETE FROM main.kernels WHERE (world, policy, seed, settings) IN
  (SELECT world, policy, seed, settings FROM other.flights);
DELETE FROM main.quality WHERE (world, policy, seed, settings) IN
  (SELECT world, policy, seed, settings FROM other.flights);
INSERT OR REPLACE INTO flights SELECT * FROM other.flights;
INSERT OR REPLACE INTO kernels SELECT * FROM other.kernels;
INSERT OR REPLACE INTO quality SELECT * FROM other.quality;
)";

constexpr const char* insertion =
    "INSERT OR REPLACE INTO flights VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, "
    "?13, ?14, ?15, ?16)";
constexpr const char* kernel_insertion =
    "INSERT OR REPLACE INTO kernels VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
constexpr const char* quality_insertion =
    "INSERT OR REPLACE INTO quality VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
constexpr const char* kernel_deletion =
    "DELETE FROM kernels WHERE world = ?1 AND policy = ?2 AND seed = ?3 AND settings = ?4";
constexpr const char* quality_deletion =
    "DELETE FROM quality WHERE world = ?1 AND policy = ?2 AND seed = ?3 AND settings = ?4";
constexpr const char* selection =
    "SELECT summary FROM flights WHERE world = ?1 AND policy = ?2 AND seed = ?3 AND settings = ?4 "
    "AND mission = ?5";

/// A prepared statement, ended with its scope.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) {
    (void)sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr);
  }
  ~Statement() { (void)sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds the next place.
  Statement& bind(const std::string& text) {
    // The library copies: NOLINTNEXTLINE(performance-no-int-to-ptr) its own macro.
    (void)sqlite3_bind_text(statement_, ++place_, text.c_str(), -1, SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(double value) {
    (void)sqlite3_bind_double(statement_, ++place_, value);
    return *this;
  }
  Statement& bind(std::uint64_t value) {
    (void)sqlite3_bind_int64(statement_, ++place_, static_cast<sqlite3_int64>(value));
    return *this;
  }
  /// Binds what names a flight, in the order of the tables' first columns.
  Statement& bind(const Scenario& scenario, const std::string& settings) {
    return bind(scenario.name).bind(scenario.governor.policy).bind(scenario.seed).bind(settings);
  }
  /// `SQLITE_ROW`, `SQLITE_DONE`, or an error.
  int step() { return sqlite3_step(statement_); }
  [[nodiscard]] std::string text(int column) const {
    const unsigned char* found = sqlite3_column_text(statement_, column);
    return found == nullptr ? std::string{} : reinterpret_cast<const char*>(found);  // NOLINT
  }
  [[nodiscard]] int number(int column) const { return sqlite3_column_int(statement_, column); }

 private:
  sqlite3_stmt* statement_{};
  int place_{};
};

bool done(sqlite3* database, const char* sql) {
  return sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

/// Changes the file wholly or, when one of them fails, not at all.
class Transaction {
 public:
  explicit Transaction(sqlite3* database) : database_{database} {
    began_ = done(database, "BEGIN IMMEDIATE");
  }
  ~Transaction() {
    if (began_) {
      (void)done(database_, "ROLLBACK");
    }
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  [[nodiscard]] bool began() const { return began_; }
  bool commit() {
    const bool committed = began_ && done(database_, "COMMIT");
    began_ = began_ && !committed;
    return committed;
  }

 private:
  sqlite3* database_;
  bool began_;
};

int version_of(sqlite3* database) {
  Statement version{database, "PRAGMA user_version"};
  return version.step() == SQLITE_ROW ? version.number(0) : 0;
}

bool has_flights(sqlite3* database) {
  Statement table{database, "SELECT 1 FROM sqlite_master WHERE type='table' AND name='flights'"};
  return table.step() == SQLITE_ROW;
}

/// Under a lock, because several processes may open a new file at once.
bool prepare_tables(sqlite3* database) {
  if (version_of(database) >= this_version) {
    return true;
  }
  Transaction transaction{database};
  if (!transaction.began()) {
    return false;
  }
  const bool is_old = version_of(database) == 0 && has_flights(database);
  return (!is_old || done(database, "ALTER TABLE flights RENAME TO flights_0")) &&
         done(database, schema) && (!is_old || done(database, takes_over_version_0)) &&
         transaction.commit();
}

/// Kernels and figures of a flight, in place of those of the flight that it replaces.
bool put_parts(sqlite3* database,
               const Scenario& scenario,
               const Summary& summary,
               const std::string& settings) {
  bool is_put = true;
  for (const char* deletion : {kernel_deletion, quality_deletion}) {
    Statement of_older{database, deletion};
    is_put = is_put && of_older.bind(scenario, settings).step() == SQLITE_DONE;
  }
  for (const auto& [name, kernel] : summary.kernels) {
    Statement of_kernel{database, kernel_insertion};
    of_kernel.bind(scenario, settings).bind(name).bind(kernel.calls);
    of_kernel.bind(kernel.mission_ms_mean).bind(kernel.mission_ms_p95);
    is_put = is_put && of_kernel.step() == SQLITE_DONE;
  }
  for (const auto& [name, value] : summary.quality) {
    Statement of_quality{database, quality_insertion};
    of_quality.bind(scenario, settings).bind(name).bind(value);
    is_put = is_put && of_quality.step() == SQLITE_DONE;
  }
  return is_put;
}

}  // namespace

struct FlightStore::Connection {
  explicit Connection(std::string file) : path{std::move(file)} {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { (void)sqlite3_close(database); }

  [[nodiscard]] Error refused(const std::string& doing) const {
    const bool is_other = sqlite3_errcode(database) == SQLITE_NOTADB;
    return {is_other ? ErrorCode::invalid_input : ErrorCode::unavailable,
            "cannot " + doing + " \"" + path + "\": " + sqlite3_errmsg(database) +
                "; choose another place with --out"};
  }

  std::string path;
  sqlite3* database{};
};

std::string mission_key(const Scenario& scenario) {
  TraceHash hash;
  hash.add(std::string_view{mission_file(scenario)});
  return hash.hex();
}

Result<FlightStore> FlightStore::open(const std::string& path) {
  auto connection = std::make_unique<Connection>(path);
  // Another process that reads the results or adds to them locks the file for moments.
  constexpr int patience_ms = 60000;
  if (sqlite3_open(path.c_str(), &connection->database) != SQLITE_OK ||
      sqlite3_busy_timeout(connection->database, patience_ms) != SQLITE_OK ||
      !prepare_tables(connection->database)) {
    return connection->refused("open");
  }
  if (version_of(connection->database) > this_version) {
    return Error{
        ErrorCode::invalid_input,
        "\"" + path + "\" was written by a newer flyball; choose another place with --out"};
  }
  return FlightStore{std::move(connection)};
}

FlightStore::FlightStore(std::unique_ptr<Connection> connection)
    : connection_{std::move(connection)} {}
FlightStore::FlightStore(FlightStore&&) noexcept = default;
FlightStore& FlightStore::operator=(FlightStore&&) noexcept = default;
FlightStore::~FlightStore() = default;

std::optional<Summary> FlightStore::find(const Scenario& scenario,
                                         const std::string& settings) const {
  Statement found{connection_->database, selection};
  found.bind(scenario, settings).bind(mission_key(scenario));
  Summary summary;
  if (found.step() != SQLITE_ROW || !from_json(found.text(0), summary)) {
    return std::nullopt;
  }
  return summary;
}

Status FlightStore::add(const Scenario& scenario,
                        const Summary& summary,
                        const std::string& settings) {
  sqlite3* const database = connection_->database;
  Transaction transaction{database};
  Statement row{database, insertion};
  row.bind(scenario, settings).bind(mission_key(scenario));
  row.bind(std::string{to_string(summary.status)}).bind(std::string{to_string(summary.failure)});
  row.bind(summary.mission_time_s).bind(summary.energy_total_j());
  row.bind(summary.battery_used_percent());
  row.bind(std::uint64_t{summary.failure == MissionFailure::collision ? 1U : 0U});
  row.bind(static_cast<std::uint64_t>(summary.replans)).bind(summary.hover_time_s);
  row.bind(summary.mean_speed_m_s).bind(summary.latency_p50_s).bind(to_json(summary));
  const bool is_written = transaction.began() && row.step() == SQLITE_DONE &&
                          put_parts(database, scenario, summary, settings) && transaction.commit();
  return is_written ? Status{Done{}} : Status{connection_->refused("write")};
}

Status FlightStore::add_all_of(const std::string& other) {
  if (Result<FlightStore> readable = open(other); !readable) {  // And of this version, afterwards.
    return readable.error();
  }
  sqlite3* const database = connection_->database;
  Statement attach{database, "ATTACH DATABASE ?1 AS other"};
  if (attach.bind(other).step() != SQLITE_DONE) {
    return connection_->refused("add \"" + other + "\" to");
  }
  bool copied = false;
  {
    Transaction transaction{database};
    copied = transaction.began() && done(database, copies_all_of_other) && transaction.commit();
  }
  const Error failed = connection_->refused("add \"" + other + "\" to");
  (void)done(database, "DETACH DATABASE other");
  return copied ? Status{Done{}} : Status{failed};
}

}  // namespace flyball
