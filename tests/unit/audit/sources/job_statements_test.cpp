#include "audit/sources/job_statements.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace gumcert::audit {
namespace {

using nlohmann::json;

reports::EvaluationRecord record_of(const char* points, std::vector<reports::InputFile> files = {}) {
    reports::EvaluationRecord record;
    record.job_json = std::string(R"({"inputs": {"x": {"unit": "V", "U": 1, "k": 2, "source": "STD-1"},
        "y": {"observations": [0, 1]}, "z": {"components": [{"name": "a", "u": 1}, {"name": "b", "u": 2}]}}, "points": )") +
                      points + "}";
    record.job_files = std::move(files);
    return record;
}

TEST(JobStatements, OfAPointTakeThePlaceOfThoseOfTheJob) {
    const JobStatements job(record_of(R"([{"point": "a", "x": {"U": 0.04}, "y": {"observations": [20.1, 20.2, 20.3]}},
                                          {"x": 7}, {"point": "c", "x": {"half_width": 0.1}}])"));
    EXPECT_EQ(job.of("x", ""), json::parse(R"({"unit": "V", "U": 1, "k": 2, "source": "STD-1"})"));
    EXPECT_EQ(job.of("x", "a"), json::parse(R"({"unit": "V", "U": 0.04, "k": 2, "source": "STD-1"})"));
    EXPECT_EQ(job.of("y", "a").at("observations").size(), 3U);
    EXPECT_EQ(job.of("x", "2").at("value"), 7) << "a point without name has its number";
    EXPECT_EQ(job.of("x", "2").at("U"), 1);
    EXPECT_FALSE(job.of("x", "c").contains("U")) << "another way to state it replaces the one of the job";
    EXPECT_EQ(job.of("y", "c").at("observations").size(), 2U);
    EXPECT_TRUE(job.of("nothing", "a").is_null());
}

TEST(JobStatements, OfATableAreItsColumns) {
    const JobStatements job(record_of(
        R"({"file": "points.csv"})",
        {reports::input_file("points.csv", "point,x,x.U,y.1,y.2,y.3\nlow,1,0.01,5,6,7\nhigh,2,0.02,8,9,10\n", true)}));
    EXPECT_EQ(job.of("x", "high"), json::parse(R"({"unit": "V", "value": 2.0, "U": 0.02, "k": 2, "source": "STD-1"})"));
    EXPECT_EQ(job.of("y", "low").at("observations"), json::parse("[5.0, 6.0, 7.0]"));
}

TEST(JobStatements, OfSectionsAreNumberedThroughTheJob) {
    reports::EvaluationRecord record;
    record.job_json = R"({"inputs": {"x": {"unit": "V"}}, "sections": {
        "a": {"points": {"list": [{"x": 3}]}}, "z": {"points": [{"x": 1}, {"x": 2}]}}})";
    record.sections = {{.name = "z", .title = {}, .points = 2, .quantities = {}},
                       {.name = "a", .title = {}, .points = 1, .quantities = {}}};
    const JobStatements job(record);
    EXPECT_EQ(job.of("x", "2").at("value"), 2);
    EXPECT_EQ(job.of("x", "3").at("value"), 3) << "z stands before a in the record";
}

reports::BudgetRow part_named(const std::string& name, const std::string& standard = "") {
    reports::BudgetRow part;
    part.input = name;
    part.standard = standard;
    return part;
}

TEST(JobStatements, HaveComponents) {
    const JobStatements job(record_of("[]"));
    EXPECT_EQ(job.of_part("z", "", part_named("b")), json::parse(R"({"name": "b", "u": 2})"));
    EXPECT_TRUE(job.of_part("z", "", part_named("c")).is_null());
    EXPECT_TRUE(job.of_part("z", "", part_named("a", "STD-1")).is_null()) << "the part of a standard";
    EXPECT_TRUE(job.of_part("x", "", part_named("b")).is_null());
    EXPECT_TRUE(job.of_whole("z", "").is_null()) << "a sum of two has no statement of its own";
    EXPECT_EQ(job.of_whole("x", "").at("U"), 1);
}

TEST(JobStatements, OfAPointAreReadingsBesideTheComponentsOfTheJob) {
    const JobStatements job(
        record_of(R"([{"point": "a", "z": {"observations": [1, 2]}}, {"point": "b", "z": {"u": 5}}])"));
    EXPECT_EQ(job.of_part("z", "a", part_named("readings")), json::parse(R"({"observations": [1, 2]})"));
    EXPECT_EQ(job.of_part("z", "a", part_named("b")).at("u"), 2);
    EXPECT_TRUE(job.of_part("z", "b", part_named("b")).is_null());
}

TEST(JobStatements, OfAResolutionBesideReadingsIsItsOwn) {
    reports::EvaluationRecord record;
    record.job_json = R"({"inputs": {"x": {"observations": [1, 2], "resolution": 0.1, "distribution": "uniform"}}})";
    const JobStatements job(record);
    EXPECT_EQ(job.of_part("x", "", part_named("readings")), json::parse(R"({"observations": [1, 2]})"));
    EXPECT_EQ(job.of_part("x", "", part_named("resolution")),
              json::parse(R"({"resolution": 0.1, "distribution": "uniform"})"));
}

TEST(JobStatements, SayWhichInputsCorrelate) {
    reports::EvaluationRecord record;
    record.job_json =
        R"({"inputs": {"s": {"samples": "a.csv"}, "t": {"samples": {"file": "a.csv", "column": "t"}}, "w": {"samples": [1, 2]},
        "v": {"samples": "b.csv"}}, "correlations": [["a", "b", 0.5], ["a", "c", 0]], "simultaneous": [["d", "e", "f"]],
        "covariance": {"inputs": ["g", "h"], "matrix": [[1, 0], [0, 1]]}})";
    using Names = std::set<std::string>;
    const std::vector<Names> expected = {{"a", "b"}, {"a", "c"}, {"d", "e", "f"}, {"g", "h"}, {"s", "t"}, {"v"}};
    EXPECT_EQ(JobStatements(record).inputs_with_correlation(), expected);
    for (const char* const none : {"{}", "{\"correlations\": 3, \"covariance\": [], \"inputs\": 4}", "", "[]"}) {
        record.job_json = none;
        EXPECT_TRUE(JobStatements(record).inputs_with_correlation().empty()) << none;
    }
}

TEST(JobStatements, OfATextThatIsNoJobAreNone) {
    reports::EvaluationRecord record;
    EXPECT_TRUE(JobStatements(record).of("x", "").is_null());
    record.job_json = "{ // the fixture\n \"inputs\": {\"x\": {\"u\": 1}}}";
    EXPECT_EQ(JobStatements(record).of("x", ""), json::parse(R"({"u": 1})")) << "a job has comments";
    record.job_json = "[1]";
    EXPECT_TRUE(JobStatements(record).of("x", "").is_null());
}

}  // namespace
}  // namespace gumcert::audit
