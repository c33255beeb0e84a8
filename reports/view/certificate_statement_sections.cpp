#include "reports/view/certificate_statement_sections.h"

#include "certificate/result_names.h"
#include "certificate/section_data.h"
#include "gum/quantity/unit.h"
#include "reports/deviations.h"
#include "reports/plots/certified_plots.h"
#include "reports/plots/svg_plot.h"
#include "reports/printed_texts.h"
#include "reports/record/record_sections.h"
#include "reports/view/certificate_conformity_section.h"
#include "reports/view/certificate_identity_sections.h"
#include "reports/view/certificate_uncertainty_section.h"
#include "reports/view/certified_overview.h"
#include "reports/view/certified_value_tables.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertificateData;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Finding;

Text stated_number(const std::optional<double>& v, const std::string& unit, const Wording& words) {
    return v ? with_unit(words.number(plain(*v)), unit) : Text();
}

/// Two plain numbers with the same number of decimals: "19.8", "20.0".
std::pair<std::string, std::string> with_equal_decimals(double a, double b) {
    std::pair<std::string, std::string> texts = {plain(a), plain(b)};
    const auto decimals = [](const std::string& text) {
        const std::size_t point = text.find('.');
        return point == std::string::npos ? 0 : text.size() - point - 1;
    };
    const std::size_t most = std::max(decimals(texts.first), decimals(texts.second));
    for (std::string* text : {&texts.first, &texts.second}) {
        const std::size_t own = decimals(*text);
        if (own < most && (texts.first + texts.second).find('E') == std::string::npos) {
            *text += (own == 0 ? "." : "") + std::string(most - own, '0');
        }
    }
    return texts;
}

bool has_limits(const Plot& plot) {
    return std::any_of(plot.panels.begin(), plot.panels.end(),
                       [](const PlotPanel& p) { return !p.limits.empty() || p.series.size() > 1; });
}

/// One paragraph, so that it is not torn apart by the end of a page.
/// \param absent  a table above has a cell "–"
void legend(CertificateBuilder& builder, const Wording& words, const CertifiedOverview& overview, bool absent) {
    Text text;
    const auto mark = [&](const Text& sentence) { text += text.empty() ? sentence : " " + sentence; };
    if (absent) {
        mark(words("statement", "not_applicable_mark"));
    }
    if (overview.has_letters() && !overview.used().empty()) {
        mark(words.filled("statement", "coverage_marks", {{"heading", words("heading", "statement_of_uncertainty")}}));
    }
    if (!text.empty()) {
        builder.paragraph(text);
    }
}

void remarks_section(CertificateBuilder& builder, const Wording& words, const CertificateData& data) {
    Facts rows;
    if (!data.recalibration_date.empty() && !data.recalibration_agreement.empty()) {
        rows.emplace_back(
            words("certificate", "date_of_recalibration"),
            words.filled("statement", "recalibration",
                         {{"date", data.recalibration_date}, {"agreement", data.recalibration_agreement}}));
    }
    add_fact(rows, words("certificate", "simplified"), data.simplified_agreement);
    for (const certificate::Omission& omission : data.omissions) {
        rows.emplace_back(words.filled("certificate", "omission", {{"clause", omission.clause}}),
                          words.localised(omission.reason));
    }
    if (rows.empty() && data.remarks.empty()) {
        return;
    }
    builder.section("remarks");
    for (const certificate::LocalisedText& remark : data.remarks) {
        builder.paragraph(words.localised(remark));
    }
    if (!rows.empty()) {
        builder.definitions(rows);
    }
}

void opinions_section(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    if (certificate.data.opinions.empty()) {
        return;
    }
    builder.section("opinions");
    Text sentence =
        words("statement", certificate::has_several_items(certificate.data) ? "opinions_items" : "opinions");
    if (certificate.symbol && !certificate.profile.opinions_with_symbol) {
        sentence += " " + words("statement", "opinions_not_accredited");
    }
    builder.paragraph(sentence);
    for (const certificate::Opinion& opinion : certificate.data.opinions) {
        builder.paragraph(words.localised(opinion.text));
        const Text function = words.localised(opinion.author.function);
        builder.definitions({{words("certificate", "basis"), words.localised(opinion.basis)},
                             {words("certificate", "author"),
                              function.empty() ? Text(opinion.author.name) : opinion.author.name + ", " + function}});
    }
}

void outside_section(CertificateBuilder& builder, const Wording& words, const Certificate& certificate,
                     const CertifiedOverview& overview) {
    const auto outside = [&](const CertifiedValue& v) { return overview.is_outside(v); };
    if (!overview.separates() || !overview.any(outside)) {
        return;
    }
    builder.section("outside");
    builder.paragraph(words("statement", "outside"));
    for (std::size_t i = 0; i < certificate.tables.size(); ++i) {
        certified_table(builder, words, certificate.tables[i], "outside-" + std::to_string(i), outside, overview);
    }
}

/// The values that another laboratory provided: by what the tables print, where the data name points of them.
Text results_of_provider(const certificate::ExternalResults& external, const Certificate& certificate,
                         const Wording& words) {
    const bool names_points = std::any_of(external.results.begin(), external.results.end(),
                                          [](const std::string& name) { return name.ends_with(']'); });
    if (!names_points) {
        return Text(joined(external.results));
    }
    std::set<const CertifiedValue*> provided;
    for (const certificate::CertifiedTable& table : certificate.tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const bool at_points = table.argument && row < table.argument->printed.size();
                const std::string name = column.result + (at_points ? "[" + table.argument->printed[row] + "]" : "");
                if (certificate::is_named(external.results, column.result) ||
                    certificate::is_named(external.results, name)) {
                    provided.insert(&column.values[row]);
                }
            }
        }
    }
    const std::vector<Text> names = names_of_values(
        certificate, [&](const CertifiedValue& v) { return provided.contains(&v); }, words);
    return names.empty() ? Text(joined(external.results)) : enumerated(names, words);
}

void external_section(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    if (certificate.data.external_results.empty()) {
        return;
    }
    builder.section("external");
    for (const certificate::ExternalResults& e : certificate.data.external_results) {
        builder.paragraph(words.filled(
            "statement", "external",
            {{"provider", words.localised(e.provider)}, {"results", results_of_provider(e, certificate, words)}}));
    }
}

void changes_table(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    Rows rows;
    for (const certificate::Change& change : certificate.changes) {
        rows.push_back({place_of_change(change, words), side_of_change(change, change.before, words),
                        side_of_change(change, change.after, words)});
    }
    builder.table("changes",
                  words.filled("statement", "changes_table", {{"number", certificate.data.amendment->number}}),
                  {{words("certificate", "change"), ""},
                   {words("certificate", "before"), ""},
                   {words("certificate", "after"), ""}},
                  rows);
}

void amendment_section(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    if (!certificate.data.amendment) {
        return;
    }
    const certificate::Amendment& a = *certificate.data.amendment;
    builder.section("amendment");
    builder.paragraph(amendment_sentence(a, words));
    Facts rows;
    add_fact(rows, words("certificate", "reason"), words.localised(a.reason));
    for (const certificate::LocalisedText& change : a.changes) {
        rows.emplace_back(words("certificate", "changes"), words.localised(change));
    }
    add_fact(rows, words("certificate", "earlier_digest"), a.sha256);
    add_fact(rows, words("certificate", "amended_record"), certificate.amended_record_sha256);
    if (!rows.empty()) {
        builder.definitions(rows);
    }
    if (!certificate.changes.empty()) {
        changes_table(builder, words, certificate);
    }
}

/// Identification to description of a method.
Facts method_facts(const Wording& words, const certificate::Method& m) {
    Facts rows = {{words("certificate", "method"), m.identification}};
    add_fact(rows, words("certificate", "version"), m.version);
    add_fact(rows, words("certificate", "title"), words.localised(m.title));
    add_fact(rows, words("certificate", "standard"), m.standard);
    add_fact(rows, words("certificate", "procedure"), words.localised(m.description));
    return rows;
}

void add_deviations(Facts& rows, const Wording& words, std::vector<Text> deviations, bool none_stated) {
    if (deviations.empty()) {
        deviations.push_back(words("certificate", none_stated ? "none" : "not_stated"));
    }
    for (const Text& deviation : deviations) {
        rows.emplace_back(words("certificate", "deviations"), deviation);
    }
}

/// \param by_sections  each section states its own
void method_section(CertificateBuilder& builder, const Wording& words, const CertificateData& data, bool by_sections) {
    builder.section("method_used");
    Facts rows;
    std::vector<Text> deviations = deviations_in_words(words, data);
    if (by_sections) {
        rows.emplace_back(words("certificate", "method"), words("certificate", "with_each_section"));
    } else {
        rows = method_facts(words, data.method);
    }
    if (!by_sections || !deviations.empty()) {
        add_deviations(rows, words, std::move(deviations), data.method.no_deviations);
    }
    rows.emplace_back(words("certificate", "sampling"),
                      data.sampling.empty() ? words("certificate", "not_applicable") : words.localised(data.sampling));
    if (data.persons.performed_by) {
        rows.emplace_back(words("certificate", "performed_by"), data.persons.performed_by->name);
    }
    if (data.persons.reviewed_by) {
        rows.emplace_back(words("certificate", "reviewed_by"), data.persons.reviewed_by->name);
    }
    builder.definitions(rows);
}

/// "0.30 µm (k = 2)", "0.02 mg to 0.1 mg (k = 2)"
Text headline_uncertainty(const std::optional<double>& U, const std::optional<double>& U_to,
                          const std::optional<double>& k, const std::string& unit_of_job, const Wording& words) {
    const std::string unit = gum::unit_for_people(unit_of_job);
    Text text = stated_number(U, unit, words);
    if (U && U_to) {
        text = words.filled("certificate", "from_to", {{"low", text}, {"high", stated_number(U_to, unit, words)}});
    }
    return text.empty() || !k ? text : text + " (k\u00A0=\u00A0" + words.number(plain(*k)) + ")";
}

/// The same of each kind of quantity: "7 µV to 52 µV (k = 2); 5 µA (k = 2)"
Text headline_uncertainty(const certificate::StandardUsed& s, const Wording& words) {
    Text text = headline_uncertainty(s.U, s.U_to, s.k, s.unit, words);
    for (const certificate::StandardUsed::FurtherUncertainty& one : s.further) {
        const Text further = headline_uncertainty(one.U, one.U_to, one.k, one.unit, words);
        text += text.empty() ? further : "; " + further;
    }
    return text;
}

void traceability_section(CertificateBuilder& builder, const Wording& words, const CertificateData& data) {
    builder.section("traceability");
    if (data.standards.empty()) {
        builder.paragraph(words("statement", "no_standards"));
        return;
    }
    builder.paragraph(words("statement", "traceable"));
    Rows lines;
    for (const certificate::StandardUsed& s : data.standards) {
        Text issuer = words.localised(s.issuer);
        if (!s.issuer_accreditation.empty()) {
            issuer += " (" + s.issuer_accreditation + ")";
        } else if (words.has("traceability_route", s.route)) {
            issuer += " (" + words("traceability_route", s.route) + ")";
        }
        lines.push_back({words.localised(s.name), s.identification, s.certificate, issuer, s.calibrated, s.valid_to,
                         headline_uncertainty(s, words), words("standard_role", s.role)});
    }
    builder.table("standards", words("statement", "standards_table"),
                  {{words("certificate", "standard_used"), ""},
                   {words("certificate", "standard_identification"), ""},
                   {words("certificate", "standard_certificate"), ""},
                   {words("certificate", "issuer"), ""},
                   {words("certificate", "calibrated"), ""},
                   {words("certificate", "valid_to"), ""},
                   {words("certificate", "standard_U"), ""},
                   {words("certificate", "role"), ""}},
                  lines);
}

void conditions_table(CertificateBuilder& builder, const Wording& words, const std::string& id,
                      const std::vector<certificate::Condition>& conditions) {
    const bool limits =
        std::any_of(conditions.begin(), conditions.end(), [](const auto& c) { return c.lower_limit || c.upper_limit; });
    std::vector<Column> columns = {
        {words("certificate", "quantity"), ""},      {words("certificate", "minimum"), "", true},
        {words("certificate", "maximum"), "", true}, {words("certificate", "U_short"), "", true},
        {words("certificate", "unit"), ""},          {words("certificate", "sensor"), ""}};
    if (limits) {
        columns.push_back({words("certificate", "lower_limit"), "", true});
        columns.push_back({words("certificate", "upper_limit"), "", true});
    }
    Rows lines;
    const auto number = [](const std::optional<double>& v) { return Text(v ? plain(*v) : std::string()); };
    for (const certificate::Condition& c : conditions) {
        const auto [least, greatest] = with_equal_decimals(c.minimum, c.maximum);
        std::vector<Text> row = {words.localised(c.quantity),  least,   greatest, number(c.U),
                                 gum::unit_for_people(c.unit), c.sensor};
        if (limits) {
            row.push_back(number(c.lower_limit));
            row.push_back(number(c.upper_limit));
        }
        lines.push_back(std::move(row));
    }
    builder.table(id, words("statement", "conditions_table"), columns, lines);
}

void conditions_section(CertificateBuilder& builder, const Wording& words, const CertificateData& data,
                        bool by_sections) {
    builder.section("conditions");
    if (data.conditions.empty()) {
        builder.paragraph(words("statement", by_sections ? "conditions_with_sections" : "no_conditions"));
    } else {
        conditions_table(builder, words, "conditions", data.conditions);
    }
}

/// What a section has that the certificate as a whole has not: item, method, standards, conditions.
void section_facts(CertificateBuilder& builder, const Wording& words, const CertificateData& data,
                   const certificate::SectionData& own, const std::string& id) {
    Facts rows;
    if (own.item) {
        rows = item_facts(words, *own.item);
    }
    if (own.method) {
        for (auto& fact : method_facts(words, *own.method)) {
            rows.push_back(std::move(fact));
        }
        std::vector<Text> deviations;
        for (const certificate::LocalisedText& deviation : own.method->deviations) {
            deviations.push_back(words.localised(deviation));
        }
        add_deviations(rows, words, std::move(deviations), own.method->no_deviations);
    }
    Text standards;
    for (const std::string& identification : own.standards) {
        const auto row = std::find_if(data.standards.begin(), data.standards.end(),
                                      [&](const auto& s) { return s.identification == identification; });
        const Text name = row == data.standards.end() ? Text() : words.localised(row->name);
        standards += (standards.empty() ? Text() : Text("; ")) + name + (name.empty() ? "" : ", ") + identification;
    }
    add_fact(rows, words("certificate", "standard_used"), standards);
    if (!rows.empty()) {
        builder.definitions(rows);
        explain_marks(builder, words, rows);
    }
    if (!own.conditions.empty()) {
        conditions_table(builder, words, "conditions-" + id, own.conditions);
    }
}

/// The tables of a rotary table in the order in which they are read: what it does as a whole, its axis, then angle by
/// angle, and the set-up of the fixture last. Others as they are certified.
std::vector<std::size_t> reading_order(const Certificate& certificate) {
    static constexpr std::array<std::string_view, 7> k_order = {
        "ranges", "positioning", "location_errors", "axis_line", "error_motions", "reversal", "set_up"};
    std::vector<std::size_t> order(certificate.tables.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t i) {
        return std::find(k_order.begin(), k_order.end(), certificate.tables[i].id) - k_order.begin();
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    return order;
}

/// A clause whose last letter stays beside its number: "7.8.6.2 b".
std::string kept_together(std::string clause) {
    for (std::size_t at = clause.find(' '); at != std::string::npos; at = clause.find(' ', at + 1)) {
        const bool one_letter =
            at + 2 == clause.size() ||
            (at + 2 < clause.size() && std::ispunct(static_cast<unsigned char>(clause[at + 2])) != 0);
        if (one_letter && at > 0 && std::isdigit(static_cast<unsigned char>(clause[at - 1])) != 0) {
            clause.replace(at, 1, "\u00A0");
        }
    }
    return clause;
}

}  // namespace

void findings_section(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    if (certificate.blocked) {
        all_findings(builder, words, certificate);
    }
}

void all_findings(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    if (certificate.findings.empty()) {
        return;
    }
    builder.section("findings");
    builder.paragraph(words("statement", "findings"));
    static constexpr std::array<const char*, 4> k_severities = {"information", "minor", "major", "critical"};
    Rows lines;
    for (const Finding& f : certificate.findings) {
        const Text severity = words("finding_severity", k_severities.at(static_cast<std::size_t>(f.severity)));
        lines.push_back({f.id, kept_together(f.clause), severity, words.sentence(f.where), words.sentence(f.what),
                         words.sentence(f.action)});
    }
    builder.table("findings", words("statement", "findings_table"),
                  {{words("certificate", "finding"), ""},
                   {words("certificate", "clause"), ""},
                   {words("certificate", "severity"), ""},
                   {words("certificate", "where"), ""},
                   {words("certificate", "what"), ""},
                   {words("certificate", "action"), ""}},
                  lines);
}

void method_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const CertificateData& data = record.certificate->data;
    const certificate::StatedBySections by_sections = certificate::stated_by_sections(data, record.certificate->tables);
    method_section(builder, words, data, by_sections.method);
    traceability_section(builder, words, data);
    conditions_section(builder, words, data, by_sections.conditions);
}

void result_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const Certificate& certificate = *record.certificate;
    const CertifiedOverview overview(certificate);
    builder.section("certified_results");
    if (certificate.data.adjustment) {
        builder.paragraph(adjustment_sentence(certificate.data, *certificate.data.adjustment, words));
    }
    const auto shown = [&](const CertifiedValue& v) { return !overview.separates() || !overview.is_outside(v); };
    const std::size_t absent_before = builder.absent_cells();
    const auto figure = [&](std::size_t i) {
        if (certificate.tables[i].layout && certificate.tables[i].layout->plot == "none") {
            return;
        }
        const Text name = certified_table_name(certificate.tables[i], words);
        const std::string id = "plot-certified-" + std::to_string(i);
        if (const auto plot = certified_plot(certificate.tables[i], name.first(), words, id)) {
            Text caption = words.filled("statement", "certified_figure", {{"table", name}});
            if (has_limits(*plot)) {
                caption += " " + words("statement", "figure_limits");
            }
            builder.figure(plot->id, caption, plot->description, svg(*plot));
        }
    };
    const auto begin_section = [&](std::size_t position) {
        const SectionSummary& section = record.sections[position];
        const std::string id = std::to_string(position);
        builder.section("certified-section-" + id, words.localised(title_of(section)));
        for (const certificate::SectionData& own : certificate.data.sections) {
            if (own.section == section.name) {
                section_facts(builder, words, certificate.data, own, id);
            }
        }
    };
    std::size_t section = 0;  // sections that were begun
    std::vector<std::size_t> figures;
    const auto draw_figures = [&] {
        for (const std::size_t i : std::exchange(figures, {})) {
            figure(i);
        }
    };
    for (const std::size_t i : reading_order(certificate)) {
        const CertifiedTable& table = certificate.tables[i];
        while (section < record.sections.size() &&
               (section == 0 || record.sections[section - 1].name != table.section)) {
            draw_figures();
            begin_section(section++);
        }
        if (record.rotary) {
            figure(i);  // the curves before pages of their numbers
        }
        certified_table(builder, words, table, "certified-" + std::to_string(i), shown, overview);
        if (table.argument && !table.layout && !record.rotary) {
            certified_meanings(builder, words, table);
        }
        if (!record.rotary) {
            figures.push_back(i);
        }
    }
    if (!record.sections.empty()) {
        draw_figures();  // of the last section, before what holds for all
    }
    legend(builder, words, overview, builder.absent_cells() > absent_before);
    draw_figures();
}

void closing_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const Certificate& certificate = *record.certificate;
    const CertifiedOverview overview(certificate);
    uncertainty_section(builder, words, record, overview);
    conformity_section(builder, words, certificate);
    remarks_section(builder, words, certificate.data);
    opinions_section(builder, words, certificate);
    outside_section(builder, words, certificate, overview);
    external_section(builder, words, certificate);
    amendment_section(builder, words, certificate);
}

}  // namespace gumcert::reports
