#include "jobs/budget/point_list.h"

#include <algorithm>
#include <map>
#include <utility>

#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/input_codes.h"
#include "jobs/job_limits.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

class PointList {
public:
    PointList(const JsonDocument& document, const BudgetInputs& inputs, const std::vector<gum::BudgetFit>& fits,
              BudgetPoints& points, ProblemList& problems)
        : document_(document), inputs_(inputs), fits_(fits), points_(points), problems_(problems) {}

    void read(const json& list, const std::string& pointer) {
        // What no equation uses and every point of the section states is there to be printed, as a nominal value is.
        for (std::size_t i = 0; i < inputs_.stated().size(); ++i) {
            if (std::ranges::all_of(list, [&](const json& p) { return p.contains(inputs_.stated()[i].name); })) {
                points_.use(i);
            }
        }
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string here = child_pointer(pointer, i);
            if (!list[i].is_object()) {
                problems_.refuse(k_wrong_type, document_.where(here), described(list[i]), "must be an object",
                                 "write {\"name of an input\": value, …}");
                continue;
            }
            read_point(list[i], here);
            points_.columns().fill();
        }
        for (const auto& [key, notation] : notations_) {
            notation.refuse_mixture(text::in_quotes(key) + " of the points", problems_);
        }
    }

private:
    void read_point(const json& point, const std::string& here) {
        StatedPoint stated;
        for (const auto& [key, value] : point.items()) {
            const std::string at = child_pointer(here, key);
            if (value.is_discarded()) {
                if (const auto of = inputs_.find(key)) {
                    stated.refused.insert(*of);  // what is wrong with it is said already
                }
            } else if (key == k_point_name) {
                stated.name = name_of(value, at);
            } else {
                see_notation(key, value, at);
                if (const auto own = points_.columns().find(key)) {
                    points_.columns().read_value(*own, value, at);
                } else if (const auto input = input_of_point(key, document_.where(at), inputs_, fits_, problems_)) {
                    read_input(*input, value, at, stated);
                }
            }
        }
        points_.add(stated, document_.where(here), problems_);
    }

    [[nodiscard]] std::optional<std::string> name_of(const json& value, const std::string& at) {
        std::string name = value.is_number() ? described(value) : value.is_string() ? value.get<std::string>() : "";
        if (const auto objection = name_objection(name)) {
            problems_.refuse(k_text_not_allowed, document_.where(at), "the name of the point " + *objection,
                             "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                             "correct the name");
            return std::nullopt;
        }
        return name;
    }

    void see_notation(const std::string& key, const json& value, const std::string& at) {
        AngleNotation& notation = notations_[key];
        notation.see(value, document_, at);
        for (const char* const of_values : {"value", "observations"}) {
            if (value.is_object() && value.contains(of_values)) {
                notation.see(value[of_values], document_, child_pointer(at, of_values));
            }
        }
    }

    void read_input(std::size_t input, const json& value, const std::string& at, StatedPoint& stated) {
        if (value.is_number()) {
            stated.decimals[input] = document_.decimals_as_written(at);
            replace_value(input, value.get<double>(), at, stated);
        } else if (is_angle_text(value)) {
            if (const auto angle =
                    angle_number(value.get_ref<const std::string&>(), unit_of(input), document_.where(at), problems_)) {
                stated.decimals[input] = text::most_decimals({&angle->written, 1});
                replace_value(input, angle->value, at, stated);
            } else {
                stated.refused.insert(input);
            }
        } else if (value.is_object()) {
            read_keys(input, at, stated);
        } else {
            stated.refused.insert(input);
            problems_.refuse(k_wrong_type, document_.where(at), described(value), "must be a number or an object",
                             value.is_array() ? "state readings as {\"observations\": [...]}"
                                              : "state the value, or the keys that differ at this point");
        }
    }

    void replace_value(std::size_t input, double value, const std::string& at, StatedPoint& stated) {
        stated.replace(input, "value", inputs_.stated()[input].keys->with("value", value, document_, at, problems_));
    }

    void read_keys(std::size_t input, const std::string& at, StatedPoint& stated) {
        const JsonObject object(document_, at, keys_of<OverrideStatement>(), problems_);
        if (const json* readings = object.find("observations"); readings != nullptr && readings->is_array()) {
            stated.decimals[input] = std::max(document_.decimals_as_written(object.pointer("observations")),
                                              decimals_of_angles(*readings, unit_of(input))) +
                                     (readings->size() > 1 ? 1 : 0);
        } else if (const json* value = object.find("value"); value != nullptr && value->is_number()) {
            stated.decimals[input] = document_.decimals_as_written(object.pointer("value"));
        } else if (const auto angle = decimals_of_angle(value, unit_of(input))) {
            stated.decimals[input] = *angle;
        }
        const StatementKeys own(document_, at, keys_of<OverrideStatement>(), problems_);
        stated.statements.emplace(input, inputs_.stated()[input].keys->with(own));
        for (const std::string_view key : own.present()) {
            stated.replaced.emplace_back(input, key);
        }
    }

    [[nodiscard]] std::string unit_of(std::size_t input) const { return inputs_.stated()[input].unit.text(); }

    const JsonDocument& document_;
    const BudgetInputs& inputs_;
    const std::vector<gum::BudgetFit>& fits_;
    BudgetPoints& points_;
    ProblemList& problems_;
    std::map<std::string, AngleNotation> notations_;  ///< by the key
};

}  // namespace

void read_point_list(const json& list, const std::string& pointer, const JsonDocument& document,
                     const BudgetInputs& inputs, const std::vector<gum::BudgetFit>& fits, BudgetPoints& points,
                     ProblemList& problems) {
    if (list.empty() || list.size() > k_most_points) {
        problems.refuse(k_wrong_size, document.where(pointer), text::count_of(list.size(), "point"),
                        "a table has 1 to " + std::to_string(k_most_points) + " points", "correct the list");
        return;
    }
    PointList(document, inputs, fits, points, problems).read(list, pointer);
}

}  // namespace gumcert::jobs
