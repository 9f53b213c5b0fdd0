// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament_store.h"

#include "flyball/records/report.h"
#include "flyball/runtime/recorder.h"

#include <utility>

#include <sqlite3.h>

namespace flyball {
namespace {

constexpr const char* schema =
    "CREATE TABLE IF NOT EXISTS flights ("
    "world TEXT NOT NULL, policy TEXT NOT NULL, seed INTEGER NOT NULL, mission TEXT NOT NULL,"
    "status TEXT NOT NULL, failure TEXT NOT NULL, mission_time_s REAL, energy_total_j REAL,"
    "battery_used_percent REAL, collisions INTEGER, summary TEXT NOT NULL,"
    "PRIMARY KEY (world, policy, seed))";

constexpr const char* insertion =
    "INSERT OR REPLACE INTO flights VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)";

constexpr const char* selection =
    "SELECT summary FROM flights WHERE world = ?1 AND policy = ?2 AND seed = ?3 AND mission = ?4";

/// A prepared statement, ended with its scope.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) {
    (void)sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr);
  }
  ~Statement() { (void)sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int place, const std::string& text) {
    // The library copies: NOLINTNEXTLINE(performance-no-int-to-ptr) its own macro.
    (void)sqlite3_bind_text(statement_, place, text.c_str(), -1, SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(int place, double value) {
    (void)sqlite3_bind_double(statement_, place, value);
    return *this;
  }
  Statement& bind(int place, std::uint64_t value) {
    (void)sqlite3_bind_int64(statement_, place, static_cast<sqlite3_int64>(value));
    return *this;
  }
  /// `SQLITE_ROW`, `SQLITE_DONE`, or an error.
  int step() { return sqlite3_step(statement_); }
  [[nodiscard]] std::string text(int column) const {
    const unsigned char* found = sqlite3_column_text(statement_, column);
    return found == nullptr ? std::string{} : reinterpret_cast<const char*>(found);  // NOLINT
  }

 private:
  sqlite3_stmt* statement_{};
};

}  // namespace

struct TournamentStore::Connection {
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

Result<TournamentStore> TournamentStore::open(const std::string& path) {
  auto connection = std::make_unique<Connection>(path);
  // Another process that reads the results or adds to them locks the file for moments.
  constexpr int patience_ms = 60000;
  if (sqlite3_open(path.c_str(), &connection->database) != SQLITE_OK ||
      sqlite3_busy_timeout(connection->database, patience_ms) != SQLITE_OK ||
      sqlite3_exec(connection->database, schema, nullptr, nullptr, nullptr) != SQLITE_OK) {
    return connection->refused("open");
  }
  return TournamentStore{std::move(connection)};
}

TournamentStore::TournamentStore(std::unique_ptr<Connection> connection)
    : connection_{std::move(connection)} {}
TournamentStore::TournamentStore(TournamentStore&&) noexcept = default;
TournamentStore& TournamentStore::operator=(TournamentStore&&) noexcept = default;
TournamentStore::~TournamentStore() = default;

std::optional<Summary> TournamentStore::find(const Scenario& scenario) const {
  Statement found{connection_->database, selection};
  found.bind(1, scenario.name).bind(2, scenario.governor.policy).bind(3, scenario.seed);
  found.bind(4, mission_key(scenario));
  Summary summary;
  if (found.step() != SQLITE_ROW || !from_json(found.text(0), summary)) {
    return std::nullopt;
  }
  return summary;
}

Status TournamentStore::add(const Scenario& scenario, const Summary& summary) {
  Statement row{connection_->database, insertion};
  row.bind(1, scenario.name).bind(2, scenario.governor.policy).bind(3, scenario.seed);
  row.bind(4, mission_key(scenario)).bind(5, std::string{to_string(summary.status)});
  row.bind(6, std::string{to_string(summary.failure)}).bind(7, summary.mission_time_s);
  row.bind(8, summary.energy_total_j()).bind(9, summary.battery_used_percent());
  row.bind(10, std::uint64_t{summary.failure == MissionFailure::collision ? 1U : 0U});
  row.bind(11, to_json(summary));
  if (row.step() != SQLITE_DONE) {
    return connection_->refused("write");
  }
  return Done{};
}

}  // namespace flyball
