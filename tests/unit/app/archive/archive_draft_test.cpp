#include "app/archive/archive_draft.h"

#include <gtest/gtest.h>

#include <string>

#include "app/laboratory_overview.h"
#include "tests/unit/reports/certified_sample.h"

namespace gumcert::app {
namespace {

// A laboratory has another day than UTC for some hours of each day; two days are another matter.
TEST(ArchiveDraft, PrintedDaysAreThoseOfThePlace) {
    reports::EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.dates.authorised = "2026-11-28";
    record.certificate->data.dates.issued = "2026-12-31";
    const std::string text = to_canonical_json(record);
    const auto doubts = [&](const std::string& kind, const std::string& day) {
        return doubts_about_days(text, "EX-1", kind, day).size();
    };
    for (const char* const day : {"2026-11-27", "2026-11-28", "2026-11-29"}) {
        EXPECT_EQ(doubts("authorised", day), 0U) << day;
    }
    EXPECT_EQ(doubts("authorised", "2026-11-30"), 1U);
    EXPECT_EQ(doubts("issued", "2027-01-01"), 0U);
    EXPECT_EQ(doubts("issued", "2027-01-02"), 1U);
    EXPECT_EQ(doubts("reviewed", "2027-01-02"), 0U);
}

TEST(ArchiveDraft, ADayIsOneOfUtcOrBesideIt) {
    const std::string now = "2026-12-31T23:50:00Z";
    EXPECT_TRUE(is_day_somewhere("2026-12-30", now));
    EXPECT_TRUE(is_day_somewhere("2026-12-31", now));
    EXPECT_TRUE(is_day_somewhere("2027-01-01", now));
    for (const char* const other : {"2026-12-29", "2027-01-02", "2027-12-31", "", "31.12.2026"}) {
        EXPECT_FALSE(is_day_somewhere(other, now)) << other;
    }
}

}  // namespace
}  // namespace gumcert::app
