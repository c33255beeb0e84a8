#include "evaluation/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "jobs/file_source.h"
#include "jobs/job_limits.h"

namespace gumcert::evaluation {
namespace {

TEST(Limits, AreToldOnceAndTogether) {
    std::set<std::string> seen;
    std::set<std::string_view> closed;
    std::string_view last;
    for (const Limit& limit : limits()) {
        EXPECT_GT(limit.most, 0U) << limit.what;
        EXPECT_TRUE(seen.insert(std::string(limit.applies_to) + "/" + std::string(limit.what)).second) << limit.what;
        if (limit.applies_to != last) {
            EXPECT_TRUE(closed.insert(limit.applies_to).second) << limit.applies_to << " stands in two places";
            last = limit.applies_to;
        }
    }
}

TEST(Limits, AreThoseThatRefuse) {
    std::set<std::string> values;
    for (const Limit& limit : limits()) {
        values.insert(std::string(limit.what) + " " + limit.value());
    }
    EXPECT_TRUE(values.contains("points of a section, or of a job without sections 100 000"));
    EXPECT_TRUE(values.contains("trials of Monte Carlo 10 000 000 000"));
    EXPECT_TRUE(values.contains("a file 64 MiB"));
    EXPECT_TRUE(values.contains("time for a document 60 s"));
    EXPECT_TRUE(values.contains("a file 20 000 000 bytes"));
    EXPECT_TRUE(values.contains("time, unless --time-limit says otherwise 600 s"));
    EXPECT_EQ(walls_of_evaluation().time, 600U);
    EXPECT_EQ(walls_of_evaluation().memory, std::uint64_t{4} << 30U);
}

TEST(Limits, StandInLinesByWhatTheyApplyTo) {
    const std::string text = limits_text();
    EXPECT_TRUE(text.starts_with("files of a job:\n")) << text.substr(0, 40);
    EXPECT_NE(text.find("\n\njobs of kind budget:\n"), std::string::npos);
    std::size_t width = 0;
    for (const Limit& limit : limits()) {
        const std::string line = limit.value() + "  " + std::string(limit.what) + "\n";
        EXPECT_NE(text.find(line), std::string::npos) << line;
        width = std::max(width, limit.value().size());
    }
    EXPECT_NE(text.find("\n" + std::string(width + 2 - std::string("64 MiB").size(), ' ') + "64 MiB  a file\n"),
              std::string::npos)
        << "values end in one column";
}

TEST(Limits, OfFilesOfOthersGrowWithThem) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "walls_of_files";
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "small") << "x";
    std::ofstream(folder / "large") << "x";
    fs::resize_file(folder / "large", 25'000'000);
    constexpr std::uint64_t k_gib = std::uint64_t{1} << 30U;
    EXPECT_EQ(walls_of({}).time, 30U);
    EXPECT_EQ(walls_of({}).memory, k_gib);
    EXPECT_EQ(walls_of({folder / "small", folder / "nothing"}).time, 60U);
    EXPECT_EQ(walls_of({folder / "small", folder / "large"}).time, 120U) << "1 and 3 steps";
    EXPECT_EQ(walls_of({folder / "small", folder / "large"}).memory, 3 * k_gib + 2 * 262'144) << "the largest counts";
    EXPECT_EQ(walls_of_evaluation({folder / "large"}).memory, 4 * k_gib);
    EXPECT_EQ(walls_of_evaluation({folder / "large"}).time, 600U);
    // A budget of 100 000 points and four inputs, the most points of a job, which takes 6 GB.
    fs::resize_file(folder / "large", 379'275'231);
    EXPECT_EQ(walls_of_evaluation({folder / "large"}).memory, walls_of({folder / "large"}).memory);
    EXPECT_EQ(walls_of_evaluation({folder / "large"}).time, walls_of({folder / "large"}).time);
    EXPECT_GT(walls_of_evaluation({folder / "large"}).memory, 8 * k_gib);
}

}  // namespace
}  // namespace gumcert::evaluation
