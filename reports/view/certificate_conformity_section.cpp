#include "reports/view/certificate_conformity_section.h"

#include "certificate/point_names.h"
#include "certificate/point_tables.h"
#include "gum/quantity/unit.h"
#include "reports/point_headings.h"
#include "reports/printed_texts.h"
#include "reports/record/certified_tables.h"
#include "reports/result_names.h"
#include "reports/view/certified_overview.h"
#include "reports/view/certified_value_tables.h"
#include "reports/view/decision_formula.h"
#include "text/numbers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::AgreedSpecification;
using certificate::Certificate;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

constexpr double k_least_ratio_of_far_limits = 1.0 - 1e-9;
constexpr std::array<const char*, 6> k_verdicts = {"pass", "conditional_pass", "conditional_fail", "undetermined",
                                                   "fail", "not_applicable"};

/// A value with a verdict, and where it stands.
struct Decided {
    const CertifiedColumn* column = nullptr;
    const CertifiedValue* value = nullptr;
    const CertifiedTable::Argument* argument = nullptr;
    std::string at;          ///< printed argument, or what its row shows in its place; "" without
    std::string table = {};  ///< id
    bool is_named = false;   ///< `at` is what its row shows
    bool is_shown = false;   ///< its limits and verdict stand in the table of results
    std::string form = {};   ///< of its values, as in the table of results

    [[nodiscard]] std::string in_form(const std::string& printed) const {
        return certificate::in_form(printed, form, column->unit);
    }
};

std::vector<Decided> decided_by(const Certificate& certificate, const AgreedSpecification& specification) {
    const auto points = certificate::identities_of_rows(certificate.tables);
    std::vector<Decided> all;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t i = 0; i < column.values.size(); ++i) {
                const CertifiedValue& v = column.values[i];
                if (v.verdict && v.verdict->specification == specification.id) {
                    all.push_back({.column = &column,
                                   .value = &v,
                                   .argument = table.argument ? &*table.argument : nullptr,
                                   .at = !table.argument ? std::string()
                                         : certificate::hides_points(table)
                                             ? points.at(table.argument->printed.at(i)).name
                                             : table.argument->printed.at(i),
                                   .table = table.id,
                                   .is_named = certificate::hides_points(table),
                                   .is_shown = shows_verdict(table, column.result),
                                   .form = certificate::form_of_result(table, column.result)});
                }
            }
        }
    }
    return all;
}

/// One text a decided value, for a column of the table of verdicts.
template <class Take>
std::vector<std::string> texts_of(const std::vector<Decided>& decided, Take take) {
    std::vector<std::string> texts;
    for (const Decided& d : decided) {
        texts.push_back(take(d));
    }
    return texts;
}

/// "DR-03: guarded acceptance, w = U"
Text rule_by_name(const std::string& id, const Wording& words) {
    return id + ": " + words("rule_name", id);
}

Text rule_parameters(const AgreedSpecification& s, const Wording& words) {
    Text text;
    const auto parameter = [&](const std::string& name, const std::optional<double>& v, const std::string& unit) {
        if (v) {
            const Text one = words.filled("statement", "rule_parameter",
                                          {{"name", name}, {"value", with_unit(words.number(plain(*v)), unit)}});
            text = text.empty() ? one : text + "; " + one;
        }
    };
    parameter("r", s.rule.guard_factor, "");
    const std::string unit = gum::unit_for_people(s.unit);
    parameter("w", s.rule.guard_band, unit);
    parameter("p", s.rule.probability, "");
    parameter("TUR", s.rule.test_uncertainty_ratio, "");
    parameter("U_max", s.rule.largest_U, unit);
    parameter("EOPR", s.rule.population_reliability, "");
    parameter("s_0", s.rule.population_deviation, unit);
    if (s.rule.population_deviation || s.rule.population_reliability) {
        // Without a centre the population lies in the middle; who recomputes the risk must know it.
        const std::optional<double> middle =
            s.lower && s.upper ? std::optional(0.5 * (*s.lower + *s.upper)) : std::nullopt;
        parameter("y_0", s.rule.population_centre ? s.rule.population_centre : middle, unit);
    }
    if (!s.rule.method.empty()) {
        const Text one = words.filled("statement", "rule_method", {{"method", s.rule.method}});
        text = text.empty() ? one : text + "; " + one;
    }
    return text;
}

/// What a column of points or an input is that limits rest on, as the tables of a certificate show it; "" where none does.
std::string role_in_tables(const Certificate& certificate, const std::string& name) {
    for (const CertifiedTable& table : certificate.tables) {
        for (std::size_t i = 0; table.layout && i < table.layout->columns.size(); ++i) {
            if (table.layout->columns[i].name == name && !table.layout->columns[i].role.empty()) {
                return table.layout->columns[i].role;
            }
        }
    }
    return "";
}

/// ±(0.005 % of the reading + 0.0035 % of 100 mV + 2 · 0.0001 mV)
/// \param role  of what the percentage is of: what was computed is said, whatever a data sheet calls it
/// \param is_rest  entries for ranges stand before it, and one without a range holds for all others
Text accuracy(const certificate::PointLimits::Accuracy& from, const AgreedSpecification& s, const std::string& role,
              bool is_rest, const Wording& words) {
    const std::string unit = gum::unit_for_people(from.unit.empty() ? s.unit : from.unit);
    const bool is_set = role == "nominal" || role == "setting" || role == "reference";
    Text sum;
    const auto add = [&](const Text& part) { sum += sum.empty() ? part : " + " + part; };
    const auto number = [&](double v) { return words.number(plain(v)); };
    if (from.percent_of_reading) {
        add(words.filled("point_table", is_set ? "percent_of_" + role : "percent_of_reading",
                         {{"percent", number(*from.percent_of_reading)}}));
    }
    if (from.percent_of_range) {
        add(words.filled("point_table", "percent_of_range",
                         {{"percent", number(*from.percent_of_range)},
                          {"range", with_unit(number(from.full_scale.value_or(0.0)), unit)}}));
    }
    if (from.digits) {
        add(number(*from.digits) + "\u00A0·\u00A0" + with_unit(number(from.digit.value_or(0.0)), unit));
    }
    if (from.constant) {
        add(with_unit(number(*from.constant), unit));
    }
    const Text whole = "±(" + sum + ")";
    if (!from.range.empty()) {
        return from.range + ": " + whole;
    }
    return is_rest ? words("point_table", "other_ranges") + ": " + whole : whole;
}

Text limits_of_points(const certificate::PointLimits& limits, const AgreedSpecification& s, bool in_results,
                      const Certificate& certificate, const Wording& words) {
    Text text;
    for (const certificate::PointLimits::Accuracy& entry : limits.accuracy) {
        const Text one = accuracy(entry, s, role_in_tables(certificate, limits.of), !text.empty(), words);
        text += text.empty() ? one : "; " + one;
    }
    if (text.empty()) {
        return words("point_table", in_results ? "limits_by_points" : "limits_by_points_below");
    }
    if (limits.about.empty()) {
        return text;
    }
    const std::string role = role_in_tables(certificate, limits.about);
    return words.filled("point_table", "limits_about",
                        {{"limits", text}, {"value", role.empty() ? Text(limits.about) : words("point_table", role)}});
}

bool all_are_shown(const std::vector<Decided>& decided) {
    return std::all_of(decided.begin(), decided.end(), [](const Decided& d) { return d.is_shown; });
}

/// As they were agreed: each is one number, in however many rows it stands and to whatever decimals there.
Text tolerance_limits(const std::vector<Decided>& decided, const AgreedSpecification& s, const Certificate& certificate,
                      const Wording& words) {
    if (s.limits) {
        return limits_of_points(*s.limits, s, all_are_shown(decided), certificate, words);
    }
    const std::string unit = gum::unit_for_people(s.unit);
    const std::string form = common(texts_of(decided, [](const Decided& d) { return d.form; })).value_or("");
    const auto limit = [&](const char* key, const std::optional<double>& agreed) {
        const auto number = [&] {
            return form.empty() ? plain(*agreed) : certificate::in_form(text::shortest_plain(*agreed), form, s.unit);
        };
        return agreed ? words("certificate", key) + " = " +
                            with_unit(words.number(number()), certificate::unit_in_form(unit, form, s.unit))
                      : Text();
    };
    const Text low = limit("TL", s.lower);
    const Text high = limit("TU", s.upper);
    return low.empty() || high.empty() ? low + high : low + "; " + high;
}

void specification_rows(CertificateBuilder& builder, const Wording& words, const Certificate& certificate,
                        const AgreedSpecification& s, const std::vector<Decided>& decided) {
    Facts rows = {{words("certificate", "specification"), document_of(s)}};
    add_fact(rows, words("certificate", "tolerance"), tolerance_limits(decided, s, certificate, words));
    rows.emplace_back(words("certificate", "decision_rule"), rule_by_name(s.rule.id, words));
    const Facts conditions = conditions_of_rule(s, words);
    rows.insert(rows.end(), conditions.begin(), conditions.end());
    add_fact(rows, words("certificate", "agreed_wording"), words.localised(s.rule.text));
    add_fact(rows, words("certificate", "prescribed_by"), s.rule.prescribed_by);
    std::vector<std::string> agreed;
    for (const std::string& part : {s.agreed_by, s.agreed_on, s.agreement}) {
        if (!part.empty()) {
            agreed.push_back(part);
        }
    }
    add_fact(rows, words("certificate", "agreed"), joined(agreed));
    builder.definitions(rows);
}

/// What stands behind the verdict "conditional pass", which is no pass: its risk is another one. None without such values.
///
/// At a tolerance limit the risk is 50 %, and it grows no further inside of it (ILAC-G8:09/2019, 4.2.3), where the other
/// limit is far: with TUR ≥ 1 it is 2 U away, and adds less than 0.01 %. What a distribution that is not symmetric makes
/// of it is seen at the values.
Text risk_of_conditional_pass(const std::vector<Decided>& decided, const Wording& words) {
    const certificate::Verdict* largest = nullptr;
    bool far_limits = true;
    for (const Decided& d : decided) {
        const certificate::Verdict& v = *d.value->verdict;
        far_limits = far_limits && v.test_uncertainty_ratio.value_or(1.0) >= k_least_ratio_of_far_limits;
        if (v.verdict == "conditional_pass" && (largest == nullptr || v.specific_risk > largest->specific_risk)) {
            largest = &v;
        }
    }
    if (largest == nullptr) {
        return {};
    }
    const bool bounded = far_limits && largest->specific_risk <= 0.5;
    return words.filled("statement", bounded ? "conformity_risk_conditional" : "conformity_risk_conditional_narrow",
                        {{"risk", words.number(largest->printed.specific_risk)}});
}

bool is_undecided(const CertifiedValue& v) {
    return v.verdict->verdict == "not_applicable";
}

/// A sentence that holds for some of the decided values.
struct HoldsForSome {
    Text sentence;
    CertifiedOverview::Holds holds;
    std::vector<Text> names = {};  ///< of those values
};

std::vector<const CertifiedValue*> values_of(const Certificate& certificate, const CertifiedOverview::Holds& holds) {
    std::vector<const CertifiedValue*> all;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (const CertifiedValue& v : column.values) {
                if (v.verdict && holds(v)) {
                    all.push_back(&v);
                }
            }
        }
    }
    return all;
}

/// The verdicts of those of the values for which something holds, where it holds for all values with these verdicts: "“pass”, “fail”".
/// Empty else.
Text verdicts_that_tell(const std::vector<const CertifiedValue*>& values, const CertifiedOverview::Holds& holds,
                        const Wording& words) {
    std::vector<std::string> with, without;
    for (const CertifiedValue* v : values) {
        std::vector<std::string>& those = holds(*v) ? with : without;
        if (std::find(those.begin(), those.end(), v->verdict->verdict) == those.end()) {
            those.push_back(v->verdict->verdict);
        }
    }
    const bool apart = std::none_of(with.begin(), with.end(), [&](const std::string& verdict) {
        return std::find(without.begin(), without.end(), verdict) != without.end();
    });
    std::vector<Text> names;
    for (const char* verdict : k_verdicts) {
        if (apart && std::find(with.begin(), with.end(), verdict) != with.end()) {
            names.push_back(words.filled("statement", "quoted_verdict", {{"verdict", words("verdict_name", verdict)}}));
        }
    }
    return enumerated(names, words);
}

/// Sentences about some of the values with a verdict, each with the values that it is about: by name where they are few, else
/// by their verdict where that tells them, for it stands beside each. The most that are left are "all other values", where
/// every one has a sentence.
/// \param among  the values that the sentences speak of
void sentences_about_some(CertificateBuilder& builder, const Wording& words, const Certificate& certificate,
                          std::vector<HoldsForSome> sentences, const CertifiedOverview::Holds& among) {
    constexpr std::size_t k_few = 6;
    const std::vector<const CertifiedValue*> values = values_of(certificate, among);
    const auto write = [&](const char* key, const char* name, const Text& which, const Text& sentence) {
        builder.paragraph(words.filled("statement", key, {{name, which}, {"sentence", sentence}}));
    };
    std::vector<const HoldsForSome*> long_ones;
    for (HoldsForSome& one : sentences) {
        one.names = names_of_values(certificate, one.holds, words);
        const Text verdicts = one.names.size() > k_few ? verdicts_that_tell(values, one.holds, words) : Text();
        if (!verdicts.empty()) {
            write("of_verdicts", "verdicts", verdicts, one.sentence);
        } else if (one.names.size() > k_few) {
            long_ones.push_back(&one);
        } else {
            write("of_rows", "names", enumerated(one.names, words), one.sentence);
        }
    }
    const bool all_told = std::all_of(values.begin(), values.end(), [&](const CertifiedValue* v) {
        return std::any_of(sentences.begin(), sentences.end(), [&](const HoldsForSome& one) { return one.holds(*v); });
    });
    std::stable_sort(long_ones.begin(), long_ones.end(),
                     [](const HoldsForSome* a, const HoldsForSome* b) { return a->names.size() < b->names.size(); });
    for (const HoldsForSome* one : long_ones) {
        if (all_told && sentences.size() > 1 && one == long_ones.back()) {
            builder.paragraph(words.filled("statement", "of_other_values", {{"sentence", one->sentence}}));
        } else {
            write("of_rows", "names", enumerated(one->names, words), one->sentence);
        }
    }
}

/// The global probability of false acceptance, where no table of verdicts states it value by value: ANSI/NCSL Z540.3, 5.3, is
/// about this number, and a note may speak of it.
Text global_risk(const std::vector<Decided>& decided, const Wording& words) {
    const certificate::Verdict* largest = nullptr;
    bool differ = false;
    for (const Decided& d : decided) {
        const certificate::Verdict& v = *d.value->verdict;
        if (v.false_accept && !v.printed.false_accept.empty()) {
            differ = differ || (largest != nullptr && largest->printed.false_accept != v.printed.false_accept);
            largest = largest == nullptr || *v.false_accept > *largest->false_accept ? &v : largest;
        }
    }
    if (largest == nullptr || !all_are_shown(decided)) {
        return {};
    }
    return " " + words.filled("statement", differ ? "conformity_global_risk_most" : "conformity_global_risk",
                              {{"risk", words.number(largest->printed.false_accept)}});
}

/// Guard band and risks of values that were decided by one formula.
Text width_and_risks(const std::vector<Decided>& decided, const Wording& words) {
    const auto bands = common(texts_of(decided, [](const auto& d) {
        return d.value->verdict->printed.guard_band + "\u00A0" + d.column->printed_unit;
    }));
    const auto risks =
        common(texts_of(decided, [](const auto& d) { return d.value->verdict->printed.largest_specific_risk; }));
    const std::string& band = decided.front().value->verdict->printed.guard_band;
    const std::string& unit = decided.front().column->printed_unit;
    Text text;
    if (bands && !band.empty()) {
        text += " " + words.filled("statement", "conformity_guard_band", {{"w", with_unit(words.number(band), unit)}});
    }
    if (risks && !risks->empty()) {
        text += " " + words.filled("statement", "conformity_risk", {{"risk", words.number(*risks)}});
    }
    text += global_risk(decided, words);
    const Text conditional = risk_of_conditional_pass(decided, words);
    return conditional.empty() ? text : text + " " + conditional;
}

/// D-1: by which rule and formula, with which guard band and risk. Each sentence is about the values that were decided
/// so, or that were to be decided so and could not be, and names them where there are others.
void decision_sentences(CertificateBuilder& builder, const Wording& words, const Certificate& certificate,
                        const std::vector<Decided>& all) {
    struct Way {
        std::string rule, formula;
        bool undecided = false;
        bool operator==(const Way&) const = default;
    };
    const auto way_of = [](const CertifiedValue& v) {
        return Way{v.verdict->rule, v.verdict->formula, is_undecided(v)};
    };
    std::vector<Way> ways;
    for (const Decided& d : all) {
        const Way one = way_of(*d.value);
        const bool has_formula = !one.formula.empty();  // else the note says why there is none
        if (has_formula && std::find(ways.begin(), ways.end(), one) == ways.end()) {
            ways.push_back(one);
        }
    }
    const std::string& id = all.front().value->verdict->specification;
    const auto is_of_it = [&](const CertifiedValue& v) { return v.verdict && v.verdict->specification == id; };
    std::vector<HoldsForSome> some;
    for (const Way& way : ways) {
        std::vector<Decided> of_it;
        std::copy_if(all.begin(), all.end(), std::back_inserter(of_it),
                     [&](const Decided& d) { return way_of(*d.value) == way; });
        Text text = words.filled("statement", way.undecided ? "conformity_not_decided" : "conformity_sentence",
                                 {{"rule", way.rule}, {"formula", decision_formula(way.formula, words)}});
        if (!way.undecided) {
            text += width_and_risks(of_it, words);
        }
        if (of_it.size() == all.size()) {
            builder.paragraph(text);
            return;
        }
        some.push_back({text, [=](const CertifiedValue& v) { return is_of_it(v) && way_of(v) == way; }});
    }
    sentences_about_some(builder, words, certificate, some, is_of_it);
}

/// Head of the places of the values: that of their table where all stand in tables of one argument.
Column argument_column(const std::vector<Decided>& decided, const Wording& words) {
    const auto of = [](const Decided& d) { return d.argument == nullptr ? "" : d.argument->name + d.argument->unit; };
    const CertifiedTable::Argument* const argument = decided.front().argument;
    return argument != nullptr && common(texts_of(decided, of))
               ? Column{argument_head(*argument, words), argument->printed_unit, is_numeric(*argument)}
               : Column{words("certificate", "point"), ""};
}

/// One column of the table of verdicts.
struct VerdictColumn {
    Text head;
    std::string unit;
    std::vector<std::string> texts;
};

void verdict_table(CertificateBuilder& builder, const Wording& words, const AgreedSpecification& s,
                   const std::vector<Decided>& decided, const std::string& id) {
    const std::string unit =
        common(texts_of(decided, [](const Decided& d) { return d.column->printed_unit; })).value_or("");
    std::vector<VerdictColumn> numbers;
    const auto number = [&](const char* key, const std::string& in, auto take, bool only_where_different = false) {
        std::vector<std::string> texts = texts_of(decided, take);
        if (any_of(texts) && !(only_where_different && common(texts))) {
            numbers.push_back({words("certificate", key), in, std::move(texts)});
        }
    };
    const auto own_unit_of = [](const Decided& d) {
        return certificate::unit_in_form(d.column->printed_unit, d.form, d.column->unit);
    };
    const auto unit_of_all = common(texts_of(decided, own_unit_of));
    // Values with the signs of their parts beside plain ones of the same unit: it stands at these and not above both.
    const bool is_mixed = !unit.empty() && !unit_of_all;
    const std::string unit_of_values = is_mixed ? "" : unit_of_all.value_or("");
    const auto shown = [&](const Decided& d, const std::string& printed) {
        const std::string own = is_mixed && !printed.empty() ? own_unit_of(d) : "";
        return d.in_form(printed) + (own.empty() ? "" : "\u00A0" + own);
    };
    number("value", unit_of_values, [&](const Decided& d) { return shown(d, d.value->printed_value); });
    number("U_short", unit, [](const Decided& d) { return d.value->printed_U; });
    number("TL", unit_of_values, [&](const Decided& d) { return shown(d, d.value->verdict->printed.lower); });
    number("TU", unit_of_values, [&](const Decided& d) { return shown(d, d.value->verdict->printed.upper); });
    number("AL", unit_of_values,
           [&](const Decided& d) { return shown(d, d.value->verdict->printed.acceptance_lower); });
    number("AU", unit_of_values,
           [&](const Decided& d) { return shown(d, d.value->verdict->printed.acceptance_upper); });
    number("TUR", "", [](const Decided& d) { return d.value->verdict->printed.test_uncertainty_ratio; });
    number("p_c", "%", [](const Decided& d) { return d.value->verdict->printed.conformance_probability; });
    number("risk", "%", [](const Decided& d) { return d.value->verdict->printed.specific_risk; });
    number(
        "largest_risk", "%", [](const Decided& d) { return d.value->verdict->printed.largest_specific_risk; }, true);
    number("false_accept", "%", [](const Decided& d) { return d.value->verdict->printed.false_accept; });
    number("false_reject", "%", [](const Decided& d) { return d.value->verdict->printed.false_reject; });
    const bool any_argument = any_of(texts_of(decided, [](const Decided& d) { return d.at; }));
    std::vector<Column> columns = {{words("certificate", "result"), ""}};
    if (any_argument) {
        columns.push_back(argument_column(decided, words));
    }
    for (const VerdictColumn& column : numbers) {
        columns.push_back({column.head, column.unit, true});
    }
    if (unit.empty() && any_of(texts_of(decided, [](const Decided& d) { return d.column->printed_unit; }))) {
        columns.push_back({words("certificate", "unit"), ""});
    }
    const bool own_unit = columns.size() > numbers.size() + 1 + (any_argument ? 1U : 0U);
    columns.push_back({words("certificate", "verdict"), ""});
    Rows lines;
    for (std::size_t i = 0; i < decided.size(); ++i) {
        std::vector<Text> row = {name_of_result(decided[i].table, decided[i].column->result, words)};
        if (any_argument) {
            row.push_back(decided[i].is_named ? point_in_words(decided[i].at, words) : Text(decided[i].at));
        }
        for (const VerdictColumn& column : numbers) {
            row.emplace_back(column.texts[i]);
        }
        if (own_unit) {
            row.emplace_back(decided[i].column->printed_unit);
        }
        row.push_back(words("verdict_name", decided[i].value->verdict->verdict));
        lines.push_back(std::move(row));
    }
    builder.table(id, words.filled("statement", "conformity_table", {{"specification", document_of(s)}}), columns,
                  lines);
}

void verdict_meanings(CertificateBuilder& builder, const Wording& words, const std::set<std::string>& used) {
    Facts rows;
    for (const char* verdict : k_verdicts) {
        if (used.contains(verdict)) {
            rows.emplace_back(words("verdict_name", verdict), words("verdict_meaning", verdict));
        }
    }
    builder.paragraph(words("statement", "verdicts"));
    builder.definitions(rows);
}

}  // namespace

Facts conditions_of_rule(const AgreedSpecification& s, const Wording& words) {
    Facts rows;
    add_fact(rows, words("certificate", "rule_parameters"), rule_parameters(s, words));
    if (!s.rule.alternative.empty()) {
        rows.emplace_back(words("certificate", "rule_alternative"), rule_by_name(s.rule.alternative, words));
    }
    return rows;
}

std::string document_of(const AgreedSpecification& s) {
    std::string text = s.document.empty() ? s.id : s.document;
    for (const std::string& part : {s.edition, s.clause}) {
        text += part.empty() ? "" : ", " + part;
    }
    return text;
}

void conformity_section(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    builder.section("conformity");
    std::set<std::string> used;
    std::vector<std::string> notes;
    bool all_have_a_note = true;
    std::size_t number = 0;
    for (const AgreedSpecification& s : certificate.data.specifications) {
        const std::vector<Decided> decided = decided_by(certificate, s);
        if (decided.empty()) {
            continue;
        }
        specification_rows(builder, words, certificate, s, decided);
        decision_sentences(builder, words, certificate, decided);
        if (all_are_shown(decided)) {
            builder.paragraph(words("statement", "verdicts_in_tables"));
        } else {
            verdict_table(builder, words, s, decided, "conformity-" + std::to_string(number++));
        }
        for (const Decided& d : decided) {
            used.insert(d.value->verdict->verdict);
            const std::string& note = d.value->verdict->note;
            all_have_a_note = all_have_a_note && !note.empty();
            if (!note.empty() && std::find(notes.begin(), notes.end(), note) == notes.end()) {
                notes.push_back(note);
            }
        }
    }
    const auto without = [&] {
        const std::vector<Text> names = names_of_values(certificate, is_without_verdict, words);
        if (!names.empty()) {
            builder.paragraph(words.filled("statement", "conformity_without", {{"results", enumerated(names, words)}}));
        }
    };
    if (certificate.data.specifications.empty()) {
        builder.paragraph(words("statement", "no_conformity"));
        return;
    }
    if (used.empty()) {
        without();
        return;
    }
    if (all_have_a_note && notes.size() == 1) {
        builder.paragraph(words.sentence(notes.front()));
    } else {
        std::vector<HoldsForSome> some;
        for (const std::string& note : notes) {
            some.push_back({words.sentence(note),
                            [note](const CertifiedValue& v) { return v.verdict && v.verdict->note == note; }});
        }
        sentences_about_some(builder, words, certificate, some,
                             [](const CertifiedValue& v) { return v.verdict.has_value(); });
    }
    verdict_meanings(builder, words, used);
    builder.paragraph(words("statement", "conformity_points"));
    without();
}

}  // namespace gumcert::reports
