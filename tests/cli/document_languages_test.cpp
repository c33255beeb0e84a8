// No English sentence of the program, and no foreign decimal sign, on a document of another language.
#include <regex>
#include <set>

#include "tests/cli/program.h"
#include "tests/support/case_count.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

const std::vector<std::string> k_languages = {"de", "es", "zh-Hant"};

/// Jobs of every kind that a certificate or a report is made of.
const std::vector<std::string> k_jobs = {
    "certificate/end_gauge.json", "certificate/rotary_table.json",
    "end_gauge/job.json",         "gauge_block/job.json",
    "multimeter/job.json",        "resistance_and_reactance/job.json",
    "thermometer/job.json",       "comparison/key_comparison.json",
    "comparison/methods.json",    "comparison/proficiency_test.json",
};

std::string in_one_line(const std::string& text) {
    return std::regex_replace(text, std::regex(R"(\s+)"), " ");
}

std::size_t words_of(const std::string& text) {
    static const std::regex k_word(R"([A-Za-z]{2,})");
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), k_word), std::sregex_iterator()));
}

json wording(const std::string& language) {
    return json::parse(bytes_of(fs::path(GUMCERT_SOURCE_DIR) / "templates" / "wording" / (language + ".json")));
}

/// Every sentence of a wording file by its key, without its values: the parts between `{…}` that have four words.
std::map<std::string, std::vector<std::string>> sentences_of(const json& group, const std::string& at = "") {
    std::map<std::string, std::vector<std::string>> all;
    static const std::regex k_value(R"(\{[^}]*\})");
    for (const auto& [key, value] : group.items()) {
        if (value.is_object()) {
            all.merge(sentences_of(value, at + "/" + key));
            continue;
        }
        const std::string text = value.get<std::string>();
        for (std::sregex_token_iterator part(text.begin(), text.end(), k_value, -1), end; part != end; ++part) {
            if (words_of(*part) >= 4) {
                all[at + "/" + key].push_back(*part);
            }
        }
    }
    return all;
}

/// What a person wrote in the job, as one text.
std::string stated_by_people(const json& record) {
    return record.at("job").dump() + record.value("certificate", json()).dump() + record.at("software").dump();
}

/// English sentences of the record: what the program put there.
std::vector<std::string> program_sentences(const json& record) {
    std::vector<std::string> all;
    for (const json& statement : record.at("statements")) {
        all.push_back(statement.at("text"));
    }
    for (const json& d : record.at("diagnostics")) {
        for (const char* key : {"what", "rule", "action"}) {
            all.push_back(d.at(key));
        }
    }
    const auto add = [&](const json& texts) {
        for (const json& text : texts) {
            all.push_back(text);
        }
    };
    if (record.at("comparison").is_object()) {
        add(record.at("comparison").at("remarks"));
    }
    if (record.at("rotary").is_object()) {
        const json& rotary = record.at("rotary");
        all.push_back(rotary.at("adjustment").at("variance_factor").at("reason"));
        all.push_back(rotary.at("adjustment").at("global_test").at("meaning"));
        if (rotary.at("iso230_2").is_object()) {
            add(rotary.at("iso230_2").at("remarks"));
        }
    }
    for (const auto& [name, result] : record.at("results").items()) {
        all.push_back(result.at("coverage_note"));
    }
    return all;
}

/// Numbers with a point on a page that has decimal commas. Clauses of documents ("JCGM 100:2008, 5.1.2"), names, and
/// what people wrote may have one.
std::set<std::string> numbers_with_point(const std::string& document, const std::string& by_people) {
    static const std::regex k_number(R"((^|[^A-Za-z0-9_.:/-])(\d+\.\d+)(?![.\d]*[A-Za-z_/]))");
    static const std::regex k_clause(
        R"((JCGM|ISO|ILAC|ANSI|ASME|EA|NIT|DIN|IEC|GUM|JJF|PTB|D-SI)[^.;“”"]{0,40}$|(clause|Abschnitt|capítulo|gumcert|Version|versión)[^.]{0,12}$)");
    std::set<std::string> found;
    for (std::sregex_iterator at(document.begin(), document.end(), k_number), end; at != end; ++at) {
        const std::string number = (*at)[2];
        const auto from = static_cast<std::size_t>(at->position(2));
        const std::string before = document.substr(from > 60 ? from - 60 : 0, std::min<std::size_t>(from, 60));
        const bool more_points = document.substr(from + number.size(), 2).find('.') == 0 &&
                                 from + number.size() + 1 < document.size() &&
                                 std::isdigit(static_cast<unsigned char>(document[from + number.size() + 1])) != 0;
        if (!more_points && by_people.find(number) == std::string::npos && !std::regex_search(before, k_clause)) {
            found.insert(before.substr(before.size() > 25 ? before.size() - 25 : 0) + number);
        }
    }
    return found;
}

class DocumentLanguages : public ProgramTest {
protected:
    /// The record of an example job.
    json evaluated(const std::string& job) {
        const fs::path file = folder() / (std::to_string(++count_) + ".json");
        const Ended ended = gumcert({"evaluate", (fs::path(GUMCERT_SOURCE_DIR) / "examples" / job).string(), "-o",
                                     file.string(), "--share", GUMCERT_SOURCE_DIR, "--quiet"});
        EXPECT_TRUE(ended.code == 0 || ended.code == 1) << job << ": " << ended.err;
        record_ = file;
        return json::parse(bytes_of(file));
    }
    std::string rendered(const std::string& format, const std::string& language) {
        const fs::path file = folder() / (std::to_string(++count_) + ".out");
        const Ended ended = gumcert({"render", record_.string(), "--format", format, "--language", language, "-o",
                                     file.string(), "--share", GUMCERT_SOURCE_DIR});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return fs::exists(file) ? in_one_line(bytes_of(file)) : "";
    }

private:
    int count_ = 0;
    fs::path record_;
};

TEST_F(DocumentLanguages, HaveNoEnglishSentenceOfTheProgramAndNoForeignDecimalSign) {
    const std::map<std::string, std::vector<std::string>> english = sentences_of(wording("en"));
    ASSERT_GT(english.size(), 300U);
    const auto stride = test::cases<std::size_t>(3, 1);
    std::size_t first = 0;
    for (const std::string& job : k_jobs) {
        const json record = evaluated(job);
        const std::string people = stated_by_people(record);
        const bool comparison = record.at("kind") == "comparison";
        ++first;
        for (const std::string format : {"text", "html", "dcc"}) {
            if (comparison && format == "dcc") {
                continue;
            }
            ++first;  // of the next document another language
            for (std::size_t k = first % stride; k < k_languages.size(); k += stride) {
                const std::string& language = k_languages[k];
                const json own = wording(language);
                const std::string document = rendered(format, language);
                ASSERT_FALSE(document.empty());
                for (const std::string& text : program_sentences(record)) {
                    if (words_of(text) >= 3 && people.find(json(text).dump()) == std::string::npos) {
                        EXPECT_EQ(document.find(in_one_line(text)), std::string::npos)
                            << job << ", " << format << ", " << language << ": " << text;
                    }
                }
                for (const auto& [key, parts] : english) {
                    const json& translated = own.at(json::json_pointer(key));
                    for (const std::string& part : parts) {
                        if (translated.get<std::string>().find(part) == std::string::npos) {
                            EXPECT_EQ(document.find(part), std::string::npos)
                                << job << ", " << format << ", " << language << ": " << key << ": " << part;
                        }
                    }
                }
                if (format == "text" && language != "zh-Hant") {
                    EXPECT_EQ(numbers_with_point(document, people), std::set<std::string>()) << job << ", " << language;
                }
            }
        }
    }
}

/// Items that nothing can be computed for, each for a reason of its own, and one that is compared.
void write_items_without_result(const fs::path& folder) {
    std::ofstream(folder / "job.json") << R"({"schema": "gumcert/job/1", "kind": "comparison", "title": "T",
  "unit": "mm", "participants": {"file": "r.csv"}, "correlations": [["A", "B", 0.5]],
  "items": [{"id": "good", "assigned_value": "weighted_mean"},
            {"id": "nobody", "assigned_value": "weighted_mean"}, {"id": "one", "assigned_value": "median"},
            {"id": "single", "assigned_value": "median"},
            {"id": "reference", "assigned_value": {"method": "reference", "participant": "A"}},
            {"id": "no_u", "assigned_value": "mandel_paule"}, {"id": "no_s", "assigned_value": "vangel_rukhin"},
            {"id": "equal", "assigned_value": "algorithm_a"}, {"id": "same", "assigned_value": "q_hampel"},
            {"id": "zero", "assigned_value": "algorithm_a", "sigma_pt": {"percent": 10}},
            {"id": "correlated", "assigned_value": "mandel_paule"}]})";
    std::ofstream table(folder / "r.csv");
    table << "participant,item,value,u,contributes,reason\n";
    for (const std::string laboratory : {"A", "B", "C"}) {
        const std::string shift = laboratory == "A" ? "0" : laboratory == "B" ? "0.1" : "-0.1";
        table << laboratory << ",good," << shift << ",0.1,yes,\n"
              << laboratory << ",nobody,1,0.1,no,damaged\n"
              << laboratory << ",no_u,1,,yes,\n"
              << laboratory << ",no_s,1,0.1,yes,\n"
              << laboratory << ",equal,2,,yes,\n"
              << laboratory << ",same,2,,yes,\n"
              << laboratory << ",zero," << shift << ",,yes,\n"
              << laboratory << ",correlated," << shift << ",0.1,yes,\n";
    }
    table << "A,one,1,0.1,yes,\nA,single,1,0.1,yes,\nB,single,1,0.1,no,damaged\n"
          << "B,reference,1,0.1,yes,\nC,reference,1,0.1,yes,\n";
}

TEST_F(DocumentLanguages, WordWhyAnItemHasNoResult) {
    write_items_without_result(folder());
    const json record = evaluated((folder() / "job.json").string());
    const json& items = record.at("comparison").at("items_without_result");
    ASSERT_EQ(items.size(), 10U);
    for (const std::string& language : k_languages) {
        for (const std::string format : {"text", "html"}) {
            const std::string document = rendered(format, language);
            for (const json& item : items) {
                for (const char* part : {"what", "rule", "action"}) {
                    EXPECT_EQ(document.find(in_one_line(item.at(part).get<std::string>())), std::string::npos)
                        << language << ": " << item.at(part);
                }
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::cli
