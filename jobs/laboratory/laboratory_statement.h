#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "jobs/input_text.h"
#include "jobs/job_fields.h"
#include "laboratory/standard_record.h"

namespace gumcert::jobs {

// What the files of a laboratory folder say, and their description (jobs/job_fields.h). Customers and methods are those of
// certificate data; `laboratory` and `accreditation` too.

inline constexpr std::string_view k_laboratory_schema_word = "gumcert/laboratory/1";
inline constexpr std::string_view k_standard_schema_word = "gumcert/standard/1";

/// A person who signs, and what.
struct SignatoryStatement {
    std::string id, name, function, from, to;
    std::vector<std::string> methods;
    bool authorises = true;
};

/// laboratory.json
struct LaboratoryStatement {
    std::vector<SignatoryStatement> signatories;
};

/// standards/ID.json
struct StandardStatement {
    laboratory::StandardRecord record;
};

inline constexpr std::string_view k_date_schema = R"({"$ref": "#/definitions/certificate_date"})";
inline constexpr std::string_view k_unit_schema = R"({"$ref": "#/definitions/certificate_unit"})";
inline constexpr std::string_view k_text_schema = R"({"$ref": "#/definitions/certificate_text"})";

template <class Archive>
void describe_date(Archive& a, std::string_view key, std::string_view sentence) {
    a.by_hand(key, k_date_schema, "a date, \"2026-11-21\"", sentence);
}

template <class Archive>
void describe(Archive& a, SignatoryStatement& r) {
    a.definition("laboratory_signatory");
    a.needed("id", r.id, Line{}, "By which jobs name the person.");
    a.needed("name", r.name, Line{}, "As on certificates.");
    a("function", r.function, Line{}, "In the laboratory.");
    describe_date(a, "from", "First day on which the person may sign.");
    describe_date(a, "to", "Last day; left out: no limit.");
    a.by_code("methods", Several{Line{}},
              "Identifications of the methods that the person may sign for; left out: any.");
    a("authorises", r.authorises, Truth{}, "Whether the person may authorise certificates; true when left out.");
}

template <class Archive>
void describe(Archive& a, LaboratoryStatement& r) {
    a.definition("laboratory", "The file laboratory.json of the folder.");
    a.by_hand("$schema", R"({"type": "string"})", "a text", "For editors; the program does not look at it.");
    a.constant("schema", k_laboratory_schema_word, "The form of the file.");
    a.by_hand("laboratory", R"({"$ref": "#/definitions/certificate_laboratory"})",
              "an object, as in [certificate_data.md](certificate_data.md)",
              "Name and address; logo is relative to the folder.");
    a.by_hand("accreditation", R"({"$ref": "#/definitions/certificate_accreditation"})",
              "an object, as in [certificate_data.md](certificate_data.md)",
              "Accreditation with its scope (CMC); symbol_file is relative to the folder.");
    a.list("signatories", r.signatories, "Who may sign what, and until when.");
    a.by_hand("notes", R"({"type": "string"})", "a text", "For people; the program does not look at it.");
}

template <class Archive>
void describe(Archive& a, laboratory::CalibrationResult& r) {
    a.definition("laboratory_result", "One line of a certificate.");
    a("quantity", r.quantity, Line{}, "Tells the lines apart, where the certificate has several quantities.");
    a("range", r.range, Line{}, "Of the instrument, where the certificate has several.");
    a("mode", r.mode, Line{}, "Such as DC, heating, upwards, where the certificate has several.");
    a("nominal", r.nominal, In{}, "Nominal value, in nominal_unit.");
    a.by_hand("nominal_unit", k_unit_schema, "a unit", "Of nominal, low and high; that of the value when left out.");
    a("low", r.low, In{}, "The line holds from this value on, in nominal_unit; with high.");
    a("high", r.high, In{}, "Up to this one.");
    a.needed("value", r.value, In{}, "As on the certificate.");
    a.needed_by_hand("unit", k_unit_schema, "a unit", "Of value and U.");
    a("U", r.U, In{above_zero("")}, "Expanded uncertainty, with k or p.");
    a("relative_U", r.relative_U,
      In{{.low = 0.0, .high = 1.0, .low_open = true, .hint = "state it as a ratio: 0.5 % is 0.005"}},
      "U over the value, in place of U, as the certificate states it.");
    a("k", r.k, In{{.low = 1.0, .hint = "a coverage factor is not below 1; check that U is an expanded uncertainty"}},
      "Its coverage factor.");
    a("p", r.p,
      In{{.low = 0.0,
          .high = 1.0,
          .low_open = true,
          .high_open = true,
          .hint = "state a probability, not a percentage, such as 0.9545"}},
      "Its coverage probability.");
    a.by_code("nu", Either{In{above_zero("")}, Words<bool, 1>{{{"inf", true}}}},
              "Degrees of freedom; inf when left out.");
    a.exactly_one_of({"U", "relative_U"});
    a.at_least_one_of({"k", "p"});
    a.needs("low", "high");
    a.needs("high", "low");
}

template <class Archive>
void describe(Archive& a, laboratory::Calibration& r) {
    constexpr std::string_view k_routes = R"({"enum": ["1", "2", "3a", "3b", "in_house", "crm"]})";
    a.definition("laboratory_calibration", "One calibration of a standard.");
    a.needed_by_hand("calibrated", k_date_schema, "a date, \"2026-11-21\"", "Date of the calibration.");
    describe_date(a, "valid_to", "Last day on which the laboratory uses it.");
    a.needed("certificate", r.certificate, Line{}, "Number of the certificate.");
    a.by_hand("issuer", k_text_schema, "a text, or one in each language", "Who calibrated it.");
    a("issuer_accreditation", r.issuer_accreditation, Line{}, "Accreditation number of the issuer, or NMI.");
    a.by_hand("route", k_routes, "`1`, `2`, `3a`, `3b`, `in_house` or `crm`",
              "Of ILAC-P10:07/2020, as in certificate data.");
    a("evidence", r.evidence, Line{4096}, "Of competence, where the route demands it.");
    a.by_hand("sha256", R"({"type": "string", "pattern": "^[0-9a-f]{64}$"})", "64 hexadecimal digits",
              "Of the certificate, where it is a file.");
    a.needed_list("results", r.results, "The lines of the certificate.", {.least = 1});
}

template <class Archive>
void describe(Archive& a, laboratory::DriftModel& r) {
    using laboratory::DriftKind;
    constexpr Words<DriftKind, 4> k_models{{{"none", DriftKind::none},
                                            {"limit_per_year", DriftKind::limit_per_year},
                                            {"linear", DriftKind::linear},
                                            {"last_difference", DriftKind::last_difference}}};
    constexpr Words<bool, 2> k_weights{{{"equal", false}, {"by_uncertainty", true}}};
    a.needed(
        "model", r.kind, k_models,
        "none: with a reason; limit_per_year: uniform within a limit that grows with time; linear: a straight line "
        "through the history; last_difference: no more than between the last two calibrations.");
    a("reason", r.reason, Line{4096}, "Why there is no drift, or where the limit is from.");
    a("limit", r.limit, In{above_zero("")},
      "Of limit_per_year: largest change in a year, in unit; in percent or ppm, of a value that is no ratio, a share "
      "of the nominal value of each line.");
    a.by_hand("unit", k_unit_schema, "a unit", "Of limit.");
    a("weights", r.weighted, k_weights, "Of linear: equal, when left out, or by 1/u².");
    a.needs("limit", "unit");
}

template <class Archive>
void describe(Archive& a, laboratory::UsageReading& r) {
    a.definition("laboratory_usage");
    a.needed_by_hand("date", k_date_schema, "a date, \"2026-11-21\"", "Of the reading.");
    a.needed("hours", r.hours, In{not_negative("")}, "That the counter shows.");
}

template <class Archive>
void describe(Archive& a, laboratory::IntervalPlan& r) {
    using laboratory::IntervalMethod;
    constexpr Words<IntervalMethod, 3> k_methods{{{"staircase", IntervalMethod::staircase},
                                                  {"control_chart", IntervalMethod::control_chart},
                                                  {"in_use_time", IntervalMethod::in_use_time}}};
    constexpr Whole k_days{{.low = 1.0, .high = 36'600.0}};
    a.needed("method", r.method, k_methods, "Of ILAC-G24:2022 / OIML D 10:2022, clause 6.");
    a("limit", r.limit, In{above_zero("")},
      "staircase: largest permissible error; control_chart: largest change that is allowed. In percent or ppm, of a "
      "value that is no ratio, a share of the nominal value of each line.");
    a.by_hand("unit", k_unit_schema, "a unit", "Of limit.");
    a("present_days", r.present_days, k_days, "staircase: the interval so far.");
    a("extend_by", r.extend_by, In{{.low = 1.0, .low_open = true}},
      "staircase: factor where the standard was found within 80 % of the limit.");
    a("reduce_by", r.reduce_by, In{{.low = 0.0, .high = 1.0, .low_open = true, .high_open = true}},
      "staircase: factor where it was found outside of the limit.");
    a("least_days", r.least_days, k_days, "Shortest interval; 1 when left out.");
    a("most_days", r.most_days, k_days, "Longest interval; 3653 when left out.");
    a("coverage_factor", r.coverage_factor, In{above_zero("")},
      "control_chart: of the uncertainty of the drift; 2 when left out.");
    a("hours", r.hours, In{above_zero("")}, "in_use_time: hours of use between calibrations.");
    a("hours_at_calibration", r.hours_at_calibration, In{not_negative("")},
      "in_use_time: of the counter at the last calibration; 0 when left out.");
    a.list("readings", r.readings, "in_use_time: of the counter since then, by date.");
}

template <class Archive>
void describe(Archive& a, StandardStatement& r) {
    using laboratory::Interpolation;
    constexpr Words<Interpolation, 3> k_interpolations{
        {{"none", Interpolation::none}, {"nearest", Interpolation::nearest}, {"linear", Interpolation::linear}}};
    a.definition("standard", "A file standards/ID.json of the folder.");
    a.by_hand("$schema", R"({"type": "string"})", "a text", "For editors; the program does not look at it.");
    a.constant("schema", k_standard_schema_word, "The form of the file.");
    a.needed("id", r.record.id, Line{}, "The name of the file without .json.");
    a.needed_by_hand("description", k_text_schema, "a text, or one in each language", "What it is.");
    a("manufacturer", r.record.manufacturer, Line{}, "Of the standard.");
    a("type", r.record.type, Line{}, "Of the standard.");
    a("serial_number", r.record.serial_number, Line{}, "Of the standard.");
    a.by_hand("role", R"({"enum": ["reference", "working"]})", "`reference` or `working`", "working when left out.");
    a.needed_list("calibrations", r.record.calibrations, "All that are known, the earliest first.", {.least = 1});
    a.needed_part("drift", r.record.drift, "How it changes after a calibration.");
    a("interpolation", r.record.interpolation, k_interpolations, "Between calibrated values; none when left out.");
    a.part("interval", r.record.interval, "How the date of the next calibration is found.");
    a.by_hand("notes", R"({"type": "string"})", "a text", "For people; the program does not look at it.");
}

}  // namespace gumcert::jobs
