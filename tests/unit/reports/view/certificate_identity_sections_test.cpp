#include "reports/view/certificate_identity_sections.h"

#include "reports/forms/asset_files.h"
#include "reports/view/certificate_view.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

json english() {
    return json::parse(read_asset(assets().templates / "wording" / "en.json"));
}

json page_of(const EvaluationRecord& record) {
    const json texts = english();
    const Wording words(texts);
    CertificateBuilder builder(words);
    return identity_page(builder, words, record);
}

/// "label=value" of all definitions of a section of the page.
std::vector<std::string> lines_of_section(const json& page, const std::string& section) {
    std::vector<std::string> rows;
    for (const json& s : page.at("sections")) {
        for (const json& block : s.at("blocks")) {
            for (const json& definitions : block.at("definitions")) {
                for (const json& row : definitions.at("rows")) {
                    if (s.at("id") == section) {
                        rows.push_back(row.at("label").get<std::string>() + "=" + row.at("value").get<std::string>());
                    }
                }
            }
        }
    }
    return rows;
}

std::string texts_of(const json& lines) {
    std::string text;
    for (const json& line : lines) {
        text += line.at("text").get<std::string>() + "\n";
    }
    return text;
}

TEST(CertificateIdentity, SaysWhoWhatWhenAndWhere) {
    const json page = page_of(test::certified_rotary_record());
    EXPECT_EQ(page.at("laboratory"), "Example Calibration Laboratory");
    EXPECT_EQ(page.at("number"), "EX-2026-0042");
    EXPECT_THAT(texts_of(page.at("address")), HasSubstr("Example Street 1, 12345 Example Town, DE"));
    EXPECT_THAT(lines_of_section(page, "item"),
                ElementsAre("Object=Item under calibration", "Manufacturer=Example Works", "Type=EW 50",
                            "Serial number=SN-1001", "Identification=INV-55 †", "Condition on receipt=No damage seen",
                            "Owner=Example Customer"));
    EXPECT_THAT(lines_of_section(page, "customer"),
                ElementsAre("Customer=Example Customer", "Address=Sample Road 2, 54321 Sample Town, AT",
                            "Contact=Quality department, quality@example.com", "Order number=PO-2026-77"));
    EXPECT_THAT(lines_of_section(page, "dates"),
                ElementsAre("Date of receipt=2026-11-16", "Date of calibration=2026-11-18 – 2026-11-19",
                            "Date of issue=2026-11-21",
                            "Place of calibration=at the laboratory, Measuring room 2, Example Street 1, "
                            "12345 Example Town, DE"));
    EXPECT_THAT(lines_of_section(page, "authorisation"),
                ElementsAre("Authorised by=Head of laboratory", "Function=Head of laboratory",
                            "Date of authorisation=2026-11-20"));
    EXPECT_THAT(texts_of(page.at("foot")), HasSubstr("The results relate only to the item described"));
    EXPECT_THAT(texts_of(page.at("foot")), HasSubstr("only in full unless the laboratory agrees in writing"));
}

TEST(CertificateIdentity, PrintsAnAddressByItsParts) {
    EvaluationRecord record = test::certified_budget_record();
    certificate::Address& address = record.certificate->data.laboratory.address;
    const std::string as_lines = page_of(record).dump();
    address = {.country = address.country};
    address.street = "Example Street";
    address.street_no = "1";
    address.postcode = "12345";
    address.city = "Example Town";
    EXPECT_EQ(page_of(record).dump(), as_lines) << "the same address in the other form, everywhere";
}

TEST(CertificateIdentity, SaysWhoMayReproduceItWhereTheProfileWantsIt) {
    EvaluationRecord record = test::certified_budget_record();
    ASSERT_TRUE(record.certificate->profile.reproduction_sentence_mandatory);
    EXPECT_THAT(texts_of(page_of(record).at("foot")), HasSubstr("reproduced only in full"));
    record.certificate->profile.reproduction_sentence_mandatory = false;
    EXPECT_THAT(texts_of(page_of(record).at("foot")), Not(HasSubstr("reproduced only in full")));
    EXPECT_THAT(texts_of(page_of(record).at("foot")), HasSubstr("relate only to the item"));
}

TEST(CertificateIdentity, HasTheLogoWhereThereIsOne) {
    EvaluationRecord record = test::certified_budget_record();
    EXPECT_THAT(page_of(record).at("logo"), IsEmpty());
    certificate::Laboratory& laboratory = record.certificate->data.laboratory;
    laboratory.logo = "a/logo.svg";
    laboratory.logo_media_type = "image/svg+xml";
    laboratory.logo_base64 = "PHN2Zy8+";
    record.certificate->symbol = false;
    const json logo = page_of(record).at("logo");
    ASSERT_EQ(logo.size(), 1U);
    EXPECT_EQ(logo[0].at("file"), "laboratory-logo.svg") << "no name of a picture beside a template";
    EXPECT_EQ(logo[0].at("data_uri"), "data:image/svg+xml;base64,PHN2Zy8+");
    EXPECT_EQ(logo[0].at("alt"), "Logo of Example Calibration Laboratory");
    laboratory.logo_media_type = "image/jpeg";
    EXPECT_EQ(page_of(record).at("logo")[0].at("file"), "laboratory-logo.jpg");
}

TEST(CertificateIdentity, SummarisesTheVerdictsWithTheirRule) {
    EvaluationRecord record = test::certified_rotary_record();
    EXPECT_THAT(
        lines_of_section(page_of(record), "summary").at(1),
        HasSubstr("Conformity=Drawing 1234, B, 3.2; EAA: pass (36 of 36 values); decision rule DR-03, guarded"));
    for (certificate::CertifiedColumn& column : record.certificate->tables[0].columns) {
        if (column.result == "EAA") {
            column.values[4].verdict->verdict = "fail";
        }
    }
    EXPECT_THAT(lines_of_section(page_of(record), "summary").at(1),
                HasSubstr("EAA: pass (35 of 36 values), fail (1 of 36 values); decision rule"));
    record.certificate->data.specifications.clear();
    EXPECT_THAT(lines_of_section(page_of(record), "summary"),
                ElementsAre("Results=see the following pages", "Conformity=No statement of conformity was requested."));
}

// That an item failed before its adjustment says nothing of how it leaves the laboratory.
TEST(CertificateIdentity, SummarisesVerdictsBeforeAndAfterAnAdjustmentApart) {
    EvaluationRecord record = test::certified_rotary_record();
    certificate::CertifiedTable* of_axial = nullptr;
    for (certificate::CertifiedTable& table : record.certificate->tables) {
        for (certificate::CertifiedColumn& column : table.columns) {
            of_axial = column.result == "EAA" ? &table : of_axial;
        }
    }
    ASSERT_NE(of_axial, nullptr);
    const auto axial = std::ranges::find(of_axial->columns, "EAA", &certificate::CertifiedColumn::result);
    certificate::CertifiedColumn before = *axial;
    before.result = "EAF";
    before.values[4].verdict->verdict = "fail";
    of_axial->columns.push_back(before);
    certificate::TableLayout& layout = of_axial->layout.emplace();
    layout.shown = {{.show = "value", .of = "EAA", .heading = {}, .role = "error", .stage = "as_left"},
                    {.show = "value", .of = "EAF", .heading = {}, .role = "error", .stage = "as_found"}};
    const std::vector<std::string> lines = lines_of_section(page_of(record), "summary");
    ASSERT_GE(lines.size(), 3U);
    EXPECT_THAT(lines[1], HasSubstr("As found, EAF: pass (35 of 36 values), fail (1 of 36 values); decision rule"));
    EXPECT_THAT(lines[2], HasSubstr("As left, EAA: pass (36 of 36 values); decision rule"));
    layout.shown[1].stage = "as_left";
    EXPECT_THAT(lines_of_section(page_of(record), "summary").at(1), HasSubstr("pass (71 of 72 values), fail"))
        << "of one stage in one line";
}

TEST(CertificateIdentity, StatesTheOneResultInALine) {
    EvaluationRecord record = test::certified_budget_record();
    certificate::Certificate& c = *record.certificate;
    ASSERT_EQ(c.tables.size(), 1U);
    ASSERT_EQ(c.tables[0].columns.size(), 1U);
    c.tables[0].columns[0].values.resize(1);
    certificate::CertifiedValue& value = c.tables[0].columns[0].values[0];
    value = test::certified_value(-1.0, 0.1, 2.16, {}, {.value = "-1.00", .U = "0.22", .unit = "nm"}, "L1");
    c.tables[0].columns[0].printed_unit = "nm";
    value.printed_k = "2.16";
    const auto line = [&] { return lines_of_section(page_of(record), "summary").at(0); };
    EXPECT_EQ(line(), "Results=l = −1.00\u00A0nm ± 0.22\u00A0nm, k = 2.16");
    c.profile.plus_minus_in_tables = false;
    EXPECT_EQ(line(), "Results=l = −1.00\u00A0nm, U = 0.22\u00A0nm, k = 2.16");
    value.interval = {-1.2, -0.7};
    value.printed_low = "-1.20";
    value.printed_high = "-0.70";
    EXPECT_THAT(line(), HasSubstr("coverage interval from −1.20\u00A0nm to −0.70\u00A0nm"));
    value.scope_entry = "";
    EXPECT_EQ(line(), "Results=see the following pages") << "the mark * is explained there";
}

TEST(CertificateIdentity, NamesTheCertificateThatItAmends) {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.amendment =
        certificate::Amendment{.kind = "amended", .number = "EX-2026-0041", .sha256 = "", .reason = {}, .changes = {}};
    EXPECT_THAT(lines_of_section(page_of(record), "summary").back(),
                HasSubstr("Amendment=Amendment to calibration certificate EX-2026-0041."));
}

TEST(CertificateIdentity, ClaimsTheAccreditationOnlyTogetherWithTheSymbol) {
    EvaluationRecord record = test::certified_rotary_record();
    json page = page_of(record);
    EXPECT_THAT(texts_of(page.at("accreditation")), HasSubstr("Accreditation number: EX-0000"));
    ASSERT_EQ(page.at("symbol").size(), 1U);
    EXPECT_EQ(page.at("symbol")[0].at("file"), "symbol.png");
    EXPECT_THAT(page.at("symbol")[0].at("data_uri").get<std::string>(),
                ::testing::StartsWith("data:image/png;base64,"));
    EXPECT_THAT(texts_of(page.at("foot")), HasSubstr("A sentence of the accreditation body."));

    record.certificate->symbol = false;
    page = page_of(record);
    EXPECT_THAT(page.dump(), Not(HasSubstr("EX-0000")));
    EXPECT_THAT(page.at("symbol"), IsEmpty());
    EXPECT_THAT(texts_of(page.at("accreditation")), HasSubstr("The accreditation is not claimed for this document."));
    EXPECT_THAT(texts_of(page.at("foot")), Not(HasSubstr("A sentence of the accreditation body.")));

    record.certificate->data.status = "not_accredited";
    EXPECT_THAT(texts_of(page_of(record).at("accreditation")),
                HasSubstr("This certificate is issued without reference to an accreditation."));
}

TEST(CertificateIdentity, ShowsWhatIsMissingAsADash) {
    EvaluationRecord record = test::certified_rotary_record();
    record.certificate->data.item = {};
    record.certificate->data.persons.authorised_by.reset();
    const json page = page_of(record);
    EXPECT_THAT(lines_of_section(page, "item"),
                ElementsAre("Object=–", "Manufacturer=–", "Type=–", "Serial number=–", "Condition on receipt=–"));
    EXPECT_EQ(lines_of_section(page, "authorisation").front(), "Authorised by=–");
    EXPECT_THAT(page.dump(), Not(HasSubstr("†"))) << "the legend of a mark that does not occur";
    // A dagger in a text of the laboratory is no mark of the customer's.
    record.certificate->data.item.description = "Meter with a † on its case";
    record.certificate->data.item.stated_by_customer.clear();
    EXPECT_THAT(page_of(record).dump(), Not(HasSubstr("† Stated by the customer")));
}

TEST(CertificateIdentity, MarksDraftsAndSpecimens) {
    const json texts = english();
    const Wording words(texts);
    EvaluationRecord record = test::certified_rotary_record();
    EXPECT_THAT(document_marks(words, record, ""), IsEmpty());
    EXPECT_EQ(running_texts(words, record).at("header_right"), "Calibration certificate EX-2026-0042");
    record.certificate->data.number = std::string(200, '7');
    EXPECT_THAT(running_texts(words, record).at("header_right").get<std::string>(), HasSubstr(std::string(200, '7')))
        << "the number is never cut";
    record = test::drafted(record);
    EXPECT_EQ(document_marks(words, record, "").at(0).at("text"), "DRAFT — not issued");
    EXPECT_THAT(running_texts(words, record).at("header_right").get<std::string>(), HasSubstr("DRAFT"));
    record.certificate->data.status = "specimen";
    EXPECT_EQ(document_marks(words, record, "").size(), 2U);
    record.certificate.reset();
    EXPECT_THAT(texts_of(document_marks(words, record, "")), HasSubstr("SPECIMEN"));
    EXPECT_THAT(running_texts(words, record).at("header_right").get<std::string>(), HasSubstr("SPECIMEN"));
}

TEST(CertificateIdentity, OneDayIsOneDate) {
    EXPECT_EQ(from_to("2026-11-18", "2026-11-18"), "2026-11-18");
    EXPECT_EQ(from_to("2026-11-18", ""), "2026-11-18");
    EXPECT_EQ(from_to("", "2026-11-19"), "2026-11-19");
    EXPECT_EQ(from_to("2026-11-18", "2026-11-19"), "2026-11-18 – 2026-11-19");
}

TEST(CertificateIdentity, HasNumberAndPageOnEveryPageOfThePdf) {
    SKIP_WITHOUT_PDF();
    RenderAssets a = assets();
    a.languages = {"en"};
    const std::string text = pdf_text(render_pdf(test::certified_budget_record(), a));
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing";
    }
    const std::size_t of = text.find("page 1 of ") + std::string("page 1 of ").size();
    const std::string count = text.substr(of, text.find(' ', of) - of);
    const int pages = std::stoi(count);
    EXPECT_GE(pages, 3);
    std::size_t at = 0;
    for (int page = 1; page <= pages; ++page) {
        const std::size_t number = text.find(page == 1 ? "EX-2026-0042" : "Calibration certificate EX-2026-0042", at);
        at = text.find("page " + std::to_string(page) + " of " + count, at);
        ASSERT_NE(at, std::string::npos) << page;
        EXPECT_LT(number, at) << page;
    }
    const std::size_t end_mark = text.find("End of calibration certificate");
    ASSERT_NE(end_mark, std::string::npos);
    EXPECT_EQ(text.find("End of calibration certificate", end_mark + 1), std::string::npos);
    EXPECT_LT(text.find("page 1 of "), text.find("Results of the calibration")) << "results start on page 2";
}

TEST(CertificateIdentity, TellsInTheTitleWhatIsAmendedOrReplaced) {
    EvaluationRecord record = test::certified_budget_record();
    const auto title = [&](const char* language) {
        RenderAssets of_language = assets();
        of_language.languages = {language};
        return certificate_view(record, read_wording(of_language)).at("type").get<std::string>();
    };
    EXPECT_EQ(title("en"), "Calibration certificate");
    record.certificate->data.amendment.emplace();
    record.certificate->data.amendment->kind = "amended";
    record.certificate->data.amendment->number = "EX-1";
    EXPECT_EQ(title("en"), "Amendment to calibration certificate EX-1");
    EXPECT_EQ(title("de"), "Änderung zum Kalibrierschein EX-1");
    EXPECT_EQ(title("es"), "Modificación del certificado de calibración EX-1");
    EXPECT_EQ(title("zh-Hant"), "校正證書 EX-1 之修正");
    record.certificate->data.amendment->kind = "replaced";
    EXPECT_EQ(title("en"), "Calibration certificate, replacing EX-1");
}

TEST(CertificateIdentity, SaysOnEveryPageWhatTheDocumentIs) {
    EvaluationRecord record = test::certified_budget_record();
    EXPECT_EQ(document_status(record), "issued");
    const json issued = certificate_view(record, Wording(english()));
    EXPECT_EQ(texts_of(issued.at("status")), "issued 2026-11-21\n");
    EXPECT_THAT(issued.at("mark"), IsEmpty());
    record.certificate->superseded_by = "EX-2";
    const json superseded = certificate_view(record, Wording(english()));
    EXPECT_EQ(document_status(record), "superseded");
    EXPECT_THAT(superseded.at("status"), IsEmpty());
    EXPECT_EQ(superseded.at("mark").at(0).at("text"), "SUPERSEDED by EX-2");
    EXPECT_THAT(superseded.at("header_right").get<std::string>(), HasSubstr("SUPERSEDED by EX-2"));
    EXPECT_EQ(document_status(test::drafted(record)), "draft");
    record.certificate->data.status = "specimen";
    EXPECT_EQ(document_status(record), "specimen");
}

TEST(CertificateIdentity, NamesWhatAnAmendmentChanged) {
    const json texts = english();
    const Wording words(texts);
    const auto place = [&](const char* kind, const char* where) {
        return place_of_change({.kind = kind, .where = where, .before = "", .after = ""}, words).first();
    };
    EXPECT_EQ(place("text", "/item/serial_number"), "Item calibrated: Serial number");
    EXPECT_EQ(place("text", "/standards/1/certificate"), "Metrological traceability 2: certificate");
    EXPECT_EQ(place("text", "/remarks/0"), "Remarks 1");
    EXPECT_EQ(place("value", "E [10 V]"), "E [10 V]");
    EXPECT_EQ(place("U", "l"), "l: U");
    EXPECT_EQ(place("verdict", "l"), "l: Verdict");
    const certificate::Change verdict = {.kind = "verdict", .where = "l", .before = "pass", .after = "fail"};
    EXPECT_EQ(side_of_change(verdict, verdict.after, words).first(), "fail");
    const certificate::Change value = {.kind = "value", .where = "l", .before = "-1.5 nm", .after = ""};
    EXPECT_EQ(side_of_change(value, value.before, words).first(), "\u22121.5 nm");
    EXPECT_TRUE(side_of_change(value, value.after, words).empty());
}

}  // namespace
}  // namespace gumcert::reports
