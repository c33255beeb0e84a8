#include "gum/quantity/diagnostic.h"

#include <gtest/gtest.h>

namespace gumcert::gum {
namespace {

TEST(Diagnostic, IsPrintedInTheFixedForm) {
    const Diagnostic diagnostic{.code = "GC-INPUT-0012",
                                .where = "job.json#/observations/17/standard_uncertainty",
                                .what = "-2e-06 m",
                                .rule = "must be finite and greater than 0",
                                .action = "Correct the sign or remove the observation."};
    EXPECT_EQ(message(diagnostic),
              "job.json#/observations/17/standard_uncertainty — -2e-06 m — must be finite and greater than 0 — "
              "Correct the sign or remove the observation.");
}

TEST(Diagnostic, LeavesOutEmptyParts) {
    EXPECT_EQ(message({.code = "c", .where = "", .what = "what", .rule = "", .action = "do"}), "what — do");
    EXPECT_EQ(message({}), "");
}

TEST(Diagnostic, PrintsABoundInPlaceOfTheEqualsSign) {
    EXPECT_EQ(message({.code = "c", .where = "", .what = "chi-square 9, p = <1E-300, n = 5", .rule = "", .action = ""}),
              "chi-square 9, p < 1E-300, n = 5");
    EXPECT_EQ(message({.code = "c", .where = "", .what = "a = <b>, r = > 1", .rule = "", .action = ""}),
              "a = <b>, r = > 1");
}

TEST(DiagnosedError, CarriesEveryProblem) {
    const InputError error(std::vector<Diagnostic>{{.code = "1", .where = "a", .what = "x", .rule = {}, .action = {}},
                                                   {.code = "2", .where = "b", .what = "y", .rule = {}, .action = {}}});
    EXPECT_STREQ(error.what(), "a — x\nb — y");
    ASSERT_EQ(error.diagnostics().size(), 2U);
    EXPECT_EQ(error.diagnostics()[1].code, "2");
    EXPECT_THROW(throw InputError(Diagnostic{}), DiagnosedError);
}

}  // namespace
}  // namespace gumcert::gum
