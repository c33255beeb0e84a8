#include "gum/comparison/refusal_place.h"

#include <gtest/gtest.h>

#include <string>

#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {
namespace {

std::string place_of_refusal(const std::string& inner) {
    try {
        at_place("item \"A\"", [&] { refuse("GC-GUM-0001", inner, "NaN", "must be finite", "Correct it."); });
    } catch (const InputError& refused) {
        return refused.diagnostics().front().where;
    }
    return "not refused";
}

TEST(AtPlace, PutsThePlaceBeforeThatOfTheWork) {
    EXPECT_EQ(place_of_refusal("u of result 2"), "item \"A\", u of result 2");
    EXPECT_EQ(place_of_refusal("item \"A\", sigma_pt"), "item \"A\", sigma_pt") << "not twice";
}

TEST(AtPlace, KeepsTheClassOfTheFailure) {
    const auto fail = [] {
        at_place("item", [] {
            throw NoResultError(Diagnostic{
                .code = "GC-GUM-0132", .where = "weights", .what = "singular", .rule = "regular", .action = "Look."});
        });
    };
    EXPECT_THROW(fail(), NoResultError);
    bool done = false;
    at_place("item", [&] { done = true; });
    EXPECT_TRUE(done);
}

}  // namespace
}  // namespace gumcert::gum
