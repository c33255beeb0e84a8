#include "archive/certificates/archive_draft.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/reports/certified_sample.h"

namespace gumcert::archive {
namespace {

// A laboratory has another day than UTC for some hours of each day; two days are another matter.
TEST(ArchiveDraft, PrintedDaysAreThoseOfThePlace) {
    reports::EvaluationRecord record = gumcert::test::certified_budget_record();
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

}  // namespace
}  // namespace gumcert::archive
