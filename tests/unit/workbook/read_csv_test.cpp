#include "workbook/read_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::workbook {
namespace {

/// "A1=text B1=5[5.0]": each cell, numbers with their characters.
std::string cells_of_csv(const std::string& text) {
    std::string shown;
    const Workbook workbook = read_csv(text, "a.csv", "a");
    for (const Cell& cell : workbook.sheets.at(0).cells) {
        shown += (shown.empty() ? "" : " ") + a1_text(cell.address) + "=";
        shown += cell.value.kind == CellKind::number ? std::to_string(cell.value.number) + "[" + cell.value.text + "]"
                                                     : cell.value.text;
    }
    return shown;
}

std::string csv_refusal(const std::string& text) {
    try {
        static_cast<void>(read_csv(text, "a.csv", "a"));
    } catch (const gum::InputError& error) {
        return error.diagnostics().front().code + " " + gum::message(error.diagnostics().front());
    }
    return "accepted";
}

TEST(ReadCsv, KeepsTheDigitsOfNumbers) {
    EXPECT_EQ(cells_of_csv("u,0.0200\nn,+5\n"), "A1=u B1=0.020000[0.0200] A2=n B2=5.000000[+5]");
    EXPECT_EQ(cells_of_csv("1.5e-3,-.5, 7 "), "A1=0.001500[1.5e-3] B1=-0.500000[-.5] C1=7.000000[7]");
}

TEST(ReadCsv, LeavesTextAsItIs) {
    EXPECT_EQ(cells_of_csv("800.0.2,=A1+1,5%,inf,nan,0x10,1 000,+-5,++5,-+5"),
              "A1=800.0.2 B1==A1+1 C1=5% D1=inf E1=nan F1=0x10 G1=1 000 H1=+-5 I1=++5 J1=-+5");
}

TEST(ReadCsv, FindsTheSeparator) {
    EXPECT_EQ(cells_of_csv("a;b\n1;2\n"), "A1=a B1=b A2=1.000000[1] B2=2.000000[2]");
    EXPECT_EQ(cells_of_csv("a\tb;c\n1\t2\n"), "A1=a B1=b;c A2=1.000000[1] B2=2.000000[2]");
    EXPECT_EQ(cells_of_csv("Budget, May;\na;b\nc;d\n"), "A1=Budget, May A2=a B2=b A3=c B3=d");
    EXPECT_EQ(cells_of_csv("\"a;b\",c\n"), "A1=a;b B1=c") << "a separator in quotes is none";
    EXPECT_EQ(cells_of_csv("one"), "A1=one");
    EXPECT_EQ(cells_of_csv("a;b\n1,5;2\nMass, drift;3\nu = 0,5\nU = 1,0\n"),
              "A1=a B1=b A2=1.500000[1,5] B2=2.000000[2] A3=Mass, drift B3=3.000000[3] A4=u = 0,5 A5=U = 1,0")
        << "lines of words below a table are none of its rows";
    EXPECT_EQ(cells_of_csv("a; b\n1,5\n2,6\n"), "A1=a; b A2=1.000000[1] B2=5.000000[5] A3=2.000000[2] B3=6.000000[6]");
    EXPECT_EQ(cells_of_csv("a; b, 1\nc, 2\nd, 3\n"), "A1=a; b B1=1.000000[1] A2=c B2=2.000000[2] A3=d B3=3.000000[3]");
}

TEST(ReadCsv, HonoursALineThatStatesTheSeparator) {
    EXPECT_EQ(cells_of_csv("sep=;\na;b,c\n1,5;2\n"), "A2=a B2=b,c A3=1.500000[1,5] B3=2.000000[2]");
    EXPECT_EQ(cells_of_csv("sep=|\r\na|b;c\r\n"), "A2=a B2=b;c");
    EXPECT_EQ(cells_of_csv("sep=;x\n"), "A1=sep= B1=x") << "a row like any other";
}

TEST(ReadCsv, ReadsDecimalCommasBehindSemicolons) {
    EXPECT_EQ(cells_of_csv("a;1,50\nb;2\n"), "A1=a B1=1.500000[1,50] A2=b B2=2.000000[2]");
    EXPECT_EQ(cells_of_csv("a;1,5;1.5\n"), "A1=a B1=1.500000[1,5] C1=1.5")
        << "a point is no decimal mark beside commas";
    EXPECT_EQ(cells_of_csv("a;1.5\n"), "A1=a B1=1.500000[1.5]") << "no field of the file has a comma";
    EXPECT_EQ(cells_of_csv("1,5,6\n"), "A1=1.000000[1] B1=5.000000[5] C1=6.000000[6]");
}

TEST(ReadCsv, ReadsQuotesAndLineEnds) {
    EXPECT_EQ(cells_of_csv("\"a \"\"b\"\"\",\"c\nd\"\r\ne\rf"), "A1=a \"b\" B1=c\nd A2=e A3=f");
    EXPECT_EQ(cells_of_csv("\xEF\xBB\xBF,,x\n\n\ny"), "C1=x A4=y") << "blank fields are no cells";
    EXPECT_EQ(cells_of_csv(""), "");
}

TEST(ReadCsv, RefusesWhatItCannotRead) {
    EXPECT_THAT(csv_refusal("a,\"b\nc"), testing::StartsWith("GC-WORKBOOK-0017 a.csv B1 — a quote that is not closed"));
    EXPECT_THAT(csv_refusal("\"a\"b,c"), testing::StartsWith("GC-WORKBOOK-0017 a.csv A1 — something behind the quote"));
    EXPECT_THAT(csv_refusal("\xB5m,1"),
                testing::StartsWith("GC-WORKBOOK-0016 a.csv — bytes that are no text in UTF-8"));
    EXPECT_THAT(csv_refusal(std::string("a\0b", 3)), testing::StartsWith("GC-WORKBOOK-0016"));
    EXPECT_THAT(csv_refusal(std::string(20'000'001, 'a')),
                testing::StartsWith("GC-WORKBOOK-0001 a.csv — 20000001 bytes"));
    EXPECT_THAT(csv_refusal(std::string(16'384, ',') + "x"), testing::StartsWith("GC-WORKBOOK-0012"));
}

}  // namespace
}  // namespace gumcert::workbook
