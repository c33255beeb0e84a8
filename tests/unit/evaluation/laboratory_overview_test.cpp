#include "evaluation/laboratory_overview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {
namespace {

const std::filesystem::path k_laboratory = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/laboratory/laboratory";

std::string state_of(const std::vector<OverviewRow>& rows, const std::string& id) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const OverviewRow& one) { return one.id == id; });
    return row == rows.end() ? "none" : row->state;
}

TEST(LaboratoryOverview, SaysWhatIsValidOnADay) {
    const LaboratoryOverview overview = laboratory_overview(k_laboratory, "2026-11-24");
    EXPECT_FALSE(overview.is_overdue());
    EXPECT_EQ(state_of(overview.standards, "STD-017"), "valid");
    EXPECT_EQ(state_of(overview.signatories, "OP3"), "valid");
    ASSERT_EQ(overview.accreditation.size(), 1U);
    EXPECT_EQ(overview.accreditation.front().state, "valid");
    EXPECT_EQ(overview_text(overview, "here", "").substr(0, 18), "here on 2026-11-24");
}

// The comparator is valid until 2027-05-10: on that day, and not on the next one.
TEST(LaboratoryOverview, SaysWhatHasRunOut) {
    const std::string last = state_of(laboratory_overview(k_laboratory, "2027-05-10").standards, "CMP-02");
    const LaboratoryOverview later = laboratory_overview(k_laboratory, "2027-05-11");
    EXPECT_EQ(last, "valid");
    EXPECT_EQ(state_of(later.standards, "CMP-02"), "overdue");
    EXPECT_TRUE(later.is_overdue());
    EXPECT_NE(overview_csv(later).find("CMP-02"), std::string::npos);
    EXPECT_NE(overview_json(later).find("\"overdue\""), std::string::npos);
}

TEST(LaboratoryOverview, SaysWhatIsNotYetValid) {
    const LaboratoryOverview early = laboratory_overview(k_laboratory, "2024-12-31");
    EXPECT_EQ(state_of(early.accreditation, "EX-0000"), "not_yet");
    EXPECT_EQ(state_of(early.signatories, "HL"), "valid");
}

TEST(LaboratoryOverview, OfNoFolderOfALaboratoryIsRefused) {
    EXPECT_THROW((void)laboratory_overview(k_laboratory / "standards", "2026-11-24"), gum::InputError);
}

TEST(LaboratoryOverview, ADayIsOneOfTheCalendar) {
    EXPECT_TRUE(is_day("2026-11-24"));
    EXPECT_TRUE(is_day("2028-02-29"));
    for (const char* const other : {"2026-02-29", "2026-13-01", "24.11.2026", "2026-11-24T00:00:00Z", ""}) {
        EXPECT_FALSE(is_day(other)) << other;
    }
}

TEST(LaboratoryOverview, ADayIsOneOfUtcOrBesideIt) {
    const std::string now = "2026-12-31T23:50:00Z";
    EXPECT_TRUE(is_day_somewhere("2026-12-30", now));
    EXPECT_TRUE(is_day_somewhere("2026-12-31", now));
    EXPECT_TRUE(is_day_somewhere("2027-01-01", now));
    for (const char* const other : {"2026-12-29", "2027-01-02", "2027-12-31", "", "31.12.2026"}) {
        EXPECT_FALSE(is_day_somewhere(other, now)) << other;
    }
}

}  // namespace
}  // namespace gumcert::evaluation
