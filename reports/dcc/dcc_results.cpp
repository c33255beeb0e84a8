#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "gum/rounding.h"
#include "reports/dcc/dcc_joint_results.h"
#include "reports/dcc/dcc_quantity.h"
#include "reports/dcc/dcc_writer.h"
#include "reports/point_headings.h"
#include "reports/reported_results.h"
#include "reports/result_names.h"
#include "reports/view/decision_formula.h"
#include "reports/view/point_table_view.h"

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Verdict;

constexpr const char* k_nothing = "NaN";
// JCGM 100:2008, 7.2.6: at most two digits of an uncertainty say something.
constexpr int k_digits_of_u = 2;

/// What is stated of the uncertainty of a value. A list of D-SI states one of these, so a column whose values state
/// different things is written as one list for each, with the values of its own rows only: the same value twice, once
/// with its uncertainty and once with NaN, would contradict itself.
enum class Stated { expanded, interval, standard, nothing };

bool has_usable_factor(const CertifiedValue& v) {
    return d_si_coverage_factor(v.printed_k) != k_nothing;
}

Stated stated_of(const CertifiedValue& v) {
    if (v.interval && !v.printed_low.empty() && !v.printed_high.empty()) {
        return Stated::interval;
    }
    if (!v.printed_U.empty()) {
        // D-SI has no coverage factor below 1. U is then left out and the standard uncertainty is stated, with a text
        // that says why.
        return has_usable_factor(v) ? Stated::expanded : Stated::standard;
    }
    return v.coverage == "none" && v.u > 0.0 ? Stated::standard : Stated::nothing;
}

std::string distribution_of(const CertifiedValue& v) {
    if (v.coverage == "convolution" || v.coverage == "monte_carlo") {
        return v.coverage;
    }
    // As many degrees of freedom as are printed as infinite leave nothing of Student's t.
    return v.coverage == "student_t" && d_si_number(v.printed_nu_eff) != k_nothing ? "student_t" : "normal";
}

/// One column of one table, and what its lists need.
struct Column {
    const CertifiedTable& table;
    const CertifiedColumn& column;
    bool list;                        ///< lists, even of one row; else single numbers
    Stated stated = Stated::nothing;  ///< what the list that is written states

    /// Whether a value belongs to the list that is written.
    [[nodiscard]] bool has(const CertifiedValue& v) const { return stated_of(v) == stated; }
    [[nodiscard]] const Verdict* verdict(const CertifiedValue& v, const std::string& specification) const {
        return has(v) && v.verdict && v.verdict->specification == specification ? &*v.verdict : nullptr;
    }
    [[nodiscard]] std::vector<std::string> entries(const std::function<std::string(const CertifiedValue&)>& of) const {
        std::vector<std::string> all;
        for (const CertifiedValue& v : column.values) {
            all.push_back(of(v));
        }
        return all;
    }
};

/// An element "si:name", or "si:nameXMLList" with one entry a row, or one where all are the same.
void number_or_list(DccWriter& w, const Column& c, const std::string& name, const std::vector<std::string>& entries) {
    w.xml.element(c.list ? name + "XMLList" : name, c.list ? joined_list(entries) : entries.front());
}

void uncertainty(DccWriter& w, const Column& c) {
    const auto only = [&](const std::function<std::string(const CertifiedValue&)>& text) {
        // Rows of a table share their position in all of its lists: a row of another list has NaN here, also as value.
        return c.entries([&](const CertifiedValue& v) { return c.has(v) ? text(v) : k_nothing; });
    };
    const std::string suffix = c.list ? "XMLList" : "";
    std::vector<std::string> probabilities;
    for (const double probability : coverage_probabilities(w.record(), c.table, c.column)) {
        probabilities.push_back(d_si_probability(probability));
    }
    const auto u = [&] {
        number_or_list(w, c, "si:valueStandardMU", only([](const CertifiedValue& v) {
                           // An interval of a distribution without variance has no standard uncertainty.
                           return v.u > 0.0 ? d_si_number(gum::round_significant(v.u, k_digits_of_u))
                                            : std::string(k_nothing);
                       }));
    };
    w.xml.open("si:measurementUncertaintyUnivariate" + suffix);
    if (c.stated == Stated::expanded) {
        w.xml.open("si:expandedMU" + suffix);
        number_or_list(w, c, "si:valueExpandedMU", only([&](const CertifiedValue& v) {
                           return required_d_si_number(v.printed_U, c.column.result);
                       }));
        number_or_list(w, c, "si:coverageFactor",
                       only([](const CertifiedValue& v) { return d_si_coverage_factor(v.printed_k); }));
        number_or_list(w, c, "si:coverageProbability", probabilities);
        number_or_list(w, c, "si:distribution", c.entries(distribution_of));
    } else if (c.stated == Stated::interval) {
        w.xml.open("si:coverageIntervalMU" + suffix);
        u();
        number_or_list(w, c, "si:intervalMin", only([&](const CertifiedValue& v) {
                           return required_d_si_number(v.printed_low, c.column.result);
                       }));
        number_or_list(w, c, "si:intervalMax", only([&](const CertifiedValue& v) {
                           return required_d_si_number(v.printed_high, c.column.result);
                       }));
        number_or_list(w, c, "si:coverageProbability", probabilities);
    } else {
        w.xml.open("si:standardMU" + suffix);
        u();
    }
    w.xml.close();
    w.xml.close();
}

/// Why a standard uncertainty stands where an expanded one is expected.
Text note_on_standard(DccWriter& w, const Column& c) {
    std::string U;
    std::string k;
    for (const CertifiedValue& v : c.column.values) {
        if (stated_of(v) == Stated::standard && !v.printed_U.empty()) {
            U += (U.empty() ? "" : ", ") + v.printed_U;
            k += (k.empty() ? "" : ", ") + v.printed_k;
        }
    }
    return U.empty() ? w.words()("dcc", "no_expanded_uncertainty")
                     : w.words().filled("dcc", "low_coverage_factor", {{"U", U}, {"k", k.empty() ? "?" : k}});
}

/// The six words of the format. A verdict that has no word there is no statement of conformity: the exact word stands
/// in a quantity of its own.
std::string conformity_word(const std::string& verdict) {
    if (verdict == "pass" || verdict == "fail") {
        return verdict;
    }
    if (verdict == "conditional_pass") {
        return "conditionalPass";
    }
    return verdict == "conditional_fail" ? "conditionalFail" : "noPass";
}

/// Words, one a row; blanks would split them.
void words_quantity(DccWriter& w, const Text& name, const std::string& ref_type, std::vector<std::string> entries,
                    const std::string& stage = {}) {
    for (std::string& entry : entries) {
        std::string joined;
        for (const std::string& word : xml_list(entry)) {
            joined += (joined.empty() ? "" : "_") + word;
        }
        entry = joined.empty() ? "-" : joined;
    }
    w.xml.open("dcc:quantity", {{"refType", ref_type}});
    w.text("dcc:name", name);
    w.xml.element("dcc:charsXMLList", full_list(entries));
    write_stage(w, stage);
    w.xml.close();
}

void numbers_quantity(DccWriter& w, const Column& c, const Text& name, const std::string& ref_type,
                      const std::vector<std::string>& entries, const std::string& unit, const std::string& label = {}) {
    if (c.list) {
        write_plain_list(w, {.name = name, .ref_type = ref_type, .values = entries, .unit = unit, .label = label});
    } else {
        write_plain_quantity(w, {.element = "dcc:quantity",
                                 .name = name,
                                 .ref_type = ref_type,
                                 .value = entries.front(),
                                 .unit = unit,
                                 .label = label});
    }
}

/// The limits as they are printed, where there are any.
void limit(DccWriter& w, const Column& c, const std::string& specification, const std::string& word,
           const std::function<std::string(const Verdict&)>& text) {
    const std::vector<std::string> entries = c.entries([&](const CertifiedValue& v) {
        const Verdict* const verdict = c.verdict(v, specification);
        return verdict == nullptr ? k_nothing : d_si_number(text(*verdict));
    });
    if (std::any_of(entries.begin(), entries.end(), [](const std::string& e) { return e != k_nothing; })) {
        numbers_quantity(w, c, w.words()("dcc", "limits", word), w.ref_types()(word), entries, c.column.unit);
    }
}

void conformity(DccWriter& w, const Column& c, const std::string& specification) {
    const Wording& words = w.words();
    std::vector<std::string> verdicts;
    std::vector<std::string> exact;
    std::vector<std::string> notes;
    std::vector<const Verdict*> formulas;  // several where an alternative of the rule decided some of the values
    for (const CertifiedValue& v : c.column.values) {
        const Verdict* const verdict = c.verdict(v, specification);
        const auto same = [&](const Verdict* one) { return one->formula == verdict->formula; };
        if (verdict != nullptr && !verdict->formula.empty() && std::none_of(formulas.begin(), formulas.end(), same)) {
            formulas.push_back(verdict);
        }
        if (verdict != nullptr && !verdict->note.empty() && std::ranges::find(notes, verdict->note) == notes.end()) {
            notes.push_back(verdict->note);
        }
        // A row without a specification must have an entry, and the format has none for "not decided". "noPass" claims
        // least: it says neither that the row conforms nor that it does not.
        verdicts.push_back(verdict == nullptr ? "noPass" : conformity_word(verdict->verdict));
        exact.push_back(verdict == nullptr ? "none" : verdict->verdict);
    }
    const Text name = words.filled("dcc", "verdicts", {{"name", c.column.result}});
    w.xml.open("dcc:metaData",
               {{"refId", w.specification_id(specification)}, {"refType", w.ref_types()("conformity")}});
    Text declaration;
    for (const Verdict* const one : formulas) {
        const Text formula = decision_formula(one->formula, words);
        append_line(declaration, formulas.size() > 1 ? one->rule + ": " + formula : formula);
    }
    if (std::find(verdicts.begin(), verdicts.end(), "noPass") != verdicts.end()) {
        append_line(declaration, words.filled("dcc", "conformity_words", {{"name", name}}));
    }
    for (const std::string& note : notes) {
        append_line(declaration, words.sentence(note));
    }
    w.optional_text("dcc:declaration", declaration);
    w.xml.element(c.list ? "dcc:conformityXMLList" : "dcc:conformity", full_list(verdicts));
    w.xml.open("dcc:data");
    limit(w, c, specification, "tolerance_lower", [](const Verdict& v) { return v.printed.lower; });
    limit(w, c, specification, "tolerance_upper", [](const Verdict& v) { return v.printed.upper; });
    limit(w, c, specification, "acceptance_lower", [](const Verdict& v) { return v.printed.acceptance_lower; });
    limit(w, c, specification, "acceptance_upper", [](const Verdict& v) { return v.printed.acceptance_upper; });
    limit(w, c, specification, "guard_band", [](const Verdict& v) { return v.printed.guard_band; });
    words_quantity(w, name, w.ref_types()("verdict"), exact);
    // In percent, and as words: a text such as ">99.99" is no number.
    const auto percent = [&](const char* word, const std::function<std::string(const Verdict&)>& text) {
        words_quantity(w, words("dcc", "limits", word) + " [%]", w.ref_types()(word),
                       c.entries([&](const CertifiedValue& v) {
                           const Verdict* const verdict = c.verdict(v, specification);
                           return verdict == nullptr ? std::string() : text(*verdict);
                       }));
    };
    percent("conformance_probability", [](const Verdict& v) { return v.printed.conformance_probability; });
    percent("specific_risk", [](const Verdict& v) { return v.printed.specific_risk; });
    w.xml.close();
    w.xml.close();
}

void flags(DccWriter& w, const Column& c, const XmlWriter::Attributes& attributes, const Text& declaration,
           const std::function<bool(const CertifiedValue&)>& flag) {
    w.xml.open("dcc:metaData", attributes);
    w.optional_text("dcc:declaration", declaration);
    w.xml.element(
        c.list ? "dcc:validXMLList" : "dcc:valid",
        full_list(c.entries([&](const CertifiedValue& v) { return c.has(v) && flag(v) ? "true" : "false"; })));
    w.xml.close();
}

void meta_data(DccWriter& w, const Column& c) {
    std::vector<std::string> specifications;
    bool raised = false;
    for (const CertifiedValue& v : c.column.values) {
        if (!c.has(v)) {
            continue;
        }
        raised = raised || v.raised;
        if (v.verdict &&
            std::find(specifications.begin(), specifications.end(), v.verdict->specification) == specifications.end()) {
            specifications.push_back(v.verdict->specification);
        }
    }
    const bool unit = needs_unit_definition(c.column.unit);
    if (specifications.empty() && !raised && !unit && !w.has_scope()) {
        return;
    }
    w.xml.open("dcc:measurementMetaData");
    for (const std::string& specification : specifications) {
        conformity(w, c, specification);
    }
    if (w.has_scope()) {
        flags(w, c, {{"refId", "scope"}, {"refType", w.ref_types()("capability")}}, {},
              [](const CertifiedValue& v) { return !v.scope_entry.empty() && !v.external; });
    }
    if (raised) {
        flags(w, c, {{"refType", w.ref_types()("raised")}}, w.words()("dcc", "raised"),
              [](const CertifiedValue& v) { return v.raised; });
    }
    write_unit_definition(w, c.column.unit);
    w.xml.close();
}

void column_once(DccWriter& w, const Column& c) {
    const certificate::ShownColumn* const as = certificate::column_of_values(c.table, c.column.result);
    const std::string known =
        w.ref_types()(as != nullptr && !as->role.empty() ? "role_" + as->role : "value_" + c.table.id);
    const std::string ref_type = known.empty() ? w.ref_types()("value_results") : known;
    w.xml.open("dcc:quantity", {{"refType", ref_type + " gumcert_" + as_token(c.column.result)}});
    w.text("dcc:name", result_meaning(c.table, c.column, w.words()));
    Text description = c.stated == Stated::standard ? note_on_standard(w, c) : Text();
    append_line(description, values_of_model(w.record(), c.table, c.column, w.words()));
    w.optional_text("dcc:description", description);
    w.xml.open(c.list ? "si:realListXMLList" : "si:real");
    w.xml.element(c.list ? "si:labelXMLList" : "si:label", as_token(c.column.result));
    // The text that is printed, not the number behind it: readers of the XML and of the page must get the same value.
    const std::vector<std::string> values = c.entries([&](const CertifiedValue& v) {
        return c.has(v) ? required_d_si_number(v.printed_value, c.column.result) : k_nothing;
    });
    w.xml.element(c.list ? "si:valueXMLList" : "si:value", full_list(values));
    w.xml.element(c.list ? "si:unitXMLList" : "si:unit", d_si_unit(c.column.unit));
    if (c.stated != Stated::nothing) {
        uncertainty(w, c);
    }
    w.xml.close();
    if (as != nullptr) {
        write_stage(w, as->stage);
    }
    meta_data(w, c);
    w.xml.close();
}

void degrees_of_freedom(DccWriter& w, const Column& c) {
    const std::vector<std::string> entries =
        c.entries([](const CertifiedValue& v) { return d_si_number(v.printed_nu_eff); });
    if (std::any_of(entries.begin(), entries.end(), [](const std::string& e) { return e != k_nothing; })) {
        numbers_quantity(w, c, w.words().filled("dcc", "degrees_of_freedom", {{"name", c.column.result}}),
                         w.ref_types()("degrees_of_freedom"), entries, "1", as_token(c.column.result));
    }
}

void write_column(DccWriter& w, const Column& c) {
    if (c.column.values.empty()) {
        return;
    }
    std::set<Stated> kinds;
    for (const CertifiedValue& v : c.column.values) {
        kinds.insert(stated_of(v));
    }
    for (const Stated stated : kinds) {
        column_once(w, {.table = c.table, .column = c.column, .list = c.list, .stated = stated});
    }
    degrees_of_freedom(w, c);
}

void argument(DccWriter& w, const CertifiedTable::Argument& a) {
    const bool numbers =
        !a.values.empty() && std::all_of(a.values.begin(), a.values.end(), [](const auto& v) { return v.has_value(); });
    const Text name = w.words().has("dcc", a.name) ? w.words()("dcc", a.name) : Text(a.name);
    if (!numbers) {
        words_quantity(w, name, w.ref_types()("point"), a.printed);
        return;
    }
    std::vector<std::string> entries;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const std::string printed = i < a.printed.size() ? d_si_number(a.printed[i]) : k_nothing;
        entries.push_back(printed == k_nothing ? d_si_number(*a.values[i]) : printed);
    }
    write_plain_list(w, {.name = name, .ref_type = w.ref_types()("argument"), .values = entries, .unit = a.unit});
}

/// A column of points: words, or numbers without uncertainty.
void point_column(DccWriter& w, const certificate::PointColumn& column) {
    const Text name = heading_of(column, w.words());
    const std::string known = column.role.empty() ? "" : w.ref_types()("role_" + column.role);
    const std::string own = "gumcert_" + as_token(column.name);
    const std::string ref_type = known.empty() ? own : known + " " + own;
    if (std::none_of(column.values.begin(), column.values.end(), [](const auto& v) { return v.has_value(); })) {
        words_quantity(w, name, ref_type, column.printed, column.stage);
        return;
    }
    std::vector<std::string> entries;
    for (std::size_t i = 0; i < column.values.size(); ++i) {
        const std::string printed = d_si_number(column.printed[i]);
        entries.push_back(!column.values[i] || printed != k_nothing ? printed : d_si_number(*column.values[i]));
    }
    write_plain_list(w, {.name = name,
                         .ref_type = ref_type,
                         .values = entries,
                         .unit = column.unit.empty() ? "1" : column.unit,
                         .stage = column.stage});
}

/// "Results." → "Results": the heading of a table without its full stop, in any language.
Text heading(const Text& caption, std::size_t languages) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < languages; ++i) {
        std::string text = caption.in(i);
        for (const std::string_view stop : {".", "。"}) {
            if (text.ends_with(stop)) {
                text.resize(text.size() - stop.size());
            }
        }
        all.push_back(text);
    }
    return Text(std::move(all));
}

std::vector<std::string> each_once(const std::vector<std::string>& ids) {
    std::vector<std::string> once;
    for (const std::string& id : ids) {
        if (std::find(once.begin(), once.end(), id) == once.end()) {
            once.push_back(id);
        }
    }
    return once;
}

void table(DccWriter& w, const CertifiedTable& t) {
    const Wording& words = w.words();
    const std::string known = w.ref_types()("table_" + t.id);
    const std::vector<std::string> of_rows =
        t.argument ? w.pieces().of_rows(t.argument->printed) : std::vector<std::string>();
    w.xml.open("dcc:result", {{"refId", full_list(each_once(of_rows))},
                              {"refType", known.empty() ? w.ref_types()("table_results") : known}});
    const Text caption = t.layout                        ? layout_caption(*t.layout, words)
                         : words.has("table_name", t.id) ? words("table_name", t.id)
                                                         : words.filled("table_name", "other", {{"name", t.id}});
    w.text("dcc:name", heading(caption, words.languages().size()));
    w.xml.open("dcc:data");
    w.xml.open("dcc:list", {{"refId", full_list(of_rows)}});
    if (t.argument) {
        argument(w, *t.argument);
    }
    if (t.layout) {
        for (const certificate::PointColumn& column : t.layout->columns) {
            point_column(w, column);
        }
    }
    for (const CertifiedColumn& column : t.columns) {
        write_column(w, {.table = t, .column = column, .list = t.argument.has_value() || column.values.size() > 1});
    }
    w.xml.close();
    w.xml.close();
    w.xml.close();
}

}  // namespace

void write_results(DccWriter& w, bool with_joint) {
    w.xml.open("dcc:results");
    bool any = false;
    for (const CertifiedTable& t : w.tables()) {
        if (std::any_of(t.columns.begin(), t.columns.end(), [](const auto& c) { return !c.values.empty(); })) {
            table(w, t);
            any = true;
        }
    }
    if (!any) {
        w.xml.open("dcc:result");
        w.text("dcc:name", w.words()("dcc", "results"));
        w.data_sentence(w.not_stated());
        w.xml.close();
    }
    if (with_joint) {
        write_joint_results(w);
    }
    w.xml.close();
}

}  // namespace gumcert::reports
