#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "reports/record/make/certificate/amended_record.h"
#include "reports/view/certificate_identity_sections.h"
#include "tests/support/filled_certificate_data.h"

// The list of changes of an amendment is read by the customer: no key of the data stands in it, in no language.

namespace gumcert::reports {
namespace {

using certificate::Certificate;
using certificate::Change;

Wording wording_of(const std::string& language) {
    std::ifstream file(GUMCERT_SOURCE_DIR "/templates/wording/" + language + ".json");
    return Wording(nlohmann::json::parse(file));
}

bool is_number_or_language(const std::string& token) {
    return token.find_first_not_of("0123456789") == std::string::npos || token == "en" || token == "de" ||
           token == "es" || token == "zh-Hant";
}

/// Codes that are the same in every language: of clauses of a policy, and of methods of a standard.
bool is_same_in_all(const std::string& code) {
    return (code[0] >= '0' && code[0] <= '9') || code == "rds" || code == "rp10";
}

void expect_words(const Change& change, const Wording& words) {
    std::istringstream tokens(change.where.substr(1));
    for (std::string token; std::getline(tokens, token, '/');) {
        EXPECT_TRUE(is_number_or_language(token) || words.has("change", token) || words.has("certificate", token) ||
                    words.has("heading", token))
            << words.languages().front() << " has no word for " << token << " of " << change.where;
    }
    if (change.kind == "code") {
        EXPECT_TRUE(is_same_in_all(change.after) || words.has("change_value", change.after))
            << words.languages().front() << ": " << change.after << " at " << change.where;
    }
}

TEST(ChangesInWords, NameEveryKeyAndEveryCodeOfTheData) {
    constexpr std::size_t k_most_words = 8;  // of a key with a choice
    std::size_t told = 0;
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const Wording words = wording_of(language);
        for (std::size_t turn = 0; turn < k_most_words; ++turn) {
            Certificate later;
            test::KeyFiller filler(test::KeyFiller::k_every, turn);
            describe(filler, later.data);
            for (const Change& change : changes_between(Certificate(), later)) {
                expect_words(change, words);
                ++told;
            }
        }
    }
    EXPECT_GT(told, 4000U);
}

TEST(ChangesInWords, NameWhatIsPrintedOfAResult) {
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const Wording words = wording_of(language);
        for (const char* kind : {"U",
                                 "k",
                                 "nu_eff",
                                 "u",
                                 "coverage",
                                 "scope_entry",
                                 "raised",
                                 "external",
                                 "specification",
                                 "rule",
                                 "verdict",
                                 "note",
                                 "limit_low",
                                 "limit_high",
                                 "acceptance_low",
                                 "acceptance_high",
                                 "conformance_probability",
                                 "specific_risk",
                                 "largest_specific_risk",
                                 "false_accept",
                                 "false_reject",
                                 "test_uncertainty_ratio",
                                 "heading",
                                 "role",
                                 "stage",
                                 "title",
                                 "group",
                                 "columns"}) {
            EXPECT_TRUE(words.has("change", kind) || words.has("certificate", kind)) << language << ": " << kind;
        }
        for (const char* code : {"yes", "no", "student_t", "normal", "convolution", "monte_carlo", "no_coverage"}) {
            EXPECT_TRUE(words.has("change_value", code)) << language << ": " << code;
        }
    }
}

TEST(ChangesInWords, AreWrittenAsTheDocumentWritesThem) {
    const Wording german = wording_of("de");
    const auto told = [&](const Change& change) {
        return place_of_change(change, german).first() + " | " + side_of_change(change, change.before, german).first() +
               " | " + side_of_change(change, change.after, german).first();
    };
    const auto change = [](const char* kind, const char* where, const char* before, const char* after) {
        return Change{.kind = kind, .where = where, .before = before, .after = after};
    };
    EXPECT_EQ(told(change("number", "/conditions/0/minimum", "19.6", "19.5")),
              "Umgebungsbedingungen und weitere Bedingungen 1: Kleinster Wert | 19,6 | 19,5");
    EXPECT_EQ(told(change("flag", "/method/no_deviations", "true", "false")),
              "Kalibrierverfahren: keine Abweichungen | ja | nein");
    EXPECT_EQ(told(change("code", "/standards/1/role", "reference", "working")),
              "Metrologische Rückführung 2: Rolle | Referenznormal | Gebrauchsnormal oder Messgerät");
    EXPECT_EQ(told(change("text", "/method/version", "2.1", "2.2")), "Kalibrierverfahren: Version | 2.1 | 2.2")
        << "no number";
    EXPECT_EQ(told(change("text", "/accreditation/scope/0/capability/expression", "a", "b")),
              "Akkreditierung: Eintrag des Bereichs 1: Messmöglichkeit: Ausdruck | a | b");
    EXPECT_EQ(told(change("cell", "nominal [1]", "5.1000 mm", "5.1001 mm")), "nominal [1] | 5,1000 mm | 5,1001 mm");
    EXPECT_EQ(told(change("value", "E [No. 2.1, 10.0\u00A0mV]", "1.5 mV", "")), "E [No. 2.1, 10,0\u00A0mV] | 1,5 mV | ")
        << "numbers with a unit";
    EXPECT_EQ(told(change("U", "E [10 V]", "1.5 mV", "")), "E [10 V]: U | 1,5 mV | ");
    EXPECT_EQ(told(change("words", "mark [1]", "No. 2.1", "No. 2.2")), "mark [1] | No. 2.1 | No. 2.2");
    EXPECT_EQ(told(change("limit_high", "E [2]", "1.6 mg", "5 mg")), "E [2]: obere Grenze | 1,6 mg | 5 mg");
    EXPECT_EQ(told(change("raised", "E", "false", "true")), "E: U ist die Messmöglichkeit | nein | ja");
    EXPECT_EQ(told(change("number", "/coverage_probability", "95.45\u00A0%", "95\u00A0%")),
              "Überdeckungswahrscheinlichkeit | 95,45\u00A0% | 95\u00A0%");
    EXPECT_EQ(told(change("role", "x", "reference", "")), "x: Rolle | Referenzwert | ");
}

TEST(ChangesInWords, ComeWithTheirUnitsAsPeopleWriteThem) {
    Certificate earlier;
    earlier.data.conditions.emplace_back();
    earlier.data.conditions.front().unit = "degC";
    Certificate later = earlier;
    later.data.conditions.front().unit = "percent";
    later.data.conditions.front().minimum = 2e-8;
    const std::vector<Change> changes = changes_between(earlier, later);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].after, "0.00000002\u00A0%");
    EXPECT_EQ(changes[1].before + changes[1].after, "°C%");
}

}  // namespace
}  // namespace gumcert::reports
