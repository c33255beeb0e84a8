#pragma once

#include <concepts>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "certificate/certificate_fields.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::jobs::test {

/// Writes certificate data as a job states them: without what the program fills in, and without what is empty.
class CertificateJsonWriter {
public:
    nlohmann::json object = nlohmann::json::object();

    template <class Type, class... Rule>
    void operator()(const char* key, const Type& v, Rule...) {
        nlohmann::json value = to_json(v);
        if (!value.is_null()) {
            object[key] = std::move(value);
        }
    }
    template <class Type>
    void operator()(const char* key, const Type& v, std::initializer_list<const char*>) {
        (*this)(key, v);
    }
    template <class Type, class... Rule>
    void needed(const char* key, const Type& v, Rule... rule) {
        (*this)(key, v, rule...);
    }
    template <class Type>
    void needed(const char* key, const Type& v, std::initializer_list<const char*>) {
        (*this)(key, v);
    }
    template <class Type, class... Rule>
    void added(const char* key, const Type& v, Rule... rule) {
        (*this)(key, v, rule...);
    }
    template <class Type, class... Rule>
    void stated(const char* key, const Type& v, Rule... rule) {
        (*this)(key, v, rule...);
    }
    template <class Type>
    void stated(const char* key, const Type& v, std::initializer_list<const char*>) {
        (*this)(key, v);
    }
    template <class Type>
    void filled(const char*, const Type&) {}
    template <class Type>
    void filled_if_any(const char*, const Type&) {}

    template <class Struct>
    static nlohmann::json structure(const Struct& v) {
        CertificateJsonWriter inner;
        describe(inner, v);
        return inner.object;
    }

private:
    template <class Type>
    static nlohmann::json to_json(const Type& v) {
        if constexpr (std::same_as<Type, std::string>) {
            return v.empty() ? nlohmann::json() : nlohmann::json(v);
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            nlohmann::json all;
            for (const auto& [language, text] : v.by_language) {
                all[language] = text;
            }
            return v.by_language.empty() ? to_json(v.plain) : all;
        } else if constexpr (requires { v.has_value(); }) {
            return v.has_value() ? to_json(*v) : nlohmann::json();
        } else if constexpr (requires { v.size(); }) {
            nlohmann::json all;
            for (const auto& element : v) {
                all.push_back(to_json(element));
            }
            return all;
        } else if constexpr (std::is_class_v<Type>) {
            nlohmann::json inner = structure(v);
            return inner.empty() ? nlohmann::json() : inner;
        } else {
            return v;
        }
    }
};

/// The sample with every key that certificate data have: five forms of capability, an opinion, an amendment …
inline certificate::CertificateData complete_certificate_data() {
    using namespace certificate;
    CertificateData d = gumcert::test::sample_certificate_data();
    for (Address* address : {&d.laboratory.address, &d.customer.address, &d.place.address}) {
        address->street = "Example Street";
        address->street_no = "1";
        address->post_office_box = "PO Box 7";
        address->postcode = "12345";
        address->city = "Example Town";
        address->state = "Region";
    }
    d.laboratory.logo = "symbol.png";  // a file that the tests have
    const auto scope_entry = [&](const std::string& id, const Capability& capability) {
        ScopeEntry entry = d.accreditation->scope.front();
        entry.id = id;
        entry.capability = capability;
        d.accreditation->scope.push_back(entry);
    };
    AgreedSpecification of_points = d.specifications.front();
    of_points.id = "of_points";
    of_points.lower.reset();
    of_points.upper.reset();
    of_points.limits.emplace();
    of_points.limits->by = "accuracy";
    of_points.limits->about = "nominal";
    of_points.limits->of = "V_s";
    of_points.limits->accuracy = {{.range = "10 V",
                                   .unit = "mm",
                                   .percent_of_reading = 0.01,
                                   .percent_of_range = 0.001,
                                   .full_scale = 1000.0,
                                   .digits = 2.0,
                                   .digit = 0.1,
                                   .constant = 0.5}};
    d.specifications.push_back(of_points);
    of_points.id = "of_steps";
    of_points.limits.emplace();
    of_points.limits->by = "steps";
    of_points.limits->arguments = {{.name = "L", .unit = "mm", .of = "L_n"}};
    of_points.limits->steps = {{.up_to = 10.0, .mpe = 0.12}};
    d.specifications.push_back(of_points);
    of_points.id = "of_expression";
    of_points.limits.emplace();
    of_points.limits->by = "expression";
    of_points.limits->arguments = {{.name = "L", .unit = "mm", .of = "L_n"}};
    of_points.limits->expression = "0.1 + 0.001*L";
    d.specifications.push_back(of_points);
    of_points.id = "of_two_expressions";
    of_points.limits->expression.clear();
    of_points.limits->limit_low = "-0.01*L";
    of_points.limits->limit_high = "0.03*L";
    d.specifications.push_back(of_points);
    Capability range;
    range.form = "range";
    range.unit = "um";
    range.arguments = {{.name = "L", .unit = "mm", .of = "value"}};
    range.points = {{.at = 0.1, .U = 0.8}, {.at = 0.5, .U = 1.6}};
    scope_entry("range", range);
    Capability table = range;
    table.form = "table";
    table.lookup = "linear";
    scope_entry("table", table);
    Capability matrix = range;
    matrix.form = "matrix";
    matrix.points.clear();
    matrix.arguments.push_back({.name = "T", .unit = "degC", .of = "temperature"});
    matrix.rows = {1.0, 2.0};
    matrix.columns = {18.0, 22.0};
    matrix.matrix = {{0.1, 0.2}, {0.3, 0.4}};
    matrix.lookup = "next_worse";
    scope_entry("matrix", matrix);
    Capability share;
    share.form = "value";
    share.unit = range.unit;
    share.arguments = {{.name = "L", .unit = range.unit, .of = range.arguments.front().of}};
    share.percent_of_value = 0.01;
    scope_entry("percent_of_value", share);
    share.percent_of_value.reset();
    share.ppm_of_value = 10.0;
    scope_entry("ppm_of_value", share);

    d.place = {
        .kind = "customer_site", .address = {.lines = {"Hall 3"}, .country = "AT"}, .description = d.place.description};
    d.method.valid_to = "2027-12-31";
    d.method.no_deviations = false;
    d.method.deviations = {gumcert::test::in_two_languages("Reduced number of positions.", "Weniger Positionen.")};
    d.standards.front().evidence = "Comparison report CR-7";
    d.standards.front().conformity_statement_only = true;
    d.standards.front().U_to = 0.05;
    d.standards.front().further = {{.U = 2e-6, .U_to = 5e-6, .k = 2.0, .unit = "A"}};
    d.persons.authorised_by->authorised_to = "2027-12-31";
    d.persons.performed_by->authorised_from = d.persons.reviewed_by->authorised_from = "2024-01-01";
    d.persons.performed_by->authorised_to = d.persons.reviewed_by->authorised_to = "2027-12-31";
    AgreedSpecification::Rule& rule = d.specifications[1].rule;
    rule = {};
    rule.id = "DR-02";
    rule.test_uncertainty_ratio = 4.0;
    rule.largest_U = 1.0;
    rule.alternative = "DR-04";
    rule.guard_factor = 0.5;
    rule.text = "As agreed.";
    rule.prescribed_by = "Contract 88-2026";
    AgreedSpecification other = gumcert::test::sample_specification("other", "EBA", -10.0, 10.0, "arcsec");
    other.rule = {};
    other.rule.id = "DR-05";
    other.rule.guard_band = 1.0;
    d.specifications.push_back(other);
    other.id = "population";
    other.rule = {};
    other.rule.id = "DR-09";
    other.rule.method = "1";
    other.rule.probability = 0.02;
    other.rule.population_deviation = 3.0;
    other.rule.population_centre = 0.5;
    d.specifications.push_back(other);
    other.id = "reliability";
    other.rule.population_deviation.reset();
    other.rule.population_centre.reset();
    other.rule.population_reliability = 0.9;
    d.specifications.push_back(other);
    d.opinions = {gumcert::test::sample_opinion()};
    d.opinions.front().author.authorised_from = "2024-01-01";
    d.opinions.front().author.authorised_to = "2027-12-31";
    d.external_results = {{.results = {"ECA"}, .provider = "Other Example Laboratory"}};
    d.parameters = {{.name = "T", .unit = "degC", .value = 20.1}};
    d.sampling = gumcert::test::in_two_languages("All items", "Alle Teile");
    d.adjustment = Adjustment{.adjusted = true, .as_found = "Certificate EX-2026-0041"};
    d.simplified_agreement = "Contract 88-2026, 4";
    d.recalibration_date = "2028-11-21";
    d.recalibration_agreement = "Contract 88-2026, 5";
    d.amendment = Amendment{.kind = "replaced",
                            .number = "EX-2026-0040",
                            .sha256 = std::string(64, 'c'),
                            .reason = gumcert::test::in_two_languages("Wrong serial number", "Falsche Seriennummer"),
                            .changes = {"Serial number"},
                            .record = "earlier.json"};
    d.omissions = {{.clause = "7.8.2.1 k", .reason = "No sampling was needed"}};
    d.waivers = {{.finding = "U10",
                  .where = "/results/l/budget/0, u",
                  .by = "Head of laboratory",
                  .date = "2026-11-20",
                  .reason = "The maker states it so, in writing."}};
    d.annexes = "summary";
    Address& parts = d.place.address;
    parts.street = "Example Street";
    parts.street_no = "3";
    parts.post_office_box = "PO Box 7";
    parts.postcode = "1010";
    parts.city = "Example Town";
    parts.state = "Region";
    SectionData section;
    section.section = "length";
    section.item = d.item;
    section.method = d.method;
    section.standards = {d.standards.front().identification};
    section.conditions = d.conditions;
    d.sections = {section};
    return d;
}

}  // namespace gumcert::jobs::test
