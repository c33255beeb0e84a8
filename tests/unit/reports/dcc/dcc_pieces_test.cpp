#include "reports/dcc/dcc_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

namespace gumcert::reports {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

certificate::PointColumn column(const char* role, std::vector<std::string> printed, const char* unit = "") {
    certificate::PointColumn c;
    c.name = role;
    c.role = role;
    c.unit = unit;
    for (const std::string& text : printed) {
        c.values.push_back(*unit == '\0' || text.empty() ? std::nullopt : std::optional(1.0));
    }
    c.printed = std::move(printed);
    return c;
}

EvaluationRecord record_with(std::vector<certificate::PointColumn> columns, std::vector<std::int64_t> sections = {}) {
    EvaluationRecord record;
    certificate::PointTable points;
    for (std::size_t i = 0; i < columns.front().printed.size(); ++i) {
        points.points.push_back("p" + std::to_string(i + 1));
    }
    points.columns = std::move(columns);
    record.points = std::move(points);
    for (const std::int64_t count : sections) {
        SectionSummary& section = record.sections.emplace_back();
        section.name = "s" + std::to_string(record.sections.size());
        section.points = count;
    }
    return record;
}

std::string item_of(const std::string& section) {
    return section == "s2" ? "item_2" : "item_1";
}

std::vector<std::string> ids(const std::vector<SetPiece>& pieces) {
    std::vector<std::string> all;
    for (const SetPiece& piece : pieces) {
        all.push_back(piece.id);
    }
    return all;
}

TEST(DccPieces, AreNoneWherePointsNameNone) {
    EXPECT_THAT(SetPieces(EvaluationRecord(), item_of).of_item("item_1"), IsEmpty());
    const SetPieces pieces(record_with({column("nominal", {"1", "2"}, "mm")}), item_of);
    EXPECT_THAT(pieces.of_item("item_1"), IsEmpty());
    EXPECT_THAT(pieces.of_rows({"p1", "p2"}), IsEmpty());
}

TEST(DccPieces, ShareTheirNumberBetweenTheirPoints) {
    const SetPieces pieces(record_with({column("serial_number", {"A", "A", "B", "", "C", "C"}),
                                        column("identification", {"", "", "", "", "x", "y"}),
                                        column("nominal", {"1", "1", "1", "5", "2", ""}, "mm")}),
                           item_of);
    const std::vector<SetPiece> all = pieces.of_item("item_1");
    EXPECT_THAT(ids(all), ElementsAre("item_1_1", "item_1_2", "item_1_3", "item_1_4"));
    EXPECT_EQ(all[0].nominal->printed, "1");
    EXPECT_EQ(all[2].identification, "x");
    EXPECT_FALSE(all[3].nominal);
    EXPECT_THAT(pieces.of_rows({"p1", "p2", "p3", "p4", "p5", "p6"}),
                ElementsAre("item_1_1", "item_1_1", "item_1_2", "item_1", "item_1_3", "item_1_4"));
    EXPECT_THAT(pieces.of_rows({"p4"}), IsEmpty()) << "no row names a piece";
    EXPECT_THAT(pieces.of_rows({"p1", "0 deg"}), IsEmpty()) << "no table of points";
}

TEST(DccPieces, HaveNoNominalValueWhereTheirPointsDiffer) {
    const SetPieces pieces(record_with({column("serial_number", {"A", "A"}), column("nominal", {"1", "2"}, "mm")}),
                           item_of);
    EXPECT_FALSE(pieces.of_item("item_1").at(0).nominal);
}

TEST(DccPieces, BelongToTheItemOfTheirSection) {
    const SetPieces pieces(record_with({column("serial_number", {"A", "A", "B"})}, {1, 2}), item_of);
    EXPECT_THAT(ids(pieces.of_item("item_1")), ElementsAre("item_1_1"));
    EXPECT_THAT(ids(pieces.of_item("item_2")), ElementsAre("item_2_1", "item_2_2"));
    EXPECT_THAT(pieces.of_rows({"p2", "p3"}), ElementsAre("item_2_1", "item_2_2"));
}

}  // namespace
}  // namespace gumcert::reports
