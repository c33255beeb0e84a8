#include "jobs/laboratory/register_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "certificate/dates.h"
#include "gum/quantity/unit.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/job_reader.h"
#include "jobs/laboratory/laboratory_codes.h"
#include "text/counts.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using certificate::TextForm;
using laboratory::Calibration;
using laboratory::CalibrationResult;
using laboratory::DriftKind;
using laboratory::IntervalMethod;
using laboratory::IntervalPlan;
using laboratory::StandardRecord;
using nlohmann::json;

/// What both readers of the register need.
class RegisterObjects {
public:
    RegisterObjects(const JsonDocument& document, ProblemList& problems) : document_(document), problems_(problems) {}

    /// The document as an object with the right `schema`.
    template <class Struct>
    std::optional<JsonObject> root(std::string_view schema) {
        std::optional<JsonObject> object = JsonObject::root(document_, keys_of<Struct>(), problems_);
        if (!object) {
            return std::nullopt;
        }
        const auto word = object->required_string("schema");
        if (word && *word != schema) {
            object->refuse(k_laboratory_schema, "schema", text::in_quotes(*word),
                           "this file of the laboratory has the schema " + text::in_quotes(schema),
                           "see docs/laboratory.md for the files of the folder");
        }
        return object;
    }

    [[nodiscard]] CertificatePlace place(const std::string& pointer) const { return {&document_, pointer, &problems_}; }

    /// A text of a form of its own; "" where it is absent or was refused.
    std::string text(const JsonObject& object, std::string_view key, TextForm form) {
        const auto found = object.optional_name(key);
        return found && acceptable_text(*found, form, place(object.pointer(key))) ? *found : std::string();
    }
    std::string needed_text(const JsonObject& object, std::string_view key, TextForm form) {
        (void)object.require(key);
        return text(object, key, form);
    }
    std::string word(const JsonObject& object, std::string_view key, std::initializer_list<const char*> words) {
        const auto found = object.optional_string(key);
        return found && acceptable_word(*found, words, place(object.pointer(key))) ? *found : std::string();
    }
    certificate::LocalisedText localised(const JsonObject& object, std::string_view key) {
        certificate::LocalisedText text;
        if (const json* value = object.find(key)) {
            read_localised(*value, text, false, place(object.pointer(key)));
        }
        return text;
    }

    /// Every object of a list.
    template <class Struct, class Each>
    void each(const JsonObject& object, std::string_view key, const Each& read) {
        const json* list = object.optional_array(key);
        for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
            const std::string pointer = child_pointer(object.pointer(key), i);
            if ((*list)[i].is_object()) {
                read(JsonObject(document_, pointer, keys_of<Struct>(), problems_));
            } else if (!(*list)[i].is_discarded()) {
                refuse_type((*list)[i], "an object", place(pointer));
            }
        }
    }

private:
    const JsonDocument& document_;
    ProblemList& problems_;
};

class StandardFileReader {
public:
    StandardFileReader(const JsonDocument& document, ProblemList& problems) : objects_(document, problems) {}

    std::optional<StandardRecord> read() {
        const std::optional<JsonObject> root = objects_.root<StandardStatement>(k_standard_schema_word);
        if (!root) {
            return std::nullopt;
        }
        StandardStatement statement;
        JobReader(*root).read(statement);
        record_ = std::move(statement.record);
        (void)root->require("description");
        record_.description = objects_.localised(*root, "description");
        if (const std::string role = objects_.word(*root, "role", {"reference", "working"}); !role.empty()) {
            record_.role = role;
        }
        read_calibrations(*root);
        if (const auto drift = root->optional_object("drift", keys_of<laboratory::DriftModel>())) {
            read_drift(*drift);
        }
        if (const auto interval = root->optional_object("interval", keys_of<IntervalPlan>())) {
            read_interval(*interval);
        }
        return std::move(record_);
    }

private:
    void read_calibrations(const JsonObject& root) {
        (void)root.require("calibrations");
        objects_.each<Calibration>(root, "calibrations", [&](const JsonObject& object) {
            Calibration& calibration = record_.calibrations.emplace_back();
            JobReader(object).read(calibration);
            calibration.calibrated = objects_.needed_text(object, "calibrated", TextForm::date);
            calibration.valid_to = objects_.text(object, "valid_to", TextForm::date);
            calibration.issuer = objects_.localised(object, "issuer");
            calibration.route = objects_.word(object, "route", {"1", "2", "3a", "3b", "in_house", "crm"});
            calibration.sha256 = objects_.text(object, "sha256", TextForm::sha256);
            const std::size_t before = record_.calibrations.size() - 1;
            if (before > 0 &&
                !certificate::is_after(calibration.calibrated, record_.calibrations[before - 1].calibrated) &&
                !calibration.calibrated.empty() && !record_.calibrations[before - 1].calibrated.empty()) {
                object.refuse(k_laboratory_order, "calibrated",
                              calibration.calibrated + " after " + record_.calibrations[before - 1].calibrated,
                              "calibrations follow each other by date, the earliest first, one a day",
                              "put them into the order of their dates");
            }
            if (certificate::is_after(calibration.calibrated, calibration.valid_to)) {
                object.refuse(k_laboratory_order, "valid_to",
                              calibration.valid_to + ", before the calibration on " + calibration.calibrated,
                              "the last day of use is not before the calibration", "correct one of the two days");
            }
            read_results(object, calibration);
        });
        if (record_.calibrations.empty() && root.has("calibrations")) {
            root.refuse(k_certificate_empty_list, "calibrations", "no calibration",
                        "a standard in the register was calibrated once at least", "add the calibration");
        }
    }

    void read_results(const JsonObject& object, Calibration& calibration) {
        (void)object.require("results");
        std::set<std::tuple<std::string, std::string, std::string, bool, double, std::string>> lines;
        objects_.each<CalibrationResult>(object, "results", [&](const JsonObject& line) {
            CalibrationResult& result = calibration.results.emplace_back();
            JobReader(line).read(result);
            result.unit = objects_.needed_text(line, "unit", TextForm::unit);
            result.nominal_unit = objects_.text(line, "nominal_unit", TextForm::unit);
            read_relative(line, result);
            read_degrees_of_freedom(line, result);
            if (!line.has("k") && !line.has("p")) {
                line.refuse(k_laboratory_coverage, line.has("relative_U") ? "relative_U" : "U",
                            "U with neither k nor p",
                            "an expanded uncertainty means something with its coverage factor or probability only",
                            "state k, or p, as the certificate does");
            }
            if (result.low.has_value() != result.high.has_value() || (result.low && *result.low > *result.high)) {
                line.refuse(k_certificate_limits, result.low ? "low" : "high", "limits that are none",
                            "low and high are stated together, low not above high", "correct the limits");
            }
            if (!lines
                     .emplace(result.quantity, result.range, result.mode, result.nominal.has_value(),
                              result.nominal.value_or(0.0),
                              result.nominal_unit.empty() ? result.unit : result.nominal_unit)  // 10 V is not 10 mV
                     .second) {
                line.refuse(k_certificate_repeated, "value", "the line stands here for the second time",
                            "quantity, range, mode and nominal value tell the lines of a certificate apart",
                            "add what tells it apart, or remove it");
            }
        });
        if (calibration.results.empty() && object.has("results")) {
            object.refuse(k_certificate_empty_list, "results", "no line", "a certificate states one value at least",
                          "add the values");
        }
    }

    /// Whether a value is as small beside its nominal value, or the ends of its range, as errors and corrections are.
    static bool is_small_beside_its_place(const CalibrationResult& result, const gum::Unit& unit) {
        constexpr double k_small = 0.01;
        const gum::Unit of = result.nominal_unit.empty() ? unit : gum::Unit::parse(result.nominal_unit);
        if (!gum::of_one_kind(of, unit)) {
            return false;
        }
        return std::ranges::any_of(
            std::array{result.nominal, result.low, result.high}, [&](const std::optional<double>& at) {
                return at && std::abs(unit.to_si(result.value)) < k_small * std::abs(of.to_si(*at));
            });
    }

    static void read_relative(const JsonObject& line, CalibrationResult& result) {
        const bool is_relative = line.has("relative_U");
        if (is_relative == line.has("U")) {
            line.refuse(k_laboratory_coverage, is_relative ? "relative_U" : "U",
                        is_relative ? "U and relative_U" : "neither U nor relative_U",
                        "a line states its expanded uncertainty once",
                        is_relative ? "keep the one that the certificate states"
                                    : "state U, or relative_U where the certificate states it as a share of the value");
        } else if (result.relative_U) {
            // What a unit with an origin of its own, or a level, calls 0 is no size that anything could be a share of.
            const gum::Unit unit = result.unit.empty() ? gum::Unit() : gum::Unit::parse(result.unit);
            const bool has_origin = unit.is_celsius_temperature() || unit.to_si(0.0) != 0.0 ||
                                    unit.dimension() == gum::Unit::parse("dB").dimension();
            if (result.value == 0.0 || has_origin) {
                line.refuse(
                    k_laboratory_coverage, "relative_U",
                    has_origin ? "relative_U of a value in " + text::in_quotes(result.unit)
                               : std::string("relative_U of the value 0"),
                    "a relative uncertainty is one of a value other than 0, of a scale without an origin of its own",
                    "state U in the unit of the value");
            } else if (is_small_beside_its_place(result, unit)) {
                line.refuse(k_laboratory_coverage, "relative_U",
                            "relative_U of a value that is less than a hundredth of what it was measured at",
                            "of an error or a correction, certificates state U as a share of what was measured, and "
                            "relative_U is one of \"value\"",
                            "state U in the unit of the value");
            }
            result.U = *result.relative_U * std::abs(result.value);
        }
    }

    void read_degrees_of_freedom(const JsonObject& line, CalibrationResult& result) {
        const json* nu = line.find("nu");
        if (nu == nullptr || (nu->is_string() && nu->get_ref<const std::string&>() == "inf")) {
            return;
        }
        result.nu = line.optional_number("nu", above_zero(""));
    }

    void read_drift(const JsonObject& object) {
        laboratory::DriftModel& drift = record_.drift;
        drift.unit = objects_.text(object, "unit", TextForm::unit);
        const bool is_limit = drift.kind == DriftKind::limit_per_year;
        if (drift.kind == DriftKind::none && object.has("model") && !object.has("reason")) {
            object.refuse(k_laboratory_drift, "model", "no drift, and no reason",
                          "that a standard does not change is a statement of the laboratory",
                          "state \"reason\", or another model");
        }
        if (is_limit && (!object.has("limit") || !object.has("unit"))) {
            object.refuse(k_laboratory_drift, "model", "a limit a year that is not stated",
                          "the model limit_per_year has a limit with its unit", "add \"limit\" and \"unit\"");
        }
        if (!is_limit && object.has("limit")) {
            object.refuse(k_laboratory_drift, "limit", "a limit", "only the model limit_per_year has one", "remove it");
        }
    }

    void read_interval(const JsonObject& object) {
        IntervalPlan& plan = *record_.interval;
        plan.unit = objects_.text(object, "unit", TextForm::unit);
        objects_.each<laboratory::UsageReading>(object, "readings", [&](const JsonObject& one) {
            laboratory::UsageReading& reading = plan.readings.emplace_back();
            JobReader(one).read(reading);
            reading.date = objects_.needed_text(one, "date", TextForm::date);
            const std::size_t i = plan.readings.size() - 1;
            if (i > 0 && (certificate::is_after(plan.readings[i - 1].date, reading.date) ||
                          reading.hours < plan.readings[i - 1].hours)) {
                one.refuse(k_laboratory_order, "hours", "a reading before the one above it",
                           "the readings of a counter follow each other by date and rise", "put them into their order");
            }
        });
        const auto demand = [&](std::initializer_list<std::string_view> keys, std::string_view method) {
            for (const std::string_view key : keys) {
                if (!object.has(key)) {
                    object.refuse(k_laboratory_interval, "method", text::in_quotes(key) + " is missing",
                                  "the method " + text::in_quotes(method) + " works with numbers of the laboratory",
                                  "add it");
                }
            }
        };
        switch (plan.method) {
            case IntervalMethod::staircase:
                demand({"limit", "unit", "present_days", "extend_by", "reduce_by"}, "staircase");
                break;
            case IntervalMethod::control_chart:
                demand({"limit", "unit"}, "control_chart");
                break;
            case IntervalMethod::in_use_time:
                demand({"hours"}, "in_use_time");
                break;
        }
        if (plan.least_days > plan.most_days) {
            object.refuse(k_certificate_limits, "least_days", text::count_of(plan.least_days, "day"),
                          "must not be above most_days, " + std::to_string(plan.most_days), "exchange the two");
        }
    }

    RegisterObjects objects_;
    StandardRecord record_;
};

/// An object of certificate data, checked; null where it is absent.
template <class Struct>
json checked_object(const JsonDocument& document, std::string_view key, ProblemList& problems) {
    const auto found = document.value.find(key);
    if (found == document.value.end() || found->is_discarded()) {
        return nullptr;
    }
    Struct value;
    CertificateArchive::read_struct_at(value, {&document, child_pointer("", key), &problems});
    return *found;
}

}  // namespace

std::optional<StandardRecord> read_standard(const JsonDocument& document, ProblemList& problems) {
    const std::size_t before = problems.refusals();
    std::optional<StandardRecord> record = StandardFileReader(document, problems).read();
    return problems.refusals() == before ? std::move(record) : std::nullopt;
}

std::optional<LaboratoryFile> read_laboratory(const JsonDocument& document, ProblemList& problems) {
    const std::size_t before = problems.refusals();
    RegisterObjects objects(document, problems);
    const std::optional<JsonObject> root = objects.root<LaboratoryStatement>(k_laboratory_schema_word);
    if (!root) {
        return std::nullopt;
    }
    LaboratoryFile file;
    file.laboratory = checked_object<certificate::Laboratory>(document, "laboratory", problems);
    file.accreditation = checked_object<certificate::Accreditation>(document, "accreditation", problems);
    std::set<std::string> ids;
    objects.each<SignatoryStatement>(*root, "signatories", [&](const JsonObject& object) {
        SignatoryStatement& person = file.signatories.emplace_back();
        JobReader(object).read(person);
        person.from = objects.text(object, "from", TextForm::date);
        person.to = objects.text(object, "to", TextForm::date);
        const json* methods = object.optional_array("methods");
        for (std::size_t i = 0; methods != nullptr && i < methods->size(); ++i) {
            const CertificatePlace place = objects.place(child_pointer(object.pointer("methods"), i));
            if (!(*methods)[i].is_string()) {
                refuse_type((*methods)[i], "a text", place);
            } else if (const std::string& method = (*methods)[i].get_ref<const std::string&>();
                       acceptable_text(method, TextForm::name, place)) {
                person.methods.push_back(method);
            }
        }
        if (!person.id.empty() && !ids.insert(person.id).second) {
            object.refuse(k_certificate_repeated, "id", text::in_quotes(person.id) + " for the second time",
                          "a person has an identification of his own", "choose another one");
        }
    });
    return problems.refusals() == before ? std::optional(std::move(file)) : std::nullopt;
}

}  // namespace gumcert::jobs
