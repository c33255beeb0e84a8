#include "gum/conformity/tolerance_limits.h"

#include <gtest/gtest.h>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::message_of;

TEST(ToleranceLimits, OneOrTwo) {
    EXPECT_TRUE((ToleranceLimits{.lower = 1.0, .upper = 2.0}).two_sided());
    for (const ToleranceLimits& limits : {ToleranceLimits{.lower = 1.0}, ToleranceLimits{.upper = -1.0}}) {
        EXPECT_FALSE(limits.two_sided());
        EXPECT_EQ(limits_problem(limits), "");
        EXPECT_NO_THROW(require_limits(limits));
    }
    EXPECT_EQ(limits_problem({.lower = -1.0, .upper = 0.0}), "");
    EXPECT_NO_THROW(require_limits({.lower = -1.0, .upper = 0.0}));
}

TEST(ToleranceLimits, SayWhatIsWrongWithThem) {
    EXPECT_EQ(limits_problem({}), "no tolerance limit");
    EXPECT_EQ(limits_problem({.lower = k_nan}), "a tolerance limit that is not a finite number");
    EXPECT_EQ(limits_problem({.lower = 0.0, .upper = k_infinity}), "a tolerance limit that is not a finite number");
    EXPECT_EQ(limits_problem({.lower = 2.5, .upper = 2.0}), "the lower limit 2.5 is not below the upper limit 2");
    EXPECT_EQ(limits_problem({.lower = 2.0, .upper = 2.0}), "the lower limit 2 is not below the upper limit 2");
}

TEST(ToleranceLimits, AreRefusedWithThatProblem) {
    const auto call = [] { require_limits({.lower = 2.5, .upper = 2.0}); };
    EXPECT_EQ(code_of<InputError>(call), "GC-GUM-0080");
    EXPECT_EQ(
        message_of<InputError>(call),
        "tolerance limits — the lower limit 2.5 is not below the upper limit 2 — one finite limit or two, the lower "
        "one below the upper one — Correct the limits of the specification.");
    EXPECT_EQ(code_of<InputError>([] { require_limits({}); }), "GC-GUM-0080");
}

}  // namespace
}  // namespace gumcert::gum
