#include "jobs/laboratory/standard_row.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/json_members.h"
#include "jobs/laboratory/registered_differences.h"
#include "jobs/laboratory/unit_change.h"
#include "laboratory/outlook.h"
#include "laboratory/standard_value.h"
#include "text/numbers.h"
#include "text/rounded_number.h"

namespace gumcert::jobs {

using laboratory::StandardRecord;
using nlohmann::json;

namespace {

json localised_json(const certificate::LocalisedText& text) {
    if (text.by_language.empty()) {
        return text.plain;
    }
    json languages = json::object();
    for (const auto& [language, words] : text.by_language) {
        languages[language] = words;
    }
    return languages;
}

/// U of a row in SI units, for two rows in different units.
std::optional<double> U_in_si(const json& row, const char* key) {
    const auto U = row.find(key);
    const std::string unit = text_in(row, "unit");
    if (U == row.end() || !U->is_number() || unit.empty()) {
        return std::nullopt;
    }
    try {
        return gum::Unit::parse(unit).difference_to_si(U->get<double>());
    } catch (const gum::InputError&) {
        return std::nullopt;  // refused where certificate data are read
    }
}

constexpr double k_same_U = 1e-9;
constexpr int k_digits_of_U = 2;

/// Whether the unit of a row is of the kind of another one: 2 µA are not 2 µV, though both are 2e-6.
bool is_of_kind(const json& row, const std::string& unit) {
    const std::string stated = text_in(row, "unit");
    return gum::Unit::parse(stated.empty() ? "1" : stated).dimension() == gum::Unit::parse(unit).dimension();
}

/// U of a line for the list of standards: a share of the value has as many digits as the value.
double shown_U(const laboratory::CalibrationResult& line, double U) {
    return line.relative_U ? text::rounded_number(U, k_digits_of_U) : U;
}

double factor_of(const laboratory::CalibrationResult& line) {
    return line.k ? *line.k : line.U / laboratory::standard_uncertainty(line);
}

/// From the smallest U of lines of one kind of quantity to the largest, in the unit of the first: that of one line alone
/// would be taken for all of them.
/// \param lines  those of the kind of the first are taken away
void put_uncertainty_of_kind(json& row, std::vector<const laboratory::CalibrationResult*>& lines) {
    const std::string unit = gum::unit_of_difference(lines.front()->unit);
    std::vector<std::pair<double, double>> all;  // U in the unit, and its k
    std::erase_if(lines, [&](const laboratory::CalibrationResult* line) {
        const UnitChange change(gum::unit_of_difference(line->unit), unit);
        if (change.is_possible()) {
            all.emplace_back(shown_U(*line, change.difference(line->U)), factor_of(*line));
        }
        return change.is_possible();
    });
    const auto less = [](const auto& a, const auto& b) { return a.first / a.second < b.first / b.second; };
    const double k = std::max_element(all.begin(), all.end(), less)->second;
    for (auto& [U, own] : all) {
        if (std::abs(own - k) > k_same_U * k) {  // of another k: two digits of what it is with this one
            U = text::rounded_number(U / own * k, k_digits_of_U);
        }
    }
    const auto [least, largest] = std::minmax_element(all.begin(), all.end());
    row["U"] = least->first;
    row["k"] = k;
    row["unit"] = unit;
    if (largest->first > least->first * (1.0 + k_same_U)) {
        row["U_to"] = largest->first;
    }
}

/// U of the lines that were used, each kind of quantity by itself: volts say nothing of amperes.
void put_uncertainty(json& row, std::vector<const laboratory::CalibrationResult*> lines) {
    put_uncertainty_of_kind(row, lines);
    while (!lines.empty()) {
        json further = json::object();
        put_uncertainty_of_kind(further, lines);
        row["further"].push_back(std::move(further));
    }
}

}  // namespace

json standard_row(const StandardRecord& record, const std::string& day,
                  const std::vector<const laboratory::CalibrationResult*>& lines) {
    const laboratory::Calibration* calibration = laboratory::calibration_on(record, day);
    const laboratory::Calibration& last = calibration != nullptr ? *calibration : record.calibrations.back();
    json row{{"name", localised_json(record.description)},
             {"identification", record.id},
             {"certificate", last.certificate},
             {"calibrated", last.calibrated},
             {"role", record.role}};
    if (!last.issuer.empty()) {
        row["issuer"] = localised_json(last.issuer);
    }
    set_if_stated(row, "issuer_accreditation", last.issuer_accreditation);
    set_if_stated(row, "route", last.route);
    set_if_stated(row, "evidence", last.evidence);
    set_if_stated(row, "valid_to",
                  calibration != nullptr ? laboratory::calibration_outlook(record, day).last_day : last.valid_to);
    set_if_stated(row, "sha256", last.sha256);
    put_uncertainty(row, lines.empty() ? std::vector{&last.results.front()} : lines);
    return row;
}

void note_contradictions(const json& stated, const json& row, const StandardRecord& record, const std::string& pointer,
                         std::vector<certificate::LaboratoryRegister::Contradiction>& found) {
    const auto contradict = [&](const std::string& key, const std::string& a, const std::string& b) {
        found.push_back({.where = pointer + "/" + key,
                         .subject = "the standard \"" + record.id + "\"",
                         .stated = a,
                         .registered = b});
    };
    for (const auto& [key, value] : stated.items()) {
        if (key == "name" || key == "identification" || value.is_discarded()) {
            continue;  // a name may be worded for the reader of a certificate
        }
        if (key == "further") {
            for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
                if (value[i].is_object()) {  // else its reader refuses it
                    note_contradictions(value[i], row, record, child_pointer(pointer + "/further", i), found);
                }
            }
            continue;
        }
        const auto registered = row.find(key);
        if (key == "U" || key == "U_to" || key == "k" || key == "unit") {
            // Of any of its lines, in any unit.
            const laboratory::Calibration* calibration = laboratory::calibration_on(record, text_in(row, "calibrated"));
            const std::optional<double> U = U_in_si(stated, key == "U_to" ? "U_to" : "U");
            bool fits = false;
            for (const laboratory::CalibrationResult& line : calibration->results) {
                const double of_line = gum::Unit::parse(line.unit).difference_to_si(line.U);
                const double k = factor_of(line);
                fits =
                    fits || (key == "k" ? value.is_number() && std::abs(value.get<double>() - k) <= k_same_U * k
                                        : U && is_of_kind(stated, line.unit) &&
                                              (std::abs(*U - of_line) <= k_same_U * of_line ||
                                               (line.relative_U && text::rounded_number(*U, k_digits_of_U) ==
                                                                       text::rounded_number(of_line, k_digits_of_U))));
            }
            if (!fits && (key == "k" || (key != "unit" && U))) {
                const auto of_row = registered == row.end() ? row.find("U") : registered;
                contradict(key, in_words(value) + (key != "k" ? " " + text_in(stated, "unit") : std::string()),
                           in_words(*of_row) + (key != "k" ? " " + text_in(row, "unit") : std::string()));
            }
        } else if (registered == row.end() ? value.is_string() : *registered != value) {
            contradict(key, in_words(value), registered == row.end() ? "nothing" : in_words(*registered));
        }
    }
}

}  // namespace gumcert::jobs
