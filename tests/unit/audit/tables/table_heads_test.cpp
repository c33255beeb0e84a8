#include "audit/tables/table_heads.h"
#include "audit/words/column_heads.h"

#include <gtest/gtest.h>

#include <string>

#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

std::optional<Heads> heads_in(const std::string& csv) {
    const workbook::Workbook workbook = workbook::read_csv(csv, "b.csv", "b");
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(workbook);
    const SheetView sheet(workbook, evaluation, 0, DecimalSign::point);
    return heads_of(sheet, sheet.rows().at(1));
}

TEST(TableHeads, AreAQuantityAndAnUncertainty) {
    const std::optional<Heads> heads = heads_in("symbol,description,u [nm],unit,sensitivity\n");
    ASSERT_TRUE(heads);
    EXPECT_EQ(heads->columns.size(), 4U);
    EXPECT_EQ(heads->units.at(Column::u), "nm");
    ASSERT_TRUE(heads->description);
    EXPECT_EQ(*heads->description, heads->columns.at(Column::quantity) + 1);
    EXPECT_FALSE(heads_in("quantity,unit,comment\n"));
    EXPECT_FALSE(heads_in("u,unit,comment\n"));
    EXPECT_TRUE(has_numbers_with_units(Column::u));
    EXPECT_FALSE(has_numbers_with_units(Column::nu));
}

TEST(TableHeads, NameAThirdColumnOfQuantities) {
    const std::optional<Heads> heads = heads_in("symbol,description,parameter,u,unit\n");
    ASSERT_TRUE(heads);
    EXPECT_EQ(heads->second.size(), 1U);
}

TEST(TableHeads, OfALargeSymbolAreWhatIsDivided) {
    const std::optional<Heads> heads = heads_in("Quantity,U_i / mm,k_i,u_i / mm\nStandard,0.024,2,0.012\n");
    ASSERT_TRUE(heads);
    EXPECT_EQ(heads->columns.at(Column::stated) + 2, heads->columns.at(Column::u));
    EXPECT_TRUE(heads->columns.contains(Column::divisor));
    EXPECT_TRUE(heads->second.empty());
    EXPECT_EQ(heads->units.at(Column::u), "mm");
    const std::optional<Heads> alone = heads_in("Quantity,U_i / mm,c\nStandard,0.024,2\n");
    ASSERT_TRUE(alone);
    EXPECT_TRUE(alone->columns.contains(Column::u)) << "in capitals, as far as it is said";
    EXPECT_EQ(column_of("u, mm"), Column::u);
    const std::optional<Heads> behind_c =
        heads_in("Quantity,Unit,Uncertainty u(x_i),c_i,u(x_i) c_i\nNormal,mm,0.03,2,0.06\n");
    ASSERT_TRUE(behind_c);
    EXPECT_FALSE(behind_c->columns.contains(Column::stated));
    EXPECT_LT(behind_c->columns.at(Column::u), behind_c->columns.at(Column::sensitivity));
}

TEST(TableHeads, OfUBehindACoefficientAreContributions) {
    const std::optional<Heads> heads = heads_in("Quantity,u,c,u_i / mW\nStandard,0.4,0.1,0.04\n");
    ASSERT_TRUE(heads);
    EXPECT_EQ(heads->columns.at(Column::u) + 2, heads->columns.at(Column::contribution));
    EXPECT_EQ(heads->units.at(Column::contribution), "mW");
    EXPECT_TRUE(heads->second.empty());
    for (const char* const other : {"Quantity,u,u_i / mW,c\n", "Quantity,u_i,c,u_i / mW\n", "Quantity,u,c,u (2 V)\n"}) {
        EXPECT_FALSE(heads_in(other)->columns.contains(Column::contribution)) << other;
    }
}

TEST(TableHeads, OfGroupsNameNoRows) {
    const auto first = [](const std::string& a, const std::string& b, const std::string& c) {
        const std::optional<Heads> heads = heads_in("Group,Source,u,divisor\n" + a + ",certificate,0.1,2\n" + b +
                                                    ",drift,0.1,1\n" + c + ",resolution,0.1,1\n");
        return heads ? heads->columns.at(Column::quantity) : 0U;
    };
    EXPECT_EQ(first("reference", "reference", ""), first("reference", "", "")) << "the column of the sources";
    EXPECT_EQ(first("reference", "drift", "display") + 1, first("reference", "reference", "reference"));
}

TEST(TableHeads, PartTablesBesideEachOther) {
    const workbook::Workbook workbook =
        workbook::read_csv("quantity,unit,u,quantity,unit,u\na,mm,0.1,b,mm,0.2\n", "b.csv", "b");
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(workbook);
    const SheetView sheet(workbook, evaluation, 0, DecimalSign::point);
    EXPECT_EQ(parts_of(sheet).size(), 2U);
}

TEST(TableHeads, OfBothTypesHaveNumbersOrMarks) {
    const std::string heads = "Quantity,Type A,Type B,Contribution / mV\n";
    const std::optional<Heads> marks = heads_in(heads + "Readings,x,,0.05\nReference,,✓,0.10\nU,,,0.22\n");
    ASSERT_TRUE(marks);
    EXPECT_EQ(marks->columns.size(), 2U);
    EXPECT_TRUE(marks->type_b.empty());
    EXPECT_TRUE(marks->marks_a && marks->marks_b);
    EXPECT_TRUE(marks->unknown.empty());
    for (const char* const rows : {"Readings,0.05,,\nReference,,0.10,\n", "Readings,0.05,n/a,\nReference,n/a,0.10,\n",
                                   "Readings,0.05,-,\nReference,-,0.10,\n"}) {
        const std::optional<Heads> numbers = heads_in(heads + rows);
        ASSERT_TRUE(numbers) << rows;
        EXPECT_EQ(numbers->type_b.size(), 1U) << rows;
        EXPECT_FALSE(numbers->marks_a) << rows;
    }
}

TEST(TableHeads, TakeARelativeSymbolWhereNoOtherUIs) {
    const std::optional<Heads> weights = heads_in("Quantity,Half-width / µm,w,u / µm\nStandard,0.6,0.5,0.30\n");
    ASSERT_TRUE(weights);
    EXPECT_EQ(weights->columns.at(Column::u), weights->columns.at(Column::stated) + 2);
    EXPECT_EQ(weights->unknown.size(), 1U);
    const std::optional<Heads> beside = heads_in("Quantity,w_i / %,c,Contribution / µm\nStandard,50,1,0.30\n");
    ASSERT_TRUE(beside);
    EXPECT_FALSE(beside->columns.contains(Column::u));
    for (const char* const table :
         {"Quantity,w / %,c\nForce,0.02,1\n", "Quantity,w_i (%),c\nForce,0.02,1\n", "Quantity,w,c\nForce,0.02 %,1\n",
          "Quantity,w,unit,c\nForce,0.02,%,1\n", "Quantity,w / %,c,Contribution / %\nForce,0.02,1,0.02\n"}) {
        const std::optional<Heads> relative = heads_in(table);
        ASSERT_TRUE(relative) << table;
        EXPECT_EQ(relative->columns.at(Column::u), 2U) << table;
    }
    EXPECT_FALSE(heads_in("Quantity,w,c\nForce,0.5,1\n")) << "nobody knows of what it is a part";
}

}  // namespace
}  // namespace gumcert::audit
