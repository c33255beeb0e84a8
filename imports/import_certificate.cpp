#include "imports/import_certificate.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "gum/expression/syntax_tree.h"
#include "gum/quantity/unit.h"
#include "json/strict_parser.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/printable_text.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/plus_sign.h"
#include "text/utf8.h"

namespace gumcert::imports {

namespace {

using reports::ImportedCertificate;
using reports::ImportedNumber;
using reports::ImportedQuantity;

/// A number of a certificate as JSON wants it, with the digits that stand there: "+.50" → "0.50", "5." → "5". Nothing
/// for NaN or another text that is no finite number.
std::optional<std::string> json_number(const std::string& text) {
    std::string number(text::without_plus(text));
    const bool negative = number.starts_with('-');
    std::string rest = negative ? number.substr(1) : number;
    const std::size_t exponent_at = std::min(rest.find_first_of("eE"), rest.size());
    std::string digits = rest.substr(0, exponent_at);
    if (digits.starts_with('.')) {
        digits.insert(0, "0");
    }
    if (digits.ends_with('.')) {
        digits.pop_back();
    }
    const std::size_t whole = std::min(digits.find('.'), digits.size());
    const std::size_t first = std::min(digits.find_first_not_of('0'), whole);
    digits.erase(0, first == whole ? first - (first > 0 ? 1 : 0) : first);
    number = (negative ? "-" : "") + digits + rest.substr(exponent_at);
    const std::optional<nlohmann::json> parsed = gumcert::json::parse_faultless(number, {.long_integers = true});
    double value = 0.0;
    // Numbers too large or too small for a double are refused by the reader of jobs as well.
    const bool in_range = std::from_chars(number.data(), number.data() + number.size(), value).ec == std::errc();
    return parsed && parsed->is_number() && in_range && std::isfinite(value) ? std::optional(number) : std::nullopt;
}

double value_of(const std::string& number) {
    double value = 0.0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    return value;
}

std::string json_text(const std::string& text) {
    return nlohmann::json(reports::printable(text)).dump();
}

/// Members of a JSON object, numbers with their own digits.
using Members = std::vector<std::pair<std::string, std::string>>;

std::string object_on_one_line(const Members& members) {
    std::string text = "{";
    for (const auto& [key, value] : members) {
        if (text.size() > 1) {
            text += ", ";
        }
        text += json_text(key) + ": " + value;
    }
    return text + "}";
}

struct Input {
    std::string name;
    Members members;

    [[nodiscard]] bool is_constant() const {
        return std::any_of(members.begin(), members.end(), [](const auto& m) { return m.first == "constant"; });
    }
};

/// Whether the reader of jobs takes the numbers of an input, in coherent SI units.
bool fits_a_budget(const std::string& unit_text, const Input& input) {
    const gum::Unit unit = gum::Unit::parse(unit_text);
    double u = 1.0, divisor = 1.0;
    for (const auto& [key, number] : input.members) {
        if (key == "value" && !std::isfinite(unit.to_si(value_of(number)))) {
            return false;
        }
        if (key == "u" || key == "U") {
            u = unit.difference_to_si(value_of(number));
        }
        if (key == "k" || key == "p") {
            divisor = value_of(number);  // k is about p where both are small
        }
    }
    constexpr double k_least = 1e-139, k_largest = 1e139;
    const auto is_inside = [](double number) { return number > k_least && number < k_largest; };
    return input.is_constant() || (is_inside(u) && is_inside(u / divisor));
}

class Importer {
public:
    explicit Importer(std::string file) : file_(std::move(file)) {}

    /// Nothing where the statement of uncertainty cannot be used: remarked.
    std::optional<Input> input_of(const ImportedQuantity& q);
    std::vector<gum::Diagnostic> remarks;

private:
    void remark(const ImportedQuantity& q, const std::string& what, const std::string& rule, const std::string& action);
    bool add_uncertainty(const ImportedQuantity& q, Members& members);
    bool add_interval(const ImportedQuantity& q, Members& members);
    std::string name_for(const ImportedQuantity& q);
    bool add_expanded(const ImportedQuantity& q, const std::string& stated, Members& members);

    std::string file_;
    std::set<std::string, std::less<>> names_;
    const ImportedQuantity* last_remarked_ = nullptr;
    std::string first_remarked_;  // name of the first row that the last remark is about
};

/// One remark for all rows of a column that it holds for.
void Importer::remark(const ImportedQuantity& q, const std::string& what, const std::string& rule,
                      const std::string& action) {
    const bool next_row = last_remarked_ != nullptr && q.row && last_remarked_->row &&
                          *q.row == *last_remarked_->row + 1 && q.table == last_remarked_->table &&
                          q.quantity == last_remarked_->quantity && q.result == last_remarked_->result;
    const bool same = next_row && remarks.back().what == what && remarks.back().rule == rule;
    last_remarked_ = &q;
    if (same) {
        remarks.back().where = file_ + ": " + first_remarked_ + " to " + q.name;
        return;
    }
    first_remarked_ = q.name;
    remarks.push_back({.code = "GC-DCC-0031",
                       .where = file_ + ": " + q.name,
                       .what = what,
                       .rule = rule,
                       .action = action,
                       .severity = gum::Severity::warning});
}

std::string Importer::name_for(const ImportedQuantity& q) {
    std::string name = gum::is_reserved_name(q.name) ? q.name + "_value" : q.name;
    while (!names_.insert(name).second) {
        name += "_";
    }
    return name;
}

/// Ends of an interval of probability p about the value: a standard uncertainty is stated beside it in the DCC, and the
/// budget takes that one.
bool Importer::add_interval(const ImportedQuantity& q, Members& members) {
    const auto u = json_number(q.u);
    if (!u || value_of(*u) <= 0.0) {
        remark(q, "an interval without a standard uncertainty", "an input needs a statement of its uncertainty",
               "add the input by hand");
        return false;
    }
    if (value_of(json_number(q.low).value_or("0")) > value_of(json_number(q.high).value_or("0"))) {
        remark(q, "an interval from " + q.low + " to " + q.high, "an interval begins before it ends",
               "ask the laboratory; add the input by hand");
        return false;
    }
    members.emplace_back("u", *u);
    const double value = value_of(json_number(q.value).value_or("0"));
    const double low = value - value_of(json_number(q.low).value_or("0"));
    const double high = value_of(json_number(q.high).value_or("0")) - value;
    constexpr double k_symmetric = 0.1;
    if (std::abs(high - low) > k_symmetric * std::max(std::abs(high), std::abs(low))) {
        remark(q, "the interval from " + q.low + " to " + q.high + " is not symmetric about " + q.value,
               "the budget takes the standard uncertainty as that of a normal distribution",
               "state another distribution where that matters");
    }
    return true;
}

bool Importer::add_uncertainty(const ImportedQuantity& q, Members& members) {
    if (q.kind == "coverage_interval") {
        return add_interval(q, members);
    }
    const auto stated = json_number(q.kind == "standard" ? q.u : q.U);
    if (!stated || value_of(*stated) < 0.0) {
        remark(q, "no number as uncertainty", "an input needs a statement of its uncertainty", "add the input by hand");
        return false;
    }
    if (value_of(*stated) == 0.0) {
        members.emplace_back("constant", "true");
        remark(q, "an uncertainty of 0", "the budget holds it as a constant", "make sure that this is meant");
        return true;
    }
    if (q.kind == "standard") {
        members.emplace_back("u", *stated);
        return true;
    }
    return add_expanded(q, *stated, members);
}

/// U with its k, else with p; never both, because a job takes one of them.
bool Importer::add_expanded(const ImportedQuantity& q, const std::string& stated, Members& members) {
    const auto k = json_number(q.k);
    const auto p = json_number(q.p);
    if (!k && !p) {
        remark(q, "U without k and p", "an expanded uncertainty needs its coverage factor", "add the input by hand");
        return false;
    }
    if (k && value_of(*k) <= 0.0) {
        remark(q, "the coverage factor is " + *k, "a coverage factor is greater than 0",
               "ask the laboratory; add the input by hand");
        return false;
    }
    if (!k && (value_of(*p) <= 0.0 || value_of(*p) >= 1.0)) {
        remark(q, "U without k, and the coverage probability is " + *p, "a probability is between 0 and 1",
               "ask the laboratory; add the input by hand");
        return false;
    }
    if (!k) {
        remark(q, "U without k", "the budget takes the coverage factor of a normal distribution for p = " + *p,
               "ask the laboratory for its k");
    }
    members.emplace_back("U", stated);
    members.emplace_back(k ? "k" : "p", k ? *k : *p);
    return true;
}

std::optional<Input> Importer::input_of(const ImportedQuantity& q) {
    const auto value = json_number(q.value);
    if (!value) {
        remark(q, "the value is " + json_text(q.value), "a value is a finite number",
               "nothing, if none is stated there");
        return std::nullopt;
    }
    if (q.unit.empty()) {
        remark(q,
               q.d_si_unit.empty() ? "no unit" : "unit \"" + reports::printable(q.d_si_unit) + "\" is not known here",
               "an input has a unit of the program", "add the input by hand, in a unit that is known");
        return std::nullopt;
    }
    Input input;
    input.members = {{"unit", json_text(q.unit)}, {"value", *value}};
    if (!q.objection.empty()) {
        remark(q, q.objection, "an input needs a statement of its uncertainty that holds",
               "ask the laboratory; add the input by hand");
        return std::nullopt;
    }
    if (q.kind == "none") {
        input.members.emplace_back("constant", "true");
    } else if (!add_uncertainty(q, input.members)) {
        return std::nullopt;
    }
    if (!fits_a_budget(q.unit, input)) {
        remark(q, "the value " + q.value + " or its uncertainty is too large or too small",
               "a budget takes uncertainties from 1e-140 to 1e140 in coherent SI units", "ask the laboratory");
        return std::nullopt;
    }
    input.name = name_for(q);
    return input;
}

/// What stands in the same row of a table as a value: where it was measured, and how many degrees of freedom it has.
class Rows {
public:
    explicit Rows(const ImportedCertificate& certificate) : certificate_(certificate) {
        for (const ImportedQuantity& q : certificate.quantities) {
            if (is_beside(q)) {
                beside_[{q.table, *q.row}].push_back(&q);
            } else if (is_degrees_of_freedom(q)) {
                degrees_of_freedom_[{q.table, q.row.value_or(0), q.label}] = &q;
            }
        }
    }

    /// A number without uncertainty in a table: it says where the values of its row were measured.
    [[nodiscard]] static bool is_beside(const ImportedQuantity& q) {
        return q.role == "result" && q.table > 0 && q.row && q.kind == "none" && q.objection.empty() &&
               !is_degrees_of_freedom(q);
    }
    /// Of a certificate that this program wrote: they carry the label of their result.
    [[nodiscard]] static bool is_degrees_of_freedom(const ImportedQuantity& q) {
        return q.ref_type == "gumcert_effectiveDegreesOfFreedom" && !q.label.empty();
    }

    /// "Nominal value 0.5 mm, Serial number 40210, Point 10_V": the item, where the certificate has several, and what stands
    /// in the row of a table; "" where there is neither. What was read before an adjustment says nothing of a result after it.
    [[nodiscard]] std::string place_of(const ImportedQuantity& q) const {
        std::string text;
        std::set<std::string> said;  // an item may be called by what stands in its row
        const auto append = [&](const std::string& entry) {
            if (said.insert(entry).second) {
                text += (text.empty() ? "" : ", ") + entry;
            }
        };
        if (q.about) {
            append(certificate_.items[*q.about].name);
            for (const std::string& identification : certificate_.items[*q.about].identifications) {
                append(identification);
            }
        }
        if (q.table == 0 || !q.row) {
            return text;
        }
        for (const reports::ImportedWords& words : certificate_.words) {
            if (words.table == q.table && *q.row < words.words.size() &&
                reports::may_be_of_one_stage(q.before_adjustment, words.before_adjustment)) {
                append((words.quantity.empty() ? "" : words.quantity + " ") + words.words[*q.row]);
            }
        }
        if (const auto found = beside_.find({q.table, *q.row}); found != beside_.end()) {
            for (const ImportedQuantity* other : found->second) {
                const bool once_more = other->quantity == q.quantity;  // the same column in another form
                if (!once_more && reports::may_be_of_one_stage(q.before_adjustment, other->before_adjustment)) {
                    append((other->quantity.empty() ? other->name : other->quantity) + " " + with_unit(*other));
                }
            }
        }
        return text;
    }

    [[nodiscard]] std::optional<std::string> degrees_of_freedom(const ImportedQuantity& q) const {
        const auto found = degrees_of_freedom_.find({q.table, q.row.value_or(0), q.label});
        const auto nu = found == degrees_of_freedom_.end() ? std::nullopt : json_number(found->second->value);
        return nu && value_of(*nu) > 0.0 ? nu : std::nullopt;
    }

private:
    static std::string with_unit(const ImportedNumber& number) {
        const std::string& unit = number.unit.empty() ? number.d_si_unit : number.unit;
        return number.value + (unit == "1" ? "" : " " + unit);
    }

    const ImportedCertificate& certificate_;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<const ImportedQuantity*>> beside_;
    std::map<std::tuple<std::size_t, std::size_t, std::string>, const ImportedQuantity*> degrees_of_freedom_;
};

/// The results of a certificate of this program that stand there once more, beside their covariance.
bool is_stated_twice(const ImportedQuantity& q) {
    return q.ref_type == "gumcert_jointResults";
}

/// Distributions other than the normal one are not carried over by U and k alone.
bool is_normal(const std::string& distribution) {
    return distribution.empty() || distribution == "normal" || distribution == "gaussian";
}

void note_distribution(const ImportedQuantity& q, Members& members) {
    std::string note;
    if (!is_normal(q.distribution)) {
        note = "distribution in the certificate: " + q.distribution;
    }
    if (q.kind == "expanded" && !q.p.empty() && !q.k.empty()) {
        note += (note.empty() ? "" : "; ") + std::string("coverage probability ") + q.p;
    }
    if (q.kind == "coverage_interval") {
        note += (note.empty() ? "" : "; ") + std::string("coverage interval ") + q.low + " to " + q.high +
                (q.p.empty() ? "" : ", probability " + q.p);
    }
    for (const ImportedNumber& other : q.also) {
        note += (note.empty() ? "" : "; ") + std::string("also ") + other.value + " " +
                (other.unit.empty() ? other.d_si_unit : other.unit);
    }
    if (!note.empty()) {
        members.emplace_back("note", json_text(note));
    }
}

/// The beginning of a text that has no more bytes than a line of a job may have.
std::string beginning_of(const std::string& text, std::size_t most_bytes) {
    const std::string shown = reports::printable(text);
    std::size_t characters = most_bytes;
    std::string beginning = reports::shortened(shown, characters);
    while (beginning.size() > most_bytes) {
        beginning = reports::shortened(shown, --characters);
    }
    return beginning;
}

/// Without blanks of any script at its end, which the reader of jobs refuses.
std::string without_last_blanks(std::string line) {
    while (!line.empty()) {
        std::size_t last = line.size() - 1;
        while (last > 0 && text::is_continuation(line[last])) {
            --last;
        }
        if (!text::is_blank(text::decode_utf8(line, last).code)) {
            break;
        }
        line.resize(last);
    }
    return line;
}

constexpr std::size_t k_longest_title = 900;  // [byte] of an identifier, with the words before it at most 1000
constexpr std::size_t k_longest_name = 75;    // [byte] of an identifier or a laboratory, both in a line of 256

std::string source_of(const ImportedCertificate& c) {
    return (c.state.empty() ? "" : c.state + " of ") + "certificate " + beginning_of(c.identifier, k_longest_name) +
           (c.laboratory.empty() ? "" : ", " + beginning_of(c.laboratory, k_longest_name)) + ", SHA-256 " + c.sha256;
}

std::string description_of(const ImportedQuantity& q, const std::string& place) {
    std::string text = q.result;
    if (!q.quantity.empty()) {
        text += (text.empty() ? "" : ": ") + q.quantity;
    }
    if (q.row) {
        text += (text.empty() ? "" : ", ") + std::string("row ") + std::to_string(*q.row + 1);
    }
    if (q.before_adjustment) {
        text += (text.empty() ? "" : ", ") + std::string(*q.before_adjustment ? "as found" : "as left");
    }
    return text + (place.empty() ? "" : " (" + place + ")");
}

gum::Diagnostic note_of(const char* code, const std::string& file, const std::string& what, const std::string& rule,
                        const std::string& action) {
    return {.code = code, .where = file, .what = what, .rule = rule, .action = action, .severity = gum::Severity::note};
}

/// What a person has to know of the job as a whole.
void add_notes(const std::string& file, std::size_t inputs, std::size_t left_out,
               const std::map<std::string, std::size_t>& distributions, std::vector<gum::Diagnostic>& remarks) {
    for (const auto& [distribution, count] : distributions) {
        remarks.push_back(note_of("GC-DCC-0033", file,
                                  "distribution \"" + reports::printable(distribution) + "\" of " +
                                      std::to_string(count) + (count == 1 ? " input" : " inputs"),
                                  "the job takes U/k as the standard uncertainty of a normal distribution",
                                  "state `distribution` or `nu` where that matters"));
    }
    if (left_out > 0) {
        remarks.push_back(note_of(
            "GC-DCC-0034", file,
            std::to_string(left_out) +
                (left_out == 1 ? " result without uncertainty is" : " results without uncertainty are") + " left out",
            "inputs are the results that have one", "add them as constants where the model needs them"));
    }
    if (inputs > 1) {
        remarks.push_back(note_of("GC-DCC-0032", file, text::count_of(inputs, "input") + " from one certificate",
                                  "results of one calibration usually share errors; the job holds them as independent",
                                  "state `correlations` or `covariance` where the certificate gives reason to"));
    }
}

/// What the issuer marks as outside of its accreditation: no traceability rests on its mark.
void add_unaccredited(const std::string& file, const std::vector<std::string>& names,
                      std::vector<gum::Diagnostic>& remarks) {
    if (names.empty()) {
        return;
    }
    remarks.push_back({.code = "GC-DCC-0035",
                       .where = file,
                       .what = std::to_string(names.size()) + (names.size() == 1 ? " input is" : " inputs are") +
                               " outside of the accreditation of the issuer: " + text::listed(names, 8),
                       .rule = "an accreditation covers what its scope names (ILAC-P10:07/2020)",
                       .action = "do not rely on the accreditation for them: choose another route of traceability",
                       .severity = gum::Severity::warning});
}

std::string job_text(const ImportedCertificate& c, const std::vector<Input>& inputs) {
    std::string result = "y";
    while (std::any_of(inputs.begin(), inputs.end(), [&](const Input& input) { return input.name == result; })) {
        result += '_';
    }
    std::string text = "{\n \"schema\": \"gumcert/job/1\",\n \"kind\": \"budget\",\n";
    text += " \"title\": " +
            json_text(without_last_blanks("Inputs from certificate " + beginning_of(c.identifier, k_longest_title))) +
            ",\n";
    text += " \"notes\": " +
            json_text("Imported from a digital certificate" + (c.item.empty() ? "" : " of: " + c.item) +
                      (c.issued.empty() ? "" : ", issued " + c.issued) + ". The model is an example: write your own.") +
            ",\n";
    text += " \"model\": [" + json_text(result + " = " + inputs.front().name) + "],\n \"inputs\": {\n";
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        text += "  " + json_text(inputs[i].name) + ": " + object_on_one_line(inputs[i].members) +
                (i + 1 < inputs.size() ? ",\n" : "\n");
    }
    return text + " },\n \"outputs\": {" + json_text(result) + ": {\"unit\": " + inputs.front().members.front().second +
           "}}\n}\n";
}

}  // namespace

ImportedJob import_certificate(std::string_view bytes, const std::string& file, const CertificateTrust& trust) {
    const reports::ParsedDcc document = reports::parse_dcc(std::string(bytes), file);
    const ImportedCertificate& certificate = document.certificate;
    const std::vector<gum::Diagnostic> reservations = reservations_on(document, file, trust);
    bool unreliable = false;
    for (const gum::Diagnostic& reservation : reservations) {
        if (reservation.code == "GC-DCC-0041") {
            throw gum::InputError(reservation);
        }
        unreliable = unreliable || reservation.severity == gum::Severity::error;
    }
    Importer importer(file);
    const bool any_uncertainty = std::any_of(
        certificate.quantities.begin(), certificate.quantities.end(),
        [](const ImportedQuantity& q) { return q.role == "result" && (q.kind != "none" || !q.objection.empty()); });
    const Rows rows(certificate);
    std::vector<Input> inputs;
    std::vector<std::size_t> quantities;
    std::map<std::string, std::size_t> distributions;
    std::set<std::size_t> tables;  // that inputs come from
    std::vector<std::string> unaccredited;
    for (const ImportedQuantity& q : certificate.quantities) {
        if (q.role != "result" || Rows::is_degrees_of_freedom(q) || is_stated_twice(q)) {
            continue;
        }
        if (any_uncertainty && q.kind == "none" && q.objection.empty()) {
            continue;
        }
        if (std::optional<Input> input = importer.input_of(q); input) {
            const auto nu = q.kind == "expanded" ? rows.degrees_of_freedom(q) : std::nullopt;
            if (nu && !input->is_constant()) {
                input->members.emplace_back("nu", *nu);
            } else if (!is_normal(q.distribution)) {
                ++distributions[q.distribution];
            }
            input->members.emplace_back("description", json_text(description_of(q, rows.place_of(q))));
            input->members.emplace_back("source", json_text(source_of(certificate)));
            note_distribution(q, input->members);
            if (q.in_scope == false) {
                unaccredited.push_back(input->name);
            }
            inputs.push_back(std::move(*input));
            quantities.push_back(static_cast<std::size_t>(&q - certificate.quantities.data()));
            tables.insert(q.table);
        }
    }
    const auto left_out = static_cast<std::size_t>(
        std::count_if(certificate.quantities.begin(), certificate.quantities.end(), [&](const ImportedQuantity& q) {
            const bool in_description = Rows::is_beside(q) && tables.contains(q.table);
            return any_uncertainty && q.role == "result" && q.kind == "none" && q.objection.empty() &&
                   !Rows::is_degrees_of_freedom(q) && !in_description;
        }));
    if (inputs.empty()) {
        std::vector<gum::Diagnostic> refusal = importer.remarks;
        refusal.insert(refusal.begin(), gum::Diagnostic{.code = "GC-DCC-0030",
                                                        .where = file,
                                                        .what = "no result that can be an input of a budget",
                                                        .rule = "results with a number and a known unit are imported",
                                                        .action = "enter the inputs by hand"});
        throw gum::InputError(std::move(refusal));
    }
    ImportedJob out{.job = job_text(certificate, inputs),
                    .remarks = reservations,
                    .quantities = quantities,
                    .negative = unreliable};
    out.remarks.insert(out.remarks.end(), certificate.remarks.begin(), certificate.remarks.end());
    out.remarks.insert(out.remarks.end(), importer.remarks.begin(), importer.remarks.end());
    add_unaccredited(file, unaccredited, out.remarks);
    add_notes(file, inputs.size(), left_out, distributions, out.remarks);
    return out;
}

}  // namespace gumcert::imports
