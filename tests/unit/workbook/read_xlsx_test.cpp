#include "workbook/read_xlsx.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/support/xlsx_file.h"

namespace gumcert::workbook {
namespace {

using test::XlsxFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

Workbook read(const XlsxFile& file) {
    return read_xlsx(file.bytes(), "a.xlsx");
}

XlsxFile with_rows(const std::string& rows) {
    XlsxFile file;
    file.sheets = {{"Sheet1", rows}};
    return file;
}

std::string refusal_of(const std::string& bytes) {
    try {
        static_cast<void>(read_xlsx(bytes, "a.xlsx"));
    } catch (const gum::InputError& error) {
        return error.diagnostics().front().code + " " + gum::message(error.diagnostics().front());
    }
    return "accepted";
}

const Cell& cell_at(const Workbook& workbook, const std::string& address) {
    const Cell* const cell = find_cell(workbook.sheets.at(0), *read_a1(address));
    EXPECT_NE(cell, nullptr) << address;
    static const Cell k_none;
    return cell == nullptr ? k_none : *cell;
}

TEST(ReadXlsx, ReadsEachKindOfCell) {
    XlsxFile file = with_rows(
        R"(<row r="2"><c r="A2"><v>1.50</v></c><c r="B2" t="s"><v>1</v></c><c r="C2" t="b"><v>1</v></c>)"
        R"(<c r="D2" t="e"><v>#DIV/0!</v></c><c r="E2" t="inlineStr"><is><r><t>in</t></r><r><t>line</t></r></is></c>)"
        R"(<c r="F2" s="1"/><c r="G2" t="str"><f>A2&amp;"x"</f><v>1.5x</v></c></row>)"
        R"(<row r="4"><c r="A4"><f>A2*2</f><v>3</v></c><c r="B4"><f>A2*3</f></c></row>)");
    file.shared_strings =
        "<si><t>no</t></si><si><t xml:space=\"preserve\"> µm</t><rPh sb=\"0\" eb=\"1\"><t>x</t></rPh></si>";
    const Workbook workbook = read(file);
    EXPECT_EQ(cell_at(workbook, "A2").value, (CellValue{.kind = CellKind::number, .number = 1.5, .text = "1.50"}));
    EXPECT_EQ(cell_at(workbook, "B2").value, (CellValue{.kind = CellKind::text, .text = " µm"}));
    EXPECT_EQ(cell_at(workbook, "C2").value, (CellValue{.kind = CellKind::boolean, .number = 1.0}));
    EXPECT_EQ(cell_at(workbook, "D2").value.error, CellError::division_by_zero);
    EXPECT_EQ(cell_at(workbook, "E2").value.text, "inline");
    EXPECT_EQ(cell_at(workbook, "G2").formula, "A2&\"x\"");
    EXPECT_EQ(cell_at(workbook, "G2").value.text, "1.5x");
    EXPECT_EQ(cell_at(workbook, "A4").value.number, 3.0);
    EXPECT_EQ(cell_at(workbook, "A4").formula_kind, FormulaKind::plain);
    EXPECT_EQ(cell_at(workbook, "B4").value.kind, CellKind::blank) << "nothing was stored";
    EXPECT_EQ(find_cell(workbook.sheets[0], {2, 6}), nullptr) << "a format alone is no cell";
    EXPECT_EQ(workbook.sheets[0].cells.size(), 8U);
}

TEST(ReadXlsx, PutsCellsWithoutAddressBehindEachOther) {
    const Workbook workbook = read(with_rows(
        "<row><c><v>1</v></c><c><v>2</v></c></row><row r=\"5\"><c r=\"C5\"><v>3</v></c><c><v>4</v></c></row>"));
    EXPECT_EQ(cell_at(workbook, "B1").value.number, 2.0);
    EXPECT_EQ(cell_at(workbook, "D5").value.number, 4.0);
}

TEST(ReadXlsx, MovesSharedFormulasToEachCell) {
    const Workbook workbook = read(with_rows(
        R"(<row r="1"><c r="B1"><f t="shared" ref="B1:B3" si="7">SUM(A$1:A1)*$C$1 + Old!A1+LOG10(A1)</f><v>0</v></c></row>)"
        R"(<row r="2"><c r="B2"><f t="shared" si="7"/><v>0</v></c></row><row r="3"><c r="D3"><f t="shared" si="7"/></c></row>)"));
    EXPECT_EQ(cell_at(workbook, "B1").formula, "SUM(A$1:A1)*$C$1 + Old!A1+LOG10(A1)");
    EXPECT_EQ(cell_at(workbook, "B2").formula, "SUM(A$1:A2)*$C$1 + Old!A2+LOG10(A2)");
    EXPECT_EQ(cell_at(workbook, "D3").formula, "SUM(C$1:C3)*$C$1 + Old!C3+LOG10(C3)");
}

TEST(ReadXlsx, KeepsArrayFormulasAndDataTables) {
    const Workbook workbook = read(with_rows(
        R"(<row r="1"><c r="B1"><f t="array" ref="B1:B2">A1:A2*2</f><v>2</v></c><c r="C1"><f t="array" ref="C1">SUM(A1:A2^2)</f></c>)"
        R"(<c r="D1"><f t="dataTable" ref="D1:D2" r1="A1" r2="A2"/><v>1</v></c></row>)"));
    EXPECT_EQ(cell_at(workbook, "B1").formula_kind, FormulaKind::array);
    EXPECT_EQ(cell_at(workbook, "C1").formula, "SUM(A1:A2^2)");
    EXPECT_EQ(cell_at(workbook, "D1").formula_kind, FormulaKind::data_table);
    EXPECT_THAT(workbook.sheets[0].array_ranges, ElementsAre(CellRange{{1, 2}, {2, 2}}));
}

TEST(ReadXlsx, ReadsFormatsOfNumbers) {
    XlsxFile file = with_rows(
        R"(<row r="1"><c r="A1" s="0"><v>45000</v></c><c r="B1" s="1"><v>45000</v></c><c r="C1" s="2"><v>0.1</v></c></row>)");
    file.styles =
        R"(<numFmts count="1"><numFmt numFmtId="164" formatCode="0.000&quot; µm&quot;"/></numFmts>)"
        R"(<cellStyleXfs><xf numFmtId="9"/></cellStyleXfs><cellXfs><xf numFmtId="0"/><xf numFmtId="14"/><xf numFmtId="164"/></cellXfs>)";
    const Workbook workbook = read(file);
    EXPECT_EQ(workbook.number_formats.at(cell_at(workbook, "A1").number_format), "General");
    EXPECT_EQ(workbook.number_formats.at(cell_at(workbook, "B1").number_format), "mm-dd-yy");
    EXPECT_EQ(workbook.number_formats.at(cell_at(workbook, "C1").number_format), "0.000\" µm\"");
    EXPECT_EQ(cell_at(workbook, "B1").value.number, 45000.0) << "a date stays a number";
}

TEST(ReadXlsx, ReadsWhatTheWorkbookSays) {
    XlsxFile file;
    file.sheets = {{"Budget", ""}, {"Old", ""}};
    file.sheet_attributes = "state=\"hidden\"";
    file.behind_sheets =
        "<definedNames><definedName name=\"u_ref\">Budget!$B$2</definedName>"
        "<definedName name=\"k\" localSheetId=\"1\" hidden=\"1\">2</definedName></definedNames>"
        "<workbookProtection lockStructure=\"1\"/><externalReferences><externalReference "
        "r:id=\"rIdX\"/></externalReferences>"
        "<calcPr fullPrecision=\"0\" iterate=\"1\"/>";
    file.behind_cells = "<sheetProtection sheet=\"1\" objects=\"1\"/>";
    file.more_relationships = test::relationship("rIdX", "externalLink", "externalLinks/externalLink1.xml");
    file.more_parts = {
        {"xl/externalLinks/externalLink1.xml", test::xml_part("externalLink", "<externalBook r:id=\"rId1\"/>")},
        {"xl/externalLinks/_rels/externalLink1.xml.rels",
         test::relationships_part(test::relationship("rId1", "externalLinkPath", "file:///Z:/certificates.xlsx",
                                                     " TargetMode=\"External\""))},
        {"xl/vbaProject.bin", "x"},
        {"xl/charts/chart1.xml", "x"}};
    const Workbook workbook = read(file);
    EXPECT_EQ(workbook.sheets[0].state, SheetState::hidden);
    EXPECT_TRUE(workbook.sheets[0].is_protected);
    ASSERT_EQ(workbook.defined_names.size(), 2U);
    EXPECT_EQ(workbook.defined_names[0].formula, "Budget!$B$2");
    EXPECT_FALSE(workbook.defined_names[0].sheet);
    EXPECT_EQ(workbook.defined_names[1].sheet, 1U);
    EXPECT_TRUE(workbook.defined_names[1].is_hidden);
    ASSERT_EQ(workbook.external_links.size(), 1U);
    EXPECT_EQ(workbook.external_links[0].target, "file:///Z:/certificates.xlsx");
    EXPECT_EQ(workbook.external_links[0].kind, "workbook");
    EXPECT_TRUE(workbook.metadata.structure_is_protected);
    EXPECT_TRUE(workbook.metadata.precision_as_displayed);
    EXPECT_TRUE(workbook.metadata.iterates);
    EXPECT_FALSE(workbook.metadata.dates_from_1904);
    EXPECT_THAT(workbook.metadata.not_examined, ElementsAre("macros", "charts"));
}

TEST(ReadXlsx, ReadsHiddenRowsAndColumns) {
    XlsxFile file = with_rows("<row r=\"2\" hidden=\"1\"/><row r=\"3\" hidden=\"1\"/><row r=\"7\" hidden=\"1\"/>");
    file.behind_cells = "<cols><col min=\"2\" max=\"4\" hidden=\"1\"/><col min=\"6\" max=\"6\" width=\"8\"/></cols>";
    const Workbook workbook = read(file);
    EXPECT_THAT(workbook.sheets[0].hidden_rows, ElementsAre(Span{2, 3}, Span{7, 7}));
    EXPECT_THAT(workbook.sheets[0].hidden_columns, ElementsAre(Span{2, 4}));
}

TEST(ReadXlsx, ReadsWhoStoredTheFile) {
    auto parts = XlsxFile().parts();
    parts[0].second = test::relationships_part(
        test::relationship("rId1", "officeDocument", "/xl/workbook.xml") +
        test::relationship("rId2", "extended-properties", "docProps/app.xml") +
        "<Relationship Id=\"rId3\" "
        "Type=\"http://schemas.openxmlformats.org/package/2006/relationships/metadata/core-properties\" "
        "Target=\"docProps/core.xml\"/>");
    parts.emplace_back(
        "docProps/app.xml",
        "<Properties><Application>Microsoft Excel</Application><AppVersion>16.0300</AppVersion></Properties>");
    parts.emplace_back("docProps/core.xml",
                       "<p:coreProperties xmlns:p=\"a\" xmlns:d=\"b\"><d:created>2024-01-24T08:00:00Z</d:created>"
                       "<d:modified>2024-02-01T08:00:00Z</d:modified></p:coreProperties>");
    const Workbook workbook = read_xlsx(test::archive_of(parts), "a.xlsx");
    EXPECT_EQ(workbook.metadata.application, "Microsoft Excel");
    EXPECT_EQ(workbook.metadata.application_version, "16.0300");
    EXPECT_EQ(workbook.metadata.created, "2024-01-24T08:00:00Z");
    EXPECT_EQ(workbook.metadata.modified, "2024-02-01T08:00:00Z");
}

TEST(ReadXlsx, NamesChartSheetsAsNotLookedAt) {
    XlsxFile file;
    auto parts = file.parts();
    for (auto& [name, bytes] : parts) {
        if (name == "xl/_rels/workbook.xml.rels") {
            bytes = test::relationships_part(test::relationship("rId1", "chartsheet", "chartsheets/sheet1.xml"));
        }
    }
    EXPECT_THAT(read_xlsx(test::archive_of(parts), "a.xlsx").metadata.not_examined,
                ElementsAre("the sheet \"Sheet1\", a chartsheet"));
}

// Files that are no workbook, or that somebody made to do harm.

TEST(HostileXlsx, OtherFilesAreToldApart) {
    EXPECT_THAT(refusal_of(""), StartsWith("GC-WORKBOOK-0002 a.xlsx — no ZIP archive"));
    EXPECT_THAT(refusal_of("a,b\n1,2\n"), StartsWith("GC-WORKBOOK-0002"));
    EXPECT_THAT(refusal_of("\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"),
                AllOf(StartsWith("GC-WORKBOOK-0003 a.xlsx — a workbook in the old binary format (.xls)"),
                      HasSubstr("store it as .xlsx")));
    EXPECT_THAT(refusal_of("PK\x03\x04 and nothing more"),
                StartsWith("GC-WORKBOOK-0004 a.xlsx — the archive cannot be opened"));
    EXPECT_THAT(refusal_of(test::archive_of({{"mimetype", "x"}})),
                StartsWith("GC-WORKBOOK-0002 a.xlsx — an archive without a workbook"));
    EXPECT_THAT(refusal_of(test::archive_of({{"_rels/.rels", test::relationships_part(test::relationship(
                                                                 "rId1", "officeDocument", "xl/workbook.bin"))}})),
                StartsWith("GC-WORKBOOK-0002 a.xlsx — a binary workbook (.xlsb)"));
    EXPECT_THAT(refusal_of(std::string(20'000'001, 'P')), StartsWith("GC-WORKBOOK-0001 a.xlsx — 20000001 bytes"));
}

TEST(HostileXlsx, DamagedArchivesAreRefused) {
    const std::string bytes = XlsxFile().bytes();
    EXPECT_EQ(refusal_of(bytes), "accepted");
    for (std::size_t size = 2; size < bytes.size(); size += 97) {
        EXPECT_THAT(refusal_of(bytes.substr(0, size)), StartsWith("GC-WORKBOOK-0004")) << size;
    }
    std::string spoiled = with_rows(std::string(4000, ' ')).bytes();
    spoiled[spoiled.find("xl/workbook.xml") + 60] ^= 0x55;
    EXPECT_THAT(refusal_of(spoiled), StartsWith("GC-WORKBOOK-00"));
}

TEST(HostileXlsx, ABombIsNotUnpacked) {
    XlsxFile file;
    file.sheets = {{"Sheet1", std::string(100'000'000, ' ')}, {"Sheet2", ""}};
    auto parts = file.parts();
    for (auto& [name, part] : parts) {
        if (name == "xl/_rels/workbook.xml.rels") {
            part = test::relationships_part(test::relationship("rId1", "worksheet", "worksheets/sheet1.xml") +
                                            test::relationship("rId2", "worksheet", "worksheets/sheet1.xml"));
        }
    }
    const std::string bytes = test::archive_of(parts);
    ASSERT_LT(bytes.size(), 1'000'000U);
    EXPECT_THAT(refusal_of(bytes),
                StartsWith("GC-WORKBOOK-0005 a.xlsx#xl/worksheets/sheet1.xml — parts of more than 200 MB"));
}

TEST(HostileXlsx, PartsHaveNamesOfTheirOwnAndAreNotTooMany) {
    auto parts = XlsxFile().parts();
    parts.emplace_back("XL/Workbook.xml", "x");
    EXPECT_THAT(refusal_of(test::archive_of(parts)), StartsWith("GC-WORKBOOK-0004 a.xlsx — two parts of the name"));
    auto many = XlsxFile().parts();
    for (int i = 0; i < 10'001; ++i) {
        many.emplace_back("p" + std::to_string(i), "");
    }
    EXPECT_THAT(refusal_of(test::archive_of(many)), StartsWith("GC-WORKBOOK-0006"));
}

TEST(HostileXlsx, PathsStayInsideTheFile) {
    const auto with_target = [](const std::string& target) {
        auto parts = XlsxFile().parts();
        for (auto& [name, bytes] : parts) {
            if (name == "xl/_rels/workbook.xml.rels") {
                bytes = test::relationships_part(target);
            }
        }
        return refusal_of(test::archive_of(parts));
    };
    EXPECT_EQ(with_target(test::relationship("rId1", "worksheet", "./../xl/worksheets/sheet1.xml")), "accepted");
    EXPECT_THAT(with_target(test::relationship("rId1", "worksheet", "../../../etc/passwd")),
                StartsWith("GC-WORKBOOK-0010 a.xlsx#xl/workbook.xml — a part outside of the file"));
    EXPECT_THAT(with_target(test::relationship("rId1", "worksheet", "file:///etc/passwd", " TargetMode=\"External\"")),
                StartsWith("GC-WORKBOOK-0010"));
    EXPECT_THAT(with_target(test::relationship("rId1", "worksheet", "/etc/passwd")),
                StartsWith("GC-WORKBOOK-0010 a.xlsx — the part \"etc/passwd\" is missing"));
    EXPECT_THAT(with_target(""),
                StartsWith("GC-WORKBOOK-0010 a.xlsx#xl/workbook.xml — no part of the sheet \"Sheet1\""));
}

TEST(HostileXlsx, XmlCannotGrowOrReadFiles) {
    const auto with_sheet = [](const std::string& xml) {
        auto parts = XlsxFile().parts();
        for (auto& [name, bytes] : parts) {
            if (name == "xl/worksheets/sheet1.xml") {
                bytes = xml;
            }
        }
        return refusal_of(test::archive_of(parts));
    };
    EXPECT_THAT(with_sheet("<!DOCTYPE a [<!ENTITY b SYSTEM \"file:///etc/passwd\">]><worksheet>&b;</worksheet>"),
                StartsWith("GC-WORKBOOK-0008 a.xlsx#xl/worksheets/sheet1.xml:1:"));
    EXPECT_THAT(with_sheet("<worksheet>&b;</worksheet>"), StartsWith("GC-WORKBOOK-0007"));
    EXPECT_THAT(with_sheet("<worksheet><a></worksheet>"), StartsWith("GC-WORKBOOK-0007"));
    EXPECT_THAT(with_sheet(""), StartsWith("GC-WORKBOOK-0007 a.xlsx#xl/worksheets/sheet1.xml — an empty part"));
    EXPECT_THAT(with_sheet(std::string("<\0w/>", 5)), StartsWith("GC-WORKBOOK-0007"));
    EXPECT_THAT(with_sheet("<?xml version=\"1.0\" encoding=\"UTF-16\"?><worksheet/>"), StartsWith("accepted"))
        << "the declared encoding is not believed";
    std::string deep;
    for (int i = 0; i < 100'000; ++i) {
        deep += "<a>";
    }
    EXPECT_THAT(with_sheet(deep), StartsWith("GC-WORKBOOK-0009 a.xlsx#xl/worksheets/sheet1.xml:1:"));
    std::string crowded = "<worksheet";
    for (int i = 0; i < 65; ++i) {
        crowded += " a" + std::to_string(i) + "=\"1\"";
    }
    EXPECT_THAT(with_sheet(crowded + "/>"),
                StartsWith("GC-WORKBOOK-0009 a.xlsx#xl/worksheets/sheet1.xml — a tag of more than 64"));
}

TEST(HostileXlsx, CellsAreCheckedOneByOne) {
    const auto with_cells = [](const std::string& cells) {
        return refusal_of(with_rows("<row r=\"1\">" + cells + "</row>").bytes());
    };
    EXPECT_THAT(with_cells("<c r=\"A1\"><v>1</v></c><c r=\"A1\"><v>2</v></c>"),
                StartsWith("GC-WORKBOOK-0011 a.xlsx#xl/worksheets/sheet1.xml Sheet1!A1 — a cell that occurs twice"));
    for (const char* const bad :
         {"<c r=\"A2\"><v>1</v></c>", "<c r=\"XFE1\"><v>1</v></c>", "<c r=\"-1\"><v>1</v></c>",
          "<c r=\"A1\"><v>1e999</v></c>", "<c r=\"A1\"><v>nan</v></c>", "<c r=\"A1\"><v>0x5</v></c>",
          "<c r=\"A1\" t=\"s\"><v>0</v></c>", "<c r=\"A1\" t=\"s\"><v>-1</v></c>", "<c r=\"A1\" t=\"b\"><v>2</v></c>",
          "<c r=\"A1\" t=\"e\"><v>x</v></c>", "<c r=\"A1\"><f t=\"shared\" si=\"1\"/></c>",
          "<c r=\"A1\"><f t=\"shared\"/></c>", "<c r=\"A1\"><f t=\"array\" ref=\"A1:XFE2\">1</f></c>"}) {
        EXPECT_THAT(with_cells(bad), StartsWith("GC-WORKBOOK-0011")) << bad;
    }
    EXPECT_THAT(refusal_of(with_rows("<row r=\"4294967297\"/>").bytes()), StartsWith("GC-WORKBOOK-0011"));
    EXPECT_THAT(refusal_of(with_rows("<row r=\"1048577\"/>").bytes()), StartsWith("GC-WORKBOOK-0011"));
    EXPECT_THAT(with_cells("<c r=\"A1\"><f>" + std::string(8193, '1') + "</f></c>"), StartsWith("GC-WORKBOOK-0013"));
}

TEST(HostileXlsx, StatedDimensionsAreNotBelieved) {
    XlsxFile file = with_rows("<row r=\"1048576\"><c r=\"XFD1048576\"><v>1</v></c></row>");
    file.behind_cells = "<dimension ref=\"A1:XFD1048576\"/>";
    EXPECT_EQ(read(file).sheets[0].cells.size(), 1U);
}

TEST(HostileXlsx, NamesOccurOnce) {
    XlsxFile sheets;
    sheets.sheets.assign(1001, {"Same", ""});
    EXPECT_THAT(refusal_of(sheets.bytes()),
                StartsWith("GC-WORKBOOK-0011 a.xlsx#xl/workbook.xml — a second sheet of the name \"Same\""));
    std::string same, different;
    for (int i = 0; i < 100'001; ++i) {
        same += "<definedName name=\"u\">1</definedName>";
        different += "<definedName name=\"u" + std::to_string(i) + "\">1</definedName>";
    }
    XlsxFile names;
    names.behind_sheets = "<definedNames>" + same + "</definedNames>";
    EXPECT_THAT(refusal_of(names.bytes()),
                StartsWith("GC-WORKBOOK-0011 a.xlsx#xl/workbook.xml — two definitions of the name \"u\""));
    names.behind_sheets = "<definedNames>" + different + "</definedNames>";
    EXPECT_THAT(refusal_of(names.bytes()),
                StartsWith("GC-WORKBOOK-0012 a.xlsx#xl/workbook.xml — more than 100000 defined names"));
}

TEST(HostileXlsx, TextsThatManyCellsShareAreCounted) {
    std::string cells;
    for (int row = 1; row <= 7000; ++row) {
        cells +=
            "<row r=\"" + std::to_string(row) + "\"><c r=\"A" + std::to_string(row) + "\" t=\"s\"><v>0</v></c></row>";
    }
    XlsxFile file = with_rows(cells);
    file.shared_strings = "<si><t>" + std::string(30'000, 'x') + "</t></si>";
    EXPECT_THAT(refusal_of(file.bytes()), StartsWith("GC-WORKBOOK-0018"));
    std::string formulas = "<row r=\"1\"><c r=\"A1\"><f t=\"shared\" si=\"0\" ref=\"A1:A30000\">" +
                           std::string(8000, '1') + "</f></c></row>";
    for (int row = 2; row <= 30'000; ++row) {
        formulas += "<row r=\"" + std::to_string(row) + "\"><c r=\"A" + std::to_string(row) +
                    "\"><f t=\"shared\" si=\"0\"/></c></row>";
    }
    EXPECT_THAT(refusal_of(with_rows(formulas).bytes()), StartsWith("GC-WORKBOOK-0018"));
}

}  // namespace
}  // namespace gumcert::workbook
