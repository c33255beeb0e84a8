#include "jobs/budget/budget_statement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_statement_reader.h"
#include "jobs/job_limits.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::Distribution;
using gum::DistributionKind;
using nlohmann::json;

constexpr std::array<std::string_view, 14> k_column_keys{"value",      "u",           "U",          "k",         "p",
                                                         "nu",         "reliability", "half_width", "beta",      "d",
                                                         "resolution", "mpe",         "relative_u", "relative_U"};

// ---- rows of the table of statements --------------------------------------------------------------------------------

constexpr std::array<StatementRowKeys, 15> k_rows{
    {{StatementRow::constant, "constant", {"value", "u"}},
     {StatementRow::standard_uncertainty, "u", {"value", "nu", "reliability", "distribution"}},
     {StatementRow::expanded_uncertainty, "U", {"value", "k", "p", "nu", "reliability", "distribution"}},
     {StatementRow::half_width, "half_width", {"value", "distribution", "beta", "d", "nu", "reliability"}},
     {StatementRow::limits, "limits", {"distribution", "beta", "d", "nu", "reliability"}},
     {StatementRow::resolution, "resolution", {"value", "distribution", "nu", "reliability"}},
     {StatementRow::maximum_permissible_error, "mpe", {"value", "distribution", "nu", "reliability"}},
     {StatementRow::observations, "observations", {"pooled"}},
     {StatementRow::groups, "groups", {}},
     {StatementRow::samples, "samples", {}},
     {StatementRow::distribution, "distribution", {}},
     {StatementRow::relative_standard_uncertainty, "relative_u", {"value", "nu", "reliability", "distribution"}},
     {StatementRow::relative_expanded_uncertainty,
      "relative_U",
      {"value", "k", "p", "nu", "reliability", "distribution"}},
     {StatementRow::specification, "specification", {"value", "nu", "reliability"}},
     // No key of its own: the variance stands in the covariance matrix of the job.
     {StatementRow::covariance, "", {"value", "nu", "reliability"}}}};

constexpr std::array<std::string_view, 5> k_everywhere{"type", "source", "significance", "note", "name"};

const StatementRowKeys& keys_of_row(StatementRow row) {
    return *std::find_if(k_rows.begin(), k_rows.end(), [&](const StatementRowKeys& known) { return known.row == row; });
}

std::string list_of(const std::vector<std::string_view>& keys, std::string_view last_word) {
    std::string text;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        text += i == 0 ? "" : i + 1 == keys.size() ? " " + std::string{last_word} + " " : ", ";
        text += text::in_quotes(keys[i]);
    }
    return text;
}

constexpr double k_least_nu_of_limits = 0.5;  // a reliability of 1: limits that are off by all of the half-width

}  // namespace

std::optional<EvaluatedStatement> StatementReader::evaluate() {
    quantity_.where = keys_.where();
    const std::optional<StatementRow> row = find_row();
    if (!row) {
        read_remarks(StatementRow::constant);
        return std::nullopt;
    }
    const bool remarks_read = read_remarks(*row);
    const bool belongs = refuse_strangers(*row);
    if (!read(*row) || !belongs || !remarks_read || (!specification_ && !is_representable(*row))) {
        return std::nullopt;
    }
    return EvaluatedStatement{std::move(quantity_), is_constant_, std::move(specification_)};
}

// ---- which statement it is --------------------------------------------------------------------------------------

bool StatementReader::leads(const StatementRowKeys& row) const {
    if (row.key.empty() || !keys_.has(row.key)) {
        return false;
    }
    const json* value = keys_.value(row.key);
    switch (row.row) {
        case StatementRow::constant:
            return value != nullptr && !(value->is_boolean() && !value->get<bool>());
        case StatementRow::distribution:
            return value != nullptr && value->is_object();
        case StatementRow::standard_uncertainty:
            // "u": 0 beside "constant": true says the same twice.
            return !(value != nullptr && value->is_number() && value->get<double>() == 0.0 && says_constant());
        default:
            return true;
    }
}

bool StatementReader::says_constant() const {
    const json* value = keys_.value("constant");
    return value != nullptr && value->is_boolean() && value->get<bool>();
}

std::optional<StatementRow> StatementReader::find_row() {
    std::vector<std::string_view> leading;
    std::optional<StatementRow> row;
    for (const StatementRowKeys& known : k_rows) {
        if (leads(known)) {
            leading.push_back(known.key);
            row = known.row;
        }
    }
    if (leading.size() > 1) {
        keys_.refuse(k_two_statements, leading[1], list_of(leading, "and") + " are given together",
                     "exactly one statement says what is known of a quantity",
                     context_.is_component
                         ? "keep one of them, and make the other a component of its own"
                         : "keep one of them; contributions that add up are listed under \"components\"");
        return std::nullopt;
    }
    if (row) {
        return row;
    }
    if (context_.variance) {
        return StatementRow::covariance;
    }
    std::vector<std::string_view> given = keys_.present();
    std::erase_if(given, [](std::string_view key) {
        return std::find(k_everywhere.begin(), k_everywhere.end(), key) != k_everywhere.end() || key == "unit" ||
               key == "description" || key == "between_points";
    });
    keys_.refuse(k_no_statement,
                 given.empty() ? "nothing is stated of it" : "only " + list_of(given, "and") + " is given",
                 "a quantity has exactly one statement of what is known of it: u, U with k or p, half_width, limits, "
                 "resolution, mpe, observations, groups, samples, distribution, relative_u, relative_U, "
                 "specification",
                 "state its uncertainty, or \"constant\": true if it has none");
    return std::nullopt;
}

bool StatementReader::refuse_strangers(StatementRow row) const {
    const StatementRowKeys& known = keys_of_row(row);
    bool belongs = true;
    for (const std::string_view key : keys_.present()) {
        const bool is_known = key == known.key || key == "unit" || key == "description" || key == "between_points" ||
                              key == "components" ||
                              std::find(known.others.begin(), known.others.end(), key) != known.others.end() ||
                              std::find(k_everywhere.begin(), k_everywhere.end(), key) != k_everywhere.end();
        // "constant": false is what everything but a constant is.
        const json* value = keys_.value(key);
        if (is_known || (key == "constant" && value != nullptr && value->is_boolean() && !value->get<bool>())) {
            continue;
        }
        belongs = false;
        std::vector<std::string_view> others(known.others.begin(), known.others.end());
        std::erase(others, std::string_view{});
        const std::string leading = known.key.empty() ? "from \"covariance\"" : "by " + text::in_quotes(known.key);
        keys_.refuse(k_two_statements, key, text::in_quotes(key) + " does not belong to a statement " + leading,
                     others.empty() ? "it stands alone" : "it goes with " + list_of(others, "and"),
                     key == "value" ? "remove it: the statement gives the value" : "remove it");
    }
    return belongs;
}

// ---- what stands beside every statement -------------------------------------------------------------------------

bool StatementReader::read_remarks(StatementRow row) {
    const auto source = keys_.name("source");
    const auto significance = keys_.text("significance");
    const auto note = keys_.text("note");
    const auto type = keys_.text("type");
    quantity_.source = source.value_or("");
    quantity_.significance = significance.value_or("");
    quantity_.note = note.value_or("");
    const bool is_type_a = row == StatementRow::observations || row == StatementRow::groups;
    quantity_.evaluation = is_type_a ? gum::Evaluation::type_a : gum::Evaluation::type_b;
    bool type_fits = type.has_value() || !keys_.has("type");
    if (type && *type != "A" && *type != "B") {
        keys_.refuse(k_unknown_choice, "type", text::in_quotes(*type), "must be A or B",
                     "state A for a statistical evaluation of observations, B for any other");
        type_fits = false;
    } else if (type && is_type_a && *type == "B") {
        keys_.refuse(k_two_statements, "type", "type is \"B\" beside observations",
                     "an evaluation of observations by statistics is of Type A (JCGM 100:2008, 2.3.2)",
                     "remove \"type\"");
        type_fits = false;
    } else if (type) {
        quantity_.evaluation = *type == "A" ? gum::Evaluation::type_a : gum::Evaluation::type_b;
    }
    return type_fits && (source || !keys_.has("source")) && (significance || !keys_.has("significance")) &&
           (note || !keys_.has("note"));
}

std::optional<double> StatementReader::degrees_of_freedom() {
    if (keys_.has("nu") && keys_.has("reliability")) {
        keys_.refuse(k_two_statements, "reliability", "\"nu\" and \"reliability\" are given together",
                     "one of them says how well u is known: nu = 1/(2 r²)", "keep one of them");
        return std::nullopt;
    }
    if (keys_.has("nu")) {
        return keys_.degrees_of_freedom("nu");
    }
    if (keys_.has("reliability")) {
        NumberRange range{.low = 0.0, .high = 1.0, .low_open = true};
        range.hint = "state the relative uncertainty of u as a ratio: 25 % is 0.25";
        const auto r = keys_.number("reliability", range);
        // ν = 1/2 (Δu/u)⁻²                                                        (JCGM 100:2008, G.4.2, eq. G.3)
        return r ? std::optional{1.0 / (2.0 * *r * *r)} : std::nullopt;
    }
    return k_infinity;
}

// ---- values -----------------------------------------------------------------------------------------------------

double StatementReader::to_si(double value) const {
    return context_.is_later_component ? unit_.difference_to_si(value) : unit_.to_si(value);
}

void StatementReader::set_value(double value) {
    quantity_.stated_value = value;
    quantity_.value = to_si(value);
}

bool StatementReader::read_value(bool may_be_absent) {
    if (!keys_.has("value")) {
        if (!context_.is_component && !may_be_absent) {
            keys_.refuse(k_incomplete_statement, "\"value\" is missing",
                         "the statement needs the estimate of the quantity", "add \"value\"");
            return false;
        }
        set_value(0.0);
        return true;
    }
    if (const json* stated = keys_.value("value"); stated != nullptr && is_angle_text(*stated)) {
        const auto angle = angle_number(stated->get_ref<const std::string&>(), unit_.text(), keys_.where("value"),
                                        keys_.problems("value"));
        set_value(angle ? angle->value : 0.0);
        return angle.has_value();
    }
    const auto value = keys_.number("value", {.unit = unit_text_});
    set_value(value.value_or(0.0));
    return value.has_value();
}

NumberRange StatementReader::uncertainty_range() const {
    NumberRange range = above_zero(difference_text_);
    range.hint = "state the uncertainty, or \"constant\": true without it for a quantity that has none";
    return range;
}

bool StatementReader::is_representable(StatementRow row) const {
    const double u = quantity_.u;
    const bool u_fits = row == StatementRow::constant || is_constant_ || (u >= k_least_u && u <= k_largest_u) ||
                        (u == 0.0 && quantity_.distribution.kind == DistributionKind::constant);
    if (u_fits && std::isfinite(quantity_.value) && std::isfinite(quantity_.distribution.location) &&
        std::isfinite(quantity_.distribution.scale)) {
        return true;
    }
    keys_.refuse(k_not_representable,
                 "the value is " + text::shortest_plain(quantity_.value) + " and u is " + text::shortest_plain(u) +
                     " in coherent SI units",
                 "values must be finite, and uncertainties from 1e-140 to 1e140 in coherent SI units",
                 "check the numbers and the unit");
    return false;
}

// ---- rows -------------------------------------------------------------------------------------------------------

bool StatementReader::read(StatementRow row) {
    quantity_.statement = std::string{keys_of_row(row).key};
    switch (row) {
        case StatementRow::constant:
            return read_constant();
        case StatementRow::standard_uncertainty:
            return read_standard_uncertainty(false);
        case StatementRow::expanded_uncertainty:
            return read_expanded_uncertainty(false);
        case StatementRow::half_width:
            return read_half_width("half_width", 1.0);
        case StatementRow::limits:
            return read_limits();
        case StatementRow::resolution:
            return read_half_width("resolution", 0.5);
        case StatementRow::maximum_permissible_error:
            return read_half_width("mpe", 1.0);
        case StatementRow::observations:
            return read_observations();
        case StatementRow::groups:
            return read_groups();
        case StatementRow::samples:
            return read_samples();
        case StatementRow::distribution:
            return read_distribution();
        case StatementRow::relative_standard_uncertainty:
            return read_standard_uncertainty(true);
        case StatementRow::relative_expanded_uncertainty:
            return read_expanded_uncertainty(true);
        case StatementRow::specification:
            return read_specification();
        case StatementRow::covariance:
            return read_from_covariance();
    }
    return false;
}

bool StatementReader::read_constant() {
    is_constant_ = true;
    const bool flag = keys_.boolean("constant").has_value();
    const bool value = read_value();
    quantity_.distribution = Distribution::constant(quantity_.value);
    return flag && value;
}

bool StatementReader::set_standard_uncertainty(double u, double nu) {
    quantity_.u = difference_to_si(u);
    quantity_.degrees_of_freedom = nu;
    quantity_.distribution = Distribution::student_t(quantity_.value, quantity_.u, nu);
    if (!keys_.has("distribution")) {
        return true;
    }
    const auto word = keys_.text("distribution");
    const bool is_normal = word && *word == "normal";
    const bool is_t = word && (*word == "student_t" || *word == "t");
    if (!word || (is_normal && std::isinf(nu)) || (is_t && std::isfinite(nu))) {
        return word.has_value();
    }
    keys_.refuse(k_distribution_does_not_fit, "distribution",
                 text::in_quotes(*word) + " beside " + text::in_quotes(quantity_.statement),
                 "a standard or expanded uncertainty stands for the normal distribution, with \"nu\" for the scaled "
                 "and shifted t",
                 is_normal || is_t ? "remove \"distribution\"; \"nu\" decides"
                                   : "state \"half_width\" or \"limits\" with this distribution");
    return false;
}

std::optional<double> StatementReader::reference_of_relative(std::string_view key) {
    if (unit_.is_celsius_temperature() || unit_.to_si(0.0) != 0.0) {
        keys_.refuse(k_no_relative_uncertainty, key,
                     text::in_quotes(key) + " of a quantity in " + text::visible(unit_.text()),
                     "a scale with an origin of its own has no relative uncertainty",
                     "state \"u\" or \"U\" in " + text::visible(difference_text_));
        return std::nullopt;
    }
    if (quantity_.value == 0.0) {
        keys_.refuse(k_no_uncertainty, key, text::in_quotes(key) + " of the value 0",
                     "a relative uncertainty needs a value other than 0",
                     "state \"u\" or \"U\" in the unit of the quantity");
        return std::nullopt;
    }
    return std::abs(quantity_.stated_value);
}

NumberRange StatementReader::relative_range() {
    return {.low = 0.0, .high = 1.0, .low_open = true, .hint = "state it as a ratio: 0.5 % is 0.005"};
}

bool StatementReader::read_standard_uncertainty(bool is_relative) {
    const std::string_view key = is_relative ? "relative_u" : "u";
    const bool has_value = read_value();
    const auto u = keys_.number(key, is_relative ? relative_range() : uncertainty_range());
    const auto nu = degrees_of_freedom();
    if (!has_value || !u || !nu) {
        return false;
    }
    const auto reference = is_relative ? reference_of_relative(key) : std::optional{1.0};
    return reference && set_standard_uncertainty(*u * *reference, *nu);
}

std::optional<double> StatementReader::number_of(const StatementKeys& keys, std::string_view key,
                                                 const NumberRange& range) {
    return keys.number(key, range);
}

std::optional<double> StatementReader::number_of(const JsonObject& object, std::string_view key,
                                                 const NumberRange& range) {
    return object.optional_number(key, range);
}

void StatementReader::warn_of_unusual_coverage_factor(double k, double nu, std::string_view place) const {
    if (is_unusual_coverage_factor(k, nu)) {
        keys_.warn(k_warn_unusual_coverage_factor, place, "a coverage factor of " + text::shortest_plain(k),
                   "U = k u with k about 2 for a coverage probability of 95 %",
                   "check that it is the coverage factor, and neither the coverage probability (\"p\") nor U");
    }
}

bool StatementReader::read_expanded_uncertainty(bool is_relative) {
    const std::string_view key = is_relative ? "relative_U" : "U";
    const bool has_value = read_value();
    const auto expanded = keys_.number(key, is_relative ? relative_range() : uncertainty_range());
    const auto nu = degrees_of_freedom();
    const auto k = nu ? coverage_factor(keys_, *nu, "k") : std::nullopt;
    quantity_.statement += keys_.has("p") ? ", p" : ", k";
    if (!has_value || !expanded || !nu || !k) {
        return false;
    }
    const double factor = k.value_or(1.0);
    const auto reference = is_relative ? reference_of_relative(key) : std::optional{1.0};
    return reference && set_standard_uncertainty(*expanded * *reference / factor, *nu);
}

bool StatementReader::read_from_covariance() {
    quantity_.statement = "covariance";
    const bool has_value = read_value();
    const auto nu = degrees_of_freedom();
    return has_value && nu && set_standard_uncertainty(std::sqrt(*context_.variance), *nu);
}

bool StatementReader::set_bounded(double half_width) {
    const auto nu = degrees_of_freedom();
    if (!nu) {
        return false;
    }
    DistributionKind kind = DistributionKind::uniform;
    double shape = 0.0;
    if (keys_.has("distribution")) {
        const auto word = keys_.text("distribution");
        const auto known = std::find_if(k_bounded_words.begin(), k_bounded_words.end(),
                                        [&](const auto& one) { return word && one.first == *word; });
        const bool is_plain = quantity_.statement == "resolution" || quantity_.statement == "mpe";
        if (!word) {
            return false;
        }
        if (known == k_bounded_words.end() || (is_plain && known->second != DistributionKind::uniform)) {
            refuse_bounded_word(*word, is_plain);
            return false;
        }
        kind = known->second;
    }
    if (keys_.has("beta") != (kind == DistributionKind::trapezoidal) ||
        keys_.has("d") != (kind == DistributionKind::curvilinear_trapezoid)) {
        refuse_shape_keys(kind);
        return false;
    }
    if (kind == DistributionKind::trapezoidal) {
        NumberRange range = between(0.0, 1.0, "");
        range.hint = "beta is the width of the top over the width of the base";
        const auto beta = keys_.number("beta", range);
        if (!beta) {
            return false;
        }
        shape = *beta;
    } else if (kind == DistributionKind::curvilinear_trapezoid) {
        const auto d = keys_.number("d", range_of_d(half_width));
        if (!d) {
            return false;
        }
        shape = *d / half_width;
    }
    if (!limits_may_have(kind, *nu)) {
        return false;
    }
    set_bounded(kind, half_width, shape);
    quantity_.degrees_of_freedom = *nu;
    make_limits_inexact(quantity_, *nu);
    return true;
}

bool StatementReader::limits_may_have(DistributionKind kind, double nu) const {
    if (std::isinf(nu)) {
        return true;
    }
    const std::string_view key = keys_.has("nu") ? "nu" : "reliability";
    if (kind != DistributionKind::uniform) {
        const bool has_d = kind == DistributionKind::curvilinear_trapezoid;
        keys_.refuse(k_two_statements, key,
                     text::in_quotes(key) + " beside the distribution " + std::string(gum::distribution_name(kind)),
                     has_d ? "\"d\" says already how well the limits are known"
                           : "how well limits are known can be taken into account for rectangular ones: they become "
                             "those of a curvilinear trapezoid",
                     has_d ? "remove it"
                           : "remove it, or state the distribution curvilinear_trapezoid with \"d\" = reliability x "
                             "half-width");
        return false;
    }
    if (nu < k_least_nu_of_limits) {
        keys_.refuse(k_number_out_of_range, key, text::shortest_plain(nu) + " degrees of freedom of a half-width",
                     "limits that are uncertain by more than the half-width (nu below 0.5) are no limits",
                     "state \"u\" with \"nu\" instead");
        return false;
    }
    return true;
}

void StatementReader::make_limits_inexact(gum::StatedQuantity& quantity, double nu) {
    if (std::isinf(nu) || quantity.distribution.kind != DistributionKind::uniform) {
        return;
    }
    quantity.distribution.kind = DistributionKind::curvilinear_trapezoid;
    quantity.distribution.shape = std::min(1.0, std::sqrt(1.0 / (2.0 * nu)));
}

NumberRange StatementReader::range_of_d(double half_width) const {
    return {.low = 0.0,
            .high = half_width,
            .low_open = true,
            .unit = difference_text_,
            .hint = "d is how far the limits themselves may be off; at most the half-width"};
}

void StatementReader::set_bounded(DistributionKind kind, double half_width, double shape) {
    quantity_.distribution = {
        .kind = kind, .location = quantity_.value, .scale = difference_to_si(half_width), .shape = shape};
    quantity_.u = gum::standard_deviation(quantity_.distribution);
}

void StatementReader::refuse_bounded_word(const std::string& word, bool is_plain) const {
    std::vector<std::string_view> words = words_of(k_bounded_words);
    if (is_plain) {
        words.resize(1);
    }
    const bool is_normal = word == "normal" || word == "gaussian" || word == "student_t" || word == "t";
    const std::optional<std::string_view> nearest = nearest_word(word, words);
    keys_.refuse(k_distribution_does_not_fit, "distribution",
                 text::in_quotes(word) + " beside " + text::in_quotes(quantity_.statement),
                 "must be " + text::any_of(words),
                 is_normal  ? "a normal distribution has no limits: state \"u\", or \"U\" with \"k\" or \"p\""
                 : is_plain ? "state \"half_width\" with this distribution"
                 : nearest  ? "did you mean \"" + std::string{*nearest} + "\"?"
                            : "choose one of them");
}

void StatementReader::refuse_shape_keys(DistributionKind kind) const {
    const bool needs_beta = kind == DistributionKind::trapezoidal;
    const bool needs_d = kind == DistributionKind::curvilinear_trapezoid;
    const std::string name{gum::distribution_name(kind)};
    if ((needs_beta && !keys_.has("beta")) || (needs_d && !keys_.has("d"))) {
        keys_.refuse(k_incomplete_statement, "distribution",
                     "a " + name + " distribution without " + (needs_beta ? "\"beta\"" : "\"d\""),
                     needs_beta ? "beta is the width of the top over the width of the base"
                                : "d is how far the limits themselves may be off",
                     "add it");
        return;
    }
    const std::string_view extra = keys_.has("beta") && !needs_beta ? "beta" : "d";
    keys_.refuse(k_two_statements, extra, text::in_quotes(extra) + " beside the distribution " + name,
                 extra == "beta" ? "beta belongs to the trapezoidal distribution"
                                 : "d belongs to the curvilinear_trapezoid distribution",
                 "remove it, or state the distribution");
}

bool StatementReader::read_half_width(std::string_view key, double factor) {
    const bool has_value = read_value();
    const auto width = keys_.number(key, uncertainty_range());
    return has_value && width && set_bounded(*width * factor);
}

bool StatementReader::read_limits() {
    const auto limits = numbers_in_list(keys_, "limits", unit_.text());
    if (!limits) {
        return false;
    }
    if (limits->values.size() != 2) {
        keys_.refuse(k_wrong_size, "limits", "an array of " + std::to_string(limits->values.size()) + " elements",
                     "must have 2 numbers", "state the lower and the upper limit");
        return false;
    }
    const double a = limits->values[0];
    const double b = limits->values[1];
    if (!(a < b)) {
        refuse_interval("limits", a, b);
        return false;
    }
    set_value(0.5 * a + 0.5 * b);
    return set_bounded(0.5 * b - 0.5 * a);
}

void StatementReader::refuse_interval(std::string_view key, double a, double b) const {
    const NumberRange range{.unit = unit_text_};
    keys_.refuse(k_empty_interval, key, "from " + range.with_unit(a) + " to " + range.with_unit(b),
                 "the lower limit must be less than the upper one", "correct the limits, lower one first");
}

std::span<const std::string_view> budget_column_keys() {
    return k_column_keys;
}

std::optional<EvaluatedStatement> evaluate_statement(const StatementKeys& keys, const StatementContext& context) {
    return StatementReader(keys, context).evaluate();
}

bool specify(gum::StatedQuantity& quantity, const StatedSpecification& specification, double reading,
             const gum::Unit& unit, const StatementKeys& keys) {
    const double width = std::abs(reading) * specification.percent_of_reading / 100.0 +
                         specification.range * specification.percent_of_range / 100.0 + specification.floor;
    const double width_si = unit.difference_to_si(width);
    if (specification.percent_of_range > 0.0 && std::abs(reading) > specification.range) {
        keys.warn(k_warn_beyond_range, "specification",
                  "the reading " + text::shortest_plain(reading) + " is beyond the range " +
                      text::shortest_plain(specification.range),
                  "a specification holds within its range",
                  "state the range that was set, or the specification for this reading");
    }
    if (!(width_si > StatementReader::k_least_u && width_si < StatementReader::k_largest_u)) {
        keys.refuse(width_si == 0.0 ? k_no_uncertainty : k_not_representable, "specification",
                    "the specification gives " + text::shortest_plain(width) + " for the reading " +
                        text::shortest_plain(reading),
                    "an uncertainty must be greater than 0", "add \"floor\", or check the reading");
        return false;
    }
    if (specification.coverage_factor) {
        quantity.u = width_si / *specification.coverage_factor;
        quantity.distribution = Distribution::student_t(quantity.value, quantity.u, specification.degrees_of_freedom);
    } else {
        quantity.distribution = {.kind = specification.kind, .location = quantity.value, .scale = width_si};
        quantity.u = gum::standard_deviation(quantity.distribution);
        StatementReader::make_limits_inexact(quantity, specification.degrees_of_freedom);
    }
    if (!std::isfinite(quantity.value) ||
        !(quantity.u > StatementReader::k_least_u && quantity.u < StatementReader::k_largest_u)) {
        keys.refuse(k_not_representable, "specification",
                    "the value is " + text::shortest_plain(quantity.value) + " and u is " +
                        text::shortest_plain(quantity.u) + " in coherent SI units",
                    "values must be finite, and uncertainties from 1e-140 to 1e140 in coherent SI units",
                    "check the numbers and the unit");
        return false;
    }
    return true;
}

}  // namespace gumcert::jobs
