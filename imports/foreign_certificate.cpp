#include "imports/foreign_certificate.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "certificate/dates.h"
#include "certificate/placeholder_text.h"
#include "certificate/stated_text.h"
#include "reports/dcc/dcc_document.h"
#include "reports/dcc/dcc_element.h"
#include "reports/printable_text.h"
#include "signing/verify.h"
#include "text/plus_sign.h"

namespace gumcert::imports {

namespace {

using gum::Diagnostic;
using gum::Severity;

Diagnostic told(const char* code, const std::string& file, std::string what, std::string rule, std::string action,
                Severity severity) {
    return {.code = code,
            .where = file,
            .what = std::move(what),
            .rule = std::move(rule),
            .action = std::move(action),
            .severity = severity};
}

constexpr const char* k_ask = "ask the laboratory for the original document";

/// What was changed after signing, or a value that does not fit: the signature is there and says that.
bool is_broken(const Diagnostic& finding) {
    return finding.severity == Severity::error && (finding.code == "GC-SIGN-0117" || finding.code == "GC-SIGN-0118");
}

/// That the certificate of the signer leads to none that is trusted.
bool is_without_trust(const Diagnostic& finding) {
    return finding.code == "GC-SIGN-0130";
}

Diagnostic worth_of(const signing::SignatureReport& signature, const std::string& file, bool trust_named) {
    const std::string signer = signature.signer.empty() ? "a signer that is not stated" : signature.signer;
    for (const Diagnostic& finding : signature.findings) {
        if (is_broken(finding)) {
            return told("GC-DCC-0041", file, "the signature by " + signer + " is broken: " + finding.what,
                        "what was signed is unchanged", k_ask, Severity::error);
        }
    }
    for (const Diagnostic& finding : signature.findings) {
        if (finding.severity == Severity::error && (trust_named || !is_without_trust(finding))) {
            return told("GC-DCC-0042", file, "the signature by " + signer + " cannot be relied on: " + finding.what,
                        finding.rule, k_ask, Severity::error);
        }
    }
    if (!trust_named) {
        return told("GC-DCC-0043", file,
                    "signed by " + signer + "; the document is as it was signed, who the signer is was not checked",
                    "a signer is known by a certificate that you trust", "name such certificates with --trust",
                    Severity::warning);
    }
    return told("GC-DCC-0044", file, "signed by " + signer + ", valid",
                "the signer's certificate leads to a trusted one", "nothing", Severity::note);
}

void add_signatures(std::string_view bytes, const std::string& file, const CertificateTrust& trust,
                    std::vector<Diagnostic>& out) {
    const bool none = bytes.find("SignatureValue") == std::string_view::npos;
    if (none && trust.trusted) {
        out.push_back(told("GC-DCC-0042", file, "no signature, although trusted certificates are named",
                           "who wants to know the signer has a signed document", k_ask, Severity::error));
    }
    if (bytes.find("Signature") == std::string_view::npos) {
        return;
    }
    try {
        const signing::Verification verification = signing::verify_signatures(
            signing::Bytes(bytes), file, trust.trusted.value_or(std::vector<signing::Bytes>()), trust.now);
        for (const signing::SignatureReport& signature : verification.signatures) {
            out.push_back(worth_of(signature, file, trust.trusted.has_value()));
        }
    } catch (const gum::InputError& refused) {
        out.push_back(told("GC-DCC-0042", file,
                           "a signature that cannot be relied on: " + refused.diagnostics().front().what,
                           refused.diagnostics().front().rule, k_ask, Severity::error));
    }
}

std::optional<double> number_of(const std::string& text) {
    const std::string_view digits = text::without_plus(text);
    double value = 0.0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return failure == std::errc() && end == digits.data() + digits.size() ? std::optional(value) : std::nullopt;
}

/// A value or an interval that cannot be: no finite number, ends in the wrong order, a value outside of its interval, a
/// standard uncertainty larger than the interval, a factor that no probability has.
std::string fault_of_value(const reports::ImportedQuantity& q) {
    constexpr double k_largest_factor = 400.0;  // of a t-distribution with one degree of freedom and 99.7 %
    const std::optional<double> value = number_of(q.value);
    if (q.kind != "none" && (!value || !std::isfinite(*value))) {
        return "the value is " + reports::printable(q.value);
    }
    const std::optional<double> low = number_of(q.low);
    const std::optional<double> high = number_of(q.high);
    if (low && high) {
        const std::string interval =
            "the interval from " + reports::printable(q.low) + " to " + reports::printable(q.high);
        if (!(*low < *high)) {
            return interval + " does not begin before it ends";
        }
        if (value && (*value < *low || *value > *high)) {
            return interval + " does not hold the value " + reports::printable(q.value);
        }
        const std::optional<double> u = number_of(q.u);
        if (u && *u > *high - *low) {
            return interval + " is narrower than the standard uncertainty " + reports::printable(q.u);
        }
    }
    const std::optional<double> k = number_of(q.k);
    return k && *k > k_largest_factor ? "the coverage factor is " + reports::printable(q.k) : "";
}

/// A number of a statement of uncertainty that is none, or out of its range; "" where all are right.
std::string fault_of(const reports::ImportedQuantity& q) {
    for (const auto& [name, text, least] :
         {std::tuple("the expanded uncertainty", &q.U, 0.0), std::tuple("the standard uncertainty", &q.u, 0.0),
          std::tuple("the coverage factor", &q.k, 0.0)}) {
        if (text->empty()) {
            continue;
        }
        const std::optional<double> value = number_of(*text);
        if (!value || !std::isfinite(*value) || !(*value > least)) {
            return std::string(name) + " is " + reports::printable(*text);
        }
    }
    if (const std::string fault = fault_of_value(q); !fault.empty()) {
        return fault;
    }
    const std::optional<double> p = number_of(q.p);
    return !q.p.empty() && !(p && *p > 0.0 && *p < 1.0) ? "the coverage probability is " + reports::printable(q.p) : "";
}

void add_state(const reports::ImportedCertificate& certificate, const std::string& file, std::vector<Diagnostic>& out) {
    if (!certificate.state.empty()) {
        out.push_back(told("GC-DCC-0040", file,
                           "the document is a " + certificate.state + ", not an issued certificate",
                           "traceability rests on certificates that a laboratory has issued",
                           "use its numbers for trials only", Severity::warning));
    }
}

/// Elements that stand once below their parent, and twice in a document that says two things.
void add_repetitions(const reports::XmlElement& root, const std::string& file, std::vector<Diagnostic>& out) {
    static constexpr std::array<std::string_view, 24> k_once = {"si:value",
                                                                "si:unit",
                                                                "si:valueXMLList",
                                                                "si:unitXMLList",
                                                                "si:valueExpandedMU",
                                                                "si:valueStandardMU",
                                                                "si:coverageFactor",
                                                                "si:coverageProbability",
                                                                "si:distribution",
                                                                "si:intervalMin",
                                                                "si:intervalMax",
                                                                "si:measurementUncertaintyUnivariate",
                                                                "si:expandedMU",
                                                                "si:standardMU",
                                                                "si:coverageIntervalMU",
                                                                "dcc:coreData",
                                                                "dcc:uniqueIdentifier",
                                                                "dcc:beginPerformanceDate",
                                                                "dcc:endPerformanceDate",
                                                                "dcc:issueDate",
                                                                "dcc:calibrationLaboratory",
                                                                "dcc:customer",
                                                                "dcc:administrativeData",
                                                                "dcc:measurementResults"};
    reports::for_each_element(root, [&](const reports::XmlElement& e) {
        for (const std::string_view name : k_once) {
            if (e.children_named(std::string(name)).size() > 1) {
                out.push_back(told("GC-DCC-0047", reports::place_of(e, file),
                                   std::string(name.substr(name.find(':') + 1)) + " stands twice in one element",
                                   "the schema has it once: two of them say two things", k_ask, Severity::error));
            }
        }
    });
}

std::string as_day(const std::string& text) {
    constexpr std::size_t k_day = 10;
    return certificate::calendar_date(std::string_view(text).substr(0, k_day)) ? text.substr(0, k_day) : "";
}

/// Days that are none, or in an order that they cannot have.
void add_dates(const reports::ImportedCertificate& c, const std::string& file, std::int64_t now,
               std::vector<Diagnostic>& out) {
    constexpr std::int64_t k_year_9000 = 221845392000;  // a caller without a clock
    const bool clock = now > 0 && now < k_year_9000;
    const auto tomorrow = std::chrono::floor<std::chrono::days>(
        std::chrono::sys_seconds(std::chrono::seconds(clock ? now + 24 * 3600 : 0)));  // it is tomorrow further east
    const auto add = [&](std::string what) {
        out.push_back(told("GC-DCC-0048", file, std::move(what),
                           "a calibration is done, then its certificate issued, and both are past", k_ask,
                           Severity::warning));
    };
    for (const std::string* text : {&c.performed_from, &c.performed_to, &c.issued}) {
        const std::string day = as_day(*text);
        if (!text->empty() && day.empty()) {
            add("the date \"" + reports::printable(*text) + "\" is none");
        } else if (!day.empty() && clock && std::chrono::sys_days(*certificate::calendar_date(day)) > tomorrow) {
            add("the date " + day + " is in the future");
        }
    }
    const std::string issued = as_day(c.issued);
    if (!issued.empty() && issued < as_day(c.performed_to)) {
        add("issued on " + issued + ", before the work ended on " + as_day(c.performed_to));
    }
}

/// What a document says of itself: its number, and that it has results.
void add_identity(const reports::ImportedCertificate& c, const std::string& file, std::vector<Diagnostic>& out) {
    if (c.state.empty() && certificate::is_of_a_draft(c.identifier)) {
        out.push_back(told("GC-DCC-0040", file,
                           "the number \"" + reports::printable(c.identifier) +
                               "\" is that of a draft or sample, not of an issued certificate",
                           "traceability rests on certificates that a laboratory has issued",
                           "use its numbers for trials only", Severity::warning));
    } else if (!certificate::is_identification(c.identifier)) {
        out.push_back(told("GC-DCC-0040", file, "the number \"" + reports::printable(c.identifier) + "\" is none",
                           "a certificate has a number of its own", k_ask, Severity::warning));
    }
    if (c.quantities.empty()) {
        out.push_back(told("GC-DCC-0049", file, "no results", "a certificate has results", k_ask, Severity::error));
    }
}

void add_contents(const reports::ParsedDcc& document, const std::string& file, std::int64_t now,
                  std::vector<Diagnostic>& out) {
    add_identity(document.certificate, file, out);
    add_dates(document.certificate, file, now, out);
    add_repetitions(document.root, file, out);
}

}  // namespace

std::vector<Diagnostic> reservations_on(const reports::ParsedDcc& document, const std::string& file,
                                        const CertificateTrust& trust) {
    const reports::ImportedCertificate& certificate = document.certificate;
    std::vector<Diagnostic> out;
    add_state(certificate, file, out);
    add_signatures(document.bytes, file, trust, out);
    add_contents(document, file, trust.now, out);
    for (const reports::ImportedQuantity& q : certificate.quantities) {
        const std::string fault = q.objection.empty() && q.kind == "coverage_interval" ? fault_of_value(q) : "";
        if (!fault.empty()) {
            out.push_back(told("GC-DCC-0046", file + ": " + q.name, fault,
                               "a statement of uncertainty is a number, stands once, and its k belongs to its p", k_ask,
                               Severity::error));
        }
    }
    std::vector<Diagnostic> breaches = reports::check_dcc_structure(document.root, file);
    const std::vector<Diagnostic> rules = reports::check_dcc(document.root, file);
    breaches.insert(breaches.end(), rules.begin(), rules.end());
    std::erase_if(breaches, [](const Diagnostic& d) { return d.severity != Severity::error; });
    if (!breaches.empty()) {
        out.push_back(told("GC-DCC-0045", file,
                           std::to_string(breaches.size()) + (breaches.size() == 1 ? " rule is" : " rules are") +
                               " broken, the first at " + breaches.front().where + ": " + breaches.front().what,
                           breaches.front().rule, "gumcert check dcc lists all of them", Severity::warning));
    }
    return out;
}

std::vector<Diagnostic> check_certificate(const reports::ParsedDcc& document, const std::string& file,
                                          const CertificateTrust& trust) {
    const reports::ImportedCertificate& certificate = document.certificate;
    std::vector<Diagnostic> out;
    add_state(certificate, file, out);
    add_signatures(document.bytes, file, trust, out);
    add_contents(document, file, trust.now, out);
    out.insert(out.end(), certificate.remarks.begin(), certificate.remarks.end());
    for (const reports::ImportedQuantity& q : certificate.quantities) {
        const std::string fault = q.objection.empty() ? fault_of(q) : q.objection;
        if (!fault.empty()) {
            out.push_back(told("GC-DCC-0046", file + ": " + q.name, fault,
                               "a statement of uncertainty is a number, stands once, and its k belongs to its p",
                               "correct the statement", Severity::error));
        }
    }
    const std::vector<Diagnostic> schema = reports::check_dcc_structure(document.root, file);
    out.insert(out.end(), schema.begin(), schema.end());
    const std::vector<Diagnostic> breaches = reports::check_dcc(document.root, file);
    out.insert(out.end(), breaches.begin(), breaches.end());
    return out;
}

std::vector<Diagnostic> check_certificate(std::string_view bytes, const std::string& file,
                                          const CertificateTrust& trust) {
    return check_certificate(reports::parse_dcc(std::string(bytes), file), file, trust);
}

}  // namespace gumcert::imports
