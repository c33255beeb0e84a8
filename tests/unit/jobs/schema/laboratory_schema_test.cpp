#include "jobs/schema/laboratory_schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "json/readable_json.h"
#include "tests/support/file_content.h"

namespace gumcert::jobs {
namespace {

using nlohmann::ordered_json;

constexpr const char* k_advice_of_laboratory =
    "build the target write_schemas, run it in the tree, and look at the difference";

TEST(LaboratorySchema, IsTheFile) {
    const std::filesystem::path root(GUMCERT_SOURCE_DIR);
    const ordered_json jobs = ordered_json::parse(gumcert::test::file_content(root / "schemas/job-1.schema.json"));
    EXPECT_TRUE(gumcert::json::readable_json(laboratory_schema(jobs)) + "\n" ==
                gumcert::test::file_content(root / "schemas/laboratory-1.schema.json"))
        << k_advice_of_laboratory;
    EXPECT_TRUE(page_of_laboratory_keys() == gumcert::test::file_content(root / "docs/laboratory_keys.md"))
        << k_advice_of_laboratory;
}

TEST(LaboratorySchema, NeedsTheDefinitionsOfJobs) {
    EXPECT_THROW((void)laboratory_schema({{"definitions", ordered_json::object()}}), std::invalid_argument);
}

}  // namespace
}  // namespace gumcert::jobs
