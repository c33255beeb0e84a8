// gumcert fonts: what a template of a PDF may use.
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Fonts : public ProgramTest {};

TEST_F(Fonts, ListsFamiliesWithTheirStylesAndPlaces) {
    const Ended ended = gumcert({"fonts", "--share", GUMCERT_SOURCE_DIR});
    if (ended.code == 5) {
        GTEST_SKIP() << "node or its package is missing: " << ended.err;
    }
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("Libertinus Serif: Regular, Bold, Italic, Bold Italic"), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("    inside of the program\n"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace gumcert::cli
