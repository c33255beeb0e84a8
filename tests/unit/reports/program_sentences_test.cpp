#include "reports/program_sentences.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/forms_of_number.h"
#include "reports/wording.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

json catalogue_file() {
    return json::parse(read_asset(assets().templates / "wording" / "sentences.json"));
}

ProgramSentences sample() {
    return ProgramSentences(json::parse(R"({
        "a": {"en": "the value {value:number} of {name} is missing", "de": "von {name} fehlt der Wert {value}",
              "es": "falta el valor {value} de {name}", "zh-Hant": "{name} 缺值 {value}"},
        "b": {"en": "the standard \"{name}\"", "de": "das Normal „{name}“", "es": "x {name}", "zh-Hant": "y{name}"},
        "c": {"en": "{what:sentence} was late", "de": "{what} kam zu spät", "es": "{what} z", "zh-Hant": "{what}遲"},
        "d": {"en": "It is so.", "de": "Es ist so.", "es": "Es así.", "zh-Hant": "如此。"},
        "e": {"en": "set {{\"k\": 2}} in {file}", "de": "setze {{\"k\": 2}} in {file}", "es": "{file}",
              "zh-Hant": "{file}"}})"));
}

TEST(ProgramSentences, AreFoundWithTheirArguments) {
    const auto found = sample().identified("the value 1.5 mm of R 2.5 is missing");
    ASSERT_TRUE(found.has_value());
    ASSERT_EQ(found->size(), 1U);
    EXPECT_EQ(found->front().id, "a");
    EXPECT_EQ(found->front().text, "the value 1.5 mm of R 2.5 is missing");
    const std::vector<IdentifiedSentence::Argument> arguments = {{"value", "1.5 mm"}, {"name", "R 2.5"}};
    EXPECT_EQ(found->front().arguments, arguments);
    EXPECT_FALSE(sample().identified("the value nothing of R is missing").has_value());  // no number
    EXPECT_FALSE(sample().identified("something else").has_value());
}

/// Numbers of sentences had a hyphen where those of tables have a minus sign; a p below what can be stated was "p = <1E-300".
TEST(ProgramSentences, NumbersHaveTheSignsOfTables) {
    const ProgramSentences all(catalogue_file());
    const std::string many = "All 3 results together are not consistent: chi-square 12 on 2 degrees of freedom, p = ";
    EXPECT_EQ(all.worded(many + "<1E-300.", "en", "."), many.substr(0, many.size() - 2) + "< 1E-300.");
    EXPECT_TRUE(all.worded(many + "<1E-300.", "de", ",").ends_with(", p < 1E-300."));
    EXPECT_TRUE(all.worded(many + "0.012.", "de", ",").ends_with(", p = 0,012."));
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const std::string below = sample().worded("the value -1.5 of R-2 -x is missing", language, ".");
        EXPECT_NE(below.find("\u22121.5"), std::string::npos) << below;
        EXPECT_NE(below.find("R-2 -x"), std::string::npos) << below;
    }
    EXPECT_EQ(with_minus_of_numbers("-0.008; -0.010 mg, 2026-11-30"), "\u22120.008; \u22120.010 mg, 2026-11-30");
    std::string text = "y = ";
    append_value(text, "<x");
    EXPECT_EQ(text, "y = <x");
}

/// Findings on the register of the laboratory, with every reason that it gives; nothing of them stays English.
TEST(ProgramSentences, WordTheRegister) {
    const ProgramSentences all(catalogue_file());
    for (
        const char* english :
        {"the certificate states of the standard \"STD-1\" \"C-1\", and the register \"C-2\"",
         "the certificate states of the standard \"STD-1\" 0.5 mV, and the register nothing",
         "the certificate states of the laboratory \"A\", and the register \"B\"",
         "the certificate states of the accreditation \"A\", and the register \"B\"",
         "the certificate states of the method \"A\", and the register \"B\"",
         "the standard \"STD-1\" cannot be used here: it was not calibrated before 2025-01-01",
         "the standard \"STD-1\" cannot be used here: its calibration was valid to 2025-01-01, and it was used on "
         "2026-01-01",
         "the standard \"STD-1\" cannot be used here: the certificate has no quantity \"voltage\"",
         "the standard \"STD-1\" cannot be used here: the certificate has no range \"10 V\"",
         "the standard \"STD-1\" cannot be used here: the certificate has no mode \"DC\"",
         "the standard \"STD-1\" cannot be used here: 7.5 lies outside of the values that were calibrated",
         "it is not known whether the standard \"STD-1\" can be used here: the certificate has several ranges, and the "
         "use does not say which",
         "it is not known whether the standard \"STD-1\" can be used here: the certificate has several modes, and the "
         "use does not say which",
         "it is not known whether the standard \"STD-1\" can be used here: the certificate does not say for which "
         "range "
         "it holds, and the use is in \"10 V\"",
         "it is not known whether the standard \"STD-1\" can be used here: 7.5 lies between two calibrated values, and "
         "the register states no interpolation",
         "it is not known whether the standard \"STD-1\" can be used here: the day of use is not stated",
         "the standard \"STD-1\" of the certificate is not in the register of the laboratory",
         "the budget uses the standard \"STD-1\", and the list of the certificate does not name it",
         "Name it in the list; its row was added from the register.",
         "by the register, Head may not authorise this certificate: it does not name this person",
         "by the register, Head may not authorise this certificate: the authorisation is valid from 2024-01-01 to "
         "2024-12-31, and not on 2025-01-01",
         "by the register, Head may not authorise this certificate: the method \"CP-1\" is not among those of this "
         "person"}) {
        EXPECT_TRUE(all.identified(english)) << english;
        for (const char* language : {"de", "es", "zh-Hant"}) {
            const std::string worded = all.worded(english, language, ",");
            for (const char* word : {"the ", " and ", "which", "register ", " is ", "may not"}) {
                EXPECT_EQ(worded.find(word), std::string::npos) << worded;
            }
        }
    }
    EXPECT_EQ(
        all.worded("the standard \"STD-1\" cannot be used here: 7.5 lies outside of the values that were calibrated",
                   "de", ","),
        "das Normal „STD-1“ kann hier nicht verwendet werden: 7,5 liegt außerhalb der kalibrierten Werte");
}

/// Numbers get the decimal sign of the language; names stay what they are.
TEST(ProgramSentences, AreWorded) {
    const ProgramSentences all = sample();
    EXPECT_EQ(all.worded("the value 1.5 mm of R 2.5 is missing", "de", ","), "von R 2.5 fehlt der Wert 1,5 mm");
    EXPECT_EQ(all.worded("the standard \"A\" was late", "de", ","), "das Normal „A“ kam zu spät");
    EXPECT_EQ(all.worded("It is so. the standard \"A\"; It is so.", "de", ","),
              "Es ist so. das Normal „A“; Es ist so.");
    EXPECT_EQ(all.worded("It is so. It is so.", "zh-Hant", "."), "如此。如此。");
    EXPECT_EQ(all.worded("It is so. Nobody knows this one. It is so.", "de", ","),
              "Es ist so. Nobody knows this one. Es ist so.");
    EXPECT_EQ(all.worded("set {\"k\": 2} in a.json", "de", ","), "setze {\"k\": 2} in a.json");
    EXPECT_EQ(all.worded("the value 1.5 of R is missing", "en", "."), "the value 1.5 of R is missing");
    EXPECT_EQ(all.worded("the value 1.5 of R is missing", "fr", ","), "the value 1.5 of R is missing");
}

/// A value to be written into a job stays as a job is read.
TEST(ProgramSentences, KeepDecimalPointsOfJson) {
    const ProgramSentences all(catalogue_file());
    EXPECT_EQ(all.worded("where it shows no more, state \"resolution_um\": 0.5", "de", ","),
              "zeigt es nicht mehr an, geben Sie \"resolution_um\": 0.5 an");
}

/// Lists stand between semicolons where commas are decimal signs, and where names have commas.
TEST(ProgramSentences, KeepNamesOfListsWhole) {
    const ProgramSentences all(catalogue_file());
    EXPECT_EQ(all.worded("E, points 1.5, 2", "de", ","), "E, Punkte 1,5; 2");
    EXPECT_EQ(all.worded("E, points 1.5, 2", "zh-Hant", "."), "E，點 1.5、2");
    EXPECT_EQ(all.worded("E, points 1 V, 50 Hz; 2 V, 100 Hz", "de", ","), "E, Punkte 1 V, 50 Hz; 2 V, 100 Hz");
    EXPECT_EQ(all.worded("E, points 1 V, 50 Hz; 2 V, 100 Hz and 3 more", "es", ","),
              "E, puntos 1 V, 50 Hz; 2 V, 100 Hz y 3 más");
    EXPECT_EQ(all.worded("E, points 1 V, 50 Hz; 2 V, 100 Hz", "zh-Hant", "."), "E，點 1 V, 50 Hz；2 V, 100 Hz");
}

/// One pattern is several: with one and with more of a thing, in every language.
TEST(ProgramSentences, HaveFormsOfNumber) {
    const ProgramSentences all(json::parse(R"({"a": {
        "en": "p on {nu} {nu?degree|degrees} of freedom at {n} {n?point|points}",
        "de": "p mit {nu} {nu?Freiheitsgrad|Freiheitsgraden} an {n?einem Punkt|# Punkten}"}})"));
    EXPECT_EQ(all.worded("p on 1 degree of freedom at 5 points", "de", ","), "p mit 1 Freiheitsgrad an 5 Punkten");
    EXPECT_EQ(all.worded("p on 2 degrees of freedom at 1 point", "de", ","), "p mit 2 Freiheitsgraden an einem Punkt");
    EXPECT_EQ(all.worded("p on 1 degree of freedom at 1 point", "de", ","), "p mit 1 Freiheitsgrad an einem Punkt");
    const Wording words(json::parse(R"({"language": "en", "document": {"decimal_sign": "."},
                                        "g": {"t": "{n} {n?result differs|results differ} of {m}"}})"));
    EXPECT_EQ(words.filled("g", "t", {{"n", "1"}, {"m", "1"}}).first(), "1 result differs of 1");
    EXPECT_EQ(words.filled("g", "t", {{"n", "0"}, {"m", "1"}}).first(), "0 results differ of 1");
    EXPECT_THROW(static_cast<void>(words.filled("g", "t", {{"m", "1"}})), gum::StorageError);
}

/// A value ends where its sentence does: half of a list stayed English, "für 36 points of the direction z; 1.03 against …".
TEST(ProgramSentences, AreNoValuesOfEachOther) {
    const ProgramSentences all(catalogue_file());
    const std::string rows =
        "1.03 against a limit of 1.95 for 36 points of the direction z; 1.03 against a limit of 1.95 for 108 points of "
        "all "
        "directions together";
    EXPECT_EQ(all.worded(rows, "de", ","),
              "1,03 gegen eine Grenze von 1,95 für 36 Punkte der Richtung z; 1,03 gegen eine Grenze von 1,95 für 108 "
              "Punkte aller Richtungen zusammen");
    const std::string whole =
        "The limit that the largest of so many points exceeds in 1 of 100 comparisons is the one to "
        "hold it against: " +
        rows + ".";
    for (const char* language : {"de", "es", "zh-Hant"}) {
        EXPECT_THAT(all.worded(whole, language, ","), ::testing::Not(::testing::HasSubstr("points"))) << language;
        EXPECT_THAT(all.worded(whole, language, ","), ::testing::HasSubstr("108")) << language;
    }
    EXPECT_EQ(all.worded("1.0 against a limit of 2.0 for 3 points of the direction x; y", "de", ","),
              "1,0 gegen eine Grenze von 2,0 für 3 Punkte der Richtung x; y")
        << "a name may have a semicolon";
}

TEST(ProgramSentences, RefuseADamagedCatalogue) {
    for (const char* text : {R"({"a": {"de": "x"}})", R"({"a": {"en": "x {name"}})", R"({"a": {"en": "x {n:colour}"}})",
                             R"({"a": {"en": "{a}{b}"}})", R"({"a": "x"})", R"({"a": {"en": 1}})"}) {
        EXPECT_THROW(ProgramSentences(json::parse(text)), gum::StorageError) << text;
    }
    const ProgramSentences all(json::parse(R"({"a": {"en": "x {name}", "de": "y {nome}"}})"));
    EXPECT_THROW(static_cast<void>(all.worded("x z", "de", ",")), gum::StorageError);
}

/// A text that was made to match badly is given up, and in time.
TEST(ProgramSentences, GiveUpOnHostileTexts) {
    const ProgramSentences all(json::parse(R"({"a": {"en": "{a:number} a {b:number} a {c:number} a {d:number} z",
                                                     "de": "{a}{b}{c}{d}"}})"));
    std::string text;
    for (int i = 0; i < 3000; ++i) {
        text += "1 a ";
    }
    EXPECT_EQ(all.worded(text, "de", ","), text);
}

/// Law: every entry of the catalogue, filled with arguments, is found again with the same arguments and worded in each
/// language with them; and no entry hides another one.
TEST(ProgramSentences, AreEachFoundAgain) {
    const json file = catalogue_file();
    const ProgramSentences all(file);
    EXPECT_GT(file.size(), 300U);
    static const std::regex k_placeholder(R"(\{(\w+)(:(\w+))?\})");
    for (const auto& [id, texts] : file.items()) {
        const std::vector<std::string> counted = names_with_forms(texts.at("en").get<std::string>());
        for (const bool one : {false, true}) {
            std::string english;
            std::vector<IdentifiedSentence::Argument> arguments;
            std::string pattern =
                with_forms_of(texts.at("en").get<std::string>(), [&](const std::string&) { return one; });
            std::smatch match;
            int number = 0;
            while (std::regex_search(pattern, match, k_placeholder)) {
                ++number;
                const bool is_count = std::find(counted.begin(), counted.end(), match[1]) != counted.end();
                const std::string value = match[3] == "number" ? std::to_string(number) + ".5"
                                          : is_count           ? std::to_string(number) + "7"
                                                               : "Qx" + std::to_string(number) + "z";
                english += match.prefix().str() + value;
                arguments.push_back({.name = match[1], .value = value});
                pattern = match.suffix();
            }
            english += pattern;
            english =
                std::regex_replace(std::regex_replace(english, std::regex(R"(\{\{)"), "{"), std::regex(R"(\}\})"), "}");
            const auto found = all.identified(english);
            ASSERT_TRUE(found.has_value()) << id << ": " << english;
            ASSERT_EQ(found->size(), 1U) << id << ": " << english;
            if (id != "where/point_name" &&
                id != "finding/numbers_of_point_name") {  // the same words for a name in place of a number
                EXPECT_EQ(found->front().id, id) << english;
                EXPECT_EQ(found->front().arguments, arguments) << id;
            }
            for (const auto& [language, sign] :
                 {std::pair("de", ","), std::pair("es", ","), std::pair("zh-Hant", ".")}) {
                const std::string worded = all.worded(english, language, sign);
                if (id != "finding/P05") {  // it has no words of its own
                    EXPECT_NE(worded, english) << id << " " << language;
                }
                for (const IdentifiedSentence::Argument& argument : arguments) {
                    EXPECT_THAT(worded, ::testing::HasSubstr(argument.value.starts_with("Qx")
                                                                 ? argument.value
                                                                 : with_decimal_sign(argument.value, sign)))
                        << id << " " << language;
                }
            }
        }
    }
}

/// A document shows the sentences of a record in its languages; without a catalogue they stay in English.
TEST(Wording, SaysTheSentencesOfTheProgram) {
    json de = json::parse(R"({"language": "de", "document": {"decimal_sign": ","}})");
    const std::string english = "Probabilities are counted from 1000 Monte Carlo trials.";
    EXPECT_EQ(Wording(de).sentence(english).first(), english);
    de[Wording::k_sentences_key] = catalogue_file();
    const Wording words(de);
    EXPECT_EQ(words.sentence(english).first(),
              "Die Wahrscheinlichkeiten sind aus 1000 Monte-Carlo-Versuchen ausgezählt.");
    EXPECT_EQ(
        words
            .message({.code = "GC-BUDGET-0022",
                      .where = "result y",
                      .what = "1000 trials, and the results have not stabilised",
                      .rule = "",
                      .action = "Raise adaptive.max_trials, or ask for one digit."})
            .first(),
        "Ergebnis y — 1000 Versuche, und die Ergebnisse sind nicht stabil — Erhöhen Sie adaptive.max_trials, oder "
        "verlangen Sie nur eine Stelle.");
}

TEST(Wording, SaysSomethingElseWhereASentenceIsNotKnown) {
    json de = json::parse(R"({"language": "de", "document": {"decimal_sign": ","}})");
    de[Wording::k_sentences_key] = catalogue_file();
    json en = json::parse(R"({"language": "en", "document": {"decimal_sign": "."}})");
    const json both = json::array({de, en});
    const Wording words(both);
    const Text unknown = words.sentence("nobody has ever said this sentence", Text("Meldung X"));
    EXPECT_EQ(unknown.in(0), "Meldung X");
    EXPECT_EQ(unknown.in(1), "nobody has ever said this sentence");
    EXPECT_EQ(words.sentence("stability without homogeneity", Text("Meldung X")).in(0), "Stabilität ohne Homogenität");
}

}  // namespace
}  // namespace gumcert::reports
