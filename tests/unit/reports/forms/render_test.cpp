#include "reports/forms/render.h"
#include "reports/forms/pdf_worker.h"
#include "reports/printable_text.h"

#include "gum/quantity/diagnostic.h"
#include "reports/view/certificate_view.h"
#include "tests/support/hostile_strings.h"
#include "tests/support/sample_record.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"
#include "text/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// The tags of an HTML text, in order, without what stands between them. Left out are the labels of drawings, the lines
/// that lead to them and all digits (a label finds its place by its length, and a key grows with its texts), and what
/// an attribute "alt" says up to its closing quotation mark.
std::string html_tags(std::string html) {
    for (const std::string drawing : {"<i>", "</i>", "<sub>", "</sub>"}) {  // of the program, around what it knows
        for (std::size_t at = html.find(drawing); at != std::string::npos; at = html.find(drawing, at)) {
            html.erase(at, drawing.size());
        }
    }
    const std::string group = "<span class=\"g\">";
    for (std::size_t at = html.find(group); at != std::string::npos; at = html.find(group, at)) {
        html.erase(html.find("</span>", at), std::string("</span>").size());
        html.erase(at, group.size());
    }
    std::string out;
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        std::string tag = html.substr(at, html.find('>', at) - at + 1);
        if (tag.starts_with("<tspan") || tag.starts_with("</tspan")) {  // the same in drawings
            continue;
        }
        std::erase_if(tag, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
        for (const std::string attribute : {" alt=\"", " data-text=\""}) {  // texts, up to the quote that ends them
            if (const std::size_t found = tag.find(attribute); found != std::string::npos) {
                const std::size_t begin = found + attribute.size();
                tag.erase(begin, tag.find('"', begin) - begin);
            }
        }
        if (!tag.starts_with("<text ") && tag != "</text>" && !tag.starts_with("<line ")) {
            out += tag + "\n";
        }
    }
    return out;
}

/// What every form of the document must show of the record, as rows of texts that stand side by side.
std::vector<std::string> expected_rows(const EvaluationRecord& record) {
    std::vector<std::string> rows;
    for (const ErrorsAtAngle& at : record.rotary->errors) {
        std::string row = " " + at.angle_deg.text + " ";
        for (const StatedValue& e : at.errors) {
            row += e.printed.value + " " + e.printed.U + " ";
        }
        rows.push_back(row);
    }
    for (std::size_t i = 1; i < 3; ++i) {
        const RotaryTable& r = *record.rotary;
        rows.push_back(" " + r.set_up.printed_O[i].value + " " + r.axis_in_fixture.printed_O[i].value + " " +
                       r.set_up.printed_O[i].U + " µm ");
        rows.push_back(" " + r.set_up.printed_S[i].value + " " + r.axis_in_fixture.printed_S[i].value + " " +
                       r.set_up.printed_S[i].U + " ″ ");
    }
    for (const ComparisonPoint& p : record.comparison->points) {
        rows.push_back(" " + p.direction + " " + p.printed_angle + " " + p.value.text + " " + p.U.text + " " +
                       p.reference_value.text + " " + p.reference_U.text + " " + p.D.text + " " + p.U_D.text + " " +
                       p.En.text + " ");
    }
    for (const RangeRow& range : record.rotary->ranges) {
        rows.push_back(" " + range.name + " " + range.stated.printed.value + " " + range.stated.printed.U + " ");
    }
    for (const VarianceComponent& v : record.rotary->variance_components) {
        rows.push_back(" " + v.name + " " + v.printed.value + " " + v.printed.U + " " + v.printed.unit + " ");
    }
    for (const InputFile& file : record.job_files) {
        rows.push_back(" " + file.name + " " + file.sha256 + " ");
    }
    return rows;
}

TEST(RenderHtml, ShowsTheTextsOfTheRecord) {
    const EvaluationRecord record = test::sample_record();
    const std::string text = html_text(render_html(record, assets()));
    for (const std::string& row : expected_rows(record)) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    EXPECT_THAT(text, HasSubstr("SPECIMEN — not an accredited certificate"));
    EXPECT_THAT(text, HasSubstr("The results relate only to the items calibrated."));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
    EXPECT_THAT(text, HasSubstr("coverage factor k = 2.00, which for a t-distribution"));
    EXPECT_THAT(text, HasSubstr("νeff of 380 or more"));
    EXPECT_THAT(text, HasSubstr("covariance.csv"));
}

TEST(RenderHtml, LoadsNothingAndRunsNothing) {
    const std::string html = render_html(test::sample_record(), assets());
    for (const char* part : {"<script", "src=", "href=", "url(", "@import", "currentColor", "<use", "{{", "}}"}) {
        EXPECT_THAT(html, Not(HasSubstr(part)));
    }
    EXPECT_EQ(render_html(test::sample_record(), assets()), html);
}

const std::vector<std::string> k_hostile = {"<script>alert(1)</script>",
                                            "</title><img src=x onerror=alert(1)>",
                                            "\" onload=\"alert(1)",
                                            "{{title}} {{{style}}} {{#sections}}",
                                            "{{=<% %>=}}",
                                            "#let x = 1; #panic(\"x\")",
                                            "$x^2$ *b* _i_ `raw` @ref <label>",
                                            "{name} {low} {k}",
                                            "&lt;b&gt; &amp;",
                                            "]]> --> <!-- <![CDATA[",
                                            std::string(3000, 'W'),
                                            "' or 1=1 --",
                                            "\\\"\\n \\u{0}",
                                            "a\nb\tc"};

/// A record of a rotary table with one text in every place that a user fills.
EvaluationRecord with_text(const std::string& text, EvaluationRecord r = test::sample_record()) {
    r.title = text;
    r.job_files[0].name = text;
    r.comparison->remarks[0] = text;
    r.comparison->reference_name = text;
    r.comparison->reference_budget[0].input = text;
    r.rotary->stations[0].name = text;
    r.rotary->reflectors[0].name = text;
    r.rotary->dead_paths[0].name = text;
    r.rotary->flagged[0].pass = text;
    r.rotary->variance_components[0].name = text;
    r.rotary->adjustment.variance_factor.reason = text;
    r.rotary->adjustment.global_test.meaning = text;
    r.rotary->flagged[0].reason = text;
    r.rotary->axis_line[0].description = text;
    r.rotary->iso230_2->remarks[0] = text;
    r.rotary->monte_carlo->statement = text;
    r.rotary->fixture_budget->remarks[0] = text;
    r.rotary->fixture_budget->largest_coordinate = text;
    r.rotary->budget_sources[0] = text;
    for (ExternalReliability& e : r.rotary->external_reliability) {
        e.pass = text;
    }
    r.rotary->covariance_file = text;
    r.diagnostics[0].what = text;
    r.software.commit = text;
    return r;
}

/// The record of a budget with one text in every place that a user fills.
EvaluationRecord budget_with_text(const std::string& text, EvaluationRecord r) {
    r.title = text;
    r.job_files[0].name = text;
    r.software.commit = text;
    r.model->equations = {text, text};
    r.model->unknowns = {text};
    for (Result& result : r.results) {
        result.name = text;
        result.description = text;
        result.coverage_note = text;
        for (BudgetRow& row : result.budget) {
            row.input = text;
            row.source = text;
            for (BudgetRow& part : row.components) {
                part.input = text;
                part.source = text;
            }
        }
    }
    for (FitSummary& fit : r.fits) {
        fit.name = text;
        fit.equation = text;
        for (FitSummary::Parameter& parameter : fit.parameters) {
            parameter.name = text;
        }
    }
    for (ReadingsSummary& readings : r.readings) {
        readings.input = text;
        readings.component = text;
        readings.point = text;
    }
    for (VarianceAnalysis& v : r.variance_analyses) {
        v.input = text;
        v.point = text;
    }
    for (OutlyingReading& reading : r.outliers) {
        reading.input = text;
        reading.component = text;
        reading.point = text;
    }
    return r;
}

certificate::Person person(const std::string& text) {
    certificate::Person p;
    p.name = text;
    p.function = text;
    p.authorised_from = text;
    p.authorised_to = text;
    return p;
}

/// Certificate data with one text in every place that the laboratory or its customer fills with words.
certificate::CertificateData data_with_text(const std::string& text) {
    certificate::CertificateData d = test::sample_certificate_data();
    const certificate::Address address = {.lines = {text, text}, .country = text};
    d.number = text;
    d.laboratory.name = text;
    d.laboratory.address = address;
    for (std::string* const one :
         {&d.laboratory.email, &d.laboratory.telephone, &d.laboratory.web, &d.laboratory.code}) {
        *one = text;
    }
    d.accreditation->body = text;
    d.accreditation->number = text;
    d.accreditation->standard = text;
    d.customer = {.name = text, .address = address, .contact = text, .email = text, .order = text};
    d.item = {.description = text,
              .manufacturer = text,
              .type = text,
              .serial_number = text,
              .identification = text,
              .condition = text,
              .owner = text,
              .stated_by_customer = {"identification", text}};
    d.place.address = address;
    d.place.description = text;
    d.dates = {.received = text, .performed_from = text, .performed_to = text, .authorised = text, .issued = text};
    d.method = {.identification = text,
                .version = text,
                .title = text,
                .description = text,
                .standard = text,
                .valid_from = text,
                .valid_to = text,
                .deviations = {text, text}};
    for (certificate::StandardUsed& s : d.standards) {
        s.name = s.issuer = text;
        s.identification = s.certificate = s.issuer_accreditation = s.evidence = s.calibrated = s.valid_to = text;
        s.unit = s.sha256 = text;
    }
    for (certificate::Condition& c : d.conditions) {
        c.quantity = text;
        c.unit = c.sensor = text;
    }
    d.persons = {.performed_by = person(text), .reviewed_by = person(text), .authorised_by = person(text)};
    for (certificate::AgreedSpecification& s : d.specifications) {
        s.unit = s.document = s.edition = s.clause = s.agreed_by = s.agreed_on = s.agreement = text;
        s.rule.text = text;
        s.rule.prescribed_by = text;
    }
    d.opinions = {{.text = text, .basis = text, .author = person(text)}};
    d.remarks = {text, text};
    d.external_results = {{.results = {text}, .provider = text}};
    d.parameters = {{.name = text, .unit = text, .value = 1.0}};
    d.sampling = text;
    d.adjustment = certificate::Adjustment{.adjusted = true, .as_found = text};
    d.simplified_agreement = text;
    d.recalibration_date = d.recalibration_agreement = text;
    d.amendment = certificate::Amendment{
        .kind = "replaced", .number = text, .sha256 = text, .reason = text, .changes = {text, text}};
    d.omissions = {{.clause = text, .reason = text}};
    return d;
}

/// A draft with findings that quote the text, as the gates do.
EvaluationRecord certified_with_text(const std::string& text, EvaluationRecord r) {
    r = test::drafted(std::move(r));
    r.certificate->symbol = true;
    r.certificate->data = data_with_text(text);
    r.certificate->profile.id = text;
    r.certificate->profile.name = text;
    r.certificate->profile.first_page_sentences = {text};
    for (certificate::CertifiedTable& table : r.certificate->tables) {
        for (certificate::CertifiedColumn& column : table.columns) {
            column.name = text;
            column.values.front().external = true;
            for (certificate::CertifiedValue& v : column.values) {
                if (v.verdict) {
                    v.verdict->note = text;
                    v.verdict->formula = text;
                }
            }
        }
    }
    for (certificate::Finding& f : r.certificate->findings) {
        f.where = f.what = f.action = text;
    }
    return r;
}

EvaluationRecord certified_rotary_with_text(const std::string& text) {
    return with_text(text, certified_with_text(text, test::certified_rotary_record()));
}

EvaluationRecord certified_budget_with_text(const std::string& text) {
    EvaluationRecord r = certified_with_text(text, test::certified_budget_record());
    for (certificate::CertifiedColumn& column : r.certificate->tables.front().columns) {
        column.result = text;
    }
    return budget_with_text(text, std::move(r));
}

TEST(RenderHtml, HostileTextsDoNotAlterTheStructure) {
    const std::string plain = html_tags(render_html(with_text("Smith"), assets()));
    for (const std::string& text : k_hostile) {
        // Not EXPECT_EQ: the difference of two whole documents takes a minute to print.
        EXPECT_TRUE(html_tags(render_html(with_text(text), assets())) == plain) << text.substr(0, 100);
    }
    EXPECT_THAT(render_html(with_text(k_hostile[0]), assets()), HasSubstr("&lt;script&gt;alert(1)&lt;"));
    EXPECT_THAT(render_html(with_text("{{title}}"), assets()),
                HasSubstr("<h1>Calibration certificate</h1>\n<p class=\"title\">{{title}}</p>"));
}

TEST(RenderHtml, HostileTextsInCertificateDataDoNotAlterTheStructure) {
    EXPECT_GE(test::hostile_strings().size(), 200U);
    RenderAssets both = assets();
    both.languages = {"en", "de"};
    const std::string rotary = html_tags(render_html(certified_rotary_with_text("Smith"), both));
    const std::string budget = html_tags(render_html(certified_budget_with_text("Smith"), both));
    EXPECT_THAT(rotary, HasSubstr("<header class=\"identity\">"));
    const std::vector<std::string> all = test::hostile_strings();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string& text = all[i];
        EXPECT_TRUE(html_tags(render_html(certified_budget_with_text(text), both)) == budget) << text.substr(0, 100);
        if (i % 8 == 0) {  // the certificate data are the same, and a rotary table has many more numbers
            EXPECT_TRUE(html_tags(render_html(certified_rotary_with_text(text), both)) == rotary)
                << text.substr(0, 100);
        }
    }
}

TEST(RenderText, HostileTextsBringNoControlCharacters) {
    RenderAssets both = assets();
    both.languages = {"en", "zh-Hant"};
    for (const std::string& text : test::hostile_strings()) {
        std::istringstream lines(render_text(certified_budget_with_text(text), both));
        for (std::string line; std::getline(lines, line);) {
            ASSERT_EQ(printable(line), line);
        }
    }
}

TEST(RenderText, ShowsTheTextsOfTheRecordIn100Columns) {
    const EvaluationRecord record = test::sample_record();
    const std::string whole = render_text(record, assets());
    const std::string text = squeezed(whole);
    for (const std::string& row : expected_rows(record)) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    for (const std::string& hostile : k_hostile) {
        std::istringstream lines(render_text(with_text(hostile), assets()));
        for (std::string line; std::getline(lines, line);) {
            std::size_t characters = 0;
            for (const char c : line) {
                characters += !text::is_continuation(c) ? 1U : 0U;
            }
            EXPECT_LE(characters, 100U) << line;
        }
    }
    EXPECT_EQ(render_text(record, assets()), whole);
}

TEST(Render, WorksWithoutOptionalParts) {
    EvaluationRecord r = test::sample_record();
    r.rotary.reset();
    r.comparison.reset();
    r.diagnostics.clear();
    r.kind = "budget";
    r.results[0].budget = test::sample_record().comparison->reference_budget;
    const std::string text = render_text(r, assets());
    EXPECT_THAT(text, HasSubstr("offset of the fixture along y"));
    EXPECT_THAT(text, HasSubstr("Uncertainty budget of O_y (offset of the fixture along y)."));
    EXPECT_THAT(text, Not(HasSubstr("Error motions")));

    EvaluationRecord home = test::sample_record();
    home.rotary->datum = "home";
    home.rotary->reversal.clear();
    home.rotary->flagged.clear();
    home.rotary->errors[0].errors[0].printed = {.value = "0", .U = "", .unit = "µm"};
    const std::string home_text = squeezed(render_text(home, assets()));
    EXPECT_THAT(home_text, HasSubstr("Datum: the home position."));
    EXPECT_THAT(home_text, HasSubstr("reversal was not determined: that takes both senses"));
    EXPECT_THAT(home_text, HasSubstr("flagged no distance"));
    EXPECT_THAT(home_text, HasSubstr(" 0 0 – "));
}

TEST(Render, NamesWhatIsMissing) {
    RenderAssets a = assets();
    a.languages = {"../en"};
    EXPECT_THROW(static_cast<void>(render_text(test::sample_record(), a)), gum::StorageError);
    a = assets();
    a.templates = "/nowhere";
    EXPECT_THROW(static_cast<void>(render_html(test::sample_record(), a)), gum::StorageError);
    a = assets();
    a.node_program = "/nowhere/node";
    try {
        static_cast<void>(render_pdf(test::sample_record(), a));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_THAT(e.what(), HasSubstr("scripts/setup"));
    }
}

TEST(RenderPdf, ShowsTheTextsOfTheRecordAndIsRepeatable) {
    SKIP_WITHOUT_PDF();
    const EvaluationRecord record = test::sample_record();
    const std::string pdf = render_pdf(record, assets());
    EXPECT_TRUE(pdf.starts_with("%PDF-1.7"));
    EXPECT_THAT(pdf, HasSubstr("<pdfaid:part>3</pdfaid:part>"));
    EXPECT_THAT(pdf, HasSubstr("<pdfaid:conformance>A</pdfaid:conformance>"));
    EXPECT_EQ(render_pdf(record, assets()), pdf);
    const std::string text = pdf_text(pdf);
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
    }
    for (const std::string& row : expected_rows(record)) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    EXPECT_THAT(text, HasSubstr("page 1 of "));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
}

/// Typst keeps what certificates have in common. A document has the same bytes whatever was set before it, in whatever order:
/// also one that differs in a number of its pages alone, or has the same tables in another language.
TEST(RenderPdf, HasTheSameBytesWhateverWasSetBefore) {
    SKIP_WITHOUT_PDF();
    EvaluationRecord other_number = test::certified_budget_record();
    other_number.certificate->data.number = "OTHER-17";
    const std::vector<EvaluationRecord> records{test::certified_budget_record(), other_number, test::sample_record(),
                                                test::drafted(test::certified_budget_record())};
    std::vector<std::string> alone;
    for (const EvaluationRecord& record : records) {
        alone.push_back(render_pdf(record, assets()));
    }
    PdfWorker worker(assets());
    for (const std::size_t i : {1U, 0U, 2U, 3U, 0U, 1U, 3U, 2U, 2U, 0U}) {
        EXPECT_EQ(render_pdf(records[i], assets(), {}, &worker), alone[i]) << i;
    }
    // What many documents did not use is forgotten in between.
    for (int more = 0; more < 32; ++more) {
        EXPECT_EQ(render_pdf(records[2], assets(), {}, &worker), alone[2]) << more;
    }
    EXPECT_EQ(render_pdf(records[0], assets(), {}, &worker), alone[0]);
}

TEST(RenderPdf, HostileTextsAreShownAsTexts) {
    SKIP_WITHOUT_PDF();
    std::string all;
    for (const std::string& text : k_hostile) {
        if (text.size() < 100) {
            all += text + " ";
        }
    }
    const std::string text = pdf_text(render_pdf(with_text(all + std::string(500, 'W')), assets()));
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
    }
    EXPECT_THAT(text, HasSubstr("#let x = 1; #panic(\"x\")"));
    EXPECT_THAT(text, HasSubstr("$x^2$ *b* _i_ `raw` @ref <label>"));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
}

TEST(RenderPdf, ACharacterThatTheFontLacksIsAnError) {
    SKIP_WITHOUT_PDF();
    EvaluationRecord record = test::sample_record();
    record.title = "Rotary table 校";
    try {
        static_cast<void>(render_pdf(record, assets()));
        FAIL() << "accepted";
    } catch (const gum::NoResultError& e) {
        EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0011");
        EXPECT_THAT(e.what(), HasSubstr("校"));
    }
}

TEST(RenderPdf, StopsAChildThatTakesTooLong) {
    SKIP_WITHOUT_PDF();
    RenderAssets a = assets();
    a.pdf_time_limit = std::chrono::seconds(0);
    // A folder of its own: others write to the common one at the same time.
    a.temporary_folder = fs::path(testing::TempDir()) / ("time-limit-" + std::to_string(getpid()));
    fs::create_directories(a.temporary_folder);
    EXPECT_THROW(static_cast<void>(render_pdf(test::sample_record(), a)), gum::StorageError);
    for (const auto& entry : fs::directory_iterator(a.temporary_folder)) {
        ADD_FAILURE() << "left behind: " << entry.path();
    }
    fs::remove_all(a.temporary_folder);
}

}  // namespace
}  // namespace gumcert::reports
