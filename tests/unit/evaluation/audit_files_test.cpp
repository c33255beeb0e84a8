#include "evaluation/audit_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// U of a certificate divided by another number than its k, or by it.
std::string table_of_gauge(bool is_right) {
    const std::string u = is_right ? "0.10" : "0.20";
    return "quantity,unit,U or a,divisor,distribution,u,sensitivity,contribution,comment\n"
           "Reference gauge,bar,0.20," +
           std::string(is_right ? "2" : "1") + ",normal," + u + ",1," + u +
           ",\"U = 0.20 bar, k = 2\"\nRepeatability,bar,0.01,1,normal,0.01,1,0.01,\nU,bar," +
           (is_right ? "0.20" : "0.40") + "\nk,,2\n";
}

/// A folder `mix` with a table at its top and one of the same name in each of two folders.
fs::path folder_of_tables() {
    const fs::path all = fs::path(::testing::TempDir()) / "audit_files_test" / "mix";
    for (const char* name : {"budget.csv", "one/budget.csv", "two/deep/budget.csv"}) {
        fs::create_directories((all / name).parent_path());
        std::ofstream(all / name) << table_of_gauge(std::string(name) != "one/budget.csv");
    }
    return all;
}

std::vector<std::string> names_of_files(const FilesToAudit& files) {
    std::vector<std::string> names;
    for (const FileToAudit& one : files.files) {
        names.push_back(one.name);
    }
    return names;
}

TEST(AuditFiles, HaveNamesThatLeadToThem) {
    const fs::path all = folder_of_tables();
    EXPECT_THAT(names_of_files(files_to_audit({all})),
                ::testing::ElementsAre("mix/budget.csv", "mix/one/budget.csv", "mix/two/deep/budget.csv"));
    EXPECT_THAT(names_of_files(files_to_audit({all / ""})),
                ::testing::ElementsAre("mix/budget.csv", "mix/one/budget.csv", "mix/two/deep/budget.csv"));
    // The law: from wherever a folder is named, its names are those of its files from there.
    const fs::path before = fs::current_path();
    for (const auto& [from, named] : {std::pair(all.parent_path(), "mix"), std::pair(all.parent_path(), "./mix/"),
                                      std::pair(all, "."), std::pair(all / "one", "..")}) {
        fs::current_path(from);
        std::set<std::string> distinct;
        for (const FileToAudit& one : files_to_audit({named}).files) {
            EXPECT_TRUE(fs::exists(one.name)) << one.name << " from " << from;
            distinct.insert(one.name);
        }
        EXPECT_EQ(distinct.size(), 3U);
    }
    fs::current_path(before);
    EXPECT_THAT(names_of_files(files_to_audit({all / "budget.csv"})), ::testing::ElementsAre("budget.csv"));
    const std::vector<std::string> two = names_of_files(files_to_audit({all / "budget.csv", all / "one/budget.csv"}));
    EXPECT_NE(two[0], two[1]);
    EXPECT_THAT(two[1], HasSubstr("one/budget.csv"));
}

TEST(AuditFiles, OfOtherPartsOfTheProgramAreNoJobs) {
    // The law: what a laboratory keeps beside a job is named, and is no job that is wrong; a job that is damaged still is.
    const fs::path all = fs::path(::testing::TempDir()) / "audit_files_of_others";
    fs::create_directories(all);
    for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
             {"budget.csv", table_of_gauge(true)},
             {"certificate.json", R"({"schema": "gumcert/certificate/1", "title": "x"})"},
             {"waivers.json", R"([{"finding": "U10"}])"},
             {"customer.json", R"({"id": "CUST-3", "name": "x"})"},
             {"audit.json", R"({"schema": "gumcert/audit/1"})"},
             {".gumcert-set.json", R"({"schema": "gumcert/set/1"})"}}) {
        std::ofstream(all / name) << bytes;
    }
    const FilesToAudit sound = files_to_audit({all});
    EXPECT_EQ(sound.files.size(), 1U);
    EXPECT_EQ(sound.of_other_kinds.size(), 4U) << "what is hidden is not named";
    EXPECT_EQ(files_in({all, all / "none.csv"}).size(), 7U) << "a file that is named, whether it is there or not";
    std::ofstream(all / "job.json") << R"({"schema": "gumcert/job/1", "kind": )";
    std::ofstream(all / "kind.json") << R"({"kind": "budget"})";
    std::ofstream(all / "cut.json") << R"({"title": "x", )";
    std::ofstream(all / "cut_list.json") << R"([{"kind": "budget")";
    EXPECT_EQ(files_to_audit({all}).files.size(), 5U);
    fs::remove_all(all);
}

/// How long the evaluation of a job or record takes is said by whoever made it, and what a table costs as well.
TEST(AuditFiles, KeepWallsAroundEachEvaluationAndAllTables) {
    const fs::path tree = GUMCERT_SOURCE_DIR;
    const fs::path all = fs::path(testing::TempDir()) / "files_within_walls";
    fs::remove_all(all);
    fs::create_directories(all);
    fs::copy_file(tree / "examples" / "gauge_block" / "job.json", all / "job.json");
    const std::string record =
        reports::to_canonical_json(evaluate_job(all / "job.json", CovarianceFile::none, 1, tree / "templates").record);
    std::ofstream(all / "record.json") << record;
    std::ofstream(all / "table.csv") << "name,value,u\nx,1,0.1\n";
    const std::vector<FileToAudit> files = {
        {.file = all / "job.json"}, {.file = all / "record.json"}, {.file = all / "table.csv"}};
    std::vector<std::string> evaluated;
    std::vector<std::string> read;
    std::vector<std::string> progress;
    bool is_within = false;
    const std::vector<AuditAttempt> attempts =
        audit_files(files, 1, tree / "templates",
                    [&](const std::string& text) { progress.push_back(is_within ? "+" : text); }, {}, {},
                    {.of_evaluation =
                         [&](const fs::path& file, const gum::Progress& told,
                             const std::function<void(const gum::Progress&)>& work) {
                             evaluated.push_back(file.filename().string());
                             is_within = true;
                             work(told);
                             is_within = false;
                         },
                     .of_reading =
                         [&](const std::vector<fs::path>& tables, const std::function<void()>& work) {
                             for (const fs::path& table : tables) {
                                 read.push_back(table.filename().string());
                             }
                             work();
                         }});
    EXPECT_EQ(evaluated, (std::vector<std::string>{"job.json", "record.json"}));
    EXPECT_EQ(read, std::vector<std::string>{"table.csv"});
    for (const AuditAttempt& attempt : attempts) {
        EXPECT_TRUE(attempt.view);
    }
    EXPECT_THAT(progress, ::testing::Contains("+")) << "it is evaluated there";
    // What takes longer than it may ends alone: the others are audited.
    const std::vector<AuditAttempt> ended = audit_files(
        files, 1, tree / "templates", {}, {}, {},
        {.of_evaluation =
             [](const fs::path&, const gum::Progress&, const std::function<void(const gum::Progress&)>& work) {
                 work([](const std::string&) {
                     throw gum::StorageError(gum::Diagnostic{.code = "GC-STORE-0024",
                                                             .where = "--time-limit",
                                                             .what = "is used up",
                                                             .rule = {},
                                                             .action = {}});
                 });
             },
         .of_reading = {}});
    ASSERT_TRUE(ended[0].failure);
    EXPECT_THAT(ended[0].reason(), HasSubstr("is used up"));
    EXPECT_TRUE(ended[1].failure);
    EXPECT_TRUE(ended[2].view);
    fs::remove_all(all);
}

TEST(AuditFiles, TellAWaiverThatNoneOfThemTakes) {
    const FilesToAudit files = files_to_audit({folder_of_tables()});
    const auto waiver_of = [](const std::string& rule) {
        certificate::Waiver waiver;
        waiver.finding = rule;
        return waiver;
    };
    const std::vector<certificate::Waiver> waivers{waiver_of("U13"), waiver_of("W99")};
    const std::vector<AuditAttempt> attempts =
        audit_files(files.files, 1, fs::path(GUMCERT_SOURCE_DIR) / "templates", {}, waivers);
    ASSERT_EQ(attempts.size(), 3U);
    std::string told;
    for (const AuditAttempt& attempt : attempts) {
        ASSERT_TRUE(attempt.view);
        for (const std::string& sentence : reports::english_of(attempt.view->not_read)) {
            told += sentence + "\n";
        }
    }
    EXPECT_THAT(told, HasSubstr("the waiver of W99 fits no finding"));
    EXPECT_EQ(told.find("W99"), told.rfind("W99")) << "once";
    EXPECT_THAT(told, ::testing::Not(HasSubstr("U13 fits no finding"))) << "one of the files has it";
    EXPECT_EQ(attempts[1].view->name, "mix/one/budget.csv");
}

}  // namespace
}  // namespace gumcert::evaluation
