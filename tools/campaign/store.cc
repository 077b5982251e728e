// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/store.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <thread>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

constexpr const char* kSchema = R"(
  CREATE TABLE IF NOT EXISTS plan(key TEXT PRIMARY KEY, value TEXT NOT NULL);
  CREATE TABLE IF NOT EXISTS run(started INTEGER, seconds REAL, batches INTEGER, queries INTEGER);
  CREATE TABLE IF NOT EXISTS batch(suite TEXT, first INTEGER, last INTEGER, seconds REAL,
    queries INTEGER, wrong INTEGER, unresolved INTEGER, findings INTEGER,
    PRIMARY KEY(suite, first)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS tally(engine TEXT, suite TEXT, key TEXT, count INTEGER NOT NULL,
    PRIMARY KEY(engine, suite, key)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS finding(engine TEXT, suite TEXT, idx INTEGER, kind TEXT, detail TEXT,
    case_file TEXT NOT NULL DEFAULT '');
)";

// How long a predecessor that was killed may take to be gone.
constexpr std::chrono::milliseconds kLockPause(50);
constexpr int kLockTries = 400;

std::string Joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ",") + word;
  return all;
}

std::vector<std::pair<std::string, std::string>> PlanLines(const CampaignPlan& plan) {
  std::vector<std::string> suites;
  for (const Suite* suite : plan.suites) suites.emplace_back(suite->name());
  const SamplingRates& rates = plan.rates;
  return {{"suites", Joined(suites)},
          {"engines", Joined(plan.engines)},
          {"seed", std::to_string(plan.seed)},
          {"batch", std::to_string(kBatchIndices)},
          {"rates", std::to_string(rates.maxima) + ' ' + std::to_string(rates.construct) + ' ' +
                        std::to_string(rates.warm) + ' ' + std::to_string(rates.early_exit) + ' ' +
                        std::to_string(rates.values)}};
}

// Whether every name of the list `some`, with commas between, is in the list `all`: suites may be
// added to a campaign, since what is counted is counted by suite.
bool HoldsAll(const std::string& all, const std::string& some) {
  const std::string names = ',' + all + ',';
  std::istringstream words(some);
  for (std::string name; std::getline(words, name, ',');) {
    if (names.find(',' + name + ',') == std::string::npos) return false;
  }
  return true;
}

// The sum over engines of what is counted under `key`.
std::uint64_t SumOf(const Tally& tally, std::string_view key) {
  std::uint64_t sum = 0;
  for (const auto& [name, count] : tally) {
    if (std::string_view(name).substr(name.find('\t') + 1) == key) sum += count;
  }
  return sum;
}

std::string Column(sqlite3_stmt* row, int column) {
  const auto* text = sqlite3_column_text(row, column);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

std::uint64_t Count(sqlite3_stmt* row, int column) {
  return static_cast<std::uint64_t>(sqlite3_column_int64(row, column));
}

}  // namespace

// The system gives it up with the process that holds it, however that ends.
class CampaignStore::Lock {
 public:
  explicit Lock(const std::string& folder)
      : file_(open((folder + "/campaign.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) throw BadInput{folder + "/campaign.lock: " + std::strerror(errno)};
    for (int i = 0; flock(file_, LOCK_EX | LOCK_NB) != 0; ++i) {
      if (errno != EWOULDBLOCK || i == kLockTries) {
        const std::string why =
            errno == EWOULDBLOCK ? "another process works on this campaign" : std::strerror(errno);
        close(file_);
        throw BadInput{folder + "/campaign.lock: " + why};
      }
      std::this_thread::sleep_for(kLockPause);
    }
  }
  ~Lock() { close(file_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

CampaignStore::CampaignStore(const std::string& folder, const CampaignPlan& plan) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw BadInput{"--out: " + folder + " is not a folder and cannot be made one"};
  lock_ = std::make_unique<Lock>(folder);
  Open(folder, true);
  Run(kSchema);
  Run("BEGIN IMMEDIATE");
  for (const auto& [key, value] : PlanLines(plan)) {
    const std::string known = PlanValue(key);
    if (known.empty()) {
      Query("INSERT INTO plan(key, value) VALUES(?, ?)", {key, value}, nullptr);
    } else if (key == "suites" && HoldsAll(value, known)) {
      Query("UPDATE plan SET value = ? WHERE key = ?", {value, key}, nullptr);
    } else if (known != value) {
      Run("ROLLBACK");
      throw BadInput{path_ + " holds another campaign: its " + key + " is '" + known + "', not '" +
                     value + "'"};
    }
  }
  Run("COMMIT");
}

CampaignStore::CampaignStore(const std::string& folder) {
  if (!std::filesystem::exists(std::filesystem::path(folder) / "campaign.sqlite"))
    throw BadInput{folder + " holds no campaign.sqlite"};
  Open(folder, false);
}

CampaignStore::~CampaignStore() { sqlite3_close(db_); }

void CampaignStore::Open(const std::string& folder, bool create) {
  path_ = (std::filesystem::path(folder) / "campaign.sqlite").string();
  const int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
  if (sqlite3_open_v2(path_.c_str(), &db_, flags, nullptr) != SQLITE_OK) {
    const std::string message = db_ == nullptr ? "no memory" : sqlite3_errmsg(db_);
    sqlite3_close(db_);
    throw BadInput{path_ + ": " + message};
  }
  sqlite3_busy_timeout(db_, 10'000);
  // A commit survives the end of the process at once, and of the machine but for the last ones.
  try {
    Run("PRAGMA journal_mode = WAL");
    Run("PRAGMA synchronous = NORMAL");
  } catch (...) {
    sqlite3_close(db_);
    throw;
  }
}

void CampaignStore::Run(const std::string& sql) const {
  if (sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throw BadInput{path_ + ": " + sqlite3_errmsg(db_)};
}

void CampaignStore::Query(const std::string& sql, const std::vector<std::string>& values,
                          const Row& row) const {
  sqlite3_stmt* statement = nullptr;
  int state = sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr);
  for (std::size_t i = 0; state == SQLITE_OK && i < values.size(); ++i) {
    state = sqlite3_bind_text(statement, static_cast<int>(i) + 1, values[i].c_str(), -1,
                              SQLITE_TRANSIENT);
  }
  while (state == SQLITE_OK || state == SQLITE_ROW) {
    state = sqlite3_step(statement);
    if (state == SQLITE_ROW && row) row(statement);
  }
  const std::string message = sqlite3_errmsg(db_);
  sqlite3_finalize(statement);
  if (state != SQLITE_DONE) throw BadInput{path_ + ": " + message};
}

void CampaignStore::Add(std::span<const BatchResult> results, const CampaignPlan& plan) {
  if (results.empty()) return;
  Run("BEGIN IMMEDIATE");
  for (const BatchResult& result : results) {
    const std::string suite(plan.suites[result.batch.suite]->name());
    Query(
        "INSERT INTO batch VALUES(?, CAST(? AS INTEGER), CAST(? AS INTEGER), CAST(? AS REAL), "
        "CAST(? AS INTEGER), CAST(? AS INTEGER), CAST(? AS INTEGER), CAST(? AS INTEGER))",
        {suite, std::to_string(result.batch.first), std::to_string(result.batch.end),
         ShortDouble(result.seconds), std::to_string(SumOf(result.tally, keys::kQueries)),
         std::to_string(SumOf(result.tally, keys::kWrong)),
         std::to_string(SumOf(result.tally, keys::kUnresolved)),
         std::to_string(SumOf(result.tally, keys::kFindings))},
        nullptr);
    for (const auto& [name, count] : result.tally) {
      const std::size_t tab = name.find('\t');
      Query(
          "INSERT INTO tally VALUES(?, ?, ?, CAST(? AS INTEGER)) "
          "ON CONFLICT DO UPDATE SET count = count + excluded.count",
          {name.substr(0, tab), suite, name.substr(tab + 1), std::to_string(count)}, nullptr);
    }
    for (const CampaignFinding& finding : result.findings) {
      Query(
          "INSERT INTO finding(engine, suite, idx, kind, detail) "
          "VALUES(?, ?, CAST(? AS INTEGER), ?, ?)",
          {finding.engine, suite, std::to_string(finding.index), finding.kind, finding.detail},
          nullptr);
    }
  }
  Run("COMMIT");
}

void CampaignStore::AddRun(std::int64_t started, double seconds, std::uint64_t batches,
                           std::uint64_t queries) {
  Query(
      "INSERT INTO run VALUES(CAST(? AS INTEGER), CAST(? AS REAL), CAST(? AS INTEGER), "
      "CAST(? AS INTEGER))",
      {std::to_string(started), ShortDouble(seconds), std::to_string(batches),
       std::to_string(queries)},
      nullptr);
}

std::map<std::uint64_t, std::uint64_t> CampaignStore::Done(const std::string& suite) const {
  std::map<std::uint64_t, std::uint64_t> done;
  Query("SELECT first, last FROM batch WHERE suite = ?", {suite}, [&](sqlite3_stmt* row) {
    std::uint64_t& end = done[Count(row, 0) / kBatchIndices];
    end = std::max(end, Count(row, 1));
  });
  return done;
}

double CampaignStore::SecondsOf(const std::string& suite) const {
  double seconds = 0.0;
  Query("SELECT sum(seconds) FROM batch WHERE suite = ?", {suite},
        [&](sqlite3_stmt* row) { seconds = sqlite3_column_double(row, 0); });
  return seconds;
}

std::vector<std::pair<std::string, Tally>> CampaignStore::Tallies() const {
  std::vector<std::pair<std::string, Tally>> tallies;
  std::string suites = PlanValue("suites");
  for (std::size_t begin = 0; begin < suites.size();) {
    const std::size_t end = std::min(suites.find(',', begin), suites.size());
    tallies.emplace_back(suites.substr(begin, end - begin), Tally{});
    begin = end + 1;
  }
  for (auto& [suite, tally] : tallies) {
    Query("SELECT engine, key, count FROM tally WHERE suite = ?", {suite}, [&](sqlite3_stmt* row) {
      tally[Column(row, 0) + '\t' + Column(row, 1)] += Count(row, 2);
    });
  }
  return tallies;
}

std::vector<StoredFinding> CampaignStore::FirstFindings(int each) const {
  std::vector<StoredFinding> findings;
  Query(
      "SELECT engine, suite, idx, kind, detail, case_file FROM (SELECT *, row_number() OVER "
      "(PARTITION BY engine, suite, kind ORDER BY idx) AS number FROM finding) "
      "WHERE number <= CAST(? AS INTEGER) ORDER BY engine, kind, suite, idx",
      {std::to_string(each)}, [&](sqlite3_stmt* row) {
        findings.push_back({Column(row, 0), Column(row, 1), Count(row, 2), Column(row, 3),
                            Column(row, 4), Column(row, 5)});
      });
  return findings;
}

void CampaignStore::NameCase(const StoredFinding& finding, const std::string& case_file) {
  Query(
      "UPDATE finding SET case_file = ? WHERE engine = ? AND suite = ? AND "
      "idx = CAST(? AS INTEGER) AND kind = ?",
      {case_file, finding.engine, finding.suite, std::to_string(finding.index), finding.kind},
      nullptr);
}

std::string CampaignStore::PlanValue(const std::string& key) const {
  std::string value;
  Query("SELECT value FROM plan WHERE key = ?", {key},
        [&](sqlite3_stmt* row) { value = Column(row, 0); });
  return value;
}

}  // namespace touchstone
