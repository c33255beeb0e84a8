#include "evaluation/study_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;

TEST(StudyJob, KnowsItsFilesAndHoldsWhatWasRead) {
    const fs::path file = fs::path(GUMCERT_SOURCE_DIR) / "examples" / "rotary_table" / "plan.json";
    const StudyJob study(file);
    EXPECT_EQ(study.name(), "plan.json");
    EXPECT_TRUE(study.job().plan);
    EXPECT_THAT(study.inputs(), testing::Contains(file));
    ASSERT_EQ(study.inputs().size(), study.read().names.size());
    for (const std::string& name : study.read().names) {
        EXPECT_FALSE(study.read().files.read(name).empty()) << name;
    }
}

TEST(StudyJob, RefusesWhatItsReaderRefuses) {
    EXPECT_THROW(StudyJob("nothing.json"), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::evaluation
