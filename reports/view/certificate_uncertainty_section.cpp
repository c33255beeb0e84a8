#include "reports/view/certificate_uncertainty_section.h"

#include "certificate/statement_of_uncertainty.h"
#include "reports/printed_texts.h"
#include "reports/record/reported_result.h"
#include "reports/reported_results.h"
#include "reports/result_names.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::CertifiedValue;

constexpr std::size_t k_most_contributions = 30;

/// The sentence of the profile in place of U-1 and U-2, with {k} and {coverage} filled in.
Text profile_sentence(const certificate::LocalisedText& sentence, const Text& k, const Text& coverage,
                      const Wording& words) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < words.languages().size(); ++i) {
        std::string out;
        const std::string& text = sentence.in(words.languages()[i]);
        for (std::size_t at = 0; at < text.size();) {
            const auto put = [&](std::string_view name, const Text& value) {
                if (text.compare(at, name.size(), name) != 0) {
                    return false;
                }
                out += value.in(i);
                at += name.size();
                return true;
            };
            if (!put("{k}", k) && !put("{coverage}", coverage)) {
                out += text[at++];
            }
        }
        texts.push_back(std::move(out));
    }
    return Text(std::move(texts));
}

/// Trials of the values that were evaluated by Monte Carlo, where the record holds them: "8080000"; "6910000 … 8080000"
/// where results took different numbers of them.
Text trials_of(const EvaluationRecord& record, const std::vector<const CertifiedValue*>& values, const Wording& words) {
    const auto is_stated = [&](const Result& r) {
        return std::any_of(values.begin(), values.end(), [&](const CertifiedValue* v) {
            return r.reported.interval && v->interval && v->value == r.reported.value &&
                   v->interval->first == (*r.reported.interval)[0] && v->interval->second == (*r.reported.interval)[1];
        });
    };
    const bool some_are_found = std::any_of(record.results.begin(), record.results.end(), is_stated);
    std::map<double, std::string> all;
    for (const Result& r : record.results) {
        if (r.monte_carlo && (is_stated(r) || !some_are_found)) {
            const auto& trials = r.monte_carlo->trials;
            all.emplace(static_cast<double>(trials.number), trials.text.empty() ? plain(trials.number) : trials.text);
        }
    }
    if (all.empty()) {
        return record.rotary && record.rotary->monte_carlo ? words.number(plain(record.rotary->monte_carlo->trials))
                                                           : Text();
    }
    const Text fewest = words.number(all.begin()->second);
    return all.size() == 1 ? fewest : fewest + "\u00A0…\u00A0" + words.number(all.rbegin()->second);
}

/// "shortest" where a certified interval is the shortest one of its result, "symmetric" else.
std::string interval_kind(const EvaluationRecord& record, const std::vector<const CertifiedValue*>& values) {
    for (const Result& r : record.results) {
        if (!r.monte_carlo) {
            continue;
        }
        const MonteCarloSummary& m = *r.monte_carlo;
        const bool shortest = std::any_of(values.begin(), values.end(), [&](const CertifiedValue* v) {
            return v->interval->first == m.shortest.number[0] && v->interval->second == m.shortest.number[1] &&
                   m.shortest.number != m.symmetric.number;
        });
        if (shortest) {
            return "shortest";
        }
    }
    return "symmetric";
}

std::vector<std::string> printed_k(const std::vector<const CertifiedValue*>& values) {
    std::vector<std::string> texts;
    for (const CertifiedValue* v : values) {
        texts.push_back(v->printed_k);
    }
    return texts;
}

Text student_t_sentence(const std::vector<const CertifiedValue*>& values, const Text& k, const Text& p,
                        const Wording& words) {
    std::vector<std::string> nus;
    const CertifiedValue* least = values.front();
    for (const CertifiedValue* v : values) {
        nus.push_back(v->printed_nu_eff);
        least = v->nu_eff.value_or(0.0) < least->nu_eff.value_or(0.0) ? v : least;
    }
    const bool is_one = common(nus).has_value();
    const std::string low = is_one ? nus.front() : certificate::whole_degrees_of_freedom(least->nu_eff.value_or(0.0));
    const Text nu = is_one || low.starts_with('>') ? stated_degrees_of_freedom(low, words)
                                                   : words.fill("nu_between", {{"low", words.number(low)}});
    return words.fill("coverage_student_t", {{"k", k}, {"nu_eff", nu}, {"p", p}});
}

/// U that is the capability: what k and the coverage probability mean for it.
Text sentence_of_raised(const CertifiedOverview& overview, const EvaluationRecord& record, const Wording& words) {
    Text text = words("statement", "raised");
    std::vector<const CertifiedValue*> with_k;
    std::copy_if(overview.raised_values().begin(), overview.raised_values().end(), std::back_inserter(with_k),
                 [](const CertifiedValue* v) { return !v->printed_k.empty(); });
    if (!with_k.empty()) {
        const std::optional<std::string> one_k = common(printed_k(with_k));
        const Text k = one_k ? words.fill("k_one", {{"k", words.number(*one_k)}}) : Text("k");
        text +=
            " " + words.filled("statement", "raised_k", {{"k", k}, {"p", stated_probability(record, with_k, words)}});
    }
    return text;
}

Text coverage_sentence(Coverage c, const CertifiedOverview& overview, const EvaluationRecord& record,
                       const Wording& words) {
    const std::vector<const CertifiedValue*>& values = overview.values(c);
    const certificate::LocalisedText& own = record.certificate->profile.uncertainty_sentence;
    const Text p = stated_probability(record, values, words);
    const std::optional<std::string> one_k = common(printed_k(values));
    const Text k = one_k ? words.fill("k_one", {{"k", words.number(*one_k)}}) : Text("k");
    const bool ordinary = c == Coverage::normal || c == Coverage::student_t;
    if (ordinary && one_k && !own.empty()) {
        return profile_sentence(own, words.number(*one_k), p, words);
    }
    switch (c) {
        case Coverage::normal:
            return words.fill("coverage_normal", {{"k", k}, {"p", p}});
        case Coverage::student_t:
            // The tables have a column of ν_eff by the same question.
            return overview.nu_beside_k() ? words.filled("statement", "uncertainty_k_and_nu", {{"p", p}})
                                          : student_t_sentence(values, k, p, words);
        case Coverage::convolution:
            return words.fill("coverage_convolution", {{"k", k}, {"p", p}});
        case Coverage::monte_carlo:
            return words.fill("coverage_monte_carlo", {{"p", p}});
        case Coverage::interval:
            return words.filled("statement", "uncertainty_interval",
                                {{"trials", trials_of(record, values, words)},
                                 {"kind", words("statement", "interval_" + interval_kind(record, values))},
                                 {"p", p}});
        case Coverage::none:
        case Coverage::nothing:
            break;
    }
    return words.fill("coverage_none", {});
}

/// Whether a result, or its values at the points, stand in the tables of the certificate.
bool is_certified(const Result& result, const EvaluationRecord& record) {
    const std::string& name = result.quantity.empty() ? result.name : result.quantity;
    const auto& tables = record.certificate->tables;
    return std::any_of(tables.begin(), tables.end(), [&](const certificate::CertifiedTable& table) {
        return std::any_of(table.columns.begin(), table.columns.end(),
                           [&](const auto& column) { return column.result == name || column.result == result.name; });
    });
}

/// Names in an equation: of quantities, and of functions, which no row of a budget is called.
std::vector<std::string> names_in_equation(std::string_view equation) {
    const auto begins = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
    };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::vector<std::string> names;
    for (std::size_t at = 0; at < equation.size();) {
        const std::size_t from = at;
        const bool number = is_digit(equation[at]);
        while (at < equation.size() && (begins(equation[at]) || is_digit(equation[at]) || equation[at] == '\'')) {
            ++at;
        }
        if (at == from) {
            ++at;
        } else if (!number) {  // "2e" of 2e-6 is no name
            names.emplace_back(equation.substr(from, at - from));
        }
    }
    return names;
}

/// What the results of a record rest on, as its equations say it.
class Influences {
public:
    explicit Influences(const EvaluationRecord& record) {
        if (!record.model) {
            return;
        }
        unknowns_.insert(record.model->unknowns.begin(), record.model->unknowns.end());
        for (const std::string& equation : record.model->equations) {
            std::vector<std::string> names = names_in_equation(equation);
            std::vector<std::string>& of_left = named_[equation.substr(0, equation.find_first_of(" ="))];
            of_left.insert(of_left.end(), std::make_move_iterator(names.begin()), std::make_move_iterator(names.end()));
        }
    }

    /// Itself, what its equation names, and what these rest on. The points of a table have one equation.
    const std::set<std::string>& of(const std::string& quantity) {
        const auto [known, is_new] = known_.try_emplace(quantity);
        std::set<std::string>& reached = known->second;
        if (is_new) {
            std::vector<std::string> open;
            const auto see = [&](const std::string& name) {
                if (reached.insert(name).second) {
                    open.push_back(name);
                }
            };
            see(quantity);
            for (bool implicit = false; !open.empty();) {
                const std::string name = std::move(open.back());
                open.pop_back();
                see_named(name, see);
                if (!implicit && unknowns_.contains(name)) {
                    implicit = true;
                    see_named("0", see);
                }
            }
        }
        return reached;
    }

private:
    template <class See>
    void see_named(const std::string& left, const See& see) const {
        if (const auto equations = named_.find(left); equations != named_.end()) {
            std::for_each(equations->second.begin(), equations->second.end(), see);
        }
    }

    std::set<std::string> unknowns_;
    std::map<std::string, std::vector<std::string>> named_;  ///< in the equations with this left side
    std::map<std::string, std::set<std::string>> known_;
};

/// Whether a row of a budget adds to the uncertainty of its result. The trials of Monte Carlo vary every uncertain input that the
/// result rests on, also one whose sensitivity coefficient is 0: the angle of a cosine error may be the whole of it.
/// Where no equation says what the result rests on, that is itself alone.
bool contributes(const BudgetRow& row, const Result& result, Influences& all) {
    if (row.contribution.number != 0.0) {
        return true;
    }
    if (const std::string& quantity = result.quantity.empty() ? result.name : result.quantity;
        reported_result(result).method == "monte_carlo" && all.of(quantity).size() > 1) {
        const std::set<std::string>& influences = all.of(quantity);
        return row.role == "fit" ? std::any_of(row.components.begin(), row.components.end(),
                                               [&](const BudgetRow& part) { return influences.contains(part.input); })
                                 : row.u.number != 0.0 && influences.contains(row.input);
    }
    // Where no row has a sensitivity the uncertainty of the input is all that is known of it.
    const bool has_sensitivities = std::any_of(result.budget.begin(), result.budget.end(),
                                               [](const BudgetRow& r) { return r.contribution.number != 0.0; });
    return !has_sensitivities && row.u.number != 0.0;
}

/// Names of what contributes to the uncertainty of a certified result, each once.
std::vector<Text> contributions(const EvaluationRecord& record, const Wording& words) {
    std::vector<Text> names;
    const auto see = [&](const Text& name) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
        }
    };
    if (record.rotary && !record.rotary->budget_sources.empty()) {
        for (const std::string& source : record.rotary->budget_sources) {
            see(source_name(source, words));
        }
        return names;  // the inputs of the set-up errors have these sources, under other names
    }
    const bool some_are_certified = std::any_of(record.results.begin(), record.results.end(),
                                                [&](const Result& r) { return is_certified(r, record); });
    Influences influences(record);
    for (const Result& r : record.results) {
        for (const BudgetRow& row : r.budget) {
            if ((some_are_certified && !is_certified(r, record)) || !contributes(row, r, influences)) {
                continue;
            }
            if (row.role != "fit") {
                see(name_of_budget_row(row, words));
                continue;
            }
            Text data;
            for (const BudgetRow& part : row.components) {
                if (part.role == "fit_data") {
                    data += (data.empty() ? Text() : words("document", "enumeration")) + part.input;
                }
            }
            see(words.filled("statement", "contribution_of_fit", {{"data", data}, {"name", row.input}}));
        }
    }
    if (names.size() > k_most_contributions) {
        names.resize(k_most_contributions);
        names.emplace_back("…");
    }
    return names;
}

}  // namespace

Text stated_probability(const EvaluationRecord& record, const std::vector<const CertifiedValue*>& values,
                        const Wording& words) {
    const auto has_own = [&](const Result& r) { return r.coverage_probability != record.coverage_probability.number; };
    if (std::none_of(record.results.begin(), record.results.end(), has_own)) {
        return words.number(record.coverage_probability.text);
    }
    const std::set<const CertifiedValue*> these(values.begin(), values.end());
    std::map<double, std::set<const CertifiedValue*>> by_probability;
    for (const certificate::CertifiedTable& table : record.certificate->tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            const std::vector<double> probabilities = coverage_probabilities(record, table, column);
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                if (these.contains(&column.values[row])) {
                    by_probability[probabilities[row]].insert(&column.values[row]);
                }
            }
        }
    }
    Text text;
    for (const auto& [p, of] : by_probability) {
        const Text number = words.number(percent_text(p));
        if (by_probability.size() == 1) {
            return number;
        }
        const auto& some = of;  // Clang 14 lets no lambda capture a structured binding
        const auto named = [&](const CertifiedValue& v) { return some.contains(&v); };
        text += (text.empty() ? Text() : Text("; ")) + number + " (" +
                enumerated(names_of_values(*record.certificate, named, words), words) + ")";
    }
    return text;
}

void uncertainty_section(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record,
                         const CertifiedOverview& overview) {
    builder.section("statement_of_uncertainty");
    if (overview.exact()) {
        builder.paragraph(words("statement", "exact_values"));
    } else if (overview.used().empty() && !overview.raised()) {
        builder.paragraph(words("statement", "no_uncertainty"));
    }
    for (const Coverage c : overview.used()) {
        const std::string letter = overview.letter(c);
        builder.paragraph((letter.empty() ? Text() : Text(letter + " ")) +
                          coverage_sentence(c, overview, record, words));
    }
    for (const Text& sentence : reasons_for_monte_carlo(record, words)) {
        builder.paragraph(sentence);
    }
    if (overview.raised()) {
        builder.paragraph(sentence_of_raised(overview, record, words));
    }
    if (const std::vector<Text> names = contributions(record, words); !names.empty()) {
        const bool annexed = record.certificate->data.annexes != "none";
        builder.paragraph(words.filled("statement", annexed ? "contributions" : "contributions_in_record",
                                       {{"names", enumerated(names, words)}}));
    }
    builder.paragraph(validity_sentence(record.certificate->data, words));
}

}  // namespace gumcert::reports
