#include "self_test/reference_case.h"

#include <gtest/gtest.h>

#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::self_test {
namespace {

using nlohmann::json;

const std::filesystem::path k_cases = std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests" / "reference" / "cases";

ExpectedValue printed(const std::string& text) {
    return {.text = text, .wanted = 1.0};
}

TEST(ReferenceCase, TheOneOfTheEndGaugeIsRead) {
    const std::string id = "gum-h1-end-gauge";
    const ReferenceCase read = reference_case_from_json(evaluation::read_file(k_cases / (id + ".json")), id);
    EXPECT_EQ(read.id, id);
    EXPECT_EQ(read.document, "JCGM 100:2008 (GUM)");
    EXPECT_EQ(read.place, "H.1.1 to H.1.6, Table H.1");
    EXPECT_TRUE(read.is_place_seen);
    EXPECT_EQ(read.seen, "opened");
    EXPECT_EQ(read.jobs.size(), 3U);
    ASSERT_GT(read.expected.size(), 4U);
    EXPECT_EQ(std::get<double>(read.expected[0].wanted), 50000838.0);
    EXPECT_EQ(read.expected[0].digits(), 8);
    EXPECT_EQ(read.expected[3].name(), "l contribution [ls]");
}

TEST(ReferenceCase, APlaceThatNobodyLookedUpSaysSo) {
    const ReferenceCase read =
        reference_case_from_json(evaluation::read_file(k_cases / "jcgm106-oil.json"), "jcgm106-oil");
    EXPECT_FALSE(read.is_place_seen);
    EXPECT_EQ(read.seen, "recalled");
}

TEST(ReferenceCase, DigitsAndHalfUnitOfPrintedTexts) {
    EXPECT_EQ(printed("254.260").digits(), 6);
    EXPECT_DOUBLE_EQ(printed("254.260").half_unit(), 0.0005);
    EXPECT_EQ(printed("1.60E-3").digits(), 3);
    EXPECT_DOUBLE_EQ(printed("1.60E-3").half_unit(), 5e-6);
    EXPECT_DOUBLE_EQ(printed("2.3894212918E+02").half_unit(), 5e-9);
    EXPECT_EQ(printed("0.0095").digits(), 2);
    EXPECT_EQ(printed("-0.1712").digits(), 4);
    EXPECT_EQ(printed("50 000 838").digits(), 8);
    EXPECT_DOUBLE_EQ(printed("50 000 838").half_unit(), 0.5);
    EXPECT_EQ(printed("0").digits(), 1);
    EXPECT_EQ((ExpectedValue{.text = "pass", .wanted = std::string("pass")}.digits()), 0);
}

TEST(ReferenceCase, DigitsReached) {
    EXPECT_EQ(digits_reached(32.0, 2, 31.66), 2);
    EXPECT_EQ(digits_reached(0.295, 3, 0.29558), 2);
    EXPECT_EQ(digits_reached(0.295, 3, 0.29549), 3);
    EXPECT_EQ(digits_reached(-1.2, 2, -1.2), 2);
    EXPECT_EQ(digits_reached(-1.2, 2, 1.2), 0);
    EXPECT_EQ(digits_reached(8.0, 1, 3.0), 0);
    EXPECT_EQ(digits_reached(0.0, 1, 0.0), 1);
    EXPECT_EQ(digits_reached(0.0, 1, 1e-3), 0);
    EXPECT_EQ(digits_reached(1.0, 1, std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(ReferenceCase, WhatIsNoCaseIsRefusedWithItsName) {
    const json whole = json::parse(evaluation::read_file(k_cases / "iso11929-4-ex6.json"));
    const auto refused = [](const std::string& text) {
        try {
            (void)reference_case_from_json(text, "mine");
        } catch (const gum::InputError& error) {
            return error.diagnostics().front().code + " " + error.diagnostics().front().where;
        }
        return std::string("read");
    };
    EXPECT_EQ(refused(whole.dump()), "read");
    EXPECT_EQ(refused("[1]"), "GC-SELF-0002 mine");
    EXPECT_EQ(refused(whole.dump().substr(0, 200)), "GC-SELF-0002 mine");
    const std::vector<std::pair<const char*, json>> changes{{"/title", 1},
                                                            {"/source", "GUM"},
                                                            {"/source/seen", "maybe"},
                                                            {"/jobs", json::array()},
                                                            {"/data", 1},
                                                            {"/expected", "none"},
                                                            {"/expected/0", 1},
                                                            {"/expected/0/printed", nullptr},
                                                            {"/expected/0/found", 1},
                                                            {"/expected/0/tolerance", -1},
                                                            {"/expected/0/computed", 1},
                                                            {"/expected/0/not_compared", "x"}};
    for (const auto& [pointer, value] : changes) {
        json changed = whole;
        changed[json::json_pointer(pointer)] = value;
        EXPECT_EQ(refused(changed.dump()), "GC-SELF-0002 mine") << pointer;
    }
}

}  // namespace
}  // namespace gumcert::self_test
