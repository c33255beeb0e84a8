#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/render.h"
#include "reports/forms_of_number.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certificate_view.h"
#include "reports/wording.h"
#include "tests/support/sample_comparison_record.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> k_four_languages = {"en", "de", "zh-Hant", "es"};

RenderAssets in_languages(const std::vector<std::string>& languages) {
    RenderAssets a = assets();
    a.languages = languages;
    return a;
}

json wording_file(const std::string& language) {
    std::ifstream file(assets().templates / "wording" / (language + ".json"));
    return json::parse(file);
}

/// Path and text of every key of a wording file.
std::map<std::string, std::string> texts_by_key(const json& object, const std::string& path = "") {
    std::map<std::string, std::string> all;
    for (const auto& [key, value] : object.items()) {
        if (value.is_object()) {
            all.merge(texts_by_key(value, path + "/" + key));
        } else {
            all[path + "/" + key] = value.get<std::string>();
        }
    }
    return all;
}

/// Of the plural: a language may say "the only one" where another has the number 1.
std::set<std::string> placeholders(const std::string& pattern) {
    static const std::regex k_placeholder(R"(\{[^}]*\})");
    const std::string text = with_forms_of(pattern, [](const std::string&) { return false; });
    return {std::sregex_token_iterator(text.begin(), text.end(), k_placeholder), {}};
}

/// Every number of a text, with a point as decimal sign, in order of size; digests and names are left out.
std::vector<std::string> numbers_of(std::string text, const std::string& sign) {
    static const std::regex k_number(R"((^|[^A-Za-z0-9_.,/-])(\d+([.,]\d+)*([eE][+-]?\d+)?)(?![A-Za-z0-9]))");
    std::vector<std::string> all;
    for (std::sregex_iterator at(text.begin(), text.end(), k_number), end; at != end; ++at) {
        std::string number = (*at)[2];
        if (sign == ",") {
            std::replace(number.begin(), number.end(), ',', '.');
        }
        all.push_back(number);
    }
    std::sort(all.begin(), all.end());
    return all;
}

std::string sign_of(const std::string& language) {
    return language == "de" || language == "es" ? "," : ".";
}

std::vector<std::pair<std::string, EvaluationRecord>> all_records() {
    return {{"rotary", test::certified_rotary_record()},          {"budget", test::certified_budget_record()},
            {"rotary specimen", test::sample_record()},           {"budget specimen", test::sample_budget_record()},
            {"laboratories", test::sample_laboratories_record()}, {"methods", test::sample_methods_record()}};
}

/// What is in one and not in the other, to say where two documents differ.
std::string difference(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    std::vector<std::string> only_a;
    std::vector<std::string> only_b;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_a));
    std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(only_b));
    return "only in the first: " + ::testing::PrintToString(only_a) +
           " only in the second: " + ::testing::PrintToString(only_b);
}

// Names that data bring are looked up by Wording::has(): a certificate once had "{heading}: {group}." in it.
TEST(Languages, NoNameLeadsToATextWithPlacesToFill) {
    for (const std::string& language : k_four_languages) {
        const json texts = wording_file(language);
        const Wording words(texts);
        for (const auto& [group, names] : texts.items()) {
            if (!names.is_object()) {
                continue;
            }
            for (const auto& [name, text] : names.items()) {
                const bool stands_by_itself = text.is_string() && placeholders(text.get<std::string>()).empty();
                EXPECT_EQ(words.has(group, name), stands_by_itself) << language << " " << group << " " << name;
            }
        }
    }
}

TEST(WordingFiles, HaveTheSameKeysAndPlaceholders) {
    const std::map<std::string, std::string> english = texts_by_key(wording_file("en"));
    EXPECT_GT(english.size(), 600U);
    for (const std::string& language : k_four_languages) {
        const std::map<std::string, std::string> texts = texts_by_key(wording_file(language));
        EXPECT_EQ(texts.at("/language"), language);
        EXPECT_EQ(texts.at("/document/decimal_sign"), sign_of(language));
        for (const auto& [path, text] : english) {
            const auto found = texts.find(path);
            if (found == texts.end()) {
                ADD_FAILURE() << language << " lacks " << path;
                continue;
            }
            EXPECT_EQ(placeholders(found->second), placeholders(text)) << language << " " << path;
            EXPECT_TRUE(!found->second.empty() || path == "/document/page_end") << language << " " << path;
        }
        for (const auto& [path, text] : texts) {
            EXPECT_TRUE(english.contains(path)) << language << " has " << path << ", which en lacks";
        }
    }
}

TEST(WordingFiles, HoldTextsAndNothingThatMisleads) {
    for (const std::string& language : k_four_languages) {
        for (const auto& [path, text] : texts_by_key(wording_file(language))) {
            EXPECT_EQ(printable(text), text) << language << " " << path;
        }
    }
}

TEST(Languages, NumbersAreTheSameInAllOfThem) {
    for (const auto& [name, record] : all_records()) {
        for (const bool html : {true, false}) {
            const auto text = [&](const std::string& language) {
                return html ? html_text(render_html(record, in_languages({language})))
                            : render_text(record, in_languages({language}));
            };
            const std::vector<std::string> english = numbers_of(text("en"), ".");
            EXPECT_GT(english.size(), 100U) << name;
            for (const std::string& language : k_four_languages) {
                const std::vector<std::string> numbers = numbers_of(text(language), sign_of(language));
                EXPECT_TRUE(numbers == english)
                    << name << (html ? " html " : " text ") << language << ": " << difference(english, numbers);
            }
        }
    }
}

/// Chapter numbers, which keep their points, and sentences of the record, which stay English.
bool keeps_its_point(const std::string& number, const std::string& english_sentences) {
    static const std::set<std::string> k_clauses = {"5.1.2", "4.2.1", "4.2.2", "4.2.3"};
    return k_clauses.contains(number) || english_sentences.find(number) != std::string::npos;
}

TEST(Languages, DecimalSignsFollowTheBindingLanguage) {
    static const std::regex k_with_point(R"(\d+(\.\d+)+)");
    static const std::regex k_with_comma(R"(\d,\d)");
    for (const auto& [name, record] : all_records()) {
        std::string sentences = record.software.version;
        for (const gum::Diagnostic& d : record.diagnostics) {
            sentences += " " + gum::message(d);
        }
        if (record.certificate) {
            for (const certificate::AgreedSpecification& s : record.certificate->data.specifications) {
                sentences += " " + s.clause;
            }
        }
        for (const char* language : {"de", "es"}) {
            const std::string text = html_text(render_html(record, in_languages({language})));
            const auto commas =
                std::distance(std::sregex_iterator(text.begin(), text.end(), k_with_comma), std::sregex_iterator());
            EXPECT_GT(commas, 40) << name << " " << language;
            for (std::sregex_iterator at(text.begin(), text.end(), k_with_point), end; at != end; ++at) {
                EXPECT_TRUE(keeps_its_point(at->str(), sentences))
                    << name << " " << language << ": "
                    << text.substr(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, at->position() - 30)), 50);
            }
        }
        for (const char* language : {"en", "zh-Hant"}) {
            const std::string text = html_text(render_html(record, in_languages({language})));
            EXPECT_FALSE(std::regex_search(text, k_with_comma)) << name << " " << language;
        }
    }
}

TEST(Languages, EveryPrintedNumberOfTheCertificateIsThere) {
    std::size_t count = 0;
    for (const EvaluationRecord& record : {test::certified_rotary_record(), test::certified_budget_record()}) {
        for (const std::string& language : k_four_languages) {
            const std::string html = html_text(render_html(record, in_languages({language})));
            const std::string text = squeezed(render_text(record, in_languages({language})));
            for (const certificate::CertifiedTable& table : record.certificate->tables) {
                for (const certificate::CertifiedColumn& column : table.columns) {
                    for (const certificate::CertifiedValue& v : column.values) {
                        const std::string row =
                            " " + with_decimal_sign(v.printed_value + " " + v.printed_U, sign_of(language)) + " ";
                        EXPECT_THAT(html, HasSubstr(row)) << language;
                        EXPECT_THAT(text, HasSubstr(row)) << language;
                        ++count;
                    }
                }
            }
        }
    }
    EXPECT_GT(count, 4U * 100U);
}

TEST(Languages, PdfHasTheSameNumbers) {
    SKIP_WITHOUT_PDF();
    const EvaluationRecord record = test::certified_rotary_record();
    for (const char* language : {"en", "de", "es"}) {  // Chinese needs fonts that a machine may lack
        const std::string text = pdf_text(render_pdf(record, in_languages({language})));
        if (text.empty()) {
            GTEST_SKIP() << "pdftotext is missing: the numbers of the PDF were not read back";
        }
        const certificate::CertifiedTable& table = record.certificate->tables.front();
        for (std::size_t i = 0; i < table.argument->printed.size(); ++i) {
            std::string row = " " + table.argument->printed[i];
            for (const certificate::CertifiedColumn& column : table.columns) {
                row += " " + column.values[i].printed_value + " " + column.values[i].printed_U;
            }
            EXPECT_THAT(text, HasSubstr(with_decimal_sign(row, sign_of(language)))) << language;
        }
    }
}

TEST(Languages, ABilingualDocumentHoldsBoth) {
    const EvaluationRecord record = test::certified_rotary_record();  // English and German
    const std::string html = render_html(record, assets());
    EXPECT_THAT(html, HasSubstr("<html lang=\"en\">"));
    EXPECT_THAT(html, HasSubstr("Calibration certificate<span class=\"also\" lang=\"de\">Kalibrierschein</span>"));
    const std::string text = render_text(record, assets());
    EXPECT_THAT(text, HasSubstr("Calibration certificate / Kalibrierschein"));
    EXPECT_THAT(text, HasSubstr("Example Calibration Laboratory / Beispiel-Kalibrierlaboratorium"));
    EXPECT_THAT(text, HasSubstr("Results of the calibration / Ergebnisse der Kalibrierung"));
    EXPECT_THAT(squeezed(text), HasSubstr("/ Die Ergebnisse beziehen sich nur auf den beschriebenen Gegenstand"));

    const std::string german_first = render_text(record, in_languages({"de", "zh-Hant"}));
    EXPECT_THAT(german_first, HasSubstr("Kalibrierschein / 校正證書"));
    EXPECT_THAT(german_first, HasSubstr("Anhang (nicht Teil der akkreditierten Ergebnisse): Güte der Ausgleichung"));
    EXPECT_THAT(german_first, Not(HasSubstr("Calibration certificate")));
}

TEST(Languages, NumbersOfABilingualTableAreThoseOfTheBindingLanguage) {
    const json view = certificate_view(test::certified_rotary_record(), read_wording(in_languages({"de", "en"})));
    std::size_t numbers = 0;
    for (const json& section : view["sections"]) {
        for (const json& block : section["blocks"]) {
            for (const json& table : block["table"]) {
                for (const json& row : table["rows"]) {
                    for (const json& cell : row["cells"]) {
                        if (cell["align"] == "number") {
                            ++numbers;
                            EXPECT_TRUE(cell["also"].empty()) << cell.dump();
                            EXPECT_EQ(cell["text"].get<std::string>().find('.'), std::string::npos) << cell.dump();
                            EXPECT_EQ(cell["pad"].get<std::string>().find('.'), std::string::npos) << cell.dump();
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(numbers, 500U);
}

TEST(Languages, TheSecondLanguageStandsWhereItDiffersOnly) {
    const std::vector<std::string> both = {"de", "en"};
    EXPECT_TRUE(also("EXA", both).empty());
    EXPECT_TRUE(also(Text(std::vector<std::string>{"0,5 °", "0.5 °"}), both).empty());
    EXPECT_EQ(also(Text(std::vector<std::string>{"Wert", "Value"}), both),
              json::parse(R"([{"text": "Value", "language": "en"}])"));
    EXPECT_TRUE(also(Text(std::vector<std::string>{"Wert", "Value"}), {"de"}).empty());
    EXPECT_EQ(also(Text(std::vector<std::string>{"x", "\u202Ey"}), both)[0]["text"], "\uFFFDy");
}

TEST(Languages, TextsOfTheCertificateDataFollowTheDocument) {
    const Wording words = read_wording(in_languages({"de", "es"}));
    certificate::LocalisedText text;
    text.by_language = {{"en", "laser"}, {"de", "Laser-"}};
    EXPECT_EQ(words.localised(text).in(0), "Laser-");
    EXPECT_EQ(words.localised(text).in(1), "laser");  // the first one, where there is none in Spanish
    EXPECT_FALSE(words.localised("EX-1").differs());
}

TEST(Languages, ANumberKeepsItsDigitsAndItsForm) {
    const Wording words = read_wording(in_languages({"de", "en"}));
    EXPECT_EQ(words.number("-12.340").in(0), "\u221212,340");
    EXPECT_EQ(words.number("-12.340").in(1), "\u221212.340");
    EXPECT_EQ(words.number("-0.008; -0.010 mg").in(0), "\u22120,008; \u22120,010 mg") << "each of several numbers";
    EXPECT_EQ(words.number("2026-11-18").in(0), "2026-11-18");
    EXPECT_EQ(words.number("1.2E+3").in(0), "1,2\u00A0×\u00A010³");
    EXPECT_EQ(with_power_of_ten("-1.50E-12 nm"), "-1.50\u00A0×\u00A010⁻¹² nm");
    EXPECT_EQ(with_power_of_ten("EXA 5E, 2E+, E5"), "EXA 5E, 2E+, E5") << "names are no numbers";
    EXPECT_EQ(with_power_of_ten("0E+1"), "0");
    EXPECT_EQ(with_power_of_ten("0.0E+3 ± 1.2E+4 nm"), "0 ± 1.2\u00A0×\u00A010⁴ nm");
    EXPECT_EQ(with_power_of_ten("10E+1, 0.10E-3"), "10\u00A0×\u00A010¹, 0.10\u00A0×\u00A010⁻³");
    EXPECT_EQ(words.number(">99.99").in(0), ">99,99");
    EXPECT_EQ(words.number("0.41\u00A0K").in(0), "0,41\u00A0K");
    EXPECT_EQ(words.number("12. ").in(0), "12. ");
}

TEST(Languages, WhatIsMissingIsNamed) {
    try {
        static_cast<void>(render_text(test::sample_record(), in_languages({"en", "fr"})));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0006");
        EXPECT_THAT(e.what(), HasSubstr("\"fr\""));
    }
    EXPECT_THROW(static_cast<void>(render_text(test::sample_record(), in_languages({"en", "de", "es"}))),
                 gum::StorageError);
    json incomplete = json::array({wording_file("en"), wording_file("de")});
    incomplete[1]["sentence"].erase("validity");
    try {
        static_cast<void>(certificate_view(test::sample_record(), Wording(incomplete)));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_THAT(e.what(), HasSubstr("wording de#/sentence/validity"));
    }
}

TEST(Languages, AreThoseOfTheDataUnlessTheAssetsAsk) {
    const EvaluationRecord certified = test::certified_budget_record();
    EXPECT_EQ(languages_of(certified, assets()), (std::vector<std::string>{"en", "de"}));
    EXPECT_EQ(languages_of(certified, in_languages({"es"})), (std::vector<std::string>{"es"}));
    EXPECT_EQ(languages_of(test::sample_record(), assets()), (std::vector<std::string>{"en"}));
    EvaluationRecord many = certified;
    many.certificate->data.languages = {"de", "en", "es"};  // the digital certificate has all of them
    EXPECT_EQ(languages_of(many, assets()), (std::vector<std::string>{"de", "en"}));
}

TEST(Languages, LinesOfChineseTextAreFilledAndNotTooLong) {
    const std::string text = render_text(test::certified_rotary_record(), in_languages({"zh-Hant"}));
    std::istringstream lines(text);
    std::size_t long_lines = 0;
    for (std::string line; std::getline(lines, line);) {
        std::size_t columns = 0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const auto c = static_cast<unsigned char>(line[i]);
            columns += (c & 0xC0U) == 0x80U ? 0U : c >= 0xE3U && c <= 0xE9U ? 2U : 1U;
        }
        EXPECT_LE(columns, 100U) << line;
        long_lines += columns > 90 ? 1U : 0U;
        EXPECT_FALSE(line.starts_with("。") || line.starts_with("，")) << line;
    }
    EXPECT_GT(long_lines, 20U);
}

}  // namespace
}  // namespace gumcert::reports
