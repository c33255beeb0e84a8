#include "jobs/budget/budget_inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "gum/quantity/decimal_rounding.h"
#include "gum/rounding.h"
#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_fit_statement.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/job_limits.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

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

double value_in_si(const gum::BudgetInput& input) {
    double sum = 0.0;
    for (const gum::StatedQuantity& component : input.components) {
        sum += component.value;
    }
    return sum;
}

}  // namespace

BudgetInputs::BudgetInputs(const JsonDocument& document, const std::optional<StatedCovariance>& covariance,
                           JobFiles& files, ProblemList& problems)
    : document_(document), covariance_(covariance), files_(files), problems_(problems) {}

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

std::optional<std::size_t> BudgetInputs::find(const std::string& name) const {
    const auto found = of_name_.find(name);
    return found == of_name_.end() ? std::nullopt : std::optional(found->second);
}

bool BudgetInputs::is_named(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

void BudgetInputs::note_resolution(std::size_t input) {
    resolutions_.emplace(stated_[input].name, stated_[input].unit);
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

std::optional<int> BudgetInputs::decimals_of_job(const std::string& input) const {
    const auto index = of_name_.find(input);
    if (index == of_name_.end() || !stated_[index->second].keys || !stated_[index->second].keys->has("value")) {
        return std::nullopt;
    }
    const StatementKeys& keys = *stated_[index->second].keys;
    const auto of_angle = decimals_of_angle(keys.value("value"), stated_[index->second].unit.text());
    return of_angle ? *of_angle : keys.decimals_as_written("value");
}

}  // namespace gumcert::jobs
