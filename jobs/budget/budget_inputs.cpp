#include "jobs/budget/budget_inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "certificate/piece_roles.h"
#include "certificate/point_tables.h"
#include "gum/expression/name.h"
#include "gum/quantity/decimal_rounding.h"
#include "gum/rounding.h"
#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_fit_statement.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/csv_table.h"
#include "jobs/job_limits.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr std::string_view k_point = "point";
constexpr std::size_t k_most_named = 5;

/// Words that a table has for what belongs to a result.
constexpr std::array<std::string_view, 6> k_reserved{k_point, "U", "k", "nu_eff", "limit", "verdict"};

/// The keys of an input that state something of it.
std::span<const std::string_view> statement_keys() {
    static const std::vector<std::string_view> k_keys = [] {
        std::vector<std::string_view> keys(keys_of<InputStatement>().begin(), keys_of<InputStatement>().end());
        std::erase(keys, "role");
        std::erase(keys, "stage");
        std::erase(keys, "form");
        return keys;
    }();
    return k_keys;
}

bool is_limit(std::string_view name) {
    return std::find(certificate::k_limit_columns.begin(), certificate::k_limit_columns.end(), name) !=
           certificate::k_limit_columns.end();
}

/// The digits of a number as they were written, without an exponent where people read it so.
std::string digits_as_written(const std::string& written, double value) {
    return gum::round_as_written(value, text::most_decimals({&written, 1}));
}

std::string small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return text;
}

double value_in_unit(const gum::BudgetInput& input) {
    double sum = 0.0;
    for (const gum::StatedQuantity& component : input.components) {
        sum += component.stated_value;
    }
    return sum;
}

constexpr std::string_view k_resolution = "resolution";

/// Readings of one input in a row of a file of points.
struct FileReadings {
    std::vector<double> numbers;
    std::size_t first = 0;  ///< column of the first of them
    int decimals = 0;
};

double value_in_si(const gum::BudgetInput& input) {
    double sum = 0.0;
    for (const gum::StatedQuantity& component : input.components) {
        sum += component.value;
    }
    return sum;
}

}  // namespace

BudgetInputs::BudgetInputs(const JsonDocument& document, const std::optional<StatedCovariance>& covariance,
                           JobFiles& files, LaboratoryUse& laboratory, ProblemList& problems)
    : document_(document), covariance_(covariance), files_(files), laboratory_(laboratory), problems_(problems) {}

void BudgetInputs::read(const JsonObject& root) {
    const json* inputs = root.find("inputs");
    if (inputs == nullptr) {
        return;
    }
    if (!inputs->is_object()) {
        root.refuse(k_wrong_type, "inputs", described(*inputs), "must be an object", "name each input");
        symbols_are_whole_ = false;
        return;
    }
    const std::string pointer = root.pointer("inputs");
    if (inputs->size() > k_most_inputs) {
        root.refuse(k_too_many_quantities, "inputs", text::count_of(inputs->size(), "input"),
                    "a job has at most " + std::to_string(k_most_inputs) + " inputs", "split the job");
        symbols_are_whole_ = false;
        return;
    }
    names_ = keys_in_order(document_, pointer);
    note_resolutions(*inputs);
    stated_.reserve(names_.size());
    for (const std::string& name : names_) {
        read_input(name, child_pointer(pointer, name), root.has("points") || root.has("sections"));
    }
    const Reading reading = [&](const std::string& name) -> const gum::BudgetInput* {
        const auto found = of_name_.find(name);
        return found == of_name_.end() || !stated_[found->second].base ? nullptr : &stated_[found->second].base->input;
    };
    readers_.resize(stated_.size());
    for (std::size_t i = 0; i < stated_.size(); ++i) {
        Stated& stated = stated_[i];
        if (!stated.base) {
            continue;
        }
        const std::size_t problems_before = stated.pending ? stated.pending->refusals() : problems_.refusals();
        if (!complete(*stated.base, reading)) {
            // Without a message of its own it waits for an input that the points state.
            stated.is_complete = false;
            if (!stated.pending || stated.pending->refusals() > problems_before) {
                stated.base.reset();
                continue;
            }
        } else if (!check_digits(*stated.base)) {
            stated.base.reset();
            continue;
        }
        for (const std::optional<StatedSpecification>& specification : stated.base->specifications) {
            if (!specification || !specification->of) {
                continue;
            }
            // An input that was refused itself is read by nobody.
            if (const auto of = of_name_.find(*specification->of); of != of_name_.end()) {
                readers_[of->second].push_back(i);
            }
        }
    }
    warn_of_similar_names();
}

void BudgetInputs::read_input(const std::string& name, const std::string& pointer, bool has_points) {
    const std::string where = document_.where(pointer);
    const bool is_name = is_quantity_name(name, where, problems_);
    const json& value = document_.value.at(json::json_pointer(pointer));
    if (!value.is_object()) {
        if (!value.is_discarded()) {
            problems_.refuse(k_wrong_type, where, described(value), "must be an object",
                             value.is_number()
                                 ? "write {\"value\": " + described(value) + ", \"constant\": true} for a constant"
                                 : "state what is known of the input");
        }
        symbols_are_whole_ = false;
        return;
    }
    const JsonObject object(document_, pointer, keys_of<InputStatement>(), problems_);
    const auto unit = read_unit(object, "unit", problems_);
    symbols_are_whole_ = symbols_are_whole_ && unit && is_name;
    const QuantityPart part{std::string(object.optional_choice<std::string_view>("role", k_role_words).value_or("")),
                            std::string(object.optional_choice<std::string_view>("stage", k_stage_words).value_or("")),
                            std::string(object.optional_choice<std::string_view>("form", k_form_words).value_or(""))};
    if (!part.role.empty() || !part.stage.empty() || !part.form.empty()) {
        parts_[name] = part;
    }
    Stated stated;
    stated.name = name;
    stated.unit = unit.value_or(gum::Unit());
    stated.keys.emplace(document_, pointer, statement_keys(), problems_);
    if (has_points) {
        stated.pending = std::make_unique<ProblemList>(problems_.file());
        stated.base = evaluate(stated, StatementKeys(document_, pointer, statement_keys(), *stated.pending));
    } else {
        stated.base = evaluate(stated, *stated.keys);
    }
    if (!unit || !is_name) {
        if (stated.pending) {
            problems_.take(*stated.pending);
        }
        return;
    }
    of_name_.emplace(name, stated_.size());
    stated_.push_back(std::move(stated));
}

std::optional<BudgetInputs::Evaluated> BudgetInputs::evaluate(const Stated& stated, const StatementKeys& keys) {
    Evaluated out;
    out.input.name = stated.name;
    out.input.unit = stated.unit;
    out.input.where = keys.where();
    bool is_read = true;
    if (keys.has("description")) {
        certificate::LocalisedText& description = descriptions_[stated.name] = {};
        if (const nlohmann::json* value = keys.value("description"); value != nullptr && value->is_object()) {
            read_localised(*value, description, true,
                           {&keys.document("description"), keys.pointer("description"), &keys.problems("description")});
        } else {
            const auto text = keys.text("description");
            description = text.value_or("");
            is_read = text.has_value();
        }
    }
    if (keys.has("between_points")) {
        const auto word = keys.text("between_points");
        if (word && *word != "common" && *word != "independent") {
            keys.refuse(k_unknown_choice, "between_points", text::in_quotes(*word), "must be common or independent",
                        "choose one of them");
        }
        is_read = is_read && word && (*word == "common" || *word == "independent");
        out.is_stated_common = word && *word == "common";
        out.input.common = word != "independent";
    }
    const bool has_readings = keys.has("observations") || keys.has("groups");
    const bool is_evaluated = keys.has("components")                   ? evaluate_components(stated, keys, out)
                              : has_readings && keys.has("resolution") ? add_readings_and_resolution(stated, keys, out)
                                                                       : add_component(stated, keys, false, out);
    if (!is_evaluated || !is_read) {
        return std::nullopt;
    }
    return out;
}

void BudgetInputs::note_resolutions(const json& inputs) {
    const auto has_resolution = [](const json& statement) {
        return statement.is_object() && statement.contains("resolution");
    };
    for (const auto& [name, input] : inputs.items()) {
        const auto parts = input.is_object() ? input.find("components") : input.end();
        const bool is_in_part = input.is_object() && parts != input.end() && parts->is_array() &&
                                std::any_of(parts->begin(), parts->end(), has_resolution);
        if (!has_resolution(input) && !is_in_part) {
            continue;
        }
        const auto unit = input.find("unit");
        try {
            resolutions_.emplace(name, unit != input.end() && unit->is_string()
                                           ? gum::Unit::parse(unit->get_ref<const std::string&>())
                                           : gum::Unit());
        } catch (const gum::InputError&) {
            continue;  // refused where the input is read
        }
    }
}

std::string BudgetInputs::other_resolution(const Stated& stated) const {
    const auto found = std::find_if(resolutions_.begin(), resolutions_.end(), [&](const auto& other) {
        return other.first != stated.name && other.second.dimension() == stated.unit.dimension();
    });
    return found == resolutions_.end() ? "" : found->first;
}

bool BudgetInputs::add_readings_and_resolution(const Stated& stated, const StatementKeys& keys, Evaluated& out) {
    constexpr std::array<std::string_view, 4> k_of_resolution{"resolution", "distribution", "nu", "reliability"};
    constexpr std::array<std::string_view, 4> k_of_readings{"observations", "pooled", "groups", "type"};
    if (!add_component(stated, keys.without(k_of_resolution), true, out, true)) {
        return false;
    }
    out.input.components.back().name = k_component_of_readings;
    if (!add_component(stated, keys.without(k_of_readings), true, out)) {
        return false;
    }
    out.input.components.back().name = k_resolution;
    own_components_.emplace(k_component_of_readings);
    own_components_.emplace(k_resolution);
    return true;
}

bool BudgetInputs::add_component(const Stated& stated, const StatementKeys& keys, bool is_component, Evaluated& out,
                                 bool holds_resolution) {
    const StatementContext context{
        .unit = stated.unit,
        .is_later_component = !out.input.components.empty(),
        .is_component = is_component,
        .input = stated.name,
        .variance = covariance_ && !is_component ? covariance_->variance_of(stated.name) : std::nullopt,
        .resolution = is_component                                     ? std::string(holds_resolution ? "here" : "")
                      : keys.has("observations") || keys.has("groups") ? other_resolution(stated)
                                                                       : std::string(),
        .files = files_};
    std::optional<EvaluatedStatement> statement = evaluate_statement(keys, context);
    if (!statement) {
        return false;
    }
    out.input.constant = (out.input.components.empty() || out.input.constant) && statement->is_constant;
    out.input.components.push_back(std::move(statement->quantity));
    out.specifications.push_back(std::move(statement->specification));
    out.keys.push_back(keys);
    return true;
}

bool BudgetInputs::evaluate_components(const Stated& stated, const StatementKeys& keys, Evaluated& out) {
    bool is_read = true;
    // A source or a note of the input holds for every component that has none of its own.
    std::array<std::string, 3> shared;
    constexpr std::array<std::string_view, 3> k_shared{"source", "significance", "note"};
    for (std::size_t i = 0; i < k_shared.size(); ++i) {
        const auto text = keys.text(k_shared[i]);
        is_read = is_read && (text || !keys.has(k_shared[i]));
        shared[i] = text.value_or("");
    }
    const bool has_readings = keys.has("observations") || keys.has("groups");
    constexpr std::array<std::string_view, 3> k_of_readings{"observations", "pooled", "groups"};
    for (const std::string_view key : keys.present()) {
        const bool is_reading =
            has_readings && std::find(k_of_readings.begin(), k_of_readings.end(), key) != k_of_readings.end();
        if (key != "components" && key != "unit" && key != "description" && key != "between_points" && !is_reading &&
            std::find(k_shared.begin(), k_shared.end(), key) == k_shared.end()) {
            keys.refuse(k_two_statements, key, text::in_quotes(key) + " is given beside \"components\"",
                        "an input is one statement or a sum of components, each with its own statement; readings may "
                        "stand beside them",
                        key != "value" ? "move it into a component"
                                       : "move it into a component; where it is read anew at each point, give the "
                                         "components an input of their own, and add the two in the model");
            is_read = false;
        }
    }
    const json* list = keys.array("components");
    if (list == nullptr) {
        return false;
    }
    if (list->empty() || list->size() > k_most_components) {
        keys.refuse(k_wrong_size, "components", text::count_of(list->size(), "component"),
                    "an input has 1 to " + std::to_string(k_most_components) + " components", "correct the list");
        return false;
    }
    std::set<std::string> names;
    if (has_readings) {
        // The readings of a point, and what does not change from point to point: the display, a cable.
        const bool holds_resolution = std::any_of(list->begin(), list->end(), [](const json& component) {
            return component.is_object() && component.contains("resolution");
        });
        is_read = add_component(stated, keys, true, out, holds_resolution) && is_read;
        if (!out.input.components.empty()) {
            out.input.components.back().name = k_component_of_readings;
        }
        names.emplace(k_component_of_readings);
        own_components_.emplace(k_component_of_readings);
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::string pointer = child_pointer(keys.pointer("components"), i);
        const JsonDocument& document = keys.document("components");
        ProblemList& problems = keys.problems("components");
        if (!(*list)[i].is_object()) {
            problems.refuse(k_wrong_type, document.where(pointer), described((*list)[i]), "must be an object",
                            "state name and uncertainty of the component");
            is_read = false;
            continue;
        }
        const JsonObject object(document, pointer, keys_of<ComponentStatement>(), problems);
        const auto name = object.required_name("name");
        if (name && !names.insert(*name).second) {
            object.refuse(k_name_of_two, "name", "a second component " + text::in_quotes(*name),
                          "components of one input have different names", "rename one of the two");
            is_read = false;
        }
        const std::size_t before = out.input.components.size();
        is_read = add_component(stated, StatementKeys(document, pointer, keys_of<ComponentStatement>(), problems), true,
                                out) &&
                  name && is_read;
        if (out.input.components.size() > before) {
            gum::StatedQuantity& component = out.input.components.back();
            component.name = name.value_or("");
            const std::array<std::string*, 3> own{&component.source, &component.significance, &component.note};
            for (std::size_t k = 0; k < own.size(); ++k) {
                *own[k] = own[k]->empty() ? shared[k] : *own[k];
            }
        }
    }
    if (!is_read) {
        return false;
    }
    double u2 = 0.0;
    for (std::size_t i = 0; i < out.input.components.size(); ++i) {
        u2 += out.specifications[i] ? 1.0 : out.input.components[i].u;
    }
    if (!std::isfinite(value_in_si(out.input)) || !std::isfinite(value_in_unit(out.input))) {
        keys.refuse(k_not_representable, "components", "the sum of the components is not finite",
                    "values must be finite", "check the numbers");
        return false;
    }
    if (u2 == 0.0 && !out.input.constant) {
        keys.refuse(k_no_uncertainty, "components", "no component has an uncertainty",
                    "an input that is not a constant has an uncertainty greater than 0",
                    "add the missing contribution, such as the resolution");
        return false;
    }
    return true;
}

bool BudgetInputs::complete(Evaluated& evaluated, const Reading& reading) const {
    bool is_complete = true;
    gum::BudgetInput& input = evaluated.input;
    for (std::size_t i = 0; i < input.components.size(); ++i) {
        const std::optional<StatedSpecification>& specification = evaluated.specifications[i];
        if (!specification) {
            continue;
        }
        const StatementKeys& keys = evaluated.keys[i];
        double read = value_in_unit(input);
        if (specification->of) {
            const gum::BudgetInput* other = reading(*specification->of);
            if (other == nullptr) {
                // An input with problems of its own has been refused already.
                if (std::find(names_.begin(), names_.end(), *specification->of) == names_.end()) {
                    const std::vector<std::string_view> known(names_.begin(), names_.end());
                    const auto nearest = nearest_word(*specification->of, known);
                    keys.refuse(k_unknown_quantity, "specification",
                                "\"of\" is " + text::in_quotes(*specification->of) + ", which is none of the inputs",
                                "the specification refers to the value of an input",
                                nearest ? "did you mean " + text::in_quotes(*nearest) + "?" : "correct the name");
                }
                is_complete = false;
                continue;
            }
            if (!(other->unit.dimension() == input.unit.dimension())) {
                keys.refuse(k_unit_does_not_fit, "specification",
                            "\"of\" is " + text::in_quotes(other->name) + " in " + text::visible(other->unit.text()) +
                                ", and " + text::in_quotes(input.name) + " is in " + text::visible(input.unit.text()),
                            "a percentage of a reading has the kind of quantity of the reading", "correct the units");
                is_complete = false;
                continue;
            }
            // The reading as its own scale shows it: 100 °C is 100 K here, not 373.15 K, and 68 °F is 68 Δ°F, not 36 Δ°F.
            read = input.unit.difference_from_si(other->unit.difference_to_si(value_in_unit(*other)));
        }
        is_complete = specify(input.components[i], *specification, read, input.unit, keys) && is_complete;
    }
    return is_complete;
}

bool BudgetInputs::check_digits(const Evaluated& evaluated) {
    const gum::BudgetInput& input = evaluated.input;
    double u2 = 0.0;
    for (const gum::StatedQuantity& component : input.components) {
        const double u = input.unit.difference_from_si(component.u);
        u2 += u * u;
    }
    const double u = std::sqrt(u2);
    if (u == 0.0) {
        return true;
    }
    bool all_held = true;
    for (std::size_t i = 0; i < input.components.size(); ++i) {
        const gum::StatedQuantity& component = input.components[i];
        // A mean has digits of its own; what was written are the readings.
        const bool is_list = !component.observations.empty() || component.groups.has_value() ||
                             component.distribution.samples != nullptr;
        std::string_view key = "value";
        double worst = is_list ? 0.0 : component.stated_value;
        const auto see = [&](std::string_view of, const std::vector<double>& si) {
            key = si.empty() ? key : of;
            for (const double value : si) {
                const double stated = input.unit.from_si(value);
                worst = gum::decimal_rounding(stated) > gum::decimal_rounding(worst) ? stated : worst;
            }
        };
        see("observations", component.observations);
        if (component.groups) {
            see("groups", component.groups->means);
            for (const std::vector<double>& group : component.groups->readings) {
                see("groups", group);
            }
        }
        if (component.distribution.samples) {
            see("samples", *component.distribution.samples);
        }
        const double lost = gum::decimal_rounding(worst);
        if (lost > gum::k_accepted_rounding * u) {
            evaluated.keys[i].refuse(
                k_digits_lost, key,
                "the digits of " + text::shortest_plain(worst) + " are held to ±" + gum::round_significant(lost, 2) +
                    " only, and the standard uncertainty is " + text::shortest_plain(u),
                "a number has about 16 digits; what is lost of it must be small beside its uncertainty",
                "state it as a whole number, a constant, and the difference from it, an input; in the model, subtract "
                "the whole numbers from each other before the differences are added");
            all_held = false;
        }
    }
    return all_held;
}

void BudgetInputs::warn_of_similar_names() {
    std::map<std::string, std::string> seen;
    for (const std::string& name : names_) {
        const auto [entry, is_new] = seen.try_emplace(small_letters(name), name);
        if (!is_new) {
            problems_.warn(
                k_warn_same_but_case, document_.where(child_pointer("/inputs", name)),
                text::in_quotes(name) + " and " + text::in_quotes(entry->second) + " differ by capital letters only",
                "names are told apart by capital letters", "rename one of the two if people may confuse them");
        }
    }
}

std::vector<gum::BudgetInput> BudgetInputs::inputs(std::map<std::string, std::size_t>& positions) {
    std::vector<gum::BudgetInput> list;
    positions_.assign(stated_.size(), 0);
    for (std::size_t i = 0; i < stated_.size(); ++i) {
        const Stated& stated = stated_[i];
        if (stated.base || stated.pending) {
            positions_[i] = list.size();
            positions.emplace(stated.name, list.size());
            if (stated.base) {
                list.push_back(stated.base->input);
                continue;
            }
            gum::BudgetInput& open = list.emplace_back();  // until a point states it
            open.name = stated.name;
            open.unit = stated.unit;
            open.stated = false;
            open.where = stated.keys->where();
            open.components.emplace_back();
        }
    }
    return list;
}

std::vector<gum::InputSymbol> BudgetInputs::symbols() const {
    std::vector<gum::InputSymbol> symbols;
    for (const Stated& stated : stated_) {
        symbols.push_back({stated.name, stated.unit, std::nullopt});
    }
    return symbols;
}

bool BudgetInputs::is_read_by_specification(const std::string& name) const {
    const auto found = of_name_.find(name);
    return found != of_name_.end() && !readers_[found->second].empty();
}

// ---- points of a table ----------------------------------------------------------------------------------------------

void BudgetInputs::set_used(const std::optional<std::set<std::string>>& names) {
    std::vector<bool>& used = used_.emplace_back(stated_.size(), !names);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; names && i < stated_.size(); ++i) {
        used[i] = names->contains(gum::canonical_name(stated_[i].name));
        if (used[i]) {
            found.push_back(i);
        }
    }
    // A specification reads the value of another input.
    while (!found.empty()) {
        const std::size_t reader = found.back();
        found.pop_back();
        for (std::size_t i = 0; i < readers_.size(); ++i) {
            if (!used[i] && std::find(readers_[i].begin(), readers_[i].end(), reader) != readers_[i].end()) {
                used[i] = true;
                found.push_back(i);
            }
        }
    }
}

bool BudgetInputs::is_used(const std::string& input, std::size_t section) const {
    const auto found = of_name_.find(input);
    return found != of_name_.end() && section < used_.size() && used_[section][found->second];
}

void BudgetInputs::read_points(const JsonObject& object, const std::optional<std::set<std::string>>& used,
                               BudgetJob& job) {
    set_used(used);
    const json* points = object.find("points");
    if (points == nullptr) {
        for (std::size_t i = 0; i < stated_.size(); ++i) {
            stated_[i].is_wanted_alone = stated_[i].is_wanted_alone || used_.back()[i];
        }
        return;
    }
    if (const auto found = of_name_.find(std::string{k_point}); found != of_name_.end()) {
        problems_.refuse(k_name_of_two, document_.where("/inputs/point"),
                         "an input is named \"point\" in a job with points",
                         "in a table of points this word names the point", "rename the input");
        return;
    }
    const std::size_t before = job.points.size();
    if (points->is_array()) {
        read_point_array(*points, object.pointer("points"), job);
    } else if (points->is_object()) {
        static constexpr std::array<std::string_view, 3> k_keys{"file", "list", "columns"};
        const JsonObject table(document_, object.pointer("points"), k_keys, problems_);
        read_columns(table, job);
        fill_columns(before, job);
        if (table.has("list")) {
            if (table.has("file")) {
                table.refuse(k_two_statements, "list", "\"file\" and \"list\" are given together",
                             "points stand in a file or in the job", "keep one of them");
            } else if (const json* list = table.optional_array("list")) {
                read_point_array(*list, table.pointer("list"), job);
            }
        } else if (const auto name = JobFiles::file_name(table, "file", true)) {
            read_point_file(*name, job);
        }
    } else {
        object.refuse(k_wrong_type, "points", described(*points), "must be an array or an object",
                      "give an array of points, or {\"file\": \"points.csv\"}");
    }
    fill_columns(job.points.size(), job);
    for (std::size_t i = 0; i < stated_.size(); ++i) {
        stated_[i].wanted += used_.back()[i] ? job.points.size() - before : 0;
        stated_[i].is_table_refused = stated_[i].is_table_refused || (used_.back()[i] && job.points.size() == before);
    }
}

void BudgetInputs::read_columns(const JsonObject& points, BudgetJob& job) {
    const json* columns = points.find("columns");
    if (columns == nullptr) {
        return;
    }
    if (!columns->is_object() || columns->size() > k_most_point_columns) {
        points.refuse(k_wrong_type, "columns",
                      columns->is_object() ? text::count_of(columns->size(), "column") : described(*columns),
                      "must be an object of at most " + std::to_string(k_most_point_columns) + " columns",
                      "write {\"range\": \"text\", \"nominal\": \"V\"}");
        return;
    }
    for (const std::string& name : keys_in_order(document_, points.pointer("columns"))) {
        const std::string at = child_pointer(points.pointer("columns"), name);
        const std::string where = document_.where(at);
        if (const auto objection = name_objection(name)) {
            problems_.refuse(k_text_not_allowed, where, "the name of the column " + *objection,
                             "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                             "correct the name");
            continue;
        }
        if (std::find(k_reserved.begin(), k_reserved.end(), name) != k_reserved.end()) {
            problems_.refuse(k_point_column, where, text::in_quotes(name) + " is declared as a column of points",
                             "in tables this word stands for something else", "rename the column");
            continue;
        }
        if (std::find(names_.begin(), names_.end(), name) != names_.end()) {
            problems_.refuse(k_point_column, where, text::in_quotes(name) + " is an input and a column of points",
                             "a name stands for one quantity; the column of an input is not declared",
                             "remove it, or rename one of the two");
            continue;
        }
        const json& value = columns->at(name);
        certificate::PointColumn column;
        column.name = name;
        std::optional<std::string> unit;
        if (value.is_string()) {
            if (value.get<std::string>() != "text") {
                unit = value.get<std::string>();
            }
        } else if (value.is_object()) {
            static constexpr std::array<std::string_view, 5> k_keys{"unit", "heading", "role", "stage", "form"};
            const JsonObject object(document_, at, k_keys, problems_);
            unit = object.optional_string("unit");
            column.role = unit ? object.optional_choice<std::string_view>("role", k_role_words).value_or("")
                               : object.optional_choice<std::string_view>("role", k_word_roles).value_or("");
            column.stage = object.optional_choice<std::string_view>("stage", k_stage_words).value_or("");
            column.form = object.optional_choice<std::string_view>("form", k_form_words).value_or("");
            if (const json* heading = object.find("heading"); heading != nullptr && heading->is_object()) {
                read_localised(*heading, column.heading, false, {&document_, object.pointer("heading"), &problems_});
            } else {
                column.heading = object.optional_name("heading").value_or("");
            }
        } else {
            problems_.refuse(k_wrong_type, where, described(value), "must be \"text\", a unit or an object",
                             "write \"text\" for words, or the unit of numbers");
            continue;
        }
        if (unit) {
            try {
                column.unit = gum::Unit::parse(*unit).text();
            } catch (const gum::DiagnosedError& error) {
                refuse_as(error, where, problems_);
                continue;
            }
            column.printed_unit = gum::unit_for_people(column.unit);
        }
        const bool has_words = !unit && !is_limit(name);
        const auto is_among = [&](const auto& roles) {
            return std::find(roles.begin(), roles.end(), name) != roles.end();
        };
        if (column.role.empty() &&
            (is_among(certificate::k_quantity_roles) || (has_words && is_among(certificate::k_piece_roles)))) {
            column.role = name;
        }
        const auto known = std::find_if(job.point_columns.begin(), job.point_columns.end(),
                                        [&](const certificate::PointColumn& c) { return c.name == name; });
        if (known != job.point_columns.end()) {  // of a section before
            const auto position = static_cast<std::size_t>(known - job.point_columns.begin());
            if (has_words_[position] != has_words || known->unit != column.unit || known->role != column.role ||
                known->stage != column.stage || known->form != column.form || !(known->heading == column.heading)) {
                problems_.refuse(k_point_column, where,
                                 text::in_quotes(name) + " is declared otherwise than in a section before",
                                 "a name stands for one column in all sections", "declare it alike, or rename it");
            }
            continue;
        }
        has_words_.push_back(has_words);
        job.point_columns.push_back(std::move(column));
    }
}

std::optional<std::size_t> BudgetInputs::information(const std::string& name, BudgetJob& job) {
    for (std::size_t i = 0; i < job.point_columns.size(); ++i) {
        if (job.point_columns[i].name == name) {
            return i;
        }
    }
    if (!is_limit(name) || of_name_.contains(name)) {
        return std::nullopt;
    }
    certificate::PointColumn& column = job.point_columns.emplace_back();
    column.name = name;
    column.values.resize(job.points.size());
    column.printed.resize(job.points.size());
    has_words_.push_back(false);
    return job.point_columns.size() - 1;
}

void BudgetInputs::read_information(const FileColumn& column, const CsvTable& table, std::size_t row,
                                    std::size_t position, ProblemList& problems, BudgetJob& job) {
    certificate::PointColumn& into = job.point_columns[*column.information];
    const CsvCell& cell = table.cell(row, position);
    into.values.emplace_back();
    into.printed.emplace_back();
    if (cell.text.empty()) {
        return;
    }
    if (!has_words_[*column.information]) {
        const bool is_limit_without_unit = into.unit.empty() && text::has_angle_sign(cell.text);
        const auto number = is_limit_without_unit
                                ? angle_number(std::string(cell.text), {}, table.where(cell), problems)
                                : number_in_cell(table, row, position, into.unit, column.name, problems);
        if (number) {
            into.values.back() = number->value;
            into.printed.back() = digits_as_written(number->written, number->value);
        }
    } else if (const auto objection = name_objection(cell.text)) {
        problems.refuse(k_text_not_allowed, table.where(cell),
                        "the text in the column " + text::in_quotes(column.name) + " " + *objection,
                        "a text has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                        "correct the text", "text " + column.name);
    } else {
        into.printed.back() = cell.text;
    }
}

void BudgetInputs::read_information(std::size_t column, const json& value, const std::string& at, BudgetJob& job) {
    const std::string where = document_.where(at);
    certificate::PointColumn& into = job.point_columns[column];
    into.values.resize(job.points.size() + 1);  // points before may have left it out
    into.printed.resize(job.points.size() + 1);
    if (!has_words_[column]) {
        if (value.is_number()) {
            into.values.back() = value.get<double>();
            into.printed.back() = digits_as_written(document_.number_as_written(at), value.get<double>());
            return;
        }
        if (is_angle_text(value)) {
            if (const auto angle = angle_number(value.get_ref<const std::string&>(), into.unit, where, problems_)) {
                into.values.back() = angle->value;
                into.printed.back() = digits_as_written(angle->written, angle->value);
            }
            return;
        }
        problems_.refuse(k_wrong_type, where, described(value), "must be a number",
                         "write the number without quotes and unit");
        return;
    }
    const auto objection = value.is_string() ? name_objection(value.get<std::string>()) : std::nullopt;
    if (!value.is_string() || objection) {
        problems_.refuse(value.is_string() ? k_text_not_allowed : k_wrong_type, where,
                         objection ? "the text " + *objection : described(value),
                         "must be a text of 1 to 256 bytes without spaces around it and hidden characters",
                         "write it in quotes");
        return;
    }
    into.printed.back() = value.get<std::string>();
}

void BudgetInputs::fill_columns(std::size_t points, BudgetJob& job) {
    for (certificate::PointColumn& column : job.point_columns) {
        column.values.resize(points);
        column.printed.resize(points);
    }
}

void BudgetInputs::note_decimals(std::size_t input, std::size_t point, int decimals) {
    std::vector<int>& all = decimals_[input];
    all.resize(point + 1, -1);
    all[point] = decimals;
}

std::optional<int> BudgetInputs::decimals(const std::string& input, std::size_t point) const {
    const auto index = of_name_.find(input);
    const auto found = index == of_name_.end() ? decimals_.end() : decimals_.find(index->second);
    if (found == decimals_.end() || point >= found->second.size() || found->second[point] < 0) {
        return std::nullopt;
    }
    return found->second[point];
}

std::optional<int> BudgetInputs::decimals_of_job(const std::string& input) const {
    const auto index = of_name_.find(input);
    if (index == of_name_.end() || !stated_[index->second].keys || !stated_[index->second].keys->has("value")) {
        return std::nullopt;
    }
    const StatementKeys& keys = *stated_[index->second].keys;
    const auto of_angle = decimals_of_angle(keys.value("value"), stated_[index->second].unit.text());
    return of_angle ? *of_angle : keys.decimals_as_written("value");
}

void BudgetInputs::refuse_unstated(const Stated& stated, std::size_t points) {
    const std::vector<gum::Diagnostic> refused = stated.pending->refused();
    const bool nothing_stated = !refused.empty() && refused.front().code == k_no_statement.code;
    // A value, or an uncertainty, that the job leaves to the points: adding it to the job would be a statement of those
    // points that nobody has made.
    const bool is_left_open = !refused.empty() && std::ranges::all_of(refused, [](const gum::Diagnostic& one) {
        return one.code == k_no_statement.code || one.code == k_incomplete_statement.code ||
               one.code == k_no_uncertainty.code;
    });
    if (!is_left_open || (stated.points == 0 && points > 0)) {
        problems_.take(*stated.pending);
        return;
    }
    if (points == 0) {
        return;
    }
    std::string names;
    for (const std::string& name : stated.silent) {
        names += (names.empty() ? "" : ", ") + text::in_quotes(name);
    }
    const std::size_t silent = points - stated.points;
    if (silent > stated.silent.size()) {
        names += " and " + std::to_string(silent - stated.silent.size()) + " more";
    }
    if (nothing_stated) {
        stated.keys->refuse(k_no_statement,
                            "nothing is stated of it, and the points " + names + " do not state it either",
                            "an input has a statement of its own, or every point of the table has one",
                            "state it at these points, or in the inputs");
        return;
    }
    const InputCode& code = refused.front().code == k_no_uncertainty.code ? k_no_uncertainty : k_incomplete_statement;
    stated.keys->refuse(code, refused.front().what + ", and the points " + names + " do not state it either",
                        refused.front().rule, "state it at these points; in the inputs it holds for all that do not");
}

namespace {

/// Where only points state an input, what stands in the job is what the first of them says.
void take_from_points(std::size_t position, BudgetJob& job) {
    for (const gum::BudgetPoint& point : job.points) {
        for (const auto& [index, input] : point.inputs) {
            if (index == position) {
                job.inputs[position] = input;
                job.inputs[position].stated = false;
                return;
            }
        }
    }
}

}  // namespace

void BudgetInputs::finish_points(BudgetJob& job) {
    std::vector<std::string> unused;
    for (std::size_t i = 0; i < stated_.size(); ++i) {
        Stated& stated = stated_[i];
        const bool everywhere = stated.wanted > 0 && stated.points == stated.wanted && !stated.is_wanted_alone;
        if (!everywhere && stated.pending) {
            if (!stated.is_wanted_alone && stated.is_table_refused) {
                // What the job leaves open may stand in the table that could not be read.
                problems_.take(*stated.pending, [](const gum::Diagnostic& one) {
                    return one.code != k_no_statement.code && one.code != k_incomplete_statement.code &&
                           one.code != k_no_uncertainty.code;
                });
            } else if (stated.is_wanted_alone || (stated.wanted == 0 && !job.points.empty())) {
                problems_.take(*stated.pending);
            } else {
                refuse_unstated(stated, stated.wanted);
            }
        }
        if (!stated.base || !stated.is_complete) {
            take_from_points(positions_[i], job);
        }
        if (!everywhere) {
            continue;
        }
        for (const auto& [key, points] : stated.overridden) {
            if (points == stated.wanted && stated.keys->has(key) &&
                (key == "value" || key == "observations" || key == "groups" || key == "samples" || key == "limits")) {
                unused.push_back(text::in_quotes(stated.name + "." + std::string{key}));
            }
        }
    }
    if (!unused.empty()) {
        problems_.note(
            k_warn_unused_value, document_.where("/inputs"),
            text::listed(unused, k_most_named) + " of the inputs: every point of the table states another one",
            "an input may be left to the points: nothing needs to stand in its place", "remove them");
    }
}

std::optional<std::size_t> BudgetInputs::point_input(const std::string& name, const std::string& where,
                                                     const BudgetJob& job, ProblemList& problems,
                                                     const std::string* column) const {
    if (const auto found = of_name_.find(name); found != of_name_.end()) {
        return found->second;
    }
    if (std::find(names_.begin(), names_.end(), name) != names_.end()) {
        return std::nullopt;
    }
    const bool is_parameter = std::any_of(job.fits.begin(), job.fits.end(), [&](const gum::BudgetFit& fit) {
        return std::any_of(fit.parameters.begin(), fit.parameters.end(),
                           [&](const gum::BudgetFit::Parameter& parameter) { return parameter.name == name; });
    });
    if (is_parameter) {
        problems.refuse(k_point_of_fit, where, text::in_quotes(name) + " is a parameter of a fit",
                        "all points share the fits", "remove it");
        return std::nullopt;
    }
    const std::vector<std::string_view> known(names_.begin(), names_.end());
    const auto nearest = nearest_word(name, known);
    // "x.u" is the head of a column; in a point of the job the keys of x stand in an object.
    const std::size_t dot = column == nullptr ? name.find('.') : std::string::npos;
    if (dot != std::string::npos && of_name_.contains(name.substr(0, dot))) {
        problems.refuse(k_unknown_quantity, where, text::in_quotes(name) + " is the head of a column of a file",
                        "a point of the job states an input by its name, as a number or as an object of its keys",
                        "write " + text::in_quotes(name.substr(0, dot)) + ": {" +
                            text::in_quotes(name.substr(dot + 1)) + ": …}, with all keys of the input in one object");
        return std::nullopt;
    }
    problems.refuse(k_unknown_quantity, where, text::in_quotes(name) + " is none of the inputs",
                    column == nullptr
                        ? "a point states inputs of the job by their names, and its own name as \"point\""
                        : "a point states inputs of the job, by NAME or NAME.key, and its own name as \"point\"",
                    column == nullptr && name.empty() ? "remove it, or name the input"
                    : name.empty()                    ? "give the column a name, or remove it"
                    : nearest                         ? "did you mean " + text::in_quotes(*nearest) + "?"
                              : "correct the name; declare a column for people in the columns of the points, such as "
                                "\"columns\": {" +
                                    text::in_quotes(column == nullptr ? name : *column) + ": \"text\"}");
    return std::nullopt;
}

void BudgetInputs::name_point(gum::BudgetPoint& point, const std::optional<std::string>& name, const std::string& where,
                              const BudgetJob& job, ProblemList& problems) {
    point.name = name.value_or(std::to_string(job.points.size() + 1));
    const auto [entry, is_new] = point_names_.try_emplace(point.name, where);
    if (!is_new) {
        problems.refuse(k_repeated_point, where,
                        "a second point " + text::in_quotes(point.name) + ", the first is at " + entry->second,
                        "points have different names", "rename one of the two");
    }
}

void BudgetInputs::read_point_array(const json& points, const std::string& pointer, BudgetJob& job) {
    if (points.empty() || points.size() > k_most_points) {
        problems_.refuse(k_wrong_size, document_.where(pointer), text::count_of(points.size(), "point"),
                         "a table has 1 to " + std::to_string(k_most_points) + " points", "correct the list");
        return;
    }
    // What no equation uses and every point of the section states is there to be printed, as a nominal value is.
    for (std::size_t i = 0; i < stated_.size(); ++i) {
        used_.back()[i] = used_.back()[i] || std::ranges::all_of(points, [&](const json& point) {
                              return point.contains(stated_[i].name);
                          });
    }
    std::map<std::string, AngleNotation> notations;  // by the key
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::string here = child_pointer(pointer, i);
        if (!points[i].is_object()) {
            problems_.refuse(k_wrong_type, document_.where(here), described(points[i]), "must be an object",
                             "write {\"name of an input\": value, …}");
            continue;
        }
        gum::BudgetPoint point;
        std::optional<std::string> name;
        std::map<std::size_t, StatementKeys> overrides;
        std::set<std::size_t> told;
        for (const auto& [key, value] : points[i].items()) {
            const std::string at = child_pointer(here, key);
            if (value.is_discarded()) {
                if (const auto of = of_name_.find(key); of != of_name_.end()) {
                    told.insert(of->second);  // what is wrong with it is said already
                }
                continue;
            }
            if (key == k_point) {
                name = value.is_number() ? described(value) : value.is_string() ? value.get<std::string>() : "";
                if (const auto objection = name_objection(*name)) {
                    problems_.refuse(
                        k_text_not_allowed, document_.where(at), "the name of the point " + *objection,
                        "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                        "correct the name");
                    name.reset();
                }
                continue;
            }
            AngleNotation& notation = notations[key];
            notation.see(value, document_, at);
            for (const char* const of_values : {"value", "observations"}) {
                if (value.is_object() && value.contains(of_values)) {
                    notation.see(value[of_values], document_, child_pointer(at, of_values));
                }
            }
            if (const auto own = information(key, job)) {
                read_information(*own, value, at, job);
                continue;
            }
            const auto index = point_input(key, document_.where(at), job, problems_);
            if (!index) {
                continue;
            }
            const StatementKeys& base = *stated_[*index].keys;
            if (value.is_number()) {
                note_decimals(*index, job.points.size(), document_.decimals_as_written(at));
                overrides.emplace(*index, base.with("value", value.get<double>(), document_, at, problems_));
                ++stated_[*index].overridden["value"];
            } else if (is_angle_text(value)) {
                if (const auto angle = angle_number(value.get_ref<const std::string&>(), stated_[*index].unit.text(),
                                                    document_.where(at), problems_)) {
                    note_decimals(*index, job.points.size(), text::most_decimals({&angle->written, 1}));
                    overrides.emplace(*index, base.with("value", angle->value, document_, at, problems_));
                    ++stated_[*index].overridden["value"];
                } else {
                    told.insert(*index);
                }
            } else if (value.is_object()) {
                const JsonObject object(document_, at, keys_of<OverrideStatement>(), problems_);
                if (const json* readings = object.find("observations"); readings != nullptr && readings->is_array()) {
                    note_decimals(*index, job.points.size(),
                                  std::max(document_.decimals_as_written(object.pointer("observations")),
                                           decimals_of_angles(*readings, stated_[*index].unit.text())) +
                                      (readings->size() > 1 ? 1 : 0));
                } else if (const json* stated = object.find("value"); stated != nullptr && stated->is_number()) {
                    note_decimals(*index, job.points.size(), document_.decimals_as_written(object.pointer("value")));
                } else if (const auto angle = decimals_of_angle(stated, stated_[*index].unit.text())) {
                    note_decimals(*index, job.points.size(), *angle);
                }
                const StatementKeys own(document_, at, keys_of<OverrideStatement>(), problems_);
                overrides.emplace(*index, base.with(own));
                for (const std::string_view own_key : own.present()) {
                    ++stated_[*index].overridden[own_key];
                }
            } else {
                told.insert(*index);
                problems_.refuse(k_wrong_type, document_.where(at), described(value), "must be a number or an object",
                                 value.is_array() ? "state readings as {\"observations\": [...]}"
                                                  : "state the value, or the keys that differ at this point");
            }
        }
        name_point(point, name, document_.where(here), job, problems_);
        read_point(point, overrides, told, job);
        job.points.push_back(std::move(point));
        fill_columns(job.points.size(), job);
    }
    for (const auto& [key, notation] : notations) {
        notation.refuse_mixture(text::in_quotes(key) + " of the points", problems_);
    }
}

void BudgetInputs::read_point_file(const std::string& name, BudgetJob& job) {
    std::optional<JobFiles::File> file = files_.open(name);
    if (!file) {
        return;
    }
    std::vector<FileColumn> columns;
    std::vector<std::string> seen;
    std::optional<std::size_t> name_column;
    const std::span<const std::string_view> keys = budget_column_keys();
    bool is_known = true;
    for (const CsvHeaderField& field : csv_header(file->bytes)) {
        if (std::find(seen.begin(), seen.end(), field.name) != seen.end() || seen.size() > k_most_inputs) {
            continue;  // refused when the table is read
        }
        seen.push_back(field.name);
        if (field.name == k_point) {
            name_column = columns.size();
            columns.push_back({.name = field.name});
            continue;
        }
        if (const auto own = information(field.name, job)) {
            columns.push_back({.name = field.name, .information = own});
            continue;
        }
        const std::string where = text::where_in_text(name, field.place);
        if (const std::size_t bracket = field.name.find_first_of("[("); bracket != std::string::npos && bracket > 0) {
            std::string bare = field.name.substr(0, bracket);
            bare.erase(bare.find_last_not_of(' ') + 1);
            // Of another name the brackets hold words for people: "Remark (free)".
            if (std::find(names_.begin(), names_.end(), bare.substr(0, bare.rfind('.'))) != names_.end()) {
                file->problems->refuse(k_unknown_key, where, "the column " + text::in_quotes(field.name),
                                       "a column is called NAME or NAME.key: its unit is that of the input",
                                       "write " + text::in_quotes(bare) + ", and state the unit in the job");
                is_known = false;
                continue;
            }
        }
        const std::size_t dot = field.name.rfind('.');
        const bool is_reading = dot != std::string::npos && dot + 1 < field.name.size() &&
                                field.name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
        if (is_reading) {
            const auto index = point_input(field.name.substr(0, dot), where, job, *file->problems, &field.name);
            is_known = is_known && index;
            columns.push_back({.name = field.name, .input = index, .key = "observations", .is_reading = true});
            continue;
        }
        if (const auto [of_input, word] = LaboratoryUse::reference_column(field.name); !word.empty()) {
            const auto index = point_input(std::string(of_input), where, job, *file->problems, &field.name);
            is_known = is_known && index;
            columns.push_back({.name = field.name, .input = index, .key = word, .is_reference = true});
            continue;
        }
        const std::string_view key =
            dot == std::string::npos ? std::string_view{"value"} : std::string_view{field.name}.substr(dot + 1);
        const auto known = std::find(keys.begin(), keys.end(), key);
        const auto index = point_input(field.name.substr(0, dot), where, job, *file->problems, &field.name);
        if (index && known == keys.end()) {
            const auto nearest = nearest_word(key, keys);
            file->problems->refuse(k_unknown_key, where,
                                   "the key " + text::in_quotes(key) + " of the column " + text::in_quotes(field.name),
                                   "the keys of a column are " + text::any_of(keys) + ", and of a standard " +
                                       text::any_of(LaboratoryUse::reference_keys()),
                                   nearest ? "did you mean " + text::in_quotes(*nearest) + "?" : "remove the column");
        }
        if (!index || known == keys.end()) {
            is_known = false;
            continue;
        }
        columns.push_back({.name = field.name, .input = index, .key = *known});
    }
    for (const FileColumn& column : columns) {
        if (column.input) {
            used_.back()[*column.input] = true;  // as in a list: every row states it
        }
    }
    std::vector<std::string_view> wanted;
    const auto is_of_standard = [&](const FileColumn& column, std::size_t input) {
        return column.is_reference && column.input == input;
    };
    for (FileColumn& column : columns) {
        wanted.emplace_back(column.name);
        if (!column.is_reference || !column.input) {
            continue;
        }
        const bool names_standard = std::any_of(columns.begin(), columns.end(), [&](const FileColumn& other) {
            return is_of_standard(other, *column.input) && other.key == "standard";
        });
        if (names_standard) {
            column.takes_standard = column.key == "standard";
        } else if (laboratory_.is_stated_once(stated_[*column.input].name)) {
            column.takes_standard = std::none_of(columns.begin(), columns.end(), [&](const FileColumn& other) {
                return is_of_standard(other, *column.input) && other.takes_standard;
            });
        } else {
            const std::string standard = column.name.substr(0, column.name.rfind('.')) + ".standard";
            file->problems->refuse(
                k_unknown_key, name + ":1",
                "the column " + text::in_quotes(column.name) + " without " + text::in_quotes(standard),
                "it says how a standard is used, and the input or the row names the standard itself",
                "name the standard in the input, or add the column " + text::in_quotes(standard));
            is_known = false;
        }
    }
    const auto table = read_csv_table(std::move(file->bytes), wanted, {}, *file->problems, {.rows = k_most_points});
    if (!table || !is_known) {
        return;
    }
    laboratory_.fill_rows(document_, *table, wanted, *file->problems);
    std::map<std::size_t, AngleNotation> notations;  // of inputs, whose readings have a column each
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (columns[c].input && (columns[c].key == "value" || columns[c].is_reading)) {
            notations[*columns[c].input].see(*table, c);
        } else if (columns[c].information && !has_words_[*columns[c].information]) {
            AngleNotation of_column;
            of_column.see(*table, c);
            of_column.refuse_mixture("column " + text::visible(columns[c].name), *file->problems);
        }
    }
    for (const auto& [input, notation] : notations) {
        notation.refuse_mixture("column " + text::visible(stated_[input].name), *file->problems);
    }
    for (std::size_t row = 0; row < table->rows(); ++row) {
        gum::BudgetPoint point;
        std::optional<std::string> point_name;
        std::map<std::size_t, StatementKeys> overrides;
        std::set<std::size_t> told;
        std::map<std::size_t, FileReadings> readings;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const FileColumn& column = columns[c];
            if (column.information) {
                read_information(column, *table, row, c, *file->problems, job);
                continue;
            }
            if (!column.input) {
                const auto text = table->name(row, c);
                point_name = text ? std::optional{std::string{*text}} : std::nullopt;
                continue;
            }
            const CsvCell& cell = table->cell(row, c);
            if (column.is_reference && !column.takes_standard) {
                continue;  // read with the standard
            }
            if (cell.text.empty() && (!column.is_reference || column.key == "standard")) {
                file->problems->refuse(
                    k_empty_cell, table->where(cell),
                    "row " + std::to_string(row + 1) + " has no value in the column " + text::in_quotes(column.name),
                    "a missing value is neither 0 nor that of another row",
                    "state it; leave the column out where all points take what the job states", "empty " + column.name);
                told.insert(*column.input);
                continue;
            }
            if (column.is_reference) {
                const LaboratoryUse::Row of_standard = laboratory_.row(row, stated_[*column.input].name);
                if (of_standard.document == nullptr) {
                    told.insert(*column.input);
                    continue;
                }
                const auto found = overrides.find(*column.input);
                const StatementKeys& before = found == overrides.end() ? *stated_[*column.input].keys : found->second;
                overrides.insert_or_assign(*column.input,
                                           before.with(StatementKeys(*of_standard.document, of_standard.pointer,
                                                                     keys_of<OverrideStatement>(), *file->problems)));
                ++stated_[*column.input].overridden["components"];
                continue;
            }
            const bool may_be_angle = column.key == "value" || column.is_reading;
            if (const auto read = number_in_cell(*table, row, c, may_be_angle ? stated_[*column.input].unit.text() : "",
                                                 column.name, *file->problems)) {
                const std::optional<double> number = read->value;
                const int decimals = text::most_decimals({&read->written, 1});
                if (column.is_reading) {
                    FileReadings& of_input = readings[*column.input];
                    of_input.first = of_input.numbers.empty() ? c : of_input.first;
                    of_input.numbers.push_back(*number);
                    of_input.decimals = std::max(of_input.decimals, decimals);
                    continue;
                }
                if (column.key == "value") {
                    note_decimals(*column.input, job.points.size(), decimals);
                }
                const auto found = overrides.find(*column.input);
                const StatementKeys& before = found == overrides.end() ? *stated_[*column.input].keys : found->second;
                overrides.insert_or_assign(
                    *column.input, before.with(column.key, *number, *table, cell, *file->problems, column.name));
                ++stated_[*column.input].overridden[column.key];
            } else {
                told.insert(*column.input);
            }
        }
        for (const auto& [input, read] : readings) {
            const auto found = overrides.find(input);
            const StatementKeys& before = found == overrides.end() ? *stated_[input].keys : found->second;
            const FileColumn& column = columns[read.first];
            overrides.insert_or_assign(input, before.with("observations", read.numbers, read.decimals, *table,
                                                          table->cell(row, read.first), *file->problems, column.name));
            ++stated_[input].overridden["observations"];
            note_decimals(input, job.points.size(), read.decimals + (read.numbers.size() > 1 ? 1 : 0));
        }
        if (!columns.empty()) {
            const std::string where = table->where(table->cell(row, name_column.value_or(0)));
            name_point(point, point_name, where, job, *file->problems);
        }
        read_point(point, overrides, told, job);
        job.points.push_back(std::move(point));
    }
}

void BudgetInputs::read_point(gum::BudgetPoint& point, const std::map<std::size_t, StatementKeys>& overrides,
                              const std::set<std::size_t>& told, BudgetJob& job) {
    std::map<std::size_t, Evaluated> here;
    std::set<std::size_t> read_again;
    for (const auto& [index, keys] : overrides) {
        if (keys.has("resolution")) {
            resolutions_.emplace(stated_[index].name, stated_[index].unit);
        }
    }
    for (std::size_t i = 0; i < stated_.size(); ++i) {
        if (!used_.back()[i]) {
            continue;
        }
        if (overrides.contains(i) || told.contains(i)) {
            ++stated_[i].points;
        } else if (stated_[i].silent.size() < k_most_named) {
            stated_[i].silent.push_back(point.name);
        }
        if (!stated_[i].is_complete) {
            read_again.insert(i);
        }
    }
    for (const auto& [index, keys] : overrides) {
        if (told.contains(index)) {
            continue;
        }
        const Stated& stated = stated_[index];
        const std::size_t position = positions_[index];
        // The correlation from simultaneous observations belongs to the observations of the job.
        const bool is_simultaneous =
            std::any_of(job.simultaneous.begin(), job.simultaneous.end(), [&](const gum::SimultaneousInputs& set) {
                return std::find(set.inputs.begin(), set.inputs.end(), position) != set.inputs.end();
            });
        if (is_simultaneous) {
            keys.refuse(k_not_simultaneous, text::in_quotes(stated.name) + " was observed together with other inputs",
                        "its observations, and hence its value, are those of the job", "remove it from the point");
            continue;
        }
        std::optional<Evaluated> evaluated = evaluate(stated, keys);
        if (!evaluated) {
            continue;
        }
        const bool is_correlated =
            evaluated->input.constant &&
            std::any_of(job.correlations.begin(), job.correlations.end(), [&](const gum::InputCorrelation& pair) {
                return pair.first == position || pair.second == position;
            });
        if (is_correlated) {
            keys.refuse(k_correlation_of_constant,
                        text::in_quotes(stated.name) + " is a constant at this point, and correlated",
                        "a quantity without uncertainty has no correlation", "state its uncertainty");
            continue;
        }
        // A point measures its own quantity, unless the job says that it is one for all of them.
        evaluated->input.common = evaluated->is_stated_common;
        here.emplace(index, std::move(*evaluated));
        read_again.insert(readers_[index].begin(), readers_[index].end());
    }
    for (const std::size_t index : read_again) {
        if (!overrides.contains(index) && stated_[index].base) {
            here.emplace(index, *stated_[index].base);
        }
    }
    const Reading reading = [&](const std::string& name) -> const gum::BudgetInput* {
        const auto found = of_name_.find(name);
        if (found == of_name_.end()) {
            return nullptr;
        }
        if (const auto own = here.find(found->second); own != here.end()) {
            return &own->second.input;
        }
        return stated_[found->second].base ? &stated_[found->second].base->input : nullptr;
    };
    for (auto& [index, evaluated] : here) {
        if (complete(evaluated, reading) && check_digits(evaluated)) {
            point.inputs.emplace_back(positions_[index], evaluated.input);
        }
    }
    std::sort(point.inputs.begin(), point.inputs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

}  // namespace gumcert::jobs
