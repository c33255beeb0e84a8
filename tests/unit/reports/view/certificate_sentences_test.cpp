// The law of this file: a sentence of a certificate on k, coverage, rule, limits or verdict holds for exactly the rows
// that it speaks of. Certificates are generated; what a sentence speaks of is read back from the document.

#include "reports/forms/asset_files.h"
#include "reports/record/reported_result.h"
#include "reports/view/certificate_identity_sections.h"
#include "reports/view/certificate_statement_sections.h"
#include "reports/view/certified_overview.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using certificate::AgreedSpecification;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Verdict;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string k_raised_begins = "Values marked #: ";
const std::string k_without_begins = "No statement of conformity is made for: ";
const std::string k_decided_begins = "Conformity was decided by rule ";
const std::string k_not_decided_begins = "Conformity was to be decided by rule ";

/// Numbers that are the same on every machine.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ULL + 1U) {}
    std::size_t below(std::size_t n) {
        state_ ^= state_ << 13U;
        state_ ^= state_ >> 7U;
        state_ ^= state_ << 17U;
        return static_cast<std::size_t>((state_ >> 11U) % n);
    }
    bool one_in(std::size_t n) { return below(n) == 0; }
    template <class T>
    const T& of(const std::vector<T>& all) {
        return all[below(all.size())];
    }

private:
    std::uint64_t state_;
};

CertifiedValue drawn_value(Draw& draw, const std::vector<std::string>& coverages, bool may_be_raised) {
    const std::size_t decimals = 1 + draw.below(3);
    const auto number = [&](double v) { return text::fixed(v, static_cast<int>(decimals)); };
    CertifiedValue v =
        test::certified_value(1.0, 0.1, 2.0, {}, {.value = number(1.0), .U = number(0.2), .unit = "nm"}, "L1");
    v.coverage = draw.of(coverages);
    v.printed_k = draw.of<std::string>({"2.00", "2.13", "2.13"});
    if (v.coverage == "student_t") {
        v.nu_eff = v.printed_k == "2.00" ? 400.0 : 20.0;
        v.printed_nu_eff = plain(*v.nu_eff);
    }
    v.raised = may_be_raised && draw.one_in(2);
    return v;
}

Verdict drawn_verdict(Draw& draw, const AgreedSpecification& s, const CertifiedValue& value) {
    Verdict v;
    v.specification = s.id;
    v.rule = s.rule.id;
    v.lower = s.lower;
    v.upper = s.upper;
    v.formula = draw.of<std::string>({"AL = TL, AU = TU", "AL = TL, AU = TU", "AU = TU − U"});
    v.verdict = draw.of<std::string>({"pass", "pass", "fail", "undetermined", "not_applicable"});
    const std::string zeros(value.printed_value.size() - 2, '0');  // to the decimals of the value, as a record has it
    v.printed.lower = "\u2212" + plain(-*s.lower) + "." + zeros;
    v.printed.upper = plain(*s.upper) + "." + zeros;
    if (v.verdict == "not_applicable") {
        v.note = "the value is defined, not measured: it has no uncertainty";
        v.formula = draw.one_in(3) ? "" : v.formula;
        return v;
    }
    v.note = draw.one_in(2) ? "" : "Probabilities are those of the convolution of all input distributions.";
    v.printed.guard_band = draw.one_in(2) ? "0.20" : "0.2";
    v.printed.largest_specific_risk = v.formula.ends_with("U") ? "2.3" : "50";
    v.printed.conformance_probability = "97.7";
    v.printed.specific_risk = "2.3";
    return v;
}

/// Two quantities at points, one alone, none to three specifications of some of them.
EvaluationRecord drawn_record(std::uint64_t seed) {
    Draw draw(seed);
    EvaluationRecord record = test::certified_budget_record();
    certificate::Certificate& c = *record.certificate;
    const CertifiedColumn sample = c.tables.front().columns.front();
    std::vector<std::string> coverages = {"normal"};
    if (!draw.one_in(3)) {
        coverages = {"normal", "student_t", "convolution"};
    }
    const std::size_t raising = draw.below(3);  // none, some, most
    for (std::size_t s = draw.below(4); s > 0; --s) {
        const std::string id = "S" + std::to_string(s);
        AgreedSpecification one =
            test::sample_specification(id, "E", -static_cast<double>(s), 3.0 + static_cast<double>(s), "nm");
        one.document = "Sheet " + std::to_string(s);
        one.rule.id = draw.of<std::string>({"DR-01", "DR-03"});
        c.data.specifications.push_back(std::move(one));
    }
    const auto column = [&](const std::string& name, std::size_t rows) {
        CertifiedColumn made = sample;
        made.result = name;
        made.values.clear();
        const std::size_t stated = draw.below(3);  // for all rows, for some, for none
        const std::size_t block = 1 + draw.below(4);
        for (std::size_t row = 0; row < rows; ++row) {
            CertifiedValue v = drawn_value(draw, coverages, raising > 0);
            v.raised = v.raised || (raising == 2 && !draw.one_in(6));
            const bool has_one = stated == 0 || (stated == 1 && (row / block) % 2 == 0);
            if (has_one && !c.data.specifications.empty()) {
                v.verdict = drawn_verdict(draw, draw.of(c.data.specifications), v);
            }
            made.values.push_back(std::move(v));
        }
        return made;
    };
    CertifiedTable points = c.tables.front();
    points.argument = {.name = "point", .unit = "", .printed_unit = "", .values = {}, .printed = {}};
    const std::size_t rows = 1 + draw.below(9);
    for (std::size_t row = 0; row < rows; ++row) {
        points.argument->values.emplace_back(std::nullopt);
        points.argument->printed.push_back("P" + std::to_string(row + 1));
    }
    points.columns = {column("E", rows), column("F", rows)};
    CertifiedTable alone = c.tables.front();
    alone.columns = {column("l", 1)};
    c.tables = {points, alone};
    return record;
}

/// What a sentence may be about: "E[P1]", "l".
using Places = std::set<std::string>;

void for_each_value(const EvaluationRecord& record,
                    const std::function<void(const std::string& place, const CertifiedValue&)>& see) {
    for (const CertifiedTable& table : record.certificate->tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                see(table.argument ? column.result + "[" + table.argument->printed[row] + "]" : column.result,
                    column.values[row]);
            }
        }
    }
}

Places places_of(const EvaluationRecord& record, const std::function<bool(const CertifiedValue&)>& holds) {
    Places places;
    for_each_value(record, [&](const std::string& place, const CertifiedValue& v) {
        if (holds(v)) {
            places.insert(place);
        }
    });
    return places;
}

/// "E, F[P2], F[P4] to F[P7]" read back.
Places named_in(const EvaluationRecord& record, const std::string& names) {
    std::vector<std::string> order;
    for_each_value(record, [&](const std::string& place, const CertifiedValue&) { order.push_back(place); });
    const auto at = [&](const std::string& place) { return std::find(order.begin(), order.end(), place); };
    Places places;
    for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find(", ", begin), names.size());
        const std::string name = names.substr(begin, end - begin);
        const std::size_t to = name.find(" to ");
        if (to != std::string::npos) {
            const auto first = at(name.substr(0, to)), last = at(name.substr(to + 4));
            if (first == order.end() || last == order.end()) {
                ADD_FAILURE() << "no such rows: " << name;
                return places;
            }
            places.insert(first, last + 1);
        } else {
            const auto of_all = [&](const std::string& place) {
                return place == name || place.starts_with(name + "[");
            };
            if (std::none_of(order.begin(), order.end(), of_all)) {
                ADD_FAILURE() << "no such row: " << name;
            }
            std::copy_if(order.begin(), order.end(), std::inserter(places, places.end()), of_all);
        }
        begin = end + 2;
    }
    return places;
}

/// The values before the colon of a sentence: named ones, "values with the verdict “pass”, “fail”", or those of which no other
/// sentence of its kind speaks.
/// \param told  of what the sentences before it speak
Places values_meant(const EvaluationRecord& record, const std::string& names,
                    const std::function<bool(const CertifiedValue&)>& among, const std::vector<Places>& told) {
    static const std::map<std::string, std::string> ids = {{"pass", "pass"},
                                                           {"fail", "fail"},
                                                           {"undetermined", "undetermined"},
                                                           {"rule not applicable", "not_applicable"}};
    if (names == "all other values that have a verdict") {
        Places rows = places_of(record, among);
        for (const Places& those : told) {
            for (const std::string& place : those) {
                rows.erase(place);
            }
        }
        return rows;
    }
    if (!names.starts_with("values with the verdict ")) {
        return named_in(record, names);
    }
    Places rows;
    for (const auto& [name, id] : ids) {
        if (names.find("“" + name + "”") != std::string::npos) {
            rows.merge(
                places_of(record, [&](const CertifiedValue& v) { return among(v) && v.verdict->verdict == id; }));
        }
    }
    return rows;
}

struct Document {
    std::vector<std::string> uncertainty, conformity, summary;  ///< paragraphs and "label=value", in their order
    std::map<std::string, std::string> limits_in_tables;  ///< "S1 E[P1]" → "T_L T_U" as the table of verdicts has them
};

std::vector<std::string> lines_of(const json& section) {
    std::vector<std::string> lines;
    for (const json& block : section.at("blocks")) {
        for (const json& p : block.at("paragraph")) {
            lines.push_back(p.at("text").get<std::string>());
        }
        for (const json& d : block.at("definitions")) {
            for (const json& row : d.at("rows")) {
                lines.push_back(row.at("label").get<std::string>() + "=" + row.at("value").get<std::string>());
            }
        }
    }
    return lines;
}

/// Column of a table with this head; none.
std::optional<std::size_t> column_of(const json& table, const std::string& head) {
    const json& columns = table.at("columns");
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].at("head") == head) {
            return i;
        }
    }
    return std::nullopt;
}

std::string cell(const json& row, std::optional<std::size_t> column) {
    return column ? row.at("cells").at(*column).at("text").get<std::string>() : std::string();
}

/// Tables of verdicts, each of the specification that stands before it.
void read_verdicts(const json& section, Document& document) {
    std::string sheet;
    for (const json& block : section.at("blocks")) {
        for (const json& d : block.at("definitions")) {
            for (const json& row : d.at("rows")) {
                if (row.at("label") == "Specification") {
                    sheet = row.at("value").get<std::string>();
                }
            }
        }
        for (const json& table : block.at("table")) {
            const auto point = column_of(table, "Point");
            for (const json& row : table.at("rows")) {
                const std::string at = cell(row, point);
                const bool has_point = point && at != "–";
                document.limits_in_tables[sheet + " " + cell(row, 0) + (has_point ? "[" + at + "]" : "")] =
                    cell(row, column_of(table, "T_L")) + " " + cell(row, column_of(table, "T_U"));
            }
        }
    }
}

Document document_of_record(const EvaluationRecord& record) {
    static const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
    const Wording words(texts);
    Document document;
    CertificateBuilder closing(words);
    closing_sections(closing, words, record);
    for (const json& section : closing.take()) {
        if (section.at("id") == "statement_of_uncertainty") {
            document.uncertainty = lines_of(section);
        } else if (section.at("id") == "conformity") {
            document.conformity = lines_of(section);
            read_verdicts(section, document);
        }
    }
    CertificateBuilder first(words);
    const json page = identity_page(first, words, record);
    for (const json& section : page.at("sections")) {
        if (section.at("id") == "summary") {
            document.summary = lines_of(section);
        }
    }
    return document;
}

std::vector<std::string> beginning(const std::vector<std::string>& lines, const std::string& with) {
    std::vector<std::string> found;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(found),
                 [&](const std::string& line) { return line.starts_with(with); });
    return found;
}

/// k that a sentence states; none.
std::optional<std::string> stated_k(const std::string& sentence) {
    const std::size_t at = sentence.find("k = ");
    return at == std::string::npos ? std::nullopt : std::optional(sentence.substr(at + 4, 4));
}

/// "For E[P1]: sentence" parted; no names where it is about all that the section is about.
std::pair<std::optional<std::string>, std::string> parted(const std::string& line) {
    if (!line.starts_with("For ")) {
        return {std::nullopt, line};
    }
    const std::size_t colon = line.find(": ");
    return {line.substr(4, colon - 4), line.substr(colon + 2)};
}

TEST(CertificateSentences, OnKAndCoverageHoldForTheirRows) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const EvaluationRecord record = drawn_record(seed);
        const Document document = document_of_record(record);
        const CertifiedOverview overview(*record.certificate);
        const std::vector<std::string> raised = beginning(document.uncertainty, k_raised_begins);
        std::map<std::string, std::string> sentences;  // by letter; "" where there is one sentence alone
        for (const std::string& line : document.uncertainty) {
            const std::size_t at = line.find("The reported expanded uncertainty");
            if (at == 0 || at == 4) {
                ASSERT_TRUE(sentences.emplace(line.substr(0, at == 0 ? 0 : 3), line).second);
            }
        }
        std::set<std::string> used;
        for_each_value(record, [&](const std::string& place, const CertifiedValue& v) {
            const std::string note = overview.note(v);
            if (v.raised) {
                EXPECT_EQ(note, "#") << place << " has no sentence but that of its mark";
                ASSERT_EQ(raised.size(), 1U);
                EXPECT_EQ(stated_k(raised[0]).value_or(v.printed_k), v.printed_k) << place << ": " << raised[0];
                return;
            }
            ASSERT_TRUE(sentences.contains(note)) << place << " has the note '" << note << "'";
            used.insert(note);
            const std::string& sentence = sentences.at(note);
            EXPECT_EQ(stated_k(sentence).value_or(v.printed_k), v.printed_k) << place << ": " << sentence;
            const char* const kind = v.coverage == "convolution" ? "convolution of the distributions"
                                     : v.coverage == "student_t" ? "for a t-distribution"
                                                                 : "for a normal distribution";
            EXPECT_THAT(sentence, HasSubstr(kind)) << place;
        });
        EXPECT_EQ(used.size(), sentences.size()) << "a sentence about no row";
        EXPECT_EQ(raised.size(), places_of(record, [](const auto& v) { return v.raised; }).empty() ? 0U : 1U);
        // Without a column each k stands in the sentence of its rows.
        if (!overview.k_column()) {
            for (const auto& [note, sentence] : sentences) {
                EXPECT_TRUE(stated_k(sentence)) << sentence;
            }
            for (const std::string& sentence : raised) {
                EXPECT_TRUE(stated_k(sentence)) << sentence;
            }
        }
    }
}

TEST(CertificateSentences, OnRulesAndNotesNameTheirRows) {
    std::size_t decisions = 0, open = 0, notes = 0, by_verdict = 0, others = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const EvaluationRecord record = drawn_record(seed);
        const Document document = document_of_record(record);
        const AgreedSpecification* s = nullptr;
        const auto of_this = [&](const CertifiedValue& v) {
            return v.verdict && s != nullptr && v.verdict->specification == s->id;
        };
        std::map<std::string, Places> said;  // "S1 sentence", rows
        std::map<std::string, Places> noted;
        std::map<std::string, std::vector<Places>> told;  // of a specification; of notes by ""
        const auto has_verdict = [](const CertifiedValue& v) { return v.verdict.has_value(); };
        for (const std::string& line : document.conformity) {
            for (const AgreedSpecification& one : record.certificate->data.specifications) {
                s = line.starts_with("Specification=" + one.document + ",") ? &one : s;
            }
            const auto [names, sentence] = parted(line);
            const bool decided = sentence.starts_with(k_decided_begins);
            if (decided || sentence.starts_with(k_not_decided_begins)) {
                ASSERT_NE(s, nullptr);
                const std::string way = sentence.substr(0, sentence.find('.'));
                const Places rows =
                    names ? values_meant(record, *names, of_this, told[s->id]) : places_of(record, of_this);
                told[s->id].push_back(rows);
                by_verdict += names && names->starts_with("values with") ? 1U : 0U;
                others += names && names->starts_with("all other") ? 1U : 0U;
                ASSERT_TRUE(said.emplace(s->id + " " + way, rows).second) << "said twice: " << line;
                ++(decided ? decisions : open);
                if (decided && sentence.find("Largest specific probability") != std::string::npos) {
                    const std::string risk = sentence.find("pass: 2.3 %") != std::string::npos ? "2.3" : "50";
                    for_each_value(record, [&](const std::string& place, const CertifiedValue& v) {
                        if (rows.contains(place)) {
                            EXPECT_EQ(v.verdict->printed.largest_specific_risk, risk) << place << ": " << line;
                        }
                    });
                }
            }
            if (sentence.starts_with("Probabilities are") || sentence.starts_with("the value is defined")) {
                const Places rows =
                    names ? values_meant(record, *names, has_verdict, told[""]) : places_of(record, has_verdict);
                told[""].push_back(rows);
                ASSERT_TRUE(noted.emplace(sentence, rows).second) << "said twice: " << line;
                ++notes;
            }
        }
        std::map<std::string, Places> true_of, note_of;
        for_each_value(record, [&](const std::string& place, const CertifiedValue& v) {
            if (!v.verdict) {
                return;
            }
            if (!v.verdict->formula.empty()) {
                const bool undecided = v.verdict->verdict == "not_applicable";
                const std::string formula = v.verdict->formula.ends_with("U") && v.verdict->formula.starts_with("AU")
                                                ? "A_U = T_U − U"
                                                : "A_L = T_L, A_U = T_U";
                true_of[v.verdict->specification + " " + (undecided ? k_not_decided_begins : k_decided_begins) +
                        v.verdict->rule + ": " + formula]
                    .insert(place);
            }
            if (!v.verdict->note.empty()) {
                note_of[v.verdict->note].insert(place);
            }
        });
        EXPECT_EQ(said, true_of);
        EXPECT_EQ(noted, note_of);
    }
    EXPECT_GT(decisions, 300U);
    EXPECT_GT(open, 100U);
    EXPECT_GT(notes, 200U);
    EXPECT_GT(by_verdict + others, 0U);
}

TEST(CertificateSentences, OnLimitsStandForEveryRow) {
    std::size_t rows = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const EvaluationRecord record = drawn_record(seed);
        const Document document = document_of_record(record);
        std::map<std::string, const AgreedSpecification*> known;
        std::vector<std::string> expected;
        for (const AgreedSpecification& s : record.certificate->data.specifications) {
            known[s.id] = &s;
            if (!places_of(record, [&](const auto& v) {
                     return v.verdict && v.verdict->specification == s.id;
                 }).empty()) {
                expected.push_back("Tolerance limits=T_L = −" + plain(-*s.lower) +
                                   "\u00A0nm; T_U = " + plain(*s.upper) + "\u00A0nm");
            }
        }
        EXPECT_EQ(beginning(document.conformity, "Tolerance limits="), expected);
        for_each_value(record, [&](const std::string& place, const CertifiedValue& v) {
            if (!v.verdict) {
                return;
            }
            const AgreedSpecification& s = *known.at(v.verdict->specification);
            const auto found = document.limits_in_tables.find(s.document + ", B, 3.2 " + place);
            ASSERT_NE(found, document.limits_in_tables.end()) << place;
            EXPECT_EQ(found->second, v.verdict->printed.lower + " " + v.verdict->printed.upper) << place;
            ++rows;
        });
    }
    EXPECT_GT(rows, 1000U);
}

TEST(CertificateSentences, OfTheFirstPageNameWhatIsDecidedAndWhatIsNot) {
    std::size_t partial = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const EvaluationRecord record = drawn_record(seed);
        const Document document = document_of_record(record);
        const auto& specifications = record.certificate->data.specifications;
        const auto not_abridged = [](const std::string& names) { return names.find(" more") == std::string::npos; };
        std::map<std::string, Places> said, true_of;
        std::set<std::string> with_a_line, with_rows;
        for (const std::string& line : document.summary) {
            for (const AgreedSpecification& s : specifications) {
                const std::string begins = "Conformity=" + s.document + ", B, 3.2; ";
                if (line.starts_with(begins)) {
                    with_a_line.insert(s.id);
                    const std::string names = line.substr(begins.size(), line.find(": ") - begins.size());
                    if (not_abridged(names)) {
                        said[s.id] = named_in(record, names);
                    }
                    partial += names.find('[') != std::string::npos ? 1U : 0U;
                }
            }
        }
        for_each_value(record, [&](const std::string& place, const CertifiedValue& v) {
            if (v.verdict) {
                with_rows.insert(v.verdict->specification);
            }
            if (v.verdict && said.contains(v.verdict->specification)) {
                true_of[v.verdict->specification].insert(place);
            }
        });
        EXPECT_EQ(said, true_of);
        EXPECT_EQ(with_a_line, with_rows);
        const Places open = places_of(record, [](const auto& v) { return !v.verdict; });
        const bool asked = !specifications.empty();
        for (const auto* lines : {&document.summary, &document.conformity}) {
            const std::string label = lines == &document.summary ? "Conformity=" : "";
            const std::vector<std::string> found = beginning(*lines, label + k_without_begins);
            ASSERT_EQ(found.size(), asked && !open.empty() ? 1U : 0U);
            if (!found.empty()) {
                std::string names = found[0].substr(label.size() + k_without_begins.size());
                names.pop_back();
                if (lines == &document.conformity || not_abridged(names)) {
                    EXPECT_EQ(named_in(record, names), open) << found[0];
                }
            }
            EXPECT_EQ(beginning(*lines, label + "No statement of conformity was requested.").size(), asked ? 0U : 1U);
        }
    }
    EXPECT_GT(partial, 50U);
}

std::string together(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        text += line + "\n";
    }
    return text;
}

// ---- one by one ---------------------------------------------------------------------------------------------------

/// One quantity at three points with equal values.
EvaluationRecord at_three_points(const std::function<void(std::vector<CertifiedValue>&)>& change) {
    EvaluationRecord record = test::certified_budget_record();
    CertifiedTable& table = record.certificate->tables.front();
    CertifiedColumn& column = table.columns.front();
    column.result = "E";
    column.values.assign(3,
                         test::certified_value(1.0, 0.1, 2.0, {}, {.value = "1.00", .U = "0.20", .unit = "nm"}, "L1"));
    table.argument = {.name = "point", .unit = "", .printed_unit = "", .values = {}, .printed = {}};
    for (const char* point : {"pH 4", "pH 7", "pH 9"}) {
        table.argument->values.emplace_back(std::nullopt);
        table.argument->printed.emplace_back(point);
    }
    change(column.values);
    return record;
}

TEST(CertificateSentences, TheSummaryNamesTheOnePointOfASpecification) {
    EvaluationRecord record = at_three_points([](auto& values) {
        values[0].verdict = test::sample_verdict(values[0]);
        values[0].verdict->specification = "axial";
    });
    record.certificate->data.specifications = {test::sample_specification("axial", "E[pH 4]", -10.0, 10.0, "nm")};
    const Document document = document_of_record(record);
    EXPECT_THAT(document.summary, ElementsAre("Results=see the following pages",
                                              HasSubstr("Drawing 1234, B, 3.2; E[pH 4]: pass; decision rule DR-03"),
                                              "Conformity=No statement of conformity is made for: E[pH 7], E[pH 9]."));
}

TEST(CertificateSentences, ManyPlacesAreCountedOnTheFirstPageAndNamedLater) {
    EvaluationRecord record = test::certified_rotary_record();
    std::size_t every_other = 0;
    for (CertifiedColumn& column : record.certificate->tables[0].columns) {
        for (CertifiedValue& v : column.values) {
            if (v.verdict && every_other++ % 2 == 1) {
                v.verdict.reset();
            }
        }
    }
    const Document document = document_of_record(record);
    EXPECT_THAT(document.summary.at(1), HasSubstr("EAA[0\u00A0°], EAA[20\u00A0°], "));
    EXPECT_THAT(document.summary.at(1), HasSubstr("EAA[100\u00A0°] and 12 more: pass (18 of 18 values)"));
    EXPECT_THAT(document.conformity.back(), HasSubstr("EAA[350\u00A0°]"));
}

TEST(CertificateSentences, NothingIsMultipliedByKWhereAllIsTheCapability) {
    const EvaluationRecord record = at_three_points([](auto& values) {
        for (CertifiedValue& v : values) {
            v.raised = true;
            v.printed_k = "2.23";
        }
    });
    const std::string text = together(document_of_record(record).uncertainty);
    EXPECT_THAT(text, Not(HasSubstr("is the standard uncertainty of measurement multiplied")));
    EXPECT_THAT(text, Not(HasSubstr("No expanded uncertainty is stated.")));
    EXPECT_THAT(text, HasSubstr("Values marked #: the evaluated expanded uncertainty was smaller"));
    EXPECT_THAT(text, HasSubstr("multiplied by the coverage factor: k = 2.23 is that of the evaluated uncertainty."));
}

TEST(CertificateSentences, AProbabilityOfItsOwnIsThatOfItsResult) {
    EvaluationRecord record = at_three_points([](auto&) {});
    record.coverage_probability = {0.9545, "95.45 %"};
    const Result first = record.results.front();
    record.results.clear();
    for (const char* point : {"pH 4", "pH 7", "pH 9"}) {
        Result r = first;
        r.quantity = "E";
        r.point = point;
        r.coverage_probability = record.results.empty() ? 0.99 : 0.9545;
        record.results.push_back(std::move(r));
    }
    EXPECT_THAT(document_of_record(record).uncertainty.front(),
                HasSubstr("a coverage probability of approximately 95.45 % (E[pH 7], E[pH 9]); 99 % (E[pH 4])."));
}

TEST(CertificateSentences, ARuleThatDecidedNothingIsNotSaidToHaveDecided) {
    EvaluationRecord record = at_three_points([](auto& values) {
        for (CertifiedValue& v : values) {
            v.verdict = test::sample_verdict(v);
            v.verdict->verdict = "not_applicable";
            v.verdict->note = "the value is defined, not measured: it has no uncertainty";
        }
    });
    record.certificate->data.specifications = {test::sample_specification("axial", "E", -10.0, 10.0, "nm")};
    const std::string text = together(document_of_record(record).conformity);
    EXPECT_THAT(text, Not(HasSubstr("Conformity was decided")));
    EXPECT_THAT(text, Not(HasSubstr("Largest specific probability")));
    EXPECT_THAT(
        text,
        HasSubstr("Conformity was to be decided by rule DR-03: A_U = T_U − U, A_L = T_L + U. It is not decided."));
    EXPECT_THAT(text, HasSubstr("Tolerance limits=T_L = −10\u00A0nm; T_U = 10\u00A0nm"));
}

/// A law: what is named contributes to some certified result, and what contributes is named.
TEST(CertificateSentences, OnContributionsNameWhatContributes) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Draw draw(seed);
        EvaluationRecord record = test::certified_budget_record();
        std::string expected;
        for (BudgetRow& row : record.results.front().budget) {
            const bool contributes = !draw.one_in(3);
            row.contribution.number = contributes ? 1.0 : 0.0;
            row.u.number = contributes ? 1.0 : 0.0;
            expected += contributes ? (expected.empty() ? "" : ", ") + row.input : "";
        }
        const std::vector<std::string> lines =
            beginning(document_of_record(record).uncertainty, "Contributions considered: ");
        ASSERT_EQ(lines.size(), expected.empty() ? 0U : 1U);
        if (!expected.empty()) {
            EXPECT_THAT(lines.front(), ::testing::StartsWith("Contributions considered: " + expected + ". "));
        }
    }
}

/// A law: where trials are reported, every uncertain input that the result rests on is named, whatever its sensitivity
/// coefficient is, and none on which it does not rest.
TEST(CertificateSentences, OnContributionsNameWhatTrialsVaryWhereTheyAreReported) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Draw draw(seed);
        EvaluationRecord record = test::certified_budget_record();
        Result& result = record.results.front();
        const bool by_trials = !draw.one_in(3);
        result.reported = reported_result(result);
        ASSERT_NE(result.reported.printed.value, "") << "else it is not what is reported";
        if (by_trials) {
            result.reported.method = "monte_carlo";
            result.reported.interval = {result.value - result.U.value_or(1.0), result.value + result.U.value_or(1.0)};
        }
        // The result names an equation of its own, and this names the inputs.
        record.model.emplace();
        std::string sum = "0.5e-3*1e2";
        std::string expected;
        bool first = true;
        for (BudgetRow& row : result.budget) {
            const bool named = first || !draw.one_in(3);
            row.u.number = draw.one_in(4) && !first ? 0.0 : 1.0;
            row.contribution.number = first ? 1.0 : 0.0;  // a cosine error: the coefficients vanish
            sum += named ? " + cos(" + row.input + ")" : "";
            if (first || (by_trials && named && row.u.number != 0.0)) {
                expected += (expected.empty() ? "" : ", ") + row.input;
            }
            first = false;
        }
        record.model->equations = {result.quantity + " = length*2", "length = " + sum,
                                   "other = e + " + result.quantity};
        const std::vector<std::string> lines =
            beginning(document_of_record(record).uncertainty, "Contributions considered: ");
        ASSERT_EQ(lines.size(), 1U);
        EXPECT_THAT(lines.front(), ::testing::StartsWith("Contributions considered: " + expected + ". ")) << sum;
    }
}

TEST(CertificateSentences, OnMonteCarloSayHowManyTrialsEachValueHadAndWhatIsShown) {
    EvaluationRecord record = test::certified_budget_record();
    Result& first = record.results.front();
    first.reported.method = "monte_carlo";
    first.reported.because = "asymmetric";
    first.reported.value = 1.0;
    first.reported.interval = {0.7, 1.4};
    MonteCarloSummary trials;
    trials.trials = {8080000, "8080000"};
    first.monte_carlo = trials;
    Result second = first;
    second.name = second.quantity = "h";
    second.monte_carlo->trials = {6910000, "6910000"};
    second.reported.interval = {0.6, 1.4};
    Result other = first;  // by the law: its trials are no ones of an interval
    other.name = other.quantity = "x";
    other.monte_carlo->trials = {1000, "1000"};
    other.reported.interval = {0.1, 0.2};
    record.results = {first, second, other};
    CertifiedTable& table = record.certificate->tables.front();
    table.columns.resize(1);
    CertifiedValue value = table.columns[0].values[0];
    value.value = 1.0;
    value.U.reset();
    value.printed_U = value.printed_k = "";
    value.coverage = "monte_carlo";
    value.interval = {0.7, 1.4};
    value.printed_low = "0.70";
    value.printed_high = "1.40";
    table.columns[0].values[0] = value;
    const auto statement = [&] { return together(document_of_record(record).uncertainty); };
    EXPECT_THAT(statement(), HasSubstr("(8080000 trials;"));
    table.columns.push_back(table.columns[0]);
    table.columns[1].result = "h";
    table.columns[1].values[0].interval = {0.6, 1.4};
    EXPECT_THAT(statement(), HasSubstr("(6910000\u00A0…\u00A08080000 trials;"));
    EXPECT_THAT(statement(), HasSubstr("given beside it for comparison"));
    record.certificate->data.annexes = "none";
    EXPECT_THAT(statement(), Not(HasSubstr("given beside it")));
}

TEST(CertificateSentences, OnRisksHaveTheirSubjectAndTheirNumber) {
    EvaluationRecord record = at_three_points([](auto& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i].verdict = test::sample_verdict(values[i]);
            values[i].verdict->verdict = i == 0 ? "conditional_pass" : "pass";
            values[i].verdict->printed.largest_specific_risk = std::to_string(i) + ".3";
            values[i].verdict->false_accept = 0.001 * static_cast<double>(i);
            values[i].verdict->printed.false_accept = "0." + std::to_string(i);
        }
    });
    AgreedSpecification specification = test::sample_specification("axial", "E", -10.0, 10.0, "nm");
    specification.rule = {};
    specification.rule.id = "DR-09";
    specification.rule.method = "4";
    specification.rule.population_deviation = 0.2;
    specification.rule.population_centre = 0.1;
    record.certificate->data.specifications = {specification};
    CertifiedTable& table = record.certificate->tables.front();
    const std::string apart = together(document_of_record(record).conformity);
    EXPECT_THAT(apart, HasSubstr("For a conditional pass the specific probability of false acceptance is larger"))
        << "also where no other risk is told before it";
    EXPECT_THAT(apart, HasSubstr("s_0 = 0.2\u00A0nm; y_0 = 0.1\u00A0nm; method 4"));
    EXPECT_THAT(apart, Not(HasSubstr("Global probability"))) << "the table of verdicts has it";
    table.layout.emplace();
    for (const char* show : {"value", "U", "limit", "verdict"}) {
        table.layout->shown.push_back({.show = show, .of = "E", .heading = {}, .role = "", .stage = ""});
    }
    EXPECT_THAT(together(document_of_record(record).conformity),
                HasSubstr("Global probability of false acceptance (PFA): at most 0.2 % for these values."));
}

TEST(CertificateSentences, AGuardBandOfTwoUnitsIsNotOneNumber) {
    EvaluationRecord record = at_three_points([](auto& values) {
        for (CertifiedValue& v : values) {
            v.verdict = test::sample_verdict(v);
        }
    });
    record.certificate->data.specifications = {test::sample_specification("axial", "E", -10.0, 10.0, "nm")};
    EXPECT_THAT(together(document_of_record(record).conformity), HasSubstr("Guard band w = 0.20"));
    CertifiedColumn other = record.certificate->tables[0].columns[0];
    other.result = "F";
    other.printed_unit = "µm";
    record.certificate->tables[0].columns.push_back(other);
    EXPECT_THAT(together(document_of_record(record).conformity), Not(HasSubstr("Guard band w")));
}

}  // namespace
}  // namespace gumcert::reports
