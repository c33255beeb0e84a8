#include "app/import_certificate.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "gum/expression/syntax_tree.h"
#include "reports/certificate_view.h"
#include "reports/dcc/dcc_reader.h"

namespace gumcert::app {

namespace {

using reports::ImportedCertificate;
using reports::ImportedNumber;
using reports::ImportedQuantity;

/// A number of a certificate as JSON wants it, with the digits that stand there: "+.50" → "0.50", "5." → "5". Nothing
/// for NaN or another text that is no finite number.
std::optional<std::string> json_number(const std::string& text) {
    std::string number = text.starts_with('+') ? text.substr(1) : text;
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
    const nlohmann::json parsed = nlohmann::json::parse(number, nullptr, false);
    const bool finite = parsed.is_number() && std::isfinite(parsed.get<double>());
    return finite ? std::optional(number) : std::nullopt;
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
};

class Importer {
public:
    explicit Importer(std::string file) : file_(std::move(file)) {}

    /// Nothing where the statement of uncertainty cannot be used: remarked.
    std::optional<Input> input_of(const ImportedQuantity& q);
    std::vector<gum::Diagnostic> remarks;

private:
    void remark(const ImportedQuantity& q, const std::string& what, const std::string& rule,
                const std::string& action) {
        remarks.push_back({.code = "GC-DCC-0031",
                           .where = file_ + ": " + q.name,
                           .what = what,
                           .rule = rule,
                           .action = action,
                           .severity = gum::Severity::warning});
    }
    bool add_uncertainty(const ImportedQuantity& q, Members& members);
    bool add_interval(const ImportedQuantity& q, Members& members);
    std::string name_for(const ImportedQuantity& q);

    std::string file_;
    std::set<std::string, std::less<>> names_;
};

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
    const auto k = json_number(q.k);
    const auto p = json_number(q.p);
    if (!k && !p) {
        remark(q, "U without k and p", "an expanded uncertainty needs its coverage factor", "add the input by hand");
        return false;
    }
    members.emplace_back("U", *stated);
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
        remark(q, "unit " + json_text(q.d_si_unit) + " is not known here", "an input has a unit of UDUNITS-2",
               "add the input by hand, in a unit that is known");
        return std::nullopt;
    }
    Input input;
    input.members = {{"unit", json_text(q.unit)}, {"value", *value}};
    if (q.kind == "none") {
        input.members.emplace_back("constant", "true");
    } else if (!add_uncertainty(q, input.members)) {
        return std::nullopt;
    }
    input.name = name_for(q);
    return input;
}

/// Distributions other than the normal one are not carried over by U and k alone.
void note_distribution(const ImportedQuantity& q, Members& members) {
    std::string note;
    if (!q.distribution.empty() && q.distribution != "normal") {
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

std::string source_of(const ImportedCertificate& c) {
    return "certificate " + c.identifier + (c.laboratory.empty() ? "" : ", " + c.laboratory) + ", SHA-256 " + c.sha256;
}

std::string description_of(const ImportedQuantity& q) {
    std::string text = q.result;
    if (!q.quantity.empty()) {
        text += (text.empty() ? "" : ": ") + q.quantity;
    }
    if (q.row) {
        text += (text.empty() ? "" : ", ") + std::string("row ") + std::to_string(*q.row + 1);
    }
    return text;
}

std::string job_text(const ImportedCertificate& c, const std::vector<Input>& inputs) {
    std::string result = "y";
    while (std::any_of(inputs.begin(), inputs.end(), [&](const Input& input) { return input.name == result; })) {
        result += '_';
    }
    std::string text = "{\n \"schema\": \"gumcert/job/1\",\n \"kind\": \"budget\",\n";
    text += " \"title\": " + json_text("Inputs from certificate " + c.identifier) + ",\n";
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

ImportedJob import_certificate(std::string_view bytes, const std::string& file) {
    const ImportedCertificate certificate = reports::read_dcc(bytes, file);
    Importer importer(file);
    const bool any_uncertainty =
        std::any_of(certificate.quantities.begin(), certificate.quantities.end(),
                    [](const ImportedQuantity& q) { return q.role == "result" && q.kind != "none"; });
    std::vector<Input> inputs;
    for (const ImportedQuantity& q : certificate.quantities) {
        if (q.role != "result" || (any_uncertainty && q.kind == "none")) {
            continue;
        }
        if (std::optional<Input> input = importer.input_of(q); input) {
            input->members.emplace_back("description", json_text(description_of(q)));
            input->members.emplace_back("source", json_text(source_of(certificate)));
            note_distribution(q, input->members);
            inputs.push_back(std::move(*input));
        }
    }
    if (inputs.empty()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-DCC-0030",
                                              .where = file,
                                              .what = "no result that can be an input of a budget",
                                              .rule = "results with a number and a known unit are imported",
                                              .action = "enter the inputs by hand"});
    }
    ImportedJob out{.job = job_text(certificate, inputs), .remarks = certificate.remarks};
    out.remarks.insert(out.remarks.end(), importer.remarks.begin(), importer.remarks.end());
    if (inputs.size() > 1) {
        out.remarks.push_back(
            {.code = "GC-DCC-0032",
             .where = file,
             .what = std::to_string(inputs.size()) + " inputs from one certificate",
             .rule = "results of one calibration usually share errors; the job holds them as independent",
             .action = "state `correlations` or `covariance` where the certificate gives reason to",
             .severity = gum::Severity::note});
    }
    return out;
}

}  // namespace gumcert::app
