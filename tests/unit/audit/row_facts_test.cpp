#include "audit/row_facts.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::audit {
namespace {

AuditedRow row_saying(const std::string& comment, const std::string& unit = "bar") {
    AuditedRow row;
    row.unit = unit;
    row.comment = comment;
    note_row_facts(row);
    return row;
}

TEST(RowFacts, ReadWhatAPercentageIsOf) {
    const AuditedRow of_full = row_saying("accuracy 0.5 % of full scale, FS = 10 bar");
    EXPECT_EQ(of_full.relative_to, RelativeTo::full_scale);
    EXPECT_DOUBLE_EQ(*of_full.relative_uncertainty, 0.005);
    EXPECT_DOUBLE_EQ(*of_full.full_scale, 10.0);
    EXPECT_EQ(row_saying("0,5 % v.E.").relative_to, RelativeTo::full_scale);
    EXPECT_EQ(row_saying("1 % of reading").relative_to, RelativeTo::reading);
    EXPECT_EQ(row_saying("1 % v.M.").relative_to, RelativeTo::reading);
    EXPECT_EQ(row_saying("95 % coverage").relative_to, RelativeTo::not_stated);
    EXPECT_FALSE(row_saying("0.5 % FS, FS = 10 kPa").full_scale);  // another unit
}

TEST(RowFacts, ReadPointsOfACertificate) {
    const AuditedRow range = row_saying("calibrated from 0 to 100 bar, k = 2");
    EXPECT_EQ(range.certificate_low, 0.0);
    EXPECT_EQ(range.certificate_high, 100.0);
    const AuditedRow point = row_saying("kalibriert bei 20 \u00B0C", "\u00B0C");
    EXPECT_EQ(point.certificate_low, 20.0);
    EXPECT_EQ(point.certificate_high, 20.0);
    EXPECT_FALSE(row_saying("calibrated at 20 \u00B0C").certificate_low);  // the row is in bar
    EXPECT_FALSE(row_saying("calibrated by an NMI").certificate_low);
}

TEST(RowFacts, ReadLimitsThatDiffer) {
    for (const char* text : {"+0.3/-0.1", "-0.1/+0.3 bar",
                             "tolerance +0,3 / \u2212"
                             "0,1"}) {
        const AuditedRow row = row_saying(text);
        ASSERT_TRUE(row.lower_limit) << text;
        EXPECT_DOUBLE_EQ(*row.lower_limit, -0.1) << text;
        EXPECT_DOUBLE_EQ(*row.upper_limit, 0.3) << text;
    }
    EXPECT_FALSE(row_saying("+/- 0.3").lower_limit);
    EXPECT_FALSE(row_saying("+-0.3").lower_limit);
    EXPECT_FALSE(row_saying("0.3/0.1").lower_limit);
}

TEST(RowFacts, ReadReliability) {
    EXPECT_DOUBLE_EQ(*row_saying("reliability about 25 %").reliability, 0.25);
    EXPECT_DOUBLE_EQ(*row_saying("auf 10 % zuverl\u00E4ssig").reliability, 0.10);
    EXPECT_FALSE(row_saying("25 % of the limit").reliability);
}

TEST(RowFacts, ReadTheRest) {
    EXPECT_TRUE(row_saying("cyclic control of the room").cyclic);
    EXPECT_TRUE(row_saying("zyklische Regelung").cyclic);
    EXPECT_FALSE(row_saying("room temperature").cyclic);
    EXPECT_DOUBLE_EQ(*row_saying("correction -0.05 not applied").unapplied_correction, -0.05);
    EXPECT_FALSE(row_saying("correction -0.05 applied").unapplied_correction);
    EXPECT_EQ(row_saying("mean of 5 readings").averaged, 5U);
    EXPECT_EQ(row_saying("Mittel aus 3").averaged, 3U);
    EXPECT_FALSE(row_saying("mean of s").averaged);
}

TEST(RowFacts, ReadSeriesOfReadings) {
    const auto row = [](const std::string& comment) {
        AuditedRow one;
        one.comment = comment;
        one.n = 3;
        note_row_facts(one);
        return one;
    };
    EXPECT_EQ(row("largest s of 9 points").group_sizes, std::vector<std::size_t>(9, 3));
    EXPECT_EQ(row("größte s von 4 Tagen").group_sizes, std::vector<std::size_t>(4, 3));
    EXPECT_TRUE(row("largest of all").group_sizes.empty());
    EXPECT_TRUE(row("s of 9 points").group_sizes.empty());
    const AuditedRow daily = row("spread of the daily s 0.10, 0.12 , 0.09; n = 3");
    EXPECT_EQ(daily.group_deviations, (std::vector<double>{0.10, 0.12, 0.09}));
    EXPECT_EQ(daily.group_sizes, std::vector<std::size_t>(3, 3));
    EXPECT_TRUE(row("daily s of the balance").group_sizes.empty());
    EXPECT_TRUE(row_saying("largest s of 9 points").group_sizes.empty()) << "nobody says how many readings each has";
}

TEST(RowFacts, KeepWhatIsSetAndLeaveLongTexts) {
    AuditedRow row;
    row.comment = "mean of 5";
    row.averaged = 3;
    note_row_facts(row);
    EXPECT_EQ(row.averaged, 3U);
    EXPECT_FALSE(row_saying(std::string(401, ' ') + "mean of 5").averaged);
}

TEST(RowFacts, ReadASingleReading) {
    const auto averaged = [](const std::string& comment) {
        AuditedRow row;
        row.comment = comment;
        note_row_facts(row);
        return row.averaged;
    };
    EXPECT_EQ(averaged("s of 10 readings of a study; the result is a single reading"), 1U);
    EXPECT_EQ(averaged("das Ergebnis ist eine Einzelmessung"), 1U);
    EXPECT_EQ(averaged("single readings; mean of 4"), 4U);
    EXPECT_FALSE(averaged("10 readings"));
}

}  // namespace
}  // namespace gumcert::audit
