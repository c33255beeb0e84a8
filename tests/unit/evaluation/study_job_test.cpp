#include "evaluation/study_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "evaluation/simulate_job.h"
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

TEST(StudyJob, SaysInTheDocumentOfASimulationWhatItsReaderWarnsOf) {
    const StudyJob study(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "rotary_table" / "plan.json",
                         jobs::JobUse::simulate);
    jobs::RotaryTableJob job = study.job();
    job.simulation.emplace().angle_counts = {8};
    job.warnings.push_back(
        {"GC-WARN-0006", "job.json#/plan/senses", "senses is not used", "", "", gum::Severity::warning});
    const reports::StudyDocument document = simulate_job(job, study.name(), 2, 1, 1, gum::Progress{});
    std::string paragraphs;
    for (const reports::StudySection& section : document.sections) {
        for (const std::string& paragraph : section.paragraphs) {
            paragraphs += paragraph + "\n";
        }
    }
    EXPECT_THAT(paragraphs, testing::HasSubstr("senses is not used"));
}

}  // namespace
}  // namespace gumcert::evaluation
