#include "gum/argument_check.h"

#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::message_of;

/// The code and the message of the refusal of a value; "" and a test failure when there is none.
template <class Check>
std::string refusal_of(const Check& check, double value) {
    const auto call = [&] { check(value, "u"); };
    return code_of<InputError>(call) + ": " + message_of<InputError>(call);
}

TEST(ArgumentCheck, RefusalIsOneDiagnostic) {
    try {
        refuse("GC-GUM-0001", "place", "what", "rule", "Action.");
    } catch (const InputError& refusal) {
        ASSERT_EQ(refusal.diagnostics().size(), 1U);
        EXPECT_EQ(refusal.diagnostics()[0].code, "GC-GUM-0001");
        EXPECT_STREQ(refusal.what(), "place — what — rule — Action.");
    }
}

TEST(ArgumentCheck, FiniteNumbers) {
    EXPECT_NO_THROW(require_finite(-1.7e308, "u"));
    EXPECT_EQ(refusal_of(require_finite, k_infinity),
              "GC-GUM-0001: u — inf — must be a finite number — Correct the value.");
    EXPECT_EQ(refusal_of(require_finite, k_nan), "GC-GUM-0001: u — NaN — must be a finite number — Correct the value.");
}

TEST(ArgumentCheck, NumbersThatAreNotNegative) {
    EXPECT_NO_THROW(require_not_negative(0.0, "u"));
    EXPECT_NO_THROW(require_not_negative(-0.0, "u"));
    EXPECT_EQ(refusal_of(require_not_negative, -2e-6),
              "GC-GUM-0002: u — -2e-06 — must not be negative — Correct the sign or the value.");
    EXPECT_EQ(refusal_of(require_not_negative, -k_infinity).substr(0, 11), "GC-GUM-0001");
    EXPECT_EQ(refusal_of(require_not_negative, k_nan).substr(0, 11), "GC-GUM-0001");
}

TEST(ArgumentCheck, PositiveNumbers) {
    EXPECT_NO_THROW(require_positive(5e-324, "u"));
    EXPECT_EQ(refusal_of(require_positive, 0.0), "GC-GUM-0003: u — 0 — must be greater than 0 — Correct the value.");
    EXPECT_EQ(refusal_of(require_positive, -1.0).substr(0, 11), "GC-GUM-0003");
    EXPECT_EQ(refusal_of(require_positive, k_infinity).substr(0, 11), "GC-GUM-0001");
}

TEST(ArgumentCheck, Probabilities) {
    EXPECT_NO_THROW(require_probability(0.9545, "p"));
    EXPECT_EQ(refusal_of(require_probability, 95.0),
              "GC-GUM-0004: u — 95 — must lie between 0 and 1, both excluded — State it as a fraction, e.g. 0.9545 for "
              "95.45 %.");
    for (const double value : {0.0, 1.0, -0.5, k_nan}) {
        EXPECT_EQ(refusal_of(require_probability, value).substr(0, 11), "GC-GUM-0004") << value;
    }
}

TEST(ArgumentCheck, DegreesOfFreedom) {
    EXPECT_NO_THROW(require_degrees_of_freedom(k_infinity, "nu"));
    EXPECT_NO_THROW(require_degrees_of_freedom(0.5, "nu"));
    EXPECT_EQ(
        refusal_of(require_degrees_of_freedom, 0.0),
        "GC-GUM-0005: u — 0 — degrees of freedom must be greater than 0 or infinite — Correct the value, or leave "
        "it out where it is infinite.");
    for (const double value : {-1.0, k_nan}) {
        EXPECT_EQ(refusal_of(require_degrees_of_freedom, value).substr(0, 11), "GC-GUM-0005") << value;
    }
}

}  // namespace
}  // namespace gumcert::gum
