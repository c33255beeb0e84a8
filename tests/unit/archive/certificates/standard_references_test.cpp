#include "archive/certificates/standard_references.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::archive {
namespace {

using nlohmann::json;

TEST(NameInAText, IsAWordOfItsOwn) {
    for (const char* const text : {"STD-017", "STD-017, certificate 12", "(STD-017)", "see STD-017.",
                                   "by STD-017; STD-018", "STD-0171 and STD-017"}) {
        EXPECT_TRUE(names(text, "STD-017")) << text;
    }
    for (const char* const text :
         {"", "STD-0171", "XSTD-017", "STD-017-2", "STD-017/A1", "A/STD-017", "STD-01", "std-017"}) {
        EXPECT_FALSE(names(text, "STD-017")) << text;
    }
    EXPECT_FALSE(names("anything", ""));
}

/// Punctuation and blanks of any script end a name, and so does a word of a script without blanks beside it. Only a letter of the
/// same kind, an accent or a digit makes it another one.
TEST(NameInAText, EndsAtPunctuationAndWordsOfAnyScript) {
    for (const char* const text :
         {"„STD-017“", "“STD-017”", "«STD-017»", "STD-017\u00A0(K-0815)", "STD-017\u202Fund STD-018",
          "STD-017，證書 12", "用STD-017校準", "（STD-017）", "STD-017을 사용", "STD-017– from 2024", "STD-017—",
          "STD-017…", "№STD-017", "STD-017²", "STD-017\u3000", "STD-017。", "STD-017\u2010"}) {
        EXPECT_TRUE(names(text, "STD-017")) << text;
    }
    for (const char* const text : {"STD-017é", "ÉSTD-017", "STD-017µ", "STD-017\u0301", "STD-017２", "STD-017ａ",
                                   "STD-017\u20112", "STD\u2011017", "STD-017/Ä", "é-STD-017"}) {
        EXPECT_FALSE(names(text, "STD-017")) << text;
    }
    for (const char* const text : {"標準器", "標準器、天平", "「標準器」", "標準器 STD-017", "標準器STD"}) {
        EXPECT_TRUE(names(text, "標準器")) << text;
    }
    for (const char* const text : {"標準器2", "標準器-2", "標準", "標-準器", "標準器\u0301"}) {
        EXPECT_FALSE(names(text, "標準器")) << text;
    }
    EXPECT_TRUE(names("STD-017\xFF", "STD-017")) << "no UTF-8";
    EXPECT_TRUE(names("\x80STD-017", "STD-017")) << "no UTF-8";
}

/// Names in all scripts with neighbours of the same script: where words have blanks between them a letter beside a name makes
/// another word of it, and where they have none nobody can tell, and it is found.
TEST(NameInAText, StandsBetweenWordsOfItsOwnScript) {
    const struct {
        const char *before, *name, *after;
        bool has_blanks;
    } scripts[] = {
        {"用", "標準器", "校準", false},
        {"使用", "量块甲", "进行校准", false},
        {"この", "標準器", "を使う", false},
        {"コノ", "ブロックゲージ", "ヲ", false},
        {"本", "ひょうじゅん", "で", false},
        {"새", "표준기", "를 사용", false},
        {"ใช้", "เครื่องมาตรฐาน", "สอบเทียบ", false},
        {"ໃຊ້", "ມາດຕະຖານ", "ວັດ", false},
        {"ប្រើ", "ស្តង់ដារ", "វាស់", false},
        {"𠮷", "標準𠮷", "𠮷", false},
        {"with", "Normal", "block", true},
        {"с", "Эталон", "ом", true},
        {"με", "Πρότυπο", "α", true},
        {"ה", "תקן", "ים", true},
        {"ال", "معيار", "ية", true},
        {"एक", "मानक", "ता", true},
        {"և", "Չափանմուշ", "ը", true},
    };
    for (const auto& one : scripts) {
        const std::string before = one.before;
        const std::string name = one.name;
        const std::string after = one.after;
        for (const std::string& text : {name, before + " " + name, name + " " + after,
                                        before + "「" + name + "」" + after, before + ", " + name + ". " + after}) {
            EXPECT_TRUE(names(text, name)) << text;
        }
        for (const std::string& text : {before + name, name + after, before + name + after}) {
            EXPECT_EQ(names(text, name), !one.has_blanks) << text;
        }
        EXPECT_FALSE(names(name + "2", name)) << name;
        EXPECT_FALSE(names(name + "-2", name)) << name;
        EXPECT_TRUE(names(before + "STD-017" + after, "STD-017") || one.has_blanks) << before;
    }
}

/// Points of Hebrew and Arabic are written or not, such as the endings of cases: the word before them is the same one. What goes on
/// behind them, or makes another letter of the last one, makes another word.
TEST(NameInAText, EndsBeforePointsOfItsLetters) {
    const std::string arabic = "\u0645\u0639\u064A\u0627\u0631";
    const std::string hebrew = "\u05EA\u05E7\u05DF";
    for (const std::string& text : {arabic + "\u064C", arabic + "\u0650\u0651 2", arabic + "\u064F, 2"}) {
        EXPECT_TRUE(names(text, arabic)) << text;
    }
    for (const std::string& text : {hebrew + "\u05B8", hebrew + "\u05BC\u05B8 2"}) {
        EXPECT_TRUE(names(text, hebrew)) << text;
    }
    for (const std::string& text :
         {arabic + "\u0650\u064A\u0629", arabic + "\u06502", arabic + "\u0650-2", arabic + "\u0654"}) {
        EXPECT_FALSE(names(text, arabic)) << text;
    }
    EXPECT_FALSE(names(hebrew + "\u05B8\u05D9\u05DD", hebrew));
}

/// Law: a text that names something has all of its plain words, so that it is found by any of them.
TEST(NameInAText, HasItsWordsInTheText) {
    std::mt19937_64 random(29);
    const std::vector<std::string> parts = {"STD", "017",    "-",  "/", "_", ".",    " ", "標",
                                            "é",   "\u0301", "２", "„", "x", "\xFF", "0"};
    const auto of_chance = [&](std::size_t most) {
        std::string text;
        for (auto n = 1 + random() % most; n > 0; --n) {
            text += parts[random() % parts.size()];
        }
        return text;
    };
    std::size_t found = 0;
    for (int i = 0; i < 200'000; ++i) {
        const std::string name = of_chance(3);
        const std::string text = of_chance(2) + (i % 2 == 0 ? name : "") + of_chance(2);
        if (names(text, name)) {
            ++found;
            const std::vector<std::string_view> words = plain_words_of(text);
            for (const std::string_view word : plain_words_of(name)) {
                EXPECT_NE(std::find(words.begin(), words.end(), word), words.end()) << name << " in " << text;
            }
        }
    }
    EXPECT_GT(found, 10'000U);
    EXPECT_EQ(plain_words_of("STD-017"), (std::vector<std::string_view>{"STD", "017"}));
    EXPECT_TRUE(plain_words_of("„…“").empty());
}

TEST(FileOfTheRegister, SaysWhichStandardItIs) {
    EXPECT_EQ(standard_of_file("laboratory/standards/STD-017.json"), "STD-017");
    EXPECT_EQ(standard_of_file("laboratory:/standards/STD-017.json"), "STD-017");
    EXPECT_EQ(standard_of_file("standards/STD-017.json"), "STD-017");
    EXPECT_EQ(standard_of_file("other_standards/STD-017.json"), "");
    EXPECT_EQ(standard_of_file("laboratory/standards/old/STD-017.json"), "");
    EXPECT_EQ(standard_of_file("laboratory/customers/CUST-3.json"), "");
}

TEST(RecordReferences, AreTakenFromEveryPlace) {
    const nlohmann::json record = {
        {"title", "STD-9 is in the title only"},
        {"certificate",
         {{"data",
           {{"dates", {{"performed_from", "2026-01-02"}, {"performed_to", "2026-01-04"}}},
            {"standards", {{{"identification", "STD-1"}, {"certificate", "NMI-1"}}, "STD-2"}},
            {"conditions", {{{"sensor", "T-04"}}}}}}}},
        {"results", {{"l", {{"budget", {{{"source", "STD-3, certificate NMI-3"}}}}}}}},
        {"job",
         {{"files",
           {{{"name", "standards/STD-4.json"},
             {"encoding", "utf-8"},
             {"content",
              "// as files of jobs may have\n"
              R"({"calibrations": [{"certificate": "NMI-4"}]})"}}}},
          {"document", {{"inputs", {{"x", {{"source", {{"en", "STD-5"}, {"de", "Normal STD-5"}}}}}}}}}}}};
    const std::optional<RecordReferences> found = references_of(record.dump());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->used_from, "2026-01-02");
    EXPECT_EQ(found->used_to, "2026-01-04");
    const auto named = [&](const std::string& name) {
        return std::any_of(found->references.begin(), found->references.end(),
                           [&](const StandardReference& one) { return names(one.text, name); });
    };
    for (const char* const name : {"STD-1", "NMI-1", "STD-2", "T-04", "STD-3", "NMI-3", "STD-4", "NMI-4", "STD-5"}) {
        EXPECT_TRUE(named(name)) << name;
    }
    EXPECT_FALSE(named("STD-9"));
    EXPECT_FALSE(references_of("no record"));
}

/// The work was done before the certificate was authorised and issued, nobody knows how long before.
TEST(RecordReferences, TakeNoDayOfIssueForTheFirstDayOfTheWork) {
    const auto days_of = [](const std::string& dates) {
        const auto found = references_of(R"({"certificate": {"data": {"dates": )" + dates + "}}}");
        return found ? found->used_from + "/" + found->used_to : "nothing";
    };
    EXPECT_EQ(days_of(R"({"issued": "2026-05-06"})"), "/2026-05-06");
    EXPECT_EQ(days_of(R"({"authorised": "2026-05-05", "issued": "2026-05-06"})"), "/2026-05-05");
    EXPECT_EQ(days_of(R"({"performed_to": "2026-05-04", "issued": "2026-05-06"})"), "/2026-05-04");
    EXPECT_EQ(days_of(R"({"performed_from": "2026-05-03", "issued": "2026-05-06"})"), "2026-05-03/2026-05-03");
    EXPECT_EQ(days_of("{}"), "/");
    const auto of_report = references_of(R"({"comparison": {"issuer": {"number": "CMP-1", "issued": "2026-05-06"}}})");
    EXPECT_EQ(of_report->used_from + "/" + of_report->used_to, "/2026-05-06") << "the report of a comparison";
}

/// Numbers that a job takes from the register are corrected with it, those beside a source are not.
TEST(JobFile, TellsWhatItStatesOfAStandardItself) {
    const json job = json::parse(R"({
        "inputs": {
            "a": {"standard": "STD-1", "source": "STD-1, with its drift"},
            "b": {"value": 1, "u": 2, "source": "STD-1, certificate 7"},
            "c": {"components": [{"u": 1, "source": {"en": "drift", "de": "Drift von STD-1"}}, {"source": "STD-12"}]},
            "d": {"standard": "STD-2", "source": "compared with STD-1"}},
        "title": "STD-1",
        "standards": ["STD-1", {"identification": "STD-1", "U": 3}, {"certificate": "C-7"}, {"certificate": "C-77"}],
        "conditions": [{"sensor": "STD-1"}]})");
    EXPECT_EQ(stated_by_hand(job, {"STD-1", "C-7"}),
              (std::vector<std::string>{"/conditions/0/sensor", "/inputs/b/source", "/inputs/c/components/0/source",
                                        "/inputs/d/source", "/standards/1", "/standards/2"}));
    EXPECT_TRUE(stated_by_hand(json(), {"STD-1"}).empty());
    EXPECT_TRUE(stated_by_hand(job, {"STD-3"}).empty());
}

using SaidTexts = std::set<std::pair<StandardReference::Kind, std::string>>;

void add_texts(const json& value, StandardReference::Kind kind, SaidTexts& said) {
    if (value.is_string() && value != "") {
        said.emplace(kind, value.get<std::string>());
    } else if (value.is_structured()) {
        for (const json& item : value) {
            add_texts(item, kind, said);
        }
    }
}

/// What a record says, looked for in the whole of its value.
void add_said(const json& value, SaidTexts& said) {
    for (const auto& [key, item] : value.items()) {
        if (value.is_object() && key == "standards") {
            for (const json& row : item.is_array() ? item : json::array({item})) {
                if (!row.is_object()) {
                    add_texts(row, StandardReference::Kind::traceability, said);
                }
                for (const char* const member : {"identification", "certificate"}) {
                    if (row.is_object() && row.contains(member) && row[member].is_string()) {
                        add_texts(row[member], StandardReference::Kind::traceability, said);
                    }
                }
            }
        } else if (value.is_object() && (key == "source" || key == "sensor" || key == "standard")) {
            add_texts(item, StandardReference::Kind::source, said);
        } else if (item.is_structured()) {
            add_said(item, said);
        }
    }
}

/// Any value, with the keys that mean something in any place.
json value_of_chance(std::mt19937_64& random, int depth) {
    static const std::vector<std::string> k_keys{"a",        "b",         "source",         "sensor",
                                                 "standard", "standards", "results",        "dates",
                                                 "files",    "",          "identification", "certificate"};
    const auto kind = random() % (depth > 0 ? 8U : 4U);
    if (kind < 4) {
        return kind == 0   ? json("S-" + std::to_string(random() % 50))
               : kind == 1 ? json("")
               : kind == 2 ? json(static_cast<double>(random() % 100) / 8)
                           : json(nullptr);
    }
    json value = kind < 6 ? json::object() : json::array();
    for (auto n = random() % 5; n > 0; --n) {
        json item = value_of_chance(random, depth - 1);
        if (value.is_object()) {
            value[k_keys[random() % k_keys.size()]] = std::move(item);
        } else {
            value.push_back(std::move(item));
        }
    }
    return value;
}

TEST(RecordReferences, AreThoseOfTheWholeValue) {
    std::mt19937_64 random(11);
    constexpr int k_records = 3000;
    std::size_t found = 0;
    for (int i = 0; i < k_records; ++i) {
        json record = json::object();
        for (const char* const key : {"results", "certificate", "source", "standards", "title"}) {
            record[key] = value_of_chance(random, 6);
        }
        SaidTexts expected;
        add_said(record, expected);
        SaidTexts said;
        const std::optional<RecordReferences> read = references_of(record.dump(i % 2 == 0 ? -1 : 1));
        ASSERT_TRUE(read);
        for (const StandardReference& one : read->references) {
            EXPECT_TRUE(said.emplace(one.kind, one.text).second) << "said twice";
        }
        EXPECT_EQ(said, expected) << record.dump();
        found += said.size();
    }
    EXPECT_GT(found, 2U * k_records);
    for (const char* const text :
         {"", "[]", "1", "[{\"source\": \"S\"}]", "{\"source\": \"S\"", "{} x", "{\"a\": 1e999}"}) {
        EXPECT_FALSE(references_of(text)) << text;
    }
}

}  // namespace
}  // namespace gumcert::archive
