#include "jobs/laboratory/laboratory_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/sample_laboratory.h"

namespace gumcert::jobs {
namespace {

/// A job and the files beside it.
struct JobWithLaboratory {
    explicit JobWithLaboratory(std::map<std::string, std::string> all, const std::string& job)
        : source([&] {
              all["job.json"] = job;
              return all;
          }()),
          files(source, "job.json") {
        file = files.job();
        document = *read_json_document(file.bytes, *file.problems);
        folder = LaboratoryFolder::of_job(files, document, *file.problems);
    }
    MemoryFileSource source;
    JobFiles files;
    JobFiles::File file;
    JsonDocument document;
    std::optional<LaboratoryFolder> folder;
};

TEST(LaboratoryFolderTest, IsTheOneThatTheJobNames) {
    JobWithLaboratory job(test::sample_laboratory_files("../lab/"), R"({"laboratory": "../lab"})");
    ASSERT_TRUE(job.folder);
    ASSERT_NE(job.folder->standard("STD-1"), nullptr);
    EXPECT_EQ(job.folder->standard("STD-1")->id, "STD-1");
    ASSERT_NE(job.folder->laboratory(), nullptr);
    EXPECT_EQ((*job.folder->customer("CUST-3"))["name"], "Customer");
    EXPECT_EQ((*job.folder->method("CP-1"))["version"], "4");
    EXPECT_EQ(job.folder->standard("STD-9", false), nullptr);
    job.files.refuse_if_needed();
    EXPECT_THAT(job.files.names(),
                testing::ElementsAre("job.json", "../lab/standards/STD-1.json", "../lab/laboratory.json",
                                     "../lab/customers/CUST-3.json", "../lab/methods/CP-1.json"));
}

TEST(LaboratoryFolderTest, IsTheOneOfTheCallerBeforeThatOfTheJob) {
    JobWithLaboratory job(test::sample_laboratory_files("laboratory:/"), R"({"laboratory": "elsewhere"})");
    ASSERT_TRUE(job.folder);
    EXPECT_NE(job.folder->standard("STD-1"), nullptr);
    EXPECT_THAT(job.files.names(), testing::Contains("laboratory:/standards/STD-1.json"));
}

TEST(LaboratoryFolderTest, MayBeMissing) {
    EXPECT_FALSE(JobWithLaboratory({}, "{}").folder);
    JobWithLaboratory absolute({}, R"({"laboratory": "/srv/lab"})");
    EXPECT_FALSE(absolute.folder);
    EXPECT_EQ(absolute.file.problems->refusals(), 1U);
    JobWithLaboratory job({}, R"({"laboratory": "lab"})");
    EXPECT_EQ(job.folder->standard("STD-1"), nullptr);
    EXPECT_THROW(job.files.refuse_if_needed(), gum::StorageError);
}

TEST(LaboratoryFolderTest, SaysWhatIsThereInPlaceOfWhatIsNot) {
    const JobWithLaboratory job(test::sample_laboratory_files("lab/"), R"({"laboratory": "lab"})");
    EXPECT_EQ(job.folder->others_than("standards", "STD-1"), std::nullopt);
    EXPECT_THAT(job.folder->others_than("standards", "STD-2").value(), testing::ElementsAre("STD-1"));
    EXPECT_THAT(job.folder->others_than("methods", "CUST-3").value(), testing::ElementsAre("CP-1"));
    const JobWithLaboratory none({}, R"({"laboratory": "lab"})");
    EXPECT_EQ(none.folder->others_than("standards", "STD-1"), std::nullopt) << "the folder is not there";
}

TEST(LaboratoryFolderTest, FilesHaveTheirIdentificationAsName) {
    JobWithLaboratory job({{"lab/standards/STD-2.json", std::string(test::k_sample_standard)}},
                          R"({"laboratory": "lab"})");
    EXPECT_EQ(job.folder->standard("STD-2"), nullptr);
    EXPECT_THROW(job.files.refuse_if_needed(), gum::InputError);
    EXPECT_TRUE(LaboratoryFolder::is_identification("STD-017_b.2"));
    for (const char* wrong : {"", "../STD", "a/b", ".hidden", "STD 1", "STD\xC3\xA4"}) {
        EXPECT_FALSE(LaboratoryFolder::is_identification(wrong)) << wrong;
    }
}

}  // namespace
}  // namespace gumcert::jobs
