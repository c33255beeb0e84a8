#include "reports/agreement/document_agreement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

#include "evaluation/evaluate_job.h"
#include "reports/agreement/dcc_agreement.h"
#include "reports/dcc/dcc_document.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/html_texts.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/render.h"

namespace gumcert::reports {
namespace {

using certificate::CertifiedValue;
using ::testing::HasSubstr;

const std::filesystem::path k_agreement_tree(GUMCERT_SOURCE_DIR);
const std::filesystem::path k_agreement_templates = k_agreement_tree / "templates";

const std::vector<std::pair<std::string, EvaluationRecord>>& example_certificates() {
    static const std::vector<std::pair<std::string, EvaluationRecord>> k_records = [] {
        std::vector<std::pair<std::string, EvaluationRecord>> records;
        for (const char* const job :
             {"examples/certificate/end_gauge.json", "examples/everyday/pt100/job.json",
              "examples/everyday/mass_set/job.json", "examples/everyday/multimeter/job.json",
              "examples/everyday/gauge_blocks/job.json", "examples/everyday/torque_wrench/job.json",
              "examples/everyday/angle_gauges/job.json"}) {
            records.emplace_back(job, evaluation::evaluate_job(k_agreement_tree / job, evaluation::CovarianceFile::none,
                                                               1, k_agreement_templates)
                                          .record);
        }
        return records;
    }();
    return k_records;
}

RenderAssets agreement_assets(const std::vector<std::string>& languages = {}) {
    RenderAssets assets;
    assets.templates = k_agreement_templates;
    assets.languages = languages;
    return assets;
}

std::string page_of(const EvaluationRecord& record, const std::vector<std::string>& languages = {}) {
    return render_html(record, agreement_assets(languages));
}

std::string disagreement(const std::string& html, const EvaluationRecord& record) {
    static const DocumentWords k_words = document_words(read_every_wording(k_agreement_templates));
    return PrintedDocument({text_of_html(html)}).disagreement_with(*record.certificate, k_words);
}

/// Every value with its column.
template <class Work>
void for_each_value(EvaluationRecord& record, const Work& work) {
    for (certificate::CertifiedTable& table : record.certificate->tables) {
        for (certificate::CertifiedColumn& column : table.columns) {
            for (CertifiedValue& value : column.values) {
                work(value);
            }
        }
    }
}

/// Another value, of which every digit is another one.
void change_digits(std::string& printed) {
    for (char& c : printed) {
        if (c >= '0' && c <= '9') {
            c = c == '9' ? '0' : static_cast<char>(c + 1);
        }
    }
}

TEST(DocumentsAndRecords, AgreeInEveryLanguageAndForm) {
    const std::string sheet = read_asset(k_agreement_templates / "certificate.css");
    for (const auto& [name, record] : example_certificates()) {
        for (const std::vector<std::string>& languages :
             std::vector<std::vector<std::string>>{{}, {"en"}, {"de"}, {"es"}, {"zh-Hant"}, {"de", "en"}}) {
            const std::string html = page_of(record, languages);
            EXPECT_EQ(disagreement(html, record), "") << name << " " << testing::PrintToString(languages);
            EXPECT_EQ(hidden_part_of_html(html, sheet), "") << name << " " << testing::PrintToString(languages);
            EXPECT_TRUE(has_style_of(html, sheet)) << name;
            EXPECT_TRUE(says_number(html, record.certificate->data.number)) << name;
            EXPECT_FALSE(says_number(html, record.certificate->data.number + "1")) << name;
        }
        const std::string dcc = render_dcc(record, agreement_assets());
        EXPECT_EQ(disagreement_of_dcc(dcc, name, dcc), "") << name;
    }
}

/// Degrees, minutes and seconds: sums of readings by hand, in the decimal sign of each language.
TEST(DocumentsAndRecords, PrintAnglesInTheirParts) {
    const auto found = std::ranges::find_if(
        example_certificates(), [](const auto& one) { return one.first.find("angle_gauges") != std::string::npos; });
    ASSERT_NE(found, example_certificates().end());
    EvaluationRecord record = found->second;
    for (const char* const language : {"en", "de", "es", "zh-Hant"}) {
        const std::string text = text_of_html(page_of(record, {language}));
        const std::string sign = language == std::string("de") || language == std::string("es") ? "," : ".";
        for (const auto& [angle, seconds] :
             {std::pair("12°\u00A030′\u00A000", "59″"), std::pair("29°\u00A059′\u00A058", "78″"),
              std::pair("0°\u00A000′\u00A030", "22″")}) {
            EXPECT_THAT(text, HasSubstr(angle + sign + seconds)) << language;
        }
        EXPECT_THAT(text, HasSubstr("12°\u00A030′\u00A000″")) << "the nominal value as it was written";
    }
    certificate::CertifiedValue& value = record.certificate->tables.at(0).columns.at(0).values.at(3);
    ASSERT_EQ(value.printed_value, "45000.59");
    const std::string page = page_of(record, {"de"});
    value.printed_value = "-45000.59";
    EXPECT_NE(disagreement(page, record), "") << "the sign is compared";
    EXPECT_EQ(disagreement(page_of(record, {"de"}), record), "");
    value.printed_value = "45000.95";
    EXPECT_NE(disagreement(page, record), "");
}

// An angle is a number as others are: no part of a longer one, with its own sign, to its last part.
TEST(DocumentsAndRecords, DisagreeInAnglesThatAreOthers) {
    EvaluationRecord record = example_certificates().front().second;
    const DocumentWords words = document_words(read_every_wording(k_agreement_templates));
    const auto disagrees = [&](const std::string& angle) {
        return !PrintedDocument({"EX-1 l " + angle + " 67 \u2033 pass of 2"})
                    .disagreement_with(*record.certificate, words)
                    .empty();
    };
    const auto state = [&](const char* seconds, const char* unit) {
        certificate::CertifiedTable& table = record.certificate->tables.at(0);
        table.layout = certificate::TableLayout{};
        table.layout->shown = {{.show = "value",
                                .of = table.columns.at(0).result,
                                .heading = {},
                                .role = "",
                                .stage = "",
                                .form = "sexagesimal"}};
        table.columns.at(0).unit = unit;
        for_each_value(record, [&](CertifiedValue& value) {
            value.printed_value = seconds;
            value.verdict.reset();
        });
    };
    state("7205.0", "arcsec");
    EXPECT_FALSE(disagrees("2° 00′ 05.0″"));
    EXPECT_FALSE(disagrees("2° 00′ 05,0″"));
    for (const char* const other : {"12° 00′ 05.0″", "0.2° 00′ 05.0″", "\u22122° 00′ 05.0″", "-2° 00′ 05.0″",
                                    "2° 00′ 05.1″", "2° 00′ 05.0′", "2 00 05.0", "2° 00′ 5.0″"}) {
        EXPECT_TRUE(disagrees(other)) << other;
    }
    state("-3.2", "arcsec");
    EXPECT_FALSE(disagrees("\u22120° 00′ 03.2″"));
    EXPECT_FALSE(disagrees("-0° 00′ 03.2″")) << "a template may print this minus sign";
    EXPECT_TRUE(disagrees("0° 00′ 03.2″"));
    state("120", "arcmin");
    EXPECT_FALSE(disagrees("2° 00′"));
    EXPECT_TRUE(disagrees("2° 00′ 05″"));
    EXPECT_TRUE(disagrees("2° 00′ 05.0″"));
}

// Law: what no certificate is, is told by its mark, in every language and with every pair of languages.
TEST(DocumentsAndRecords, DisagreeWhereAMarkSaysThatItIsNone) {
    const std::vector<std::pair<const char*, void (*)(EvaluationRecord&)>> states = {
        {"draft", [](EvaluationRecord& record) { record.certificate->blocked = true; }},
        {"specimen", [](EvaluationRecord& record) { record.certificate->data.status = "specimen"; }},
        {"superseded", [](EvaluationRecord& record) { record.certificate->superseded_by = "EX-2026-0099/A1"; }}};
    const EvaluationRecord& record = example_certificates().front().second;
    for (const std::vector<std::string>& languages :
         std::vector<std::vector<std::string>>{{"en"}, {"de"}, {"es"}, {"zh-Hant"}, {"de", "en"}, {"en", "zh-Hant"}}) {
        const std::string named = testing::PrintToString(languages);
        for (const auto& [state, change] : states) {
            EvaluationRecord other = record;
            change(other);
            EXPECT_THAT(disagreement(page_of(other, languages), record), HasSubstr("is marked")) << state << named;
        }
        const std::string report = render_budget_report_html(record, agreement_assets(languages));
        EXPECT_THAT(disagreement(report, record), HasSubstr("is marked")) << named;
    }
}

// Every mark that the wording has is one: a kind of document that is new is not forgotten.
TEST(DocumentsAndRecords, KnowTheMarksOfAllKindsOfDocuments) {
    const DocumentWords words = document_words(read_every_wording(k_agreement_templates));
    std::vector<std::string> marks;
    for (const DocumentWords::Mark& mark : words.marks) {
        marks.push_back(mark.text);
    }
    for (const char* const mark :
         {"DRAFT \u2014 not issued", "SPECIMEN \u2014 not an accredited certificate", "SUPERSEDED by {number}",
          "INTERNAL \u2014 no calibration certificate", "Audit \u2013 not a calibration certificate",
          "ERSETZT durch {number}", "\u5DF2\u88AB {number} \u53D6\u4EE3"}) {
        EXPECT_THAT(marks, testing::Contains(mark));
    }
    // Of a sentence with two values, what stands up to the second one.
    const PrintedDocument with_head(
        {"Head of the archive of the laboratory when this document was made: 12 entries, ab"});
    EXPECT_TRUE(with_head.has_head_of_archive(words));
    EXPECT_FALSE(with_head.names_other_templates(words));
    EXPECT_TRUE(PrintedDocument({"gumcert 0.1.0 ge\u00E4nderte Vorlagen 0123abcd"}).names_other_templates(words));
    for (const DocumentWords::Mark& mark : words.marks) {
        EXPECT_NE(PrintedDocument({"x " + mark.before + "EX-1" + mark.behind + " y"})
                      .disagreement_with(*example_certificates().front().second.certificate, words)
                      .find("is marked"),
                  std::string::npos)
            << mark.text;
    }
}

// A document of a record in which one printed value or one verdict is another one.
TEST(DocumentsAndRecords, DisagreeWhereOneValueOrVerdictIsAnother) {
    for (const auto& [name, record] : example_certificates()) {
        const std::string html = page_of(record);
        const std::string dcc = render_dcc(record, agreement_assets());
        std::size_t values = 0;
        std::size_t verdicts = 0;
        EvaluationRecord counted = record;
        for_each_value(counted, [&](const CertifiedValue& v) {
            values += v.printed_value.size() > 2 && !v.printed_U.empty() ? 1U : 0U;
            verdicts += v.verdict ? 1U : 0U;
        });
        ASSERT_GT(values, 0U) << name;
        for (const std::size_t chosen : {std::size_t{0}, values / 2, values - 1}) {
            EvaluationRecord other = record;
            std::size_t i = 0;
            for_each_value(other, [&](CertifiedValue& v) {
                if (v.printed_value.size() > 2 && !v.printed_U.empty() && i++ == chosen) {
                    change_digits(v.printed_value);
                }
            });
            const std::string page = page_of(other);
            if (page != html) {
                EXPECT_NE(disagreement(html, other), "") << name << ", value " << chosen;
                EXPECT_NE(disagreement_of_dcc(render_dcc(other, agreement_assets()), name, dcc), "")
                    << name << ", value " << chosen;
            }
        }
        if (verdicts == 1) {
            EvaluationRecord other = record;
            for_each_value(other, [](CertifiedValue& v) { v.verdict->verdict = "fail"; });
            EXPECT_THAT(disagreement(html, other), HasSubstr("fail")) << name;
        }
    }
}

// Law: a number is its sign, its decimal sign, its exponent and its unit as well as its digits.
TEST(DocumentsAndRecords, DisagreeWhereTheSameDigitsAreAnotherNumber) {
    const std::vector<std::pair<const char*, void (*)(std::string&)>> changes = {
        {"sign", [](std::string& v) { v = v.starts_with('-') ? v.substr(1) : "-" + v; }},
        {"decimal sign",
         [](std::string& v) {
             const std::size_t point = v.find('.');
             if (point != std::string::npos) {
                 v.erase(point, 1);
             } else {
                 v.insert(v.size() - 1, ".");
             }
         }},
        {"exponent", [](std::string& v) { v += "E-3"; }}};
    for (const auto& [name, record] : example_certificates()) {
        for (const std::vector<std::string>& languages : std::vector<std::vector<std::string>>{{"en"}, {"de"}}) {
            const std::string html = page_of(record, languages);
            std::size_t values = 0;
            EvaluationRecord counted = record;
            for_each_value(counted, [&](const CertifiedValue& v) { values += v.printed_value.size() > 1 ? 1U : 0U; });
            for (const auto& [what, change] : changes) {
                for (const std::size_t chosen : {std::size_t{0}, values / 3, values - 1}) {
                    EvaluationRecord other = record;
                    std::size_t i = 0;
                    for_each_value(other, [&](CertifiedValue& v) {
                        if (v.printed_value.size() > 1 && i++ == chosen) {
                            change(v.printed_value);
                        }
                    });
                    if (page_of(other, languages) != html) {
                        EXPECT_NE(disagreement(html, other), "") << name << ", value " << chosen << ", " << what;
                    }
                }
            }
            for (std::size_t t = 0; t < record.certificate->tables.size(); ++t) {
                for (std::size_t c = 0; c < record.certificate->tables[t].columns.size(); ++c) {
                    EvaluationRecord other = record;
                    std::string& unit = other.certificate->tables[t].columns[c].printed_unit;
                    unit = unit == "%" ? "\u2030" : "q" + unit;
                    if (page_of(other, languages) != html) {
                        EXPECT_NE(disagreement(html, other), "") << name << ", table " << t << ", column " << c;
                    }
                }
            }
        }
    }
}

// Law: the page of an amendment says which document it amends or replaces. That number is part of its own, "EX-1" of "EX-1/A1".
TEST(DocumentsAndRecords, SayWhatTheyAmend) {
    EvaluationRecord record = example_certificates().begin()->second;
    certificate::CertificateData& data = record.certificate->data;
    const std::string original = data.number;
    data.number = original + "/A1";
    for (const char* const kind : {"amended", "replaced"}) {
        data.amendment =
            certificate::Amendment{.kind = kind, .number = original, .sha256 = {}, .reason = "r", .changes = {"c"}};
        const PrintedDocument now(std::vector{texts_of_view(view_of_document(record, agreement_assets()))});
        for (const char* const language : {"en", "de", "es", "zh-Hant"}) {
            std::string text = text_of_html(page_of(record, {language}));
            EXPECT_EQ(PrintedDocument({text}).disagreement_with_facts(facts_of(data), now), "") << language << kind;
            for (std::size_t at = text.find(original); at != std::string::npos; at = text.find(original, at + 1)) {
                if (text.compare(at + original.size(), 3, "/A1") != 0) {
                    text.replace(at, original.size(), "none");
                }
            }
            EXPECT_NE(PrintedDocument({text}).disagreement_with_facts(facts_of(data), now).find("amends or replaces"),
                      std::string::npos)
                << language << kind;
        }
    }
}

// Law: what identifies a certificate is on its pages, in every language, and another one is told.
TEST(DocumentsAndRecords, SayWhoseCertificateTheyAre) {
    for (const auto& [name, record] : example_certificates()) {
        const PrintedDocument now(std::vector{texts_of_view(view_of_document(record, agreement_assets()))});
        const std::vector<DocumentFact> facts = facts_of(record.certificate->data);
        std::size_t said = 0;
        for (const char* const language : {"en", "de", "es", "zh-Hant"}) {
            const PrintedDocument page({text_of_html(page_of(record, {language}))});
            EXPECT_EQ(page.disagreement_with_facts(facts, now), "") << name << language;
            for (const DocumentFact& fact : facts) {
                if (!now.says(fact.spellings.front())) {
                    continue;
                }
                ++said;
                const DocumentFact other{fact.what, {fact.spellings.front() + "Q7"}};
                EXPECT_NE(page.disagreement_with_facts({other}, PrintedDocument(std::vector{other.spellings.front()})),
                          "")
                    << fact.what;
            }
        }
        EXPECT_GE(said, 4U * 10U) << name;
    }
    const PrintedDocument page({"SN-7781-2, AB/3x Example\u00A0Customer 2026-11-18"});
    for (const char* const text :
         {"SN-7781", "7781-2", "AB", "AB/3", "B/3x", "Example Custom", "2026-11-1", "6-11-18"}) {
        EXPECT_FALSE(page.says(text)) << text;
    }
    for (const char* const text : {"SN-7781-2", "AB/3x", "Example Customer", "2026-11-18"}) {
        EXPECT_TRUE(page.says(text)) << text;
    }
}

TEST(DocumentsAndRecords, DifferInTheWordsThatAreTold) {
    EXPECT_EQ(difference_of_texts("a b\nc", "ab c"), "");
    EXPECT_THAT(difference_of_texts("only in full", "only in part"),
                testing::AllOf(HasSubstr("infull"), HasSubstr("inpart")));
    EXPECT_NE(difference_of_texts("a", "a b"), "");
    EXPECT_NE(difference_of_texts("", "a"), "");
}

// Law: every text, attribute and element of a digital certificate follows from its record, and another one is told.
/// Who checks a certificate may have other templates than those that it names; everything else is held against the record.
TEST(DocumentsAndRecords, LetADigitalCertificateNameItsTemplates) {
    const EvaluationRecord record = example_certificates().front().second;
    RenderAssets assets = agreement_assets();
    const std::string plain = render_dcc(record, assets);
    EXPECT_EQ(changed_templates_of_dcc(plain, "plain.xml"), "");
    assets.changed_templates = "9e7c1a5b2d3f";
    const std::string dcc = render_dcc(record, assets);
    EXPECT_EQ(changed_templates_of_dcc(dcc, "other.xml"), assets.changed_templates);
    EXPECT_NE(disagreement_of_dcc(dcc, "other.xml", plain), "");
    EXPECT_EQ(disagreement_of_dcc(dcc, "other.xml", render_dcc(record, assets)), "");
    for (const std::string no_digest : {"9e7c1a5b2d3", "9e7c1a5b2d3F", "U is 0.10 µm"}) {
        std::string other = dcc;
        other.replace(other.find("<dcc:reference>9e7c1a5b2d3f"), 27, "<dcc:reference>" + no_digest);
        EXPECT_EQ(changed_templates_of_dcc(other, "other.xml"), "") << no_digest;
    }
}

TEST(DocumentsAndRecords, TellEveryChangeOfADigitalCertificate) {
    for (const char* const job : {"examples/certificate/end_gauge.json", "examples/everyday/torque_wrench/job.json"}) {
        const EvaluationRecord& record =
            std::find_if(example_certificates().begin(), example_certificates().end(), [&](const auto& one) {
                return one.first == job;
            })->second;
        const std::string dcc = render_dcc(record, agreement_assets());
        const std::size_t body = dcc.find("<dcc:dccSoftware");
        ASSERT_NE(body, std::string::npos);
        std::size_t changed = 0;
        const auto is_told = [&](const std::string& other, std::size_t at) {
            ++changed;
            EXPECT_NE(disagreement_of_dcc(other, "other.xml", dcc), "") << job << ": " << dcc.substr(at, 60);
        };
        for (std::size_t at = dcc.find('>', body); at != std::string::npos; at = dcc.find('>', at + 1)) {
            const std::size_t end = dcc.find('<', at);
            if (end == std::string::npos || end == at + 1 || dcc[at + 1] == '\n') {
                continue;
            }
            std::string other = dcc;
            other.insert(end, "7");
            is_told(other, at);
        }
        for (std::size_t at = dcc.find("=\"", body); at != std::string::npos; at = dcc.find("=\"", at + 2)) {
            std::string other = dcc;
            other.insert(at + 2, "x");
            is_told(other, at);
        }
        EXPECT_GT(changed, 200U);
        // What is no element, wherever it stands: programs may show another page for it.
        for (std::size_t at = dcc.find('\n'); at != std::string::npos; at = dcc.find('\n', at + 1)) {
            for (const char* const node :
                 {"<?xml-stylesheet type=\"text/css\" href=\"data:text/css,x\"?>", "<!-- U = 1 nm -->"}) {
                std::string other = dcc;
                is_told(other.insert(at, node), at);
            }
        }
        // An element more, and one less.
        const std::size_t issued = dcc.find("<dcc:issueDate>");
        ASSERT_NE(issued, std::string::npos);
        const std::string line = dcc.substr(issued, dcc.find('\n', issued) + 1 - issued);
        std::string more = dcc;
        is_told(more.insert(issued, line), issued);
        std::string less = dcc;
        is_told(less.erase(issued, line.size()), issued);
        // A signature is made behind the document.
        std::string is_signed = dcc;
        is_signed.insert(is_signed.rfind("</"),
                         "<ds:Signature xmlns:ds=\"http://www.w3.org/2000/09/xmldsig#\"><x/></ds:Signature>");
        EXPECT_EQ(disagreement_of_dcc(is_signed, "signed.xml", dcc), "");
        EXPECT_THAT(languages_of_dcc(dcc, "d"), testing::ElementsAre("en"));
    }
}

TEST(DocumentsAndRecords, AgreeAsPages) {
    const EvaluationRecord& record = example_certificates().front().second;
    const DocumentWords words = document_words(read_every_wording(k_agreement_templates));
    const std::vector<std::string> pages = {"EX-1 l 50000838 67 nm pass of 2", "EX-1"};
    EXPECT_EQ(PrintedDocument(pages).disagreement_with(*record.certificate, words), "");
    for (const char* const other :
         {"EX-1 nm l 50001138 67 pass of 2", "EX-1 nm l 50000838 66 pass", "EX-1 nm l 50000838 67 fail", "EX-1 nm",
          "EX-1 nm l 50000838 67 pass DRAFT \u2014 not issued", "EX-1 nm l 50000838 67 conditional pass",
          "EX-1 nm l 67 50000838 pass", "EX-1 nm l \u221250000838 67 pass", "EX-1 nm l 5000083.8 67 pass",
          "EX-1 nm l 50000838 6.7 pass", "EX-1 mm l 50000838 67 pass", "EX-1 l 50000838 67 pass",
          "EX-1 nm l 50000838 \u00D7 10\u00B3 67 pass", "EX-1 nm l 150000838 67 pass",
          "EX-1 nm/K l 50000838 67 pass"}) {
        EXPECT_NE(PrintedDocument({other}).disagreement_with(*record.certificate, words), "") << other;
    }
}

// A value of 0 beside U = 4.8 × 10²: its power says nothing, and pages print it or leave it out.
TEST(DocumentsAndRecords, AgreeInAZeroWithAndWithoutItsPower) {
    EvaluationRecord record = example_certificates().front().second;
    const DocumentWords words = document_words(read_every_wording(k_agreement_templates));
    for (const std::string zero : {"0E+1", "0.0E+2"}) {
        for_each_value(record, [&](CertifiedValue& value) {
            value.printed_value = zero;
            value.printed_U = "4.8E+2";
        });
        const std::string power = zero == "0E+1" ? "0 \u00D7 10\u00B9" : "0.0 \u00D7 10\u00B2";
        for (const std::string& printed : {std::string("0"), power}) {
            const std::string page = "EX-1 l " + printed + " 4.8 \u00D7 10\u00B2 nm pass of 2";
            EXPECT_EQ(PrintedDocument({page}).disagreement_with(*record.certificate, words), "") << page;
        }
        for (const char* const other : {"0.1", "1", "10", "0 \u00D7 10\u2076"}) {
            const std::string page = std::string("EX-1 l ") + other + " 4.8 \u00D7 10\u00B2 nm pass of 2";
            EXPECT_NE(PrintedDocument({page}).disagreement_with(*record.certificate, words), "") << page;
        }
    }
}

TEST(DocumentsAndRecords, SayTheirNumberAsAWordOfItsOwn) {
    EXPECT_TRUE(says_number("<p>Certificate EX-1.</p>", "EX-1"));
    EXPECT_TRUE(says_number("<style>EX-2</style><p>a &amp; b EX-1</p>", "EX-1"));
    for (const char* const html :
         {"<p>EX-11</p>", "<p>EX-1/A1</p>", "<p>AEX-1</p>", "<style>EX-1</style>", "<!-- EX-1 -->",
          "<head><title>EX-1</title></head>", "<b data-text=\"Certificate EX-2\"></b><p>replaces EX-1</p>"}) {
        EXPECT_FALSE(says_number(html, "EX-1")) << html;
    }
}

}  // namespace
}  // namespace gumcert::reports
