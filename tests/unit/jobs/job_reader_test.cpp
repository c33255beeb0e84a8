#include "jobs/job_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "jobs/problem_list.h"
#include "tests/unit/jobs/described_sample.h"

namespace gumcert::jobs {
namespace {

using test::Sample;
using test::SampleShape;
using testing::ElementsAre;

/// Reads a text as a sample, all keys at once or only some.
struct ReadSample {
    ProblemList problems{"job.json"};
    JsonDocument document;
    JsonObject object;
    Sample sample;
    JobReader reader;

    explicit ReadSample(const std::string& text)
        : document(*read_json_document(text, problems)),
          object(document, "", keys_of<Sample>(), problems),
          reader(object) {}

    [[nodiscard]] std::vector<std::string> refused() const {
        std::vector<std::string> all;
        for (const gum::Diagnostic& diagnostic : problems.refused()) {
            all.push_back(diagnostic.where.substr(0, diagnostic.where.find(' ')) + " " + diagnostic.code);
        }
        return all;
    }
};

TEST(JobReader, ReadsEveryMemberInSi) {
    ReadSample read(
        R"({"kind": "sample", "length_um": 2.5, "count": 1e1, "shape": "square", "name": "n", "file": "a/b.csv",
                        "point_mm": [1, 2, 3], "turns": true, "inner": {"u": 1}, "outer": {"a": 7}, "label": 1.50, "computed": 3})");
    read.reader.read(read.sample);
    EXPECT_THAT(read.refused(), ElementsAre());
    EXPECT_EQ(read.sample.length, 2.5 * 1e-6);
    EXPECT_EQ(read.sample.count, 10U);
    EXPECT_EQ(read.sample.shape, SampleShape::square);
    EXPECT_EQ(read.sample.name, "n");
    EXPECT_EQ(read.sample.file, "a/b.csv");
    EXPECT_EQ(read.sample.point, Eigen::Vector3d(1 * 1e-3, 2 * 1e-3, 3 * 1e-3));
    EXPECT_TRUE(read.sample.turns);
    ASSERT_TRUE(read.sample.inner);
    EXPECT_EQ(read.sample.inner->u, 1.0);
    EXPECT_FALSE(read.sample.inner->v);
    EXPECT_EQ(read.sample.a, 7.0);
    EXPECT_EQ(read.sample.label, "1.5");
    EXPECT_EQ(read.sample.computed, 3.0);
    EXPECT_TRUE(read.reader.accepted("length_um"));
    EXPECT_EQ(read.reader.number("length_um"), 2.5);
    EXPECT_FALSE(read.reader.accepted("angles"));
}

TEST(JobReader, LeavesWhatIsAbsentOrRefusedAsItWas) {
    ReadSample read(R"({"kind": "sample", "length_um": 6, "count": 1.5, "shape": "sqare", "name": "", "file": "/a",
                        "point_mm": [1, 2], "turns": 1, "inner": {"v": -1}, "other": 3})");
    read.reader.read(read.sample);
    EXPECT_THAT(read.refused(), ElementsAre("job.json#/other " + std::string(k_unknown_key.code),
                                            "job.json#/length_um " + std::string(k_number_out_of_range.code),
                                            "job.json#/count " + std::string(k_not_an_integer.code),
                                            "job.json#/shape " + std::string(k_unknown_choice.code),
                                            "job.json#/name " + std::string(k_text_not_allowed.code),
                                            "job.json#/file " + std::string(k_file_name.code),
                                            "job.json#/point_mm " + std::string(k_wrong_size.code),
                                            "job.json#/turns " + std::string(k_wrong_type.code),
                                            "job.json#/inner " + std::string(k_missing_key.code),
                                            "job.json#/inner/v " + std::string(k_number_out_of_range.code),
                                            "job.json# " + std::string(k_missing_key.code)));
    EXPECT_EQ(read.sample.length, -1.0);
    EXPECT_FALSE(read.sample.count);
    EXPECT_EQ(read.sample.shape, SampleShape::round);
    EXPECT_EQ(read.sample.name, "unnamed");
    EXPECT_EQ(read.reader.number("length_um"), std::nullopt);
}

TEST(JobReader, AsksForWhatCanBeComputedWithNext) {
    ReadSample read(R"({"kind": "sample", "computed": -1, "label": " "})");
    read.reader.read(read.sample, {"computed", "label"});
    ReadSample too_large(R"({"kind": "sample", "computed": 1e4, "label": [1]})");
    too_large.reader.read(too_large.sample, {"computed", "label"});
    EXPECT_THAT(read.refused(), ElementsAre("job.json#/computed " + std::string(k_number_out_of_range.code),
                                            "job.json#/label " + std::string(k_text_not_allowed.code)));
    EXPECT_EQ(read.problems.refused().front().rule, "must be greater than 0");
    EXPECT_THAT(too_large.refused(), ElementsAre("job.json#/computed " + std::string(k_number_out_of_range.code),
                                                 "job.json#/label " + std::string(k_wrong_type.code)));
    EXPECT_EQ(too_large.problems.refused().front().rule, "must be at least 0.001 and at most 1000");
    EXPECT_FALSE(too_large.reader.accepted("computed"));
    EXPECT_EQ(too_large.sample.computed, 0.0);
    EXPECT_EQ(too_large.sample.label, "");
}

TEST(JobReader, ReadsTheKeysThatAreAskedFor) {
    ReadSample read(R"({"kind": "sample", "shape": "oval", "name": "n", "turns": 3})");
    read.reader.read(read.sample, {"name"});
    EXPECT_EQ(read.sample.name, "n");
    EXPECT_THAT(read.refused(), ElementsAre());
    read.reader.read(read.sample, {"turns"});
    read.reader.read(read.sample, {"shape"});
    EXPECT_THAT(read.refused(), ElementsAre("job.json#/turns " + std::string(k_wrong_type.code),
                                            "job.json#/shape " + std::string(k_unknown_choice.code)));
}

}  // namespace
}  // namespace gumcert::jobs
