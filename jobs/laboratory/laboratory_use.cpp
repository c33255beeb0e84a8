#include "jobs/laboratory/laboratory_use.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "certificate/dates.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/laboratory/json_members.h"
#include "jobs/laboratory/laboratory_certificate.h"
#include "jobs/laboratory/laboratory_codes.h"
#include "jobs/laboratory/unit_change.h"
#include "laboratory/outlook.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using certificate::TextForm;
using laboratory::Drift;
using laboratory::StandardRecord;
using laboratory::StandardUse;
using laboratory::StandardValue;
using nlohmann::json;

/// Keys of an input that say which standard it is and how it is used.
constexpr std::array<std::string_view, 7> k_reference_keys{"standard", "quantity", "range", "mode",
                                                           "at",       "date",     "take"};

/// As the job writes it; "" where it does not.
std::string stated_unit(const JsonDocument& job, const std::string& name) {
    const auto inputs = job.value.find("inputs");
    if (inputs == job.value.end() || !inputs->is_object()) {
        return {};
    }
    const auto input = inputs->find(name);
    return input != inputs->end() && input->is_object() ? text_in(*input, "unit") : std::string();
}

bool is_reference_key(std::string_view key) {
    return std::find(k_reference_keys.begin(), k_reference_keys.end(), key) != k_reference_keys.end();
}

bool names_standard(const json& statement) {
    return statement.is_object() && statement.contains("standard");
}

/// What a point states of an input whose standard the job names: where it is used.
bool only_says_where(const json& statement) {
    return statement.is_object() && !statement.empty() && !statement.contains("standard") &&
           std::any_of(k_reference_keys.begin(), k_reference_keys.end(),
                       [&](std::string_view key) { return statement.contains(key); });
}

/// Where points stand: a list in the job, or a file.
struct PlaceOfPoints {
    std::string list;  ///< JSON Pointer; "": none
    std::string file;
};

/// Of the job, or of its sections.
std::vector<PlaceOfPoints> places_of_points(const JsonDocument& job) {
    std::vector<PlaceOfPoints> places;
    const auto add = [&](const json& part, const std::string& pointer) {
        const auto points = part.is_object() ? part.find("points") : part.end();
        if (!part.is_object() || points == part.end()) {
            return;
        }
        const std::string here = child_pointer(pointer, "points");
        if (points->is_array()) {
            places.push_back({.list = here, .file = ""});
        } else if (points->is_object() && points->contains("list") && (*points)["list"].is_array()) {
            places.push_back({.list = child_pointer(here, "list"), .file = ""});
        } else if (std::string file = text_in(*points, "file");
                   points->is_object() && !file.empty() && !JobFiles::file_name_objection(file)) {
            places.push_back({.list = "", .file = std::move(file)});
        }
    };
    add(job.value, "");
    if (const auto sections = job.value.find("sections"); sections != job.value.end() && sections->is_object()) {
        for (const std::string& name : keys_in_order(job, "/sections")) {
            add((*sections)[name], child_pointer("/sections", name));
        }
    }
    return places;
}

/// Whether points say where the standard of an input is used, and not which one it is.
bool says_where(const JsonDocument& job, const PlaceOfPoints& place, const std::string& input, const JobFiles& files) {
    if (!place.list.empty()) {
        const json& list = job.value.at(json::json_pointer(place.list));
        return std::any_of(list.begin(), list.end(), [&](const json& point) {
            return point.is_object() && point.contains(input) && only_says_where(point[input]);
        });
    }
    bool any = false;
    for (const CsvHeaderField& field : csv_header(files.peek(place.file).value_or(""))) {
        const auto [of_input, key] = LaboratoryUse::reference_column(field.name);
        if (of_input == input && key == "standard") {
            return false;
        }
        any = any || (of_input == input && !key.empty());
    }
    return any;
}

std::string row_pointer(std::size_t row, const std::string& input) {
    return child_pointer(child_pointer("/points", row), input);
}

const char* word_of(laboratory::Answer answer) {
    return answer == laboratory::Answer::yes ? "yes" : answer == laboratory::Answer::no ? "no" : "unknown";
}

/// The same place for every value that was put there, so that messages have a line and a column.
void place_below(JsonDocument& document, const std::string& pointer, const json& value, const text::Place& place) {
    document.places.emplace(pointer, gumcert::json::ValuePlace{place});
    if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            place_below(document, child_pointer(pointer, key), member, place);
        }
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            place_below(document, child_pointer(pointer, i), value[i], place);
        }
    }
}

}  // namespace

LaboratoryUse::LaboratoryUse(JobFiles& files, const JsonDocument& job, ProblemList& problems)
    : files_(files), job_(job), problems_(problems), folder_(LaboratoryFolder::of_job(files, job, problems)) {}

// ---- inputs -------------------------------------------------------------------------------------------------------------

void LaboratoryUse::fill_inputs(JsonDocument& job) {
    const auto inputs = job.value.find("inputs");
    if (inputs == job.value.end() || !inputs->is_object()) {
        return;
    }
    const std::vector<PlaceOfPoints> places = places_of_points(job);
    for (const std::string& name : keys_in_order(job, "/inputs")) {
        if (!names_standard((*inputs)[name])) {
            continue;
        }
        if (std::any_of(places.begin(), places.end(),
                        [&](const PlaceOfPoints& p) { return says_where(job, p, name, files_); })) {
            state_once(job, name);
        } else {
            fill_statement(job, child_pointer("/inputs", name), name, text_in((*inputs)[name], "unit"), problems_);
        }
    }
    for (const PlaceOfPoints& place : places) {
        if (!place.list.empty()) {
            fill_points(job, place.list);
        }
    }
    warn_of_shared_standards(job);
}

void LaboratoryUse::state_once(JsonDocument& job, const std::string& input) {
    const std::string pointer = child_pointer("/inputs", input);
    json& statement = job.value.at(json::json_pointer(pointer));
    const StandardRecord* const record =
        standard_of(statement["standard"], {&job, child_pointer(pointer, "standard"), &problems_});
    const std::optional<StandardUse> use =
        record != nullptr ? read_use(job, statement, pointer, problems_) : std::nullopt;
    const std::optional<std::string> take = read_take(job, statement, pointer, problems_);
    if (!use || !take) {
        discard(statement);
        return;
    }
    if (!statement.contains("unit")) {
        const std::string& unit = record->calibrations.back().results.front().unit;
        statement["unit"] = *take == "deviation" ? gum::unit_of_difference(unit) : unit;
    }
    json& kept = once_[input];
    for (const auto& [key, value] : statement.items()) {
        if (is_reference_key(key) || key == "components") {
            kept[key] = value;
        }
    }
    for (const auto& [key, value] : kept.items()) {
        statement.erase(key);
    }
    note_use(record->id);
    inputs_of_[record->id].push_back(input);
}

void LaboratoryUse::fill_points(JsonDocument& job, const std::string& list) {
    const std::size_t points = job.value.at(json::json_pointer(list)).size();
    for (std::size_t i = 0; i < points; ++i) {
        const std::string point = child_pointer(list, i);
        if (!job.value.at(json::json_pointer(point)).is_object()) {
            continue;
        }
        for (const std::string& name : keys_in_order(job, point)) {
            const std::string pointer = child_pointer(point, name);
            json& statement = job.value.at(json::json_pointer(pointer));
            if (const auto once = once_.find(name); once != once_.end() && only_says_where(statement)) {
                const text::Place at = job.places[pointer];
                for (const auto& [key, value] : once->second.items()) {
                    if (!statement.contains(key)) {
                        statement[key] = value;
                        place_below(job, child_pointer(pointer, key), value, at);
                    }
                }
            }
            if (names_standard(statement)) {
                fill_statement(job, pointer, name, stated_unit(job, name), problems_);
            }
        }
    }
}

void LaboratoryUse::fill_rows(const JsonDocument& job, const CsvTable& table, std::span<const std::string_view> columns,
                              ProblemList& problems) {
    rows_.clear();
    std::vector<std::string> inputs;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto [of_input, key] = reference_column(columns[c]);
        const std::string input(of_input);
        if (key.empty() || (key != "standard" && !is_stated_once(input)) ||
            std::find(inputs.begin(), inputs.end(), input) != inputs.end()) {
            continue;
        }
        if (!folder_) {  // an input that the job states is refused without a folder
            problems.refuse(k_laboratory_missing, table.where(table.cell(0, c)),
                            "the standard " + text::in_quotes(table.cell(0, c).text) + ", and no laboratory",
                            "standards stand in the register of the laboratory",
                            "add \"laboratory\": \"FOLDER\" to the job, or use --laboratory FOLDER");
            continue;
        }
        inputs.push_back(input);
    }
    for (const std::string& input : inputs) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            fill_row(job, table, columns, row, input, problems);
        }
    }
}

void LaboratoryUse::fill_row(const JsonDocument& job, const CsvTable& table, std::span<const std::string_view> columns,
                             std::size_t row, const std::string& input, ProblemList& problems) {
    JsonDocument document;
    const std::string pointer = row_pointer(row, input);
    document.file = problems.file();
    document.is_table = true;
    json statement = json::object();
    std::optional<text::Place> first;  // of the cells that say something of the standard
    std::optional<text::Place> of_standard;
    bool is_read = true;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto [of_input, word] = reference_column(columns[c]);
        if (of_input != input || word.empty()) {
            continue;
        }
        const CsvCell& cell = table.cell(row, c);
        const text::Place here{cell.line, cell.column};
        first = first ? first : here;
        if (word == "standard") {
            of_standard = here;
            is_read = is_read && !cell.text.empty();  // refused as an empty cell
        }
        if (cell.text.empty()) {
            continue;  // says nothing
        }
        document.places[child_pointer(pointer, word)] = {here};
        if (word == "at") {
            const std::optional<double> number = table.number(row, c, {});
            is_read = is_read && number;
            statement[std::string(word)] = number.value_or(0.0);
        } else {
            const auto name = table.name(row, c);
            is_read = is_read && name;
            statement[std::string(word)] = std::string(name.value_or(""));
        }
    }
    document.places[pointer] = {of_standard ? *of_standard : first.value_or(text::Place{})};
    if (const auto once = once_.find(input); once != once_.end() && !of_standard) {
        for (const auto& [key, value] : once->second.items()) {
            if (!statement.contains(key)) {
                statement[key] = value;
                place_below(document, child_pointer(pointer, key), value, document.places[pointer]);
            }
        }
    }
    document.value = json{{"points", {{std::to_string(row), {{input, std::move(statement)}}}}}};
    if (is_read) {
        fill_statement(document, pointer, input, stated_unit(job, input), problems);
    }
    if (is_read && !document.value.at(json::json_pointer(pointer)).is_discarded()) {
        rows_.emplace(std::pair(row, input), std::move(document));
    }
}

LaboratoryUse::Row LaboratoryUse::row(std::size_t row, const std::string& input) const {
    const auto found = rows_.find({row, input});
    return found == rows_.end() ? Row{} : Row{&found->second, row_pointer(row, input)};
}

std::pair<std::string_view, std::string_view> LaboratoryUse::reference_column(std::string_view column) {
    const std::size_t dot = column.rfind('.');
    const std::string_view word = dot == std::string_view::npos ? std::string_view() : column.substr(dot + 1);
    const auto key = std::find(k_reference_keys.begin(), k_reference_keys.end(), word);
    return key == k_reference_keys.end() ? std::pair<std::string_view, std::string_view>()
                                         : std::pair(column.substr(0, dot), *key);
}

std::span<const std::string_view> LaboratoryUse::reference_keys() {
    return k_reference_keys;
}

const StandardRecord* LaboratoryUse::standard_of(const json& id, const CertificatePlace& place) {
    if (!id.is_string()) {
        refuse_type(id, "the identification of a standard", place);
        return nullptr;
    }
    const auto& name = id.get_ref<const std::string&>();
    if (!folder_) {
        place.refuse(k_laboratory_missing, "the standard " + text::in_quotes(name) + ", and no laboratory",
                     "standards stand in the register of the laboratory",
                     "add \"laboratory\": \"FOLDER\" to the job, or use --laboratory FOLDER");
        return nullptr;
    }
    if (!LaboratoryFolder::is_identification(name)) {
        place.refuse(k_laboratory_id, text::in_quotes(name),
                     "an identification is the name of a file: letters, digits, '-', '_' and '.'",
                     "name the standard as its file is named, without .json");
        return nullptr;
    }
    return refuse_absent("standards", name, place) ? nullptr : folder_->standard(name);
}

bool LaboratoryUse::refuse_absent(const std::string& part, const std::string& id, const CertificatePlace& place) {
    constexpr std::size_t k_most_named = 20;
    const std::optional<std::vector<std::string>> others = folder_->others_than(part, id);
    if (!others) {
        return false;
    }
    const std::string folder = folder_->name_of(part + "/");
    // The rows of a table name one standard, as a rule: it is told where it stands first.
    if (!absent_.insert(folder + id).second) {
        return true;
    }
    std::vector<std::string> named;
    std::transform(others->begin(), others->end(), std::back_inserter(named),
                   [](const std::string& one) { return text::in_quotes(one); });
    const std::optional<std::string_view> nearest =
        nearest_word(id, std::vector<std::string_view>(others->begin(), others->end()));
    const std::string thing = part.substr(0, part.size() - 1);
    place.refuse(k_laboratory_absent, text::in_quotes(id) + ", and the laboratory has no such " + thing,
                 "in " + text::visible(folder) +
                     (named.empty() ? " there is none"
                                    : " there " + std::string(named.size() == 1 ? "is " : "are ") +
                                          text::listed(named, k_most_named)),
                 (nearest ? "did you mean " + text::in_quotes(*nearest) + "? Else name" : std::string("name")) +
                     " the " + thing + " as its file is named, without .json, or add the file");
    return true;
}

std::optional<std::string> LaboratoryUse::read_take(const JsonDocument& job, const json& statement,
                                                    const std::string& pointer, ProblemList& problems) {
    if (!statement.contains("take")) {
        return "";
    }
    const CertificatePlace at{&job, child_pointer(pointer, "take"), &problems};
    if (!statement["take"].is_string()) {
        refuse_type(statement["take"], "a text", at);
        return std::nullopt;
    }
    std::string take = statement["take"].get<std::string>();
    return acceptable_word(take, {"value", "deviation"}, at) ? std::optional(std::move(take)) : std::nullopt;
}

void LaboratoryUse::note_use(const std::string& standard) {
    if (std::find(used_.begin(), used_.end(), standard) == used_.end()) {
        used_.push_back(standard);
    }
}

void LaboratoryUse::note_day(const StandardRecord& record, const std::string& day) {
    // The points of a table use a standard on one day, as a rule: its plan is asked once.
    if (day.empty() || !days_of_use_.emplace(record.id, day).second) {
        return;
    }
    const laboratory::CalibrationOutlook outlook = laboratory::calibration_outlook(record, day);
    const bool is_told = std::any_of(facts_.overdue.begin(), facts_.overdue.end(),
                                     [&](const auto& one) { return one.standard == record.id; });
    if (outlook.last != nullptr && certificate::is_after(day, outlook.next) && !is_told) {
        facts_.overdue.push_back({record.id, day, outlook.next});
    }
}

void LaboratoryUse::fill_statement(JsonDocument& job, const std::string& pointer, const std::string& input,
                                   const std::string& unit_of_input, ProblemList& problems) {
    json& statement = job.value.at(json::json_pointer(pointer));
    const CertificatePlace place{&job, child_pointer(pointer, "standard"), &problems};
    const StandardRecord* const record = standard_of(statement["standard"], place);
    const bool is_point = !pointer.starts_with("/inputs/");
    const std::optional<StandardUse> use =
        record != nullptr ? read_use(job, statement, pointer, problems) : std::nullopt;
    const std::optional<std::string> take = read_take(job, statement, pointer, problems);
    const bool is_accepted = use && take;
    // The unit of an input that points state is in the job: 1 when left out.
    const std::string unit = is_point && unit_of_input.empty() ? "1" : unit_of_input;
    std::optional<json> components =
        is_accepted ? components_of(*record, *use, unit, *take == "deviation", place) : std::nullopt;
    if (!components) {
        discard(statement);
        return;
    }
    const laboratory::Applicability verdict = laboratory::applicability(*record, *use);
    note_day(*record, use->date);
    facts_.uses.push_back({record->id, input, word_of(verdict.answer), verdict.because, verdict.is_of_validity});
    note_use(record->id);
    if (!is_point) {
        inputs_of_[record->id].push_back(input);
    }
    const auto found = job.places.find(place.pointer);
    const text::Place at = found == job.places.end() ? text::Place{} : found->second;
    for (const std::string_view key : k_reference_keys) {
        statement.erase(std::string(key));
    }
    if (!is_point && unit_of_input.empty()) {
        statement["unit"] = (*components)["unit"];
    }
    json& list = (*components)["components"];
    if (const auto own = statement.find("components"); own != statement.end() && own->is_array()) {
        // Those of the job stand behind: their places move with them.
        for (json& one : *own) {
            list.push_back(std::move(one));
        }
    } else if (own != statement.end()) {
        return;  // its reader refuses it
    }
    statement["components"] = list;
    const std::string below = child_pointer(pointer, "components");
    std::erase_if(job.places, [&](const auto& entry) { return entry.first.starts_with(below + "/"); });
    place_below(job, below, list, at);
}

std::optional<StandardUse> LaboratoryUse::read_use(const JsonDocument& job, const json& statement,
                                                   const std::string& pointer, ProblemList& problems) {
    StandardUse use;
    bool is_read = true;
    const auto read_text = [&](const char* key, std::string& text, TextForm form) {
        const auto found = statement.find(key);
        if (found == statement.end()) {
            return;
        }
        const CertificatePlace place{&job, child_pointer(pointer, key), &problems};
        if (!found->is_string()) {
            refuse_type(*found, "a text", place);
            is_read = false;
        } else if (acceptable_text(found->get_ref<const std::string&>(), form, place)) {
            text = found->get<std::string>();
        } else {
            is_read = false;
        }
    };
    read_text("quantity", use.quantity, TextForm::name);
    read_text("range", use.range, TextForm::name);
    read_text("mode", use.mode, TextForm::name);
    read_text("date", use.date, TextForm::date);
    if (const auto at = statement.find("at"); at != statement.end()) {
        if (at->is_number()) {
            use.at = at->get<double>();
        } else {
            if (!at->is_discarded()) {
                refuse_type(*at, "a number", {&job, child_pointer(pointer, "at"), &problems});
            }
            is_read = false;
        }
    }
    if (!statement.contains("date")) {
        use.date = day_of_work();
    } else if (is_read && !day_of_work().empty() &&
               (certificate::is_after(use.date, day_of_work()) ||
                certificate::is_after(first_day_of_work_, use.date))) {
        const bool is_one_day = first_day_of_work_.empty() || first_day_of_work_ == day_of_work();
        CertificatePlace{&job, child_pointer(pointer, "date"), &problems}.refuse(
            k_laboratory_other_day, use.date,
            "a standard is used on a day of the work, and the certificate states " +
                (is_one_day ? day_of_work() : first_day_of_work_ + " to " + day_of_work()),
            "correct \"date\", or leave it out, or correct the dates of the certificate");
        is_read = false;
    }
    return is_read ? std::optional(std::move(use)) : std::nullopt;
}

/// \return {"unit": …, "components": […]}; nothing when it was refused
std::optional<json> LaboratoryUse::components_of(const StandardRecord& record, const StandardUse& use,
                                                 const std::string& unit, bool is_deviation,
                                                 const CertificatePlace& place) {
    if (use.date.empty() && record.drift.kind != laboratory::DriftKind::none) {
        place.refuse(k_laboratory_day, "the day on which " + text::in_quotes(record.id) + " was used is not known",
                     "a drift grows from the calibration to the day of use",
                     "state performed_to or performed_from in the dates of the certificate, or \"date\" here");
        return std::nullopt;
    }
    StandardValue value;
    try {
        value = laboratory::value_of_standard(record, use);
    } catch (const gum::InputError& error) {
        for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
            place.problems->refuse({diagnostic.code, {}}, place.document->where(place.pointer),
                                   diagnostic.where + ": " + diagnostic.what, diagnostic.rule, diagnostic.action);
        }
        return std::nullopt;
    }
    std::vector<const laboratory::CalibrationResult*>& lines = lines_of_[record.id];
    for (const laboratory::CalibrationResult* line : {value.result, value.other}) {
        if (line != nullptr && std::find(lines.begin(), lines.end(), line) == lines.end()) {
            lines.push_back(line);
        }
    }
    std::string of_value = value.unit;
    double estimate = value.value;
    if (is_deviation) {
        const std::string& nominal_unit = value.result->nominal_unit;
        const std::optional<double> nominal =
            value.interpolation_half_width > 0.0 || value.result->low ? use.at : value.result->nominal;
        if (!nominal || (!nominal_unit.empty() && nominal_unit != value.unit)) {
            place.refuse(k_laboratory_unit,
                         text::in_quotes(record.id) + " has no nominal value in \"" + value.unit + "\"",
                         "a deviation is the value less its nominal value, in one unit",
                         "take the value, or state \"nominal\" in the register");
            return std::nullopt;
        }
        estimate -= *nominal;
        of_value = gum::unit_of_difference(value.unit);
    }
    const std::string target = unit.empty() ? of_value : unit;
    std::optional<UnitChange> change;
    try {
        change.emplace(of_value, target);
    } catch (const gum::InputError&) {
        return std::nullopt;  // the reader of the input refuses its unit
    }
    if (!change->is_possible()) {
        place.refuse(k_laboratory_unit,
                     text::in_quotes(record.id) + " is in \"" + of_value + "\", and the input in \"" + target + "\"",
                     "an input takes the value of a standard of the same quantity",
                     "correct the unit, or the standard");
        return std::nullopt;
    }
    const std::string source = record.id + ", certificate " + value.calibration->certificate;
    json components = json::array();
    const auto named = [&](const std::string& name, const char* kind) {
        components_[{name, source}] = {kind, record.id, value.calibration->certificate, value.calibration->calibrated};
        return name;
    };
    json calibration{{"name", named("calibration of " + record.id, "calibration")},
                     {"value", change->value(estimate)},
                     {"source", source}};
    const double U = change->difference(value.U);
    if (value.k && *value.k == 1.0) {
        calibration["u"] = U;
    } else {
        calibration["U"] = U;
        calibration[value.k ? "k" : "p"] = value.k ? *value.k : *value.p;
    }
    if (value.nu) {
        calibration["nu"] = *value.nu;
    }
    components.push_back(std::move(calibration));
    const auto add_uniform = [&](const std::string& name, double half_width) {
        components.push_back({{"name", name},
                              {"value", 0.0},
                              {"half_width", change->difference(half_width)},
                              {"distribution", "uniform"},
                              {"source", source}});
    };
    if (value.interpolation_half_width > 0.0) {
        add_uniform(named("interpolation of " + record.id, "interpolation"), value.interpolation_half_width);
    }
    const Drift& drift = value.drift;
    const std::string since = named("drift of " + record.id + " since " + value.calibration->calibrated, "drift");
    if (drift.half_width > 0.0) {
        add_uniform(since, drift.half_width);
    } else if (drift.u > 0.0 || drift.value != 0.0) {
        json component{{"name", since}, {"value", change->difference(drift.value)}, {"source", source}};
        if (drift.u > 0.0) {
            component["u"] = change->difference(drift.u);
            component["type"] = "A";
            if (!std::isinf(drift.nu)) {
                component["nu"] = drift.nu;
            }
        } else {
            component["constant"] = true;
        }
        components.push_back(std::move(component));
    }
    return json{{"unit", target}, {"components", std::move(components)}};
}

void LaboratoryUse::warn_of_shared_standards(const JsonDocument& job) {
    if (job.value.contains("correlations") || job.value.contains("covariance")) {
        return;
    }
    for (const std::string& id : used_) {
        const std::vector<std::string>& inputs = inputs_of_[id];
        if (inputs.size() > 1) {
            problems_.warn(k_laboratory_shared, job.where(child_pointer("/inputs", inputs[1])),
                           text::listed(inputs) + " draw on the standard " + text::in_quotes(id),
                           "values of one certificate have errors in common, and are taken as independent here",
                           "state their correlation under \"correlations\"");
        }
    }
}

const std::string& LaboratoryUse::day_of_work() {
    if (day_of_work_) {
        return *day_of_work_;
    }
    day_of_work_.emplace();
    const auto found = job_.value.find("certificate");
    if (found == job_.value.end()) {
        return *day_of_work_;
    }
    json data = *found;
    if (found->is_string() && !JobFiles::file_name_objection(found->get_ref<const std::string&>())) {
        // What is wrong with the file is said where the certificate is read.
        const std::optional<JobFiles::File> file = files_.open_if_there(found->get<std::string>());
        ProblemList unsaid{""};
        const std::optional<JsonDocument> document = file ? read_json_document(file->bytes, unsaid) : std::nullopt;
        data = document ? document->value : json();
    }
    if (data.is_object() && data.contains("dates") && data["dates"].is_object()) {
        const std::string to = text_in(data["dates"], "performed_to");
        const std::string from = text_in(data["dates"], "performed_from");
        const std::string day = to.empty() ? from : to;
        if (certificate::calendar_date(day)) {
            day_of_work_ = day;
        }
        if (certificate::calendar_date(from)) {
            first_day_of_work_ = from;
        }
    }
    return *day_of_work_;
}

// ---- for certificate data -------------------------------------------------------------------------------------------

const std::vector<const laboratory::CalibrationResult*>& LaboratoryUse::lines_of(const std::string& standard) const {
    static const std::vector<const laboratory::CalibrationResult*> k_none;
    const auto found = lines_of_.find(standard);
    return found == lines_of_.end() ? k_none : found->second;
}

std::optional<certificate::LaboratoryRegister> LaboratoryUse::registered() const {
    return folder_ ? std::optional(facts_) : std::nullopt;
}

std::optional<certificate::LaboratoryRegister> register_of_job(const FileSource& source, const std::string& job_file) {
    JobFiles files(source, job_file);
    const JobFiles::File file = files.job();
    const std::optional<JsonDocument> document = read_json_document(file.bytes, *file.problems);
    if (!document) {
        return std::nullopt;
    }
    LaboratoryUse use(files, *document, *file.problems);
    JsonDocument filled = *document;
    use.fill_inputs(filled);
    for (const PlaceOfPoints& place : places_of_points(*document)) {
        const std::optional<JobFiles::File> table_file = place.file.empty() ? std::nullopt : files.open(place.file);
        if (!table_file) {
            continue;
        }
        std::vector<CsvHeaderField> header = csv_header(table_file->bytes);
        std::vector<std::string_view> columns;
        for (const CsvHeaderField& field : header) {
            columns.emplace_back(field.name);
        }
        if (const auto table = read_csv_table(table_file->bytes, columns, {}, *table_file->problems)) {
            use.fill_rows(filled, *table, columns, *table_file->problems);
        }
    }
    LaboratoryCertificate completion(use);
    (void)read_certificate(files, *document, *file.problems, &completion);
    return use.registered();
}

}  // namespace gumcert::jobs
