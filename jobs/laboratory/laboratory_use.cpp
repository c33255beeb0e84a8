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
#include "jobs/laboratory/laboratory_codes.h"
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

/// Puts a value in the place of another one that was refused: readers say nothing more of it.
void discard(json& value) {
    value = json(json::value_t::discarded);
}

std::string text_in(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

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

/// Numbers of one unit in another one, and as they are where the two are one text.
class UnitChange {
public:
    UnitChange(const std::string& from, const std::string& to)
        : is_same_(from == to), from_(gum::Unit::parse(from)), to_(gum::Unit::parse(to)) {}

    [[nodiscard]] bool is_possible() const {
        return from_.dimension() == to_.dimension() && from_.is_celsius_temperature() == to_.is_celsius_temperature();
    }
    [[nodiscard]] double value(double v) const { return is_same_ ? v : in_decimals(to_.from_si(from_.to_si(v))); }
    [[nodiscard]] double difference(double v) const {
        return is_same_ ? v : in_decimals(to_.difference_from_si(from_.difference_to_si(v)));
    }

private:
    /// Without what two conversions leave behind the last digit of a decimal number.
    static double in_decimals(double v) {
        constexpr int k_digits_of_double = 15;
        const std::string text = text::significant(v, k_digits_of_double);
        double rounded = v;
        std::from_chars(text.data(), text.data() + text.size(), rounded);
        return rounded;
    }

    bool is_same_;
    gum::Unit from_, to_;
};

const char* word_of(laboratory::Answer answer) {
    return answer == laboratory::Answer::yes ? "yes" : answer == laboratory::Answer::no ? "no" : "unknown";
}

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

void set_if_stated(json& row, const char* key, const std::string& text) {
    if (!text.empty()) {
        row[key] = text;
    }
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

/// Whether the unit of a row is of the kind of another one: 2 µA are not 2 µV, though both are 2e-6.
bool is_of_kind(const json& row, const std::string& unit) {
    const std::string stated = text_in(row, "unit");
    return gum::Unit::parse(stated.empty() ? "1" : stated).dimension() == gum::Unit::parse(unit).dimension();
}

/// To the two digits of an uncertainty.
double in_two_digits(double U) {
    const std::string text = text::significant(U, 2);
    std::from_chars(text.data(), text.data() + text.size(), U);
    return U;
}

/// U of a line for the list of standards: a share of the value has as many digits as the value.
double shown_U(const laboratory::CalibrationResult& line, double U) {
    return line.relative_U ? in_two_digits(U) : U;
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
            U = in_two_digits(U / own * k);
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

/// A value as people write it: 0.00006, where JSON has 6e-05.
std::string in_words(const json& value) {
    constexpr double k_least_plain = 1e-9;
    return value.is_number_float() ? text::shortest_plain(value.get<double>(), k_least_plain) : described(value);
}

/// What tells an entry of a list: a text or number, else its id or name, else the beginning of its JSON.
std::string described_entry(const json& entry) {
    if (!entry.is_structured()) {
        return in_words(entry);
    }
    for (const char* key : {"id", "name", "measurand"}) {
        if (const auto found = entry.find(key); entry.is_object() && found != entry.end() && found->is_string()) {
            return described(*found);
        }
    }
    constexpr std::size_t k_longest = 60;
    const std::string text = entry.dump(-1, ' ', true);
    return text.size() > k_longest ? text.substr(0, k_longest) + "…" : text;
}

/// Where two values part: the members and the entries that differ, each by what stands there.
/// \param where  of the stated one
void note_differences(const json& stated, const json& registered, const std::string& subject, const std::string& where,
                      std::vector<certificate::LaboratoryRegister::Contradiction>& found) {
    if (stated.is_discarded()) {
        return;  // refused where it was read
    }
    const auto note = [&](const std::string& place, const json* a, const json* b) {
        found.push_back({.where = place,
                         .subject = subject,
                         .stated = a == nullptr ? "nothing" : described_entry(*a),
                         .registered = b == nullptr ? "nothing" : described_entry(*b)});
    };
    if (stated.is_object() && registered.is_object()) {
        for (const auto& [key, value] : stated.items()) {
            const auto other = registered.find(key);
            if (other == registered.end()) {
                note(child_pointer(where, key), &value, nullptr);
            } else if (*other != value) {
                note_differences(value, *other, subject, child_pointer(where, key), found);
            }
        }
        for (const auto& [key, value] : registered.items()) {
            if (!stated.contains(key)) {
                note(child_pointer(where, key), nullptr, &value);
            }
        }
        return;
    }
    if (!stated.is_array() || !registered.is_array()) {
        note(where, &stated, &registered);
        return;
    }
    const auto is_in = [](const json& list, const json& entry) {
        return std::find(list.begin(), list.end(), entry) != list.end();
    };
    const auto is_called_alike = [](const json& a, const json& b) {
        return a.is_object() && b.is_object() && a.contains("id") && b.contains("id") && a["id"] == b["id"];
    };
    const std::size_t before = found.size();
    for (std::size_t i = 0; i < stated.size(); ++i) {
        if (is_in(registered, stated[i])) {
            continue;
        }
        const auto alike = std::find_if(registered.begin(), registered.end(),
                                        [&](const json& other) { return is_called_alike(stated[i], other); });
        if (alike != registered.end()) {
            note_differences(stated[i], *alike, subject, child_pointer(where, i), found);
        } else {
            note(child_pointer(where, i), &stated[i], nullptr);
        }
    }
    for (const json& other : registered) {
        const bool is_known = is_in(stated, other) || std::any_of(stated.begin(), stated.end(), [&](const json& entry) {
                                  return is_called_alike(entry, other);
                              });
        if (!is_known) {
            note(where, nullptr, &other);
        }
    }
    if (found.size() == before) {  // the same entries in another order, or one of them twice
        note(where, &stated, &registered);
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

// ---- certificate data -----------------------------------------------------------------------------------------------

void LaboratoryUse::complete(JsonDocument& document, const CertificatePlace& place) {
    json& data = document.value.at(json::json_pointer(place.pointer));
    if (!data.is_object() || refuse_without_folder(data, place)) {
        return;
    }
    if (const LaboratoryFile* file = folder_->laboratory()) {
        if (file->laboratory.is_object()) {
            json registered = file->laboratory;
            name_in_folder(registered, "logo");
            complete_object(data, "laboratory", registered, "the laboratory", "");
        }
        if (file->accreditation.is_object() && text_in(data, "status") != "not_accredited") {
            complete_accreditation(data, *file);
        }
        complete_persons(data, *file, place);
        for (const SignatoryStatement& person : file->signatories) {
            facts_.signatories.push_back({person.name, person.from, person.to, person.methods, person.authorises});
        }
    } else if (data.contains("persons") && data["persons"].is_object()) {
        for (auto& [role, person] : data["persons"].items()) {
            if (person.is_string()) {
                discard(person);  // whom it means stands in the file that was refused
            }
        }
    }
    complete_by_id(data, "customer", place, "", true);
    complete_by_id(data, "method", place, "", false);
    if (const auto sections = data.find("sections"); sections != data.end() && sections->is_array()) {
        for (std::size_t i = 0; i < sections->size(); ++i) {
            if ((*sections)[i].is_object()) {
                complete_by_id((*sections)[i], "method", place, child_pointer("/sections", i), false);
            }
        }
    }
    complete_standards(data, place);
}

std::optional<certificate::LaboratoryRegister> LaboratoryUse::registered() const {
    return folder_ ? std::optional(facts_) : std::nullopt;
}

/// \return whether there is no folder; what refers to one is refused then
bool LaboratoryUse::refuse_without_folder(json& data, const CertificatePlace& place) {
    if (folder_) {
        return false;
    }
    const auto refuse = [&](json& value, const std::string& relative, const std::string& example) {
        if (value.is_string() || (value.is_object() && value.contains("id"))) {
            place.below(relative).refuse(
                k_laboratory_missing, described(value) + ", and no laboratory",
                "what is not written out stands in the files of the laboratory",
                "add \"laboratory\": \"FOLDER\" to the job, or use --laboratory FOLDER; without such a "
                "folder write it out" +
                    example);
            discard(value);
        }
    };
    for (const char* key : {"customer", "method"}) {
        if (data.contains(key)) {
            refuse(data[key], std::string("/") + key, "");
        }
    }
    if (data.contains("sections") && data["sections"].is_array()) {
        for (std::size_t i = 0; i < data["sections"].size(); ++i) {
            if (json& section = data["sections"][i]; section.is_object() && section.contains("method")) {
                refuse(section["method"], child_pointer("/sections", i) + "/method", "");
            }
        }
    }
    if (data.contains("persons") && data["persons"].is_object()) {
        for (auto& [key, person] : data["persons"].items()) {
            refuse(person, child_pointer("/persons", key), R"(, such as {"name": "A. Feld"})");
        }
    }
    if (data.contains("standards") && data["standards"].is_array()) {
        for (std::size_t i = 0; i < data["standards"].size(); ++i) {
            refuse(data["standards"][i], child_pointer("/standards", i), "");
        }
    }
    return true;
}

/// Fills in what an object of the data does not state, and notes what it states otherwise.
void LaboratoryUse::complete_object(json& data, const std::string& key, const json& registered,
                                    const std::string& subject, const std::string& pointer) {
    json& object = data[key];
    if (object.is_null()) {
        object = json::object();
    }
    if (!object.is_object()) {
        return;  // its reader refuses it
    }
    for (const auto& [name, value] : registered.items()) {
        const auto stated = object.find(name);
        if (stated == object.end()) {
            object[name] = value;
        } else if (*stated != value && !stated->is_discarded()) {
            note_differences(*stated, value, subject, pointer + "/" + key + "/" + name, facts_.contradictions);
        }
    }
}

void LaboratoryUse::complete_by_id(json& data, const char* key, const CertificatePlace& place, const std::string& below,
                                   bool is_customer) {
    const auto found = data.find(key);
    if (found == data.end()) {
        return;
    }
    const bool is_reference = found->is_object() && found->contains("id");
    if (!found->is_string() && !is_reference) {
        return;
    }
    json& value = *found;
    const CertificatePlace at = place.below(below + "/" + key + (is_reference ? "/id" : ""));
    const json id = is_reference ? value["id"] : value;
    if (!id.is_string() || !LaboratoryFolder::is_identification(id.get_ref<const std::string&>())) {
        at.refuse(k_laboratory_id, described(id),
                  "an identification is the name of a file: letters, digits, '-', '_' and '.'",
                  "name it as its file is named, without .json");
        discard(value);
        return;
    }
    const bool is_absent = refuse_absent(is_customer ? "customers" : "methods", id.get<std::string>(), at);
    const json* registered = is_absent     ? nullptr
                             : is_customer ? folder_->customer(id.get<std::string>())
                                           : folder_->method(id.get<std::string>());
    if (registered == nullptr) {
        discard(value);
        return;
    }
    if (!is_reference) {
        value = *registered;
        return;
    }
    value.erase("id");
    json other = *registered;
    if (is_customer) {  // contact and order are those of this work
        other.update(value);
        value = std::move(other);
        return;
    }
    if (value.contains("deviations") || value.contains("no_deviations")) {
        other.erase("deviations");
        other.erase("no_deviations");
    }
    complete_object(data, key, other, std::string("the ") + key, below);
}

/// Names of files are relative to the folder there, and to the job here.
void LaboratoryUse::name_in_folder(json& object, const char* key) const {
    if (const std::string file = text_in(object, key); !file.empty()) {
        object[key] = folder_->name_of(file);
    }
}

void LaboratoryUse::complete_accreditation(json& data, const LaboratoryFile& file) {
    json registered = file.accreditation;
    name_in_folder(registered, "symbol_file");
    if (!registered.contains("signatories")) {
        json names = json::array();
        for (const SignatoryStatement& person : file.signatories) {
            if (person.authorises) {
                names.push_back(person.name);
            }
        }
        if (!names.empty()) {
            registered["signatories"] = std::move(names);
        }
    }
    complete_object(data, "accreditation", registered, "the accreditation", "");
}

void LaboratoryUse::complete_persons(json& data, const LaboratoryFile& file, const CertificatePlace& place) {
    if (!data.contains("persons") || !data["persons"].is_object()) {
        return;
    }
    for (auto& [role, person] : data["persons"].items()) {
        if (!person.is_string()) {
            continue;
        }
        const auto found = std::find_if(file.signatories.begin(), file.signatories.end(),
                                        [&person = person](const SignatoryStatement& one) { return one.id == person; });
        if (found == file.signatories.end()) {
            std::vector<std::string> known;
            for (const SignatoryStatement& one : file.signatories) {
                known.push_back(text::in_quotes(one.id));
            }
            place.below(child_pointer("/persons", role))
                .refuse(k_laboratory_person, described(person), "laboratory.json names " + text::listed(known, 20),
                        "name one of them, or write the person out");
            discard(person);
            continue;
        }
        json written{{"name", found->name}};
        set_if_stated(written, "function", found->function);
        set_if_stated(written, "authorised_from", found->from);
        set_if_stated(written, "authorised_to", found->to);
        person = std::move(written);
    }
}

json LaboratoryUse::row_of(const StandardRecord& record, const std::string& day) const {
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
    const auto used = lines_of_.find(record.id);
    put_uncertainty(row, used != lines_of_.end() ? used->second : std::vector{&last.results.front()});
    return row;
}

void LaboratoryUse::compare_standard(const json& stated, const json& row, const StandardRecord& record,
                                     const std::string& pointer) {
    const auto contradict = [&](const std::string& key, const std::string& a, const std::string& b) {
        facts_.contradictions.push_back({.where = pointer + "/" + key,
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
                    compare_standard(value[i], row, record, child_pointer(pointer + "/further", i));
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
                fits = fits || (key == "k" ? value.is_number() && std::abs(value.get<double>() - k) <= k_same_U * k
                                           : U && is_of_kind(stated, line.unit) &&
                                                 (std::abs(*U - of_line) <= k_same_U * of_line ||
                                                  (line.relative_U && in_two_digits(*U) == in_two_digits(of_line))));
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

void LaboratoryUse::complete_standards(json& data, const CertificatePlace& place) {
    const std::string day = day_of_work();
    const bool is_listed = data.contains("standards");
    json& list = data["standards"];
    if (!is_listed) {
        list = json::array();
    }
    if (!list.is_array()) {
        return;  // its reader refuses it
    }
    std::vector<std::string> named;
    for (std::size_t i = 0; i < list.size(); ++i) {
        json& entry = list[i];
        const std::string pointer = child_pointer("/standards", i);
        if (entry.is_string()) {
            entry = json{{"identification", entry}};
        }
        const std::string id = entry.is_object() ? text_in(entry, "identification") : "";
        if (id.empty()) {
            continue;
        }
        named.push_back(id);
        const StandardRecord* record = LaboratoryFolder::is_identification(id) ? folder_->standard(id, false) : nullptr;
        if (record == nullptr) {
            facts_.not_registered.push_back(id);
            if (!entry.contains("name")) {
                const bool is_told =
                    LaboratoryFolder::is_identification(id) && refuse_absent("standards", id, place.below(pointer));
                if (!is_told) {
                    place.below(pointer).refuse(
                        k_laboratory_id, text::in_quotes(id) + " is not in the register",
                        "a standard that is named only stands in standards/" + text::visible(id) + ".json",
                        "add it to the register, or write the standard out");
                }
                discard(entry);
            }
            continue;
        }
        note_day(*record, day);
        const json row = row_of(*record, day);
        compare_standard(entry, row, *record, pointer);
        const bool states_U = entry.contains("U");  // and whether it is that of several lines
        for (const auto& [key, value] : row.items()) {
            if (!entry.contains(key) && !((key == "U_to" || key == "further") && states_U)) {
                entry[key] = value;
            }
        }
    }
    for (const std::string& id : used_) {
        if (std::find(named.begin(), named.end(), id) == named.end()) {
            if (is_listed) {
                facts_.not_listed.push_back(id);
            }
            list.push_back(row_of(*folder_->standard(id), day));
        }
    }
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
    (void)read_certificate(files, *document, *file.problems, &use);
    return use.registered();
}

}  // namespace gumcert::jobs
