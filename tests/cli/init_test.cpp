// gumcert init: every method that it offers is a job that runs.
#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Init : public ProgramTest {
protected:
    std::vector<std::string> methods() {
        const Ended list = gumcert({"init", "--share", GUMCERT_SOURCE_DIR});
        EXPECT_EQ(list.code, 0) << list.err;
        std::vector<std::string> names;
        for (const std::string& line : lines_of(list.out)) {
            if (line.starts_with("  ")) {
                names.push_back(line.substr(2, line.find(' ', 2) - 2));
            }
        }
        return names;
    }
};

TEST_F(Init, EveryMethodIsAFolderWithAJobThatIsEvaluated) {
    const std::vector<std::string> all = methods();
    EXPECT_GE(all.size(), 9U);
    for (const std::string& method : all) {
        SCOPED_TRACE(method);
        const fs::path place = folder() / method;
        const Ended begun = gumcert({"init", method, place.string(), "--share", GUMCERT_SOURCE_DIR});
        ASSERT_EQ(begun.code, 0) << begun.err;
        const std::size_t next = begun.out.find("Next: gumcert run ");
        ASSERT_NE(next, std::string::npos) << begun.out;
        const std::string job = lines_of(begun.out.substr(next + 18)).front();
        ASSERT_TRUE(fs::exists(job)) << job;
        const Ended checked = gumcert({"check", job});
        EXPECT_EQ(checked.code, 0) << checked.err;
    }
}

TEST_F(Init, OverwritesNothing) {
    const fs::path place = folder() / "taken";
    write_bytes(place / "job.json", "mine");
    const auto before = contents_of(folder());
    const Ended refused = gumcert({"init", "end_gauge", place.string(), "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(refused.code, 5);
    EXPECT_NE(refused.err.find("GC-STORE-0007"), std::string::npos) << refused.err;
    EXPECT_EQ(contents_of(folder()), before);
}

TEST_F(Init, KnowsWhatMayHaveBeenMeant) {
    const Ended wrong = gumcert({"init", "multimetre", "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_NE(wrong.err.find("did you mean multimeter?"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace gumcert::cli
