#include "evaluation/name_job.h"

#include <gtest/gtest.h>

namespace gumcert::evaluation {
namespace {

std::string where_in_job(const std::string& where) {
    return of_job({{.code = "GC-X-0001", .where = where, .what = "", .rule = "", .action = ""}}, "b/job.json")
        .front()
        .where;
}

TEST(NameJob, PutsTheFolderBeforeTheNameOfTheJob) {
    EXPECT_EQ(where_in_job("job.json#/model"), "b/job.json#/model");
    EXPECT_EQ(where_in_job("job.json:3:1"), "b/job.json:3:1");
    EXPECT_EQ(where_in_job("job.json"), "b/job.json");
    EXPECT_EQ(where_in_job("b/job.json#/model"), "b/job.json#/model") << "once is enough";
    EXPECT_EQ(where_in_job("points.csv:3:1"), "b/job.json, points.csv:3:1");
    EXPECT_EQ(where_in_job("job.json2"), "b/job.json, job.json2") << "another file";
    EXPECT_EQ(where_in_job(""), "b/job.json");
}

TEST(NameJob, IsDoneWhereACommandHasSeveral) {
    const auto refused = [](bool several) {
        try {
            naming_job("b/job.json", several, [] {
                throw gum::InputError(gum::Diagnostic{
                    .code = "GC-X-0001", .where = "job.json#/model", .what = "", .rule = "", .action = ""});
            });
        } catch (const gum::InputError& error) {
            return error.diagnostics().front().where;
        }
        return std::string("nothing");
    };
    EXPECT_EQ(refused(true), "b/job.json#/model");
    EXPECT_EQ(refused(false), "job.json#/model");
    EXPECT_EQ(naming_job("b/job.json", true, [] { return 7; }), 7);
}

}  // namespace
}  // namespace gumcert::evaluation
