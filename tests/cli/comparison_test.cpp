// Comparisons as a user meets them: compare, run and render, the numbers of golden vector 6 as they are printed, what
// is refused, and the same bytes for any number of threads.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path comparison_example() {
    return fs::path(GUMCERT_SOURCE_DIR) / "examples" / "comparison";
}

constexpr const char* k_key_comparison = R"({
 "schema": "gumcert/job/1", "kind": "comparison", "title": "Key comparison", "unit": "mm",
 "assigned_value": "weighted_mean",
 "participants": [
  {"id": "NMI1", "value": 12.31, "u": 0.10}, {"id": "NMI2", "value": 12.18, "u": 0.15},
  {"id": "NMI3", "value": 12.42, "u": 0.20}, {"id": "NMI4", "value": 12.25, "u": 0.12},
  {"id": "NMI5", "value": 12.95, "u": 0.15}, {"id": "NMI6", "value": 12.05, "u": 0.30}]})";

class ComparisonProgram : public ProgramTest {
protected:
    [[nodiscard]] fs::path job_file() const { return folder() / "job.json"; }
    [[nodiscard]] fs::path record_file() const { return folder() / "record.json"; }

    Ended compare(const std::string& job, std::vector<std::string> more = {}) const {
        write_bytes(job_file(), job);
        more.insert(more.begin(), {"compare", job_file().string(), "-o", record_file().string()});
        return gumcert(more);
    }
    [[nodiscard]] json record_of(const std::string& job) const {
        const Ended ended = compare(job);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return ended.code == 0 ? json::parse(bytes_of(record_file())) : json();
    }
    Ended render(const fs::path& record, const std::string& format, const fs::path& file) const {
        return gumcert(
            {"render", record.string(), "--format", format, "-o", file.string(), "--share", GUMCERT_SOURCE_DIR});
    }
    /// Is refused with a message that has this code, and nothing is written.
    void expect_refused(const std::string& job, const std::string& code) const {
        write_bytes(job_file(), job);
        const auto before = contents_of(folder());
        for (const std::string command : {"compare", "run"}) {
            const Ended ended = gumcert({command, job_file().string(), "--json-messages"});
            EXPECT_TRUE(ended.code == 3 || ended.code == 4) << command << " ended with " << ended.code;
            const std::vector<Message> messages = json_messages(ended);
            EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                                    [&](const Message& message) { return message.code == code; }))
                << code << " is missing in\n"
                << ended.err;
            EXPECT_TRUE(contents_of(folder()) == before) << command << " left something behind";
        }
    }
};

std::string with_one_replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::vector<std::string> printed_of(const json& record, const char* number) {
    std::vector<std::string> texts;
    for (const json& point : record["comparison"]["points"]) {
        texts.push_back(point["printed"][number].get<std::string>());
    }
    return texts;
}

TEST_F(ComparisonProgram, KeyComparison) {
    const json record = record_of(k_key_comparison);
    ASSERT_TRUE(record.is_object());
    EXPECT_EQ(record["kind"], "comparison");
    const json& item = record["comparison"]["items"][0];
    EXPECT_EQ(item["printed"]["value"], "12.37");
    EXPECT_EQ(item["printed"]["u"], "0.058");
    EXPECT_EQ(item["printed"]["U"], "0.12");
    EXPECT_EQ(item["consistency"]["printed"]["chi_square"], "19.11");
    EXPECT_EQ(item["consistency"]["printed"]["critical_value"], "11.07");
    EXPECT_EQ(item["consistency"]["printed"]["p_value"], "0.0018");
    EXPECT_EQ(item["consistency"]["printed"]["birge_ratio"], "1.96");
    EXPECT_EQ(printed_of(record, "En"), (std::vector<std::string>{"-0.38", "-0.70", "0.12", "-0.58", "2.09", "-0.55"}));
    const json subset = record_of(with_one_replaced(k_key_comparison, "weighted_mean", "largest_consistent_subset"));
    EXPECT_EQ(subset["comparison"]["items"][0]["printed"]["value"], "12.27");
    EXPECT_EQ(subset["comparison"]["items"][0]["not_consistent"], (json{"NMI5"}));
    EXPECT_EQ(subset["comparison"]["items"][0]["consistency"]["printed"]["chi_square"], "1.648");
    EXPECT_EQ(printed_of(subset, "En"), (std::vector<std::string>{"0.26", "-0.33", "0.40", "-0.10", "2.09", "-0.37"}));
}

TEST_F(ComparisonProgram, TellsTheAnswer) {
    const Ended ended = compare(k_key_comparison);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.err.find("GC-COMPARE-0120"), std::string::npos) << "a mean of results that do not agree";
    EXPECT_NE(ended.out.find("assigned value (weighted mean) 12.37 ± 0.12 mm"), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("NOT consistent"), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("2.09   action"), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("6 results: 1 with an action signal"), std::string::npos) << ended.out;
    for (const std::string& line : lines_of(ended.err)) {
        EXPECT_TRUE(is_message_line(line)) << line;
    }
    const Ended help = gumcert({"compare", "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("docs/comparison_job.md"), std::string::npos);
}

TEST_F(ComparisonProgram, RunWritesEveryForm) {
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf();
    }
    for (const std::string name : {"key_comparison", "proficiency_test", "methods"}) {
        const fs::path out = folder() / name;
        const Ended ended = run(comparison_example() / (name + ".json"), out);
        ASSERT_EQ(ended.code, 0) << name << "\n" << ended.err;
        std::set<std::string> names;
        for (const auto& [file, bytes] : contents_of(out)) {
            names.insert(file);
            EXPECT_GT(bytes.size(), 200U) << file;
        }
        EXPECT_EQ(names, (std::set<std::string>{".gumcert-set.json", "audit.html", "comparison.csv", "comparison.html",
                                                "comparison.pdf", "record.json"}));
        // The documents made again from the record are the same.
        for (const std::string format : {"html", "pdf", "csv"}) {
            const fs::path again = folder() / ("again." + format);
            ASSERT_EQ(render(out / "record.json", format, again).code, 0) << format;
            EXPECT_TRUE(bytes_of(again) == bytes_of(out / ("comparison." + format))) << name << " " << format;
        }
        const fs::path text = folder() / "again.txt";
        ASSERT_EQ(render(out / "record.json", "text", text).code, 0);
        const json record = json::parse(bytes_of(out / "record.json"));
        const std::string En = record["comparison"]["points"].back()["printed"]["En"].get<std::string>();
        const std::string html = with_ascii_minus(bytes_of(out / "comparison.html"));
        EXPECT_NE(html.find(En), std::string::npos) << name << ": " << En;
        EXPECT_NE(with_ascii_minus(bytes_of(text)).find(En), std::string::npos) << name << ": " << En;
    }
}

TEST_F(ComparisonProgram, HasNoDigitalCertificate) {
    ASSERT_EQ(compare(k_key_comparison).code, 0);
    const auto before = contents_of(folder());
    const Ended dcc = render(record_file(), "dcc", folder() / "record.xml");
    EXPECT_EQ(dcc.code, 3);
    EXPECT_NE(dcc.err.find("GC-REPORT-0041"), std::string::npos) << dcc.err;
    EXPECT_NE(dcc.err.find("csv"), std::string::npos) << "says what to do";
    EXPECT_TRUE(contents_of(folder()) == before);
}

TEST_F(ComparisonProgram, CsvHasARowForEachResult) {
    ASSERT_EQ(compare(k_key_comparison).code, 0);
    const fs::path csv = folder() / "scores.csv";
    ASSERT_EQ(render(record_file(), "csv", csv).code, 0);
    const std::vector<std::string> lines = lines_of(bytes_of(csv));
    ASSERT_EQ(lines.size(), 7U);
    EXPECT_NE(lines[5].find("NMI5"), std::string::npos) << lines[5];
    EXPECT_NE(lines[5].find("12.95"), std::string::npos) << lines[5];
    // The record is evaluated again first, which needs the wording of the program.
    const fs::path again = folder() / "again.csv";
    const Ended alone = gumcert({"render", record_file().string(), "--format", "csv", "-o", again.string(), "--share",
                                 (folder() / "nowhere").string()});
    EXPECT_EQ(alone.code, 5) << alone.err;
    EXPECT_EQ(gumcert({"render", record_file().string(), "--format", "html", "-o", again.string(), "--share",
                       (folder() / "nowhere").string()})
                  .code,
              5);
}

TEST_F(ComparisonProgram, OtherKindsAreNotCompared) {
    write_bytes(job_file(), bytes_of(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "end_gauge" / "job.json"));
    const auto before = contents_of(folder());
    const Ended ended = gumcert({"compare", job_file().string()});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("GC-COMPARE-0140"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("gumcert evaluate"), std::string::npos) << "says what to do";
    EXPECT_TRUE(contents_of(folder()) == before);
    // A record without a comparison has no table of scores.
    ASSERT_EQ(gumcert({"evaluate", job_file().string(), "-o", record_file().string()}).code, 0);
    const Ended csv = render(record_file(), "csv", folder() / "record.csv");
    EXPECT_EQ(csv.code, 3);
    EXPECT_NE(csv.err.find("GC-REPORT-0040"), std::string::npos) << csv.err;
    EXPECT_FALSE(fs::exists(folder() / "record.csv"));
}

TEST_F(ComparisonProgram, RefusalsLeaveNothingBehind) {
    const std::string job = k_key_comparison;
    expect_refused(with_one_replaced(job, "\"u\": 0.10", "\"U\": 0.20"), "GC-INPUT-0504");
    expect_refused(with_one_replaced(job, "\"u\": 0.10", "\"u\": 0.10, \"U\": 0.20, \"k\": 2"), "GC-INPUT-0503");
    expect_refused(with_one_replaced(job, "NMI2", "NMI1"), "GC-INPUT-0508");
    // r = 1 with two laboratories that are independent of each other is no covariance.
    expect_refused(
        with_one_replaced(job, "\"unit\": \"mm\",",
                          "\"unit\": \"mm\", \"correlations\": [[\"NMI1\",\"NMI2\",1],[\"NMI1\",\"NMI3\",1]],"),
        "GC-INPUT-0517");
    expect_refused(R"({"schema": "gumcert/job/1", "kind": "comparison", "unit": "mm",
  "participants": [{"id": "A", "value": 1, "u": 0.001}, {"id": "B", "value": 2, "u": 0.001}],
  "assigned_value": "largest_consistent_subset"})",
                   "GC-GUM-0134");
}

TEST_F(ComparisonProgram, AKindThatNobodyKnowsIsToldWithThoseThatThereAre) {
    write_bytes(job_file(), with_one_replaced(k_key_comparison, "\"comparison\"", "\"comparision\""));
    const Ended ended = gumcert({"compare", job_file().string()});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("did you mean \"comparison\"?"), std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find("GC-COMPARE-0140"), std::string::npos) << "no other command takes this job either";
}

TEST_F(ComparisonProgram, MessagesOfSeveralJobsNameTheJob) {
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf();
    }
    const std::string text = k_key_comparison;
    const std::map<std::string, std::string> jobs{
        {"warned", text},
        {"refused", with_one_replaced(text, "\"u\": 0.10", "\"U\": 0.20")},
        {"singular",
         with_one_replaced(text, "\"unit\": \"mm\",", "\"unit\": \"mm\", \"correlations\": [[\"NMI1\",\"NMI2\",1]],")}};
    std::vector<std::string> command{"run", "--share", GUMCERT_SOURCE_DIR, "--json-messages", "-q"};
    for (const auto& [name, job] : jobs) {
        write_bytes(folder() / (name + ".json"), job);
        command.push_back((folder() / (name + ".json")).string());
    }
    const Ended ended = gumcert(command);
    EXPECT_EQ(ended.code, 4) << "the highest of 0, 3 and 4";
    for (const auto& [name, code] : std::map<std::string, std::string>{
             {"warned", "GC-COMPARE-0120"}, {"refused", "GC-INPUT-0504"}, {"singular", "GC-GUM-0132"}}) {
        const std::string job = (folder() / (name + ".json")).string();
        const std::vector<Message> messages = json_messages(ended);
        EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                                [&, &code = code](const Message& message) {
                                    return message.code == code && message.where.starts_with(job);
                                }))
            << job << " " << code << " is missing in\n"
            << ended.err;
        EXPECT_EQ(fs::exists(folder() / (name + "-out") / "record.json"), name == "warned") << name;
    }
    // The record itself knows nothing of the other jobs.
    EXPECT_EQ(bytes_of(folder() / "warned-out" / "record.json").find(folder().string()), std::string::npos);
}

// What leaves the program as a table comes back as the numbers of the record, to the last bit.
TEST_F(ComparisonProgram, CsvHoldsTheNumbersOfTheRecord) {
    const json record = record_of(k_key_comparison);
    const fs::path csv = folder() / "scores.csv";
    ASSERT_EQ(render(record_file(), "csv", csv).code, 0);
    const std::vector<std::string> lines = lines_of(bytes_of(csv));
    const auto cells_of = [](const std::string& line) {
        std::vector<std::string> cells(1);
        for (const char c : line) {
            if (c == ',') {
                cells.emplace_back();
            } else {
                cells.back() += c;
            }
        }
        return cells;
    };
    const std::vector<std::string> head = cells_of(lines.at(0));
    const json& points = record["comparison"]["points"];
    ASSERT_EQ(lines.size(), points.size() + 1);
    std::size_t numbers = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::vector<std::string> cells = cells_of(lines[i + 1]);
        ASSERT_EQ(cells.size(), head.size());
        for (std::size_t j = 0; j < head.size(); ++j) {
            if (points[i].contains(head[j]) && points[i][head[j]].is_number()) {
                EXPECT_EQ(json::parse(cells[j]).get<double>(), points[i][head[j]].get<double>()) << head[j];
                ++numbers;
            }
        }
    }
    EXPECT_GE(numbers, 6U * 10U);
}

TEST_F(ComparisonProgram, BudgetsThatNameOneStandard) {
    const auto budget = [](double value) {
        return R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["x = a + s"], "outputs": {"x": {"unit": "um"}},
  "inputs": {"a": {"value": )" +
               digits(value) + R"(, "u": 0.3, "unit": "um"},
             "s": {"value": 0, "u": 0.4, "unit": "um", "source": "gauge block 17"}}})";
    };
    write_bytes(folder() / "a.json", budget(10.0));
    write_bytes(folder() / "b.json", budget(10.6));
    const std::string job = R"({"schema": "gumcert/job/1", "kind": "comparison", "unit": "um",
  "assigned_value": {"method": "reference", "participant": "A"},
  "participants": [{"id": "A", "budget": "a.json"}, {"id": "B", "budget": "b.json"}]})";
    const json record = record_of(job);
    ASSERT_TRUE(record.is_object());
    const json& point = record["comparison"]["points"][1];
    // u = 0.5 each, cov = 0.4²: u²(D) = 2 · 0.3².
    EXPECT_NEAR(point["u"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(point["correlation"].get<double>(), 0.64, 1e-12);
    EXPECT_NEAR(point["u_D"].get<double>(), 0.3 * std::sqrt(2.0), 1e-12);
    EXPECT_EQ(record["comparison"]["shared_sources"][0]["source"], "gauge block 17");
    EXPECT_EQ(record["job"]["files"].size(), 3U) << "both budgets are files of the job";
    const json independent = record_of(with_one_replaced(
        job, "\"unit\": \"um\",", "\"unit\": \"um\", \"independent_sources\": [\"gauge block 17\"],"));
    EXPECT_NEAR(independent["comparison"]["points"][1]["u_D"].get<double>(), 0.5 * std::sqrt(2.0), 1e-12);
}

TEST_F(ComparisonProgram, SameBytesForAnyNumberOfThreads) {
    const std::string job = with_one_replaced(k_key_comparison, "\"weighted_mean\"",
                                              R"({"method": "median", "uncertainty": "trials", "trials": 20000})");
    ASSERT_EQ(compare(job, {"--threads", "1"}).code, 0);
    const std::string first = bytes_of(record_file());
    ASSERT_EQ(compare(job, {"--threads", "4"}).code, 0);
    EXPECT_TRUE(bytes_of(record_file()) == first);
    for (const std::string name : {"key_comparison", "proficiency_test", "methods"}) {
        std::vector<std::string> bytes;
        for (const std::string threads : {"1", "4"}) {
            const Ended ended = gumcert({"compare", (comparison_example() / (name + ".json")).string(), "-o",
                                         record_file().string(), "--threads", threads});
            ASSERT_EQ(ended.code, 0) << ended.err;
            bytes.push_back(bytes_of(record_file()));
        }
        EXPECT_TRUE(bytes[0] == bytes[1]) << name;
    }
}

TEST_F(ComparisonProgram, TheIssuerStandsInTheReportWhereverItsDataAreWritten) {
    const json data = {{"status", "specimen"},
                       {"number", "KC-14"},
                       {"laboratory", {{"name", "Example Metrology Institute"}}},
                       {"dates", {{"issued", "2026-11-21"}}}};
    write_bytes(folder() / "issuer.json", data.dump());
    for (const json& stated : {data, json("issuer.json")}) {
        json job = json::parse(k_key_comparison);
        job["certificate"] = stated;
        EXPECT_EQ(record_of(job.dump())["comparison"]["issuer"],
                  json({{"laboratory", "Example Metrology Institute"}, {"number", "KC-14"}, {"issued", "2026-11-21"}}));
        ASSERT_EQ(render(record_file(), "text", folder() / "report.txt").code, 0);
        const std::string text = bytes_of(folder() / "report.txt");
        for (const char* shown : {"Example Metrology Institute", "KC-14", "2026-11-21"}) {
            EXPECT_NE(text.find(shown), std::string::npos) << shown;
        }
    }
}

TEST_F(ComparisonProgram, CertificateDataMakeNoCertificate) {
    json job = json::parse(k_key_comparison);
    job["certificate"] = {{"status", "specimen"}};
    write_bytes(job_file(), job.dump());
    const Ended ended = gumcert({"compare", job_file().string(), "-o", record_file().string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.err.find("GC-COMPARE-0125"), std::string::npos) << ended.err;
    const json record = json::parse(bytes_of(record_file()));
    EXPECT_TRUE(record["certificate"].is_null());
}

}  // namespace
}  // namespace gumcert::cli
