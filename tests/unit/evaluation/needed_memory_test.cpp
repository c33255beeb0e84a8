#include "evaluation/needed_memory.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace gumcert::evaluation {
namespace {

std::optional<gum::Diagnostic> told_of(double memory, std::uint64_t most) {
    static const jobs::MemoryFileSource files(std::map<std::string, std::string>{{"job.json", "{}"}});
    static const std::vector<std::string> names{"job.json", "points.csv"};
    return needed_memory({files, names, memory}, most);
}

TEST(NeededMemory, IsANoteFromAGigabyteOn) {
    EXPECT_FALSE(told_of(0.0, 0)) << "not known";
    EXPECT_FALSE(told_of(0.999e9, 0));
    const std::optional<gum::Diagnostic> note = told_of(1.2345e9, 0);
    ASSERT_TRUE(note);
    EXPECT_EQ(note->code, "GC-STORE-0026");
    EXPECT_EQ(note->where, "job.json");
    EXPECT_EQ(note->what, "its evaluation takes about 1234 MB of memory");
    EXPECT_EQ(note->severity, gum::Severity::note);
}

TEST(NeededMemory, IsAnErrorBeyondTheLimit) {
    EXPECT_FALSE(told_of(200e6, 200'000'000));
    const std::optional<gum::Diagnostic> error = told_of(200e6, 199'999'999);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->severity, gum::Severity::error);
    EXPECT_NE(error->action.find("--memory-limit"), std::string::npos);
    EXPECT_EQ(told_of(1e9, 2'000'000'000)->severity, gum::Severity::note) << "much, and not too much";
}

}  // namespace
}  // namespace gumcert::evaluation
