#include "archive/store/work_table.h"

#include <algorithm>
#include <utility>

#include "archive/store/postgresql_connection.h"

namespace gumcert::archive {

namespace {

using Value = PostgresqlValue;

constexpr std::size_t k_tasks_of_a_statement = 1000;
constexpr int k_results_of_a_page = 500;
constexpr const char* k_begin = "BEGIN ISOLATION LEVEL READ COMMITTED";

// An unlogged table would be lost when the server falls; that of a large archive is the work of hours.
constexpr const char* k_work_schema = R"sql(
CREATE SCHEMA IF NOT EXISTS gumcert_work;
CREATE TABLE IF NOT EXISTS gumcert_work.work(
 id text COLLATE "C" PRIMARY KEY,
 program text COLLATE "C" NOT NULL,
 kind text COLLATE "C" NOT NULL,
 input text NOT NULL,
 number bigint GENERATED ALWAYS AS IDENTITY
);
CREATE TABLE IF NOT EXISTS gumcert_work.task(
 work text COLLATE "C" NOT NULL REFERENCES gumcert_work.work(id) ON DELETE CASCADE,
 name text COLLATE "C" NOT NULL,
 input text NOT NULL,
 result text,
 PRIMARY KEY(work, name)
);
CREATE INDEX IF NOT EXISTS task_without_result ON gumcert_work.task(work, name) WHERE result IS NULL;
)sql";

/// A list as PostgreSQL writes it: {"a","b"}.
std::string list_of(const std::vector<std::string>& texts) {
    std::string list = "{";
    for (const std::string& text : texts) {
        list += list.size() == 1 ? "\"" : ",\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') {
                list += '\\';
            }
            list += c;
        }
        list += '"';
    }
    return list + "}";
}

class PostgresqlWorkTable : public WorkTable {
public:
    explicit PostgresqlWorkTable(const std::string& address) : connection_(address) {
        // A machine that is lost says nothing: its connection, and with it its tasks, are given up after two minutes.
        connection_.execute(
            "SET search_path = ''; SET tcp_keepalives_idle = 60; SET tcp_keepalives_interval = 10; SET "
            "tcp_keepalives_count = 6");
    }

    void add(const SharedWork& work, const std::vector<WorkTask>& tasks) override {
        connection_.transact(k_begin, [&] {
            // Two machines that begin at once would both find no table, and one of them would fail.
            connection_.execute("SELECT pg_catalog.pg_advisory_xact_lock(1735213427)");
            if (!has_tables()) {
                connection_.execute(k_work_schema);
            }
            const bool is_new =
                connection_
                    .query(
                        "INSERT INTO gumcert_work.work(id, program, kind, input) VALUES($1, $2, $3, $4) "
                        "ON CONFLICT (id) DO NOTHING RETURNING id",
                        {{work.id}, {work.program}, {work.kind}, {work.input}})
                    .size() > 0;
            for (std::size_t first = 0; is_new && first < tasks.size(); first += k_tasks_of_a_statement) {
                insert({tasks.begin() + static_cast<std::ptrdiff_t>(first),
                        tasks.begin() +
                            static_cast<std::ptrdiff_t>(std::min(first + k_tasks_of_a_statement, tasks.size()))},
                       work.id);
            }
        });
    }

    [[nodiscard]] std::optional<SharedWork> next(const std::string& program) override {
        if (!has_tables()) {
            return std::nullopt;
        }
        const PostgresqlRows rows = connection_.query(
            "SELECT id, program, kind, input FROM gumcert_work.work w WHERE program = $1 AND EXISTS (SELECT 1 FROM "
            "gumcert_work.task t WHERE t.work = w.id AND result IS NULL) ORDER BY number LIMIT 1",
            {{program}});
        return rows.size() > 0 ? std::optional(SharedWork{rows.column(0, 0), rows.column(0, 1), rows.column(0, 2),
                                                          rows.column(0, 3)})
                               : std::nullopt;
    }

    std::size_t do_some(const std::string& id, std::size_t most, const DoTasks& work) override {
        std::size_t done = 0;
        connection_.transact(k_begin, [&] {
            const PostgresqlRows rows = connection_.query(
                // The rows stay locked while they are worked on, and others pass them over. A worker that is killed
                // loses its transaction, and its tasks are free again: no clock and no lease is needed (ADR 0060).
                "SELECT name, input FROM gumcert_work.task WHERE work = $1 AND result IS NULL ORDER BY name LIMIT " +
                    std::to_string(most) + " FOR UPDATE SKIP LOCKED",
                {{id}});
            std::vector<WorkTask> tasks;
            for (int row = 0; row < rows.size(); ++row) {
                tasks.push_back({rows.column(row, 0), rows.column(row, 1)});
            }
            if (tasks.empty()) {
                return;
            }
            const std::vector<std::string> results = work(tasks);
            std::vector<std::string> names;
            for (const WorkTask& task : tasks) {
                names.push_back(task.name);
            }
            const std::string name_list = list_of(names);
            const std::string result_list = list_of(results);
            (void)connection_.query(
                "UPDATE gumcert_work.task t SET result = r.result FROM unnest($2::text[], $3::text[]) AS r(name, "
                "result) "
                "WHERE t.work = $1 AND t.name = r.name",
                {{id}, {name_list}, {result_list}});
            done = tasks.size();
        });
        return done;
    }

    [[nodiscard]] std::size_t open_tasks(const std::string& id) override {
        return static_cast<std::size_t>(
            connection_.query("SELECT count(*) FROM gumcert_work.task WHERE work = $1 AND result IS NULL", {{id}})
                .integer(0, 0));
    }

    void each_result(const std::string& id,
                     const std::function<void(const std::string&, const std::string&)>& visit) override {
        // By pages of names, and not by OFFSET, which would count all earlier rows anew for every page.
        std::string after;
        while (true) {
            const PostgresqlRows rows = connection_.query(
                "SELECT name, result FROM gumcert_work.task WHERE work = $1 AND name > $2 AND result IS NOT NULL ORDER "
                "BY "
                "name LIMIT " +
                    std::to_string(k_results_of_a_page),
                {{id}, {after}});
            for (int row = 0; row < rows.size(); ++row) {
                after = rows.column(row, 0);
                visit(after, rows.column(row, 1));
            }
            if (rows.size() < k_results_of_a_page) {
                return;
            }
        }
    }

    void remove(const std::string& id) override {
        (void)connection_.query("DELETE FROM gumcert_work.work WHERE id = $1", {{id}});
    }

private:
    PostgresqlConnection connection_;

    [[nodiscard]] bool has_tables() {
        return connection_.query("SELECT 1 WHERE pg_catalog.to_regclass('gumcert_work.task') IS NOT NULL").size() > 0;
    }

    void insert(const std::vector<WorkTask>& tasks, const std::string& id) {
        std::vector<std::string> names;
        std::vector<std::string> inputs;
        for (const WorkTask& task : tasks) {
            names.push_back(task.name);
            inputs.push_back(task.input);
        }
        const std::string name_list = list_of(names);
        const std::string input_list = list_of(inputs);
        (void)connection_.query(
            "INSERT INTO gumcert_work.task(work, name, input) SELECT $1, * FROM unnest($2::text[], $3::text[])",
            {{id}, {name_list}, {input_list}});
    }
};

}  // namespace

std::unique_ptr<WorkTable> open_work_table(const std::string& address) {
    return std::make_unique<PostgresqlWorkTable>(address);
}

}  // namespace gumcert::archive
