#pragma once

#include <concepts>
#include <type_traits>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

// Every struct of a certificate is described once, by a function `describe(archive, value)`; what reads a job, what reads
// and writes a record, what writes its JSON Schema and what compares that of jobs walk it. So a key exists once.
// The functions are found by argument-dependent lookup.
//
// What an archive has, where R is nothing, a NumberRule, a TextForm or a list of words { "a", "b" }:
//   a(key, member, R)         a member; may be missing in a job
//   a.needed(key, member, R)  a member without which the object around it means nothing
//   a.filled(key, member)     a member that the program fills in: in records, not in jobs
//   a.filled_if_any(key, member)  the same of a later release: in records only where it is not empty
//   a.stated(key, member, R)  a member that a later release added: in records only where it holds something, never null
//   a.named(key, enumerator, { words })   an enumerator by its name, in the order of the words
//   a.group(key, function)    an object that is no struct of its own: calls function(archive of it)

enum class NumberRule { any, not_negative, positive, at_least_one, one_or_two, probability };

/// What a text holds. `name` is one line of at most 256 bytes, `text` one line of at most 4096; a LocalisedText is one
/// without saying so. Only `text_or_none` may be "".
enum class TextForm { name, text, text_or_none, date, unit, country, sha256, language, decision_rule, profile, file };

template <class Type, class Whole>
concept Described = std::same_as<std::remove_const_t<Type>, Whole>;

template <class Archive, Described<Address> Struct>
void describe(Archive& a, Struct& r) {
    a("lines", r.lines);
    a("country", r.country, TextForm::country);
    a.stated("street", r.street);
    a.stated("street_no", r.street_no);
    a.stated("post_office_box", r.post_office_box);
    a.stated("postcode", r.postcode);
    a.stated("city", r.city);
    a.stated("state", r.state);
}

template <class Archive, Described<CapabilityArgument> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("name", r.name);
    a.needed("unit", r.unit, TextForm::unit);
    a("of", r.of);
}

template <class Archive, Described<CapabilityPoint> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("at", r.at);
    a.needed("U", r.U);
}

// check_capability decides which members a form of capability needs, and checks their values.
template <class Archive, Described<Capability> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("form", r.form, {"value", "range", "function", "table", "matrix"});
    a.needed("unit", r.unit, TextForm::unit);
    a("U", r.U);
    a.stated("percent_of_value", r.percent_of_value, NumberRule::positive);
    a.stated("ppm_of_value", r.ppm_of_value, NumberRule::positive);
    a("arguments", r.arguments);
    a("expression", r.expression, TextForm::text);
    a("points", r.points);
    a("rows", r.rows);
    a("columns", r.columns);
    a("matrix", r.matrix);
    a("lookup", r.lookup, {"", "linear", "next_worse"});
    a("coverage_probability", r.coverage_probability, NumberRule::probability);
}

template <class Archive, Described<Laboratory> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("address", r.address);
    a("email", r.email);
    a("telephone", r.telephone);
    a("web", r.web);
    a("code", r.code);
    a.stated("logo", r.logo, TextForm::file);
    a.filled_if_any("logo_sha256", r.logo_sha256);
    a.filled_if_any("logo_media_type", r.logo_media_type);
    a.filled_if_any("logo_base64", r.logo_base64);
}

template <class Archive, Described<ScopeEntry::Range> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("argument", r.argument);
    a.needed("low", r.low);
    a.needed("high", r.high);
}

template <class Archive, Described<ScopeEntry> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("id", r.id);
    a("measurand", r.measurand);
    a.needed("results", r.results);
    a("methods", r.methods);
    a("places", r.places, {"laboratory", "customer_site", "mobile", "temporary"});
    a("ranges", r.ranges);
    a.needed("capability", r.capability);
}

template <class Archive, Described<Accreditation> Struct>
void describe(Archive& a, Struct& r) {
    a("body", r.body);
    a("number", r.number);
    a("standard", r.standard);
    a("valid_from", r.valid_from, TextForm::date);
    a("valid_to", r.valid_to, TextForm::date);
    a("symbol_file", r.symbol_file, TextForm::file);
    a.filled("symbol_sha256", r.symbol_sha256);
    a.filled("symbol_media_type", r.symbol_media_type);
    a.filled("symbol_base64", r.symbol_base64);
    a("scope", r.scope);
    a("signatories", r.signatories);
}

template <class Archive, Described<Customer> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("address", r.address);
    a("contact", r.contact);
    a("email", r.email);
    a("order", r.order);
}

template <class Archive, Described<Item> Struct>
void describe(Archive& a, Struct& r) {
    a("description", r.description);
    a("manufacturer", r.manufacturer);
    a("type", r.type);
    a("serial_number", r.serial_number);
    a("identification", r.identification);
    a("condition", r.condition);
    a("owner", r.owner);
    a("stated_by_customer", r.stated_by_customer,
      {"description", "manufacturer", "type", "serial_number", "identification", "condition", "owner"});
}

template <class Archive, Described<Place> Struct>
void describe(Archive& a, Struct& r) {
    a("kind", r.kind, {"laboratory", "customer_site", "mobile", "temporary"});
    a("address", r.address);
    a("description", r.description);
}

template <class Archive, Described<Dates> Struct>
void describe(Archive& a, Struct& r) {
    a("received", r.received, TextForm::date);
    a("performed_from", r.performed_from, TextForm::date);
    a("performed_to", r.performed_to, TextForm::date);
    a("authorised", r.authorised, TextForm::date);
    a("issued", r.issued, TextForm::date);
}

template <class Archive, Described<Method> Struct>
void describe(Archive& a, Struct& r) {
    a("identification", r.identification);
    a("version", r.version);
    a("title", r.title);
    a("description", r.description);
    a("standard", r.standard);
    a("valid_from", r.valid_from, TextForm::date);
    a("valid_to", r.valid_to, TextForm::date);
    a("deviations", r.deviations);
    a("no_deviations", r.no_deviations);
}

template <class Archive, Described<StandardUsed::FurtherUncertainty> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("U", r.U, NumberRule::positive);
    a.stated("U_to", r.U_to, NumberRule::positive);
    a("k", r.k, NumberRule::at_least_one);
    a.needed("unit", r.unit, TextForm::unit);
}

template <class Archive, Described<StandardUsed> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("name", r.name);
    a("identification", r.identification);
    a("certificate", r.certificate);
    a("issuer", r.issuer);
    a("issuer_accreditation", r.issuer_accreditation);
    a("route", r.route, {"", "1", "2", "3a", "3b", "in_house", "crm"});
    a("evidence", r.evidence, TextForm::text);
    a("calibrated", r.calibrated, TextForm::date);
    a("valid_to", r.valid_to, TextForm::date);
    a("role", r.role, {"reference", "working"});
    a("U", r.U, NumberRule::positive);
    a.stated("U_to", r.U_to, NumberRule::positive);
    a("k", r.k, NumberRule::at_least_one);
    a("unit", r.unit, TextForm::unit);
    a.stated("further", r.further);
    a("conformity_statement_only", r.conformity_statement_only);
    a("sha256", r.sha256, TextForm::sha256);
}

template <class Archive, Described<Condition> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("quantity", r.quantity);
    a("kind", r.kind, {"", "temperature", "humidity", "pressure"});
    a.needed("minimum", r.minimum);
    a.needed("maximum", r.maximum);
    a.needed("unit", r.unit, TextForm::unit);
    a("U", r.U, NumberRule::positive);
    a("sensor", r.sensor);
    a("lower_limit", r.lower_limit);
    a("upper_limit", r.upper_limit);
}

template <class Archive, Described<Person> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("name", r.name);
    a("function", r.function);
    a("authorised_from", r.authorised_from, TextForm::date);
    a("authorised_to", r.authorised_to, TextForm::date);
}

template <class Archive, Described<Persons> Struct>
void describe(Archive& a, Struct& r) {
    a("performed_by", r.performed_by);
    a("reviewed_by", r.reviewed_by);
    a("authorised_by", r.authorised_by);
}

template <class Archive, Described<AgreedSpecification::Rule> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("id", r.id, TextForm::decision_rule);
    a("guard_factor", r.guard_factor);
    a("guard_band", r.guard_band);
    a("probability", r.probability, NumberRule::probability);
    a("test_uncertainty_ratio", r.test_uncertainty_ratio, NumberRule::positive);
    a("largest_U", r.largest_U, NumberRule::positive);
    a("alternative", r.alternative, TextForm::decision_rule);
    a("population_reliability", r.population_reliability, NumberRule::probability);
    a("population_deviation", r.population_deviation, NumberRule::positive);
    a("population_centre", r.population_centre);
    a("method", r.method, {"", "1", "2", "3", "4", "5", "6", "rds", "rp10"});
    a("text", r.text);
    a("prescribed_by", r.prescribed_by);
}

template <class Archive, Described<PointLimits::Accuracy> Struct>
void describe(Archive& a, Struct& r) {
    a("range", r.range);
    a("unit", r.unit, TextForm::unit);
    a("percent_of_reading", r.percent_of_reading, NumberRule::positive);
    a("percent_of_range", r.percent_of_range, NumberRule::positive);
    a("full_scale", r.full_scale, NumberRule::positive);
    a("digits", r.digits, NumberRule::positive);
    a("digit", r.digit, NumberRule::positive);
    a("constant", r.constant, NumberRule::positive);
}

template <class Archive, Described<PointLimits::Step> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("up_to", r.up_to, NumberRule::positive);
    a.needed("mpe", r.mpe, NumberRule::positive);
}

template <class Archive, Described<PointLimits> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("by", r.by, {"points", "accuracy", "steps", "expression"});
    a("about", r.about);
    a("of", r.of);
    a("range_column", r.range_column);
    a("accuracy", r.accuracy);
    a("steps", r.steps);
    a("arguments", r.arguments);
    a("expression", r.expression, TextForm::text);
    a.stated("limit_low", r.limit_low, TextForm::text);
    a.stated("limit_high", r.limit_high, TextForm::text);
}

template <class Archive, Described<AgreedSpecification> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("id", r.id);
    a.needed("results", r.results);
    a("lower", r.lower);
    a("upper", r.upper);
    a.stated("limits", r.limits);
    a.needed("unit", r.unit, TextForm::unit);
    a("document", r.document);
    a("edition", r.edition);
    a("clause", r.clause);
    a.needed("rule", r.rule);
    a("agreed_by", r.agreed_by);
    a("agreed_on", r.agreed_on, TextForm::date);
    a("agreement", r.agreement);
}

template <class Archive, Described<Opinion> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("text", r.text);
    a("basis", r.basis);
    a("author", r.author);
}

template <class Archive, Described<ExternalResults> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("results", r.results);
    a("provider", r.provider);
}

template <class Archive, Described<Amendment> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("kind", r.kind, {"amended", "replaced"});
    a.needed("number", r.number);
    a("sha256", r.sha256, TextForm::sha256);
    a("reason", r.reason);
    a("changes", r.changes);
    a.stated("record", r.record, TextForm::file);
}

template <class Archive, Described<Omission> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("clause", r.clause);
    a.needed("reason", r.reason);
}

template <class Archive, Described<Waiver> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("finding", r.finding);
    a("where", r.where);
    a.needed("by", r.by);
    a.needed("date", r.date, TextForm::date);
    a.needed("reason", r.reason);
}

template <class Archive, Described<Adjustment> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("adjusted", r.adjusted);
    a("as_found", r.as_found);
}

template <class Archive, Described<Parameter> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("name", r.name);
    a.needed("unit", r.unit, TextForm::unit);
    a.needed("value", r.value);
}

template <class Archive, Described<Profile::Term> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("language", r.language, TextForm::language);
    a.needed("word", r.word);
    a.needed("term", r.term);
}

template <class Archive, Described<Profile> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("id", r.id);
    a.needed("name", r.name);
    a("sources", r.sources, TextForm::text);
    a("digits", r.digits, NumberRule::one_or_two);
    a("rounding", r.rounding, {"half_even", "up"});
    a("below_capability", r.below_capability, {"raise", "outside", "refuse"});
    a("mixed_results", r.mixed_results, {"mark", "separate", "refuse"});
    a("plus_minus_in_tables", r.plus_minus_in_tables);
    a("k_position", r.k_position, {"sentence", "column"});
    a("opinions_with_symbol", r.opinions_with_symbol);
    a("reproduction_sentence_mandatory", r.reproduction_sentence_mandatory);
    a("receipt_date_mandatory", r.receipt_date_mandatory);
    a("reviewer_may_be_performer", r.reviewer_may_be_performer);
    a("required_languages", r.required_languages, TextForm::language);
    a("first_page_sentences", r.first_page_sentences);
    a("uncertainty_sentence", r.uncertainty_sentence, TextForm::text_or_none);
    a.stated("terms", r.terms);
}

template <class Archive, Described<SectionData> Struct>
void describe(Archive& a, Struct& r) {
    a.needed("section", r.section);
    a("item", r.item);
    a("method", r.method);
    a("standards", r.standards);
    a("conditions", r.conditions);
}

template <class Archive, Described<CertificateData> Struct>
void describe(Archive& a, Struct& r) {
    a("status", r.status, {"accredited", "not_accredited", "specimen"});
    a("number", r.number);
    a("languages", r.languages, TextForm::language);
    a("profile", r.profile, TextForm::profile);
    a.filled("own_profile", r.own_profile);
    a("laboratory", r.laboratory);
    a("accreditation", r.accreditation);
    a("customer", r.customer);
    a("item", r.item);
    a("place", r.place);
    a("dates", r.dates);
    a("method", r.method);
    a("standards", r.standards);
    a("conditions", r.conditions);
    a("persons", r.persons);
    a("specifications", r.specifications);
    a("opinions", r.opinions);
    a("remarks", r.remarks);
    a("external_results", r.external_results);
    a("parameters", r.parameters);
    a("sampling", r.sampling);
    a("adjustment", r.adjustment);
    a("simplified_agreement", r.simplified_agreement);
    a("recalibration_date", r.recalibration_date, TextForm::date);
    a("recalibration_agreement", r.recalibration_agreement);
    a("amendment", r.amendment);
    a("omissions", r.omissions);
    a.added("waivers", r.waivers);
    a.stated("annexes", r.annexes, {"", "none", "summary", "full"});
    a.stated("sections", r.sections);
}

// What the evaluation adds. It stands in records only.

template <class Archive, Described<Verdict> Struct>
void describe(Archive& a, Struct& r) {
    a("specification", r.specification);
    a("rule", r.rule);
    a("formula", r.formula);
    a("lower", r.lower);
    a("upper", r.upper);
    a("acceptance_lower", r.acceptance_lower);
    a("acceptance_upper", r.acceptance_upper);
    a("guard_band", r.guard_band);
    a("verdict", r.verdict, {"pass", "fail", "conditional_pass", "conditional_fail", "undetermined", "not_applicable"});
    a("conformance_probability", r.conformance_probability, NumberRule::probability);
    a("specific_risk", r.specific_risk, NumberRule::probability);
    a("largest_specific_risk", r.largest_specific_risk, NumberRule::probability);
    a("false_accept", r.false_accept, NumberRule::probability);
    a("false_reject", r.false_reject, NumberRule::probability);
    a("test_uncertainty_ratio", r.test_uncertainty_ratio, NumberRule::not_negative);
    a("verdict_from_printed", r.verdict_from_printed,
      {"", "pass", "fail", "conditional_pass", "conditional_fail", "undetermined", "not_applicable"});
    a("note", r.note);
    a.group("printed", [&](auto& b) {
        b("lower", r.printed.lower);
        b("upper", r.printed.upper);
        b("acceptance_lower", r.printed.acceptance_lower);
        b("acceptance_upper", r.printed.acceptance_upper);
        b("guard_band", r.printed.guard_band);
        b("conformance_probability", r.printed.conformance_probability);
        b("specific_risk", r.printed.specific_risk);
        b("largest_specific_risk", r.printed.largest_specific_risk);
        b("false_accept", r.printed.false_accept);
        b("false_reject", r.printed.false_reject);
        b("test_uncertainty_ratio", r.printed.test_uncertainty_ratio);
    });
}

template <class Archive, Described<CertifiedValue> Struct>
void describe(Archive& a, Struct& r) {
    a("value", r.value);
    a("u", r.u, NumberRule::not_negative);
    a("U", r.U, NumberRule::not_negative);
    a("k", r.k, NumberRule::positive);
    a("nu_eff", r.nu_eff, NumberRule::positive);
    a("interval", r.interval);
    a("coverage", r.coverage, {"student_t", "normal", "convolution", "monte_carlo", "none"});
    a("printed_value", r.printed_value);
    a("printed_U", r.printed_U);
    a("printed_k", r.printed_k);
    a("printed_nu_eff", r.printed_nu_eff);
    a.added("printed_u", r.printed_u);
    a("printed_low", r.printed_low);
    a("printed_high", r.printed_high);
    a("scope_entry", r.scope_entry);
    a("outside_because", r.outside_because);
    a("capability", r.capability, NumberRule::positive);
    a("printed_capability", r.printed_capability);
    a("raised", r.raised);
    a("external", r.external);
    a("verdict", r.verdict);
}

template <class Archive, Described<CertifiedColumn> Struct>
void describe(Archive& a, Struct& r) {
    a("result", r.result);
    a("name", r.name);
    a("unit", r.unit);
    a("printed_unit", r.printed_unit);
    a("values", r.values);
}

template <class Archive, Described<CertifiedTable::Argument> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit);
    a("printed_unit", r.printed_unit);
    a("values", r.values);
    a("printed", r.printed);
}

template <class Archive, Described<PointColumn> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("heading", r.heading);
    a("role", r.role);
    a("stage", r.stage);
    a("unit", r.unit);
    a("printed_unit", r.printed_unit);
    a("values", r.values);
    a("printed", r.printed);
    a.stated("decimals", r.decimals, {"", "of_uncertainty"});
    a.stated("form", r.form, {"", "sexagesimal"});
}

template <class Archive, Described<ShownColumn> Struct>
void describe(Archive& a, Struct& r) {
    a("show", r.show, {"point", "column", "value", "U", "k", "nu_eff", "limit", "limit_low", "limit_high", "verdict"});
    a("of", r.of);
    a("heading", r.heading);
    a("role", r.role);
    a("stage", r.stage);
    a.stated("form", r.form, {"", "sexagesimal"});
}

template <class Archive, Described<TableRequest::GroupUnit> Struct>
void describe(Archive& a, Struct& r) {
    a("group", r.group);
    a("of", r.of);
    a("unit", r.unit);
}

template <class Archive, Described<TableRequest::RowChoice> Struct>
void describe(Archive& a, Struct& r) {
    a("column", r.column);
    a("is", r.is);
}

template <class Archive, Described<TableRequest> Struct>
void describe(Archive& a, Struct& r) {
    a.stated("section", r.section);
    a("title", r.title);
    a("group_by", r.group_by);
    a("where", r.where);
    a("units", r.units);
    a("columns", r.columns);
    a.stated("plot", r.plot, {"", "none"});
}

template <class Archive, Described<PointTable> Struct>
void describe(Archive& a, Struct& r) {
    a("points", r.points);
    a("columns", r.columns);
    a("tables", r.tables);
}

template <class Archive, Described<TableLayout> Struct>
void describe(Archive& a, Struct& r) {
    a("title", r.title);
    a("group_heading", r.group_heading);
    a("group_role", r.group_role);
    a("group", r.group);
    a("columns", r.columns);
    a("shown", r.shown);
    a.stated("plot", r.plot, {"", "none"});
}

template <class Archive, Described<CertifiedTable> Struct>
void describe(Archive& a, Struct& r) {
    a("id", r.id);
    a.stated("section", r.section);
    a("argument", r.argument);
    a.stated("layout", r.layout);
    a("columns", r.columns);
}

template <class Archive, Described<Finding> Struct>
void describe(Archive& a, Struct& r) {
    a("id", r.id);
    a("clause", r.clause);
    a.named("severity", r.severity, {"information", "minor", "major", "critical"});
    a("where", r.where);
    a("what", r.what);
    a("action", r.action);
}

template <class Archive, Described<Change> Struct>
void describe(Archive& a, Struct& r) {
    a("kind", r.kind,
      {"value",
       "U",
       "k",
       "nu_eff",
       "u",
       "interval",
       "coverage",
       "scope_entry",
       "raised",
       "external",
       "specification",
       "rule",
       "verdict",
       "note",
       "limit_low",
       "limit_high",
       "acceptance_low",
       "acceptance_high",
       "conformance_probability",
       "specific_risk",
       "largest_specific_risk",
       "false_accept",
       "false_reject",
       "test_uncertainty_ratio",
       "cell",
       "words",
       "heading",
       "role",
       "stage",
       "title",
       "group",
       "columns",
       "text",
       "number",
       "flag",
       "code"});
    a("where", r.where);
    a("before", r.before);
    a("after", r.after);
}

template <class Archive, Described<Certificate> Struct>
void describe(Archive& a, Struct& r) {
    a("data", r.data);
    a("profile", r.profile);
    a("tables", r.tables);
    a("findings", r.findings);
    a("blocked", r.blocked);
    a("symbol", r.symbol);
    a.stated("changes", r.changes);
    a.stated("amended_record_sha256", r.amended_record_sha256);
}

}  // namespace gumcert::certificate
