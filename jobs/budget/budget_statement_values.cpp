#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "gum/type_a.h"
#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_statement_reader.h"
#include "jobs/csv_table.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

// Statements whose estimate comes from values: observations, groups, samples, distributions and specifications.

namespace gumcert::jobs {

namespace {

using gum::Distribution;
using gum::DistributionKind;
using nlohmann::json;

}  // namespace

// ---- Type A -----------------------------------------------------------------------------------------------------

std::optional<gum::ObservationSummary> StatementReader::summary_of(std::string_view key,
                                                                   const std::vector<double>& readings) const {
    if (readings.size() == 1) {
        return gum::ObservationSummary{.observations = 1, .mean = readings.front()};
    }
    try {
        return gum::evaluate_type_a(readings);
    } catch (const gum::NoResultError& error) {
        for (const gum::Diagnostic& found : error.diagnostics()) {
            keys_.refuse(k_number_out_of_range, key, found.what, found.rule,
                         "state the values in a unit nearer to their size");
        }
        return std::nullopt;
    }
}

bool StatementReader::read_observations() {
    const auto written = numbers_in_list(keys_, "observations", unit_.text());
    const std::vector<double>* const observations = written ? &written->values : nullptr;
    std::optional<double> pooled_s;
    std::optional<double> nu;
    if (keys_.has("pooled")) {
        const auto pooled = keys_.object("pooled", keys_of<PooledStatement>());
        if (pooled) {
            pooled_s = pooled->required_number("s", above_zero(difference_text_));
            const StatementKeys inner(keys_.document("pooled"), keys_.pointer("pooled"), keys_of<PooledStatement>(),
                                      keys_.problems("pooled"));
            nu = pooled->require("nu") ? inner.degrees_of_freedom("nu") : std::nullopt;
        }
        if (!pooled_s || !nu) {
            return false;
        }
    }
    if (observations == nullptr || !count_fits("observations", observations->size(), pooled_s ? 1 : 2,
                                               pooled_s ? "with a pooled standard deviation, one observation will do"
                                                        : "a standard deviation needs at least 2 observations")) {
        return false;
    }
    const auto summary = summary_of("observations", *observations);
    if (!summary) {
        return false;
    }
    set_value(summary->mean);
    for (const double observation : *observations) {
        quantity_.observations.push_back(to_si(observation));
    }
    quantity_.observation_decimals = written->decimals;
    const double u = pooled_s ? gum::u_of_mean(*pooled_s, observations->size()) : summary->standard_deviation_of_mean;
    if (pooled_s) {
        quantity_.pooled_standard_deviation = difference_to_si(*pooled_s);
    }
    return set_type_a("observations", u, nu.value_or(static_cast<double>(observations->size()) - 1.0));
}

bool StatementReader::set_type_a(std::string_view key, double u, double nu) {
    if (u > 0.0) {
        quantity_.u = difference_to_si(u);
        quantity_.degrees_of_freedom = nu;
        quantity_.distribution = Distribution::student_t(quantity_.value, quantity_.u, nu);
        return true;
    }
    // The scatter of equal readings is below the step of the display, which is then the contribution
    //                                                                                (JCGM 100:2008, F.2.2.1)
    const std::string rule = "equal values say that the scatter is below the resolution, not that it is 0";
    if (context_.is_component || !context_.resolution.empty()) {
        if (context_.resolution.empty()) {
            keys_.warn(k_warn_equal_observations, key, "all values are equal: the component has u = 0", rule,
                       "make sure that another component holds the resolution");
        } else if (context_.resolution != "here") {
            keys_.warn(k_warn_equal_observations, key, "all values are equal: they have u = 0", rule,
                       "make sure that the resolution of " + text::in_quotes(context_.resolution) +
                           " is that of these readings");
        }
        quantity_.degrees_of_freedom = nu;
        quantity_.distribution = Distribution::constant(quantity_.value);
        return true;
    }
    keys_.refuse(k_no_uncertainty, key, "all values are equal: u would be 0", rule,
                 "state \"resolution\" beside them, in the input or its component");
    return false;
}

bool StatementReader::count_fits(std::string_view key, std::size_t count, std::size_t least,
                                 const std::string& rule) const {
    if (count < least) {
        keys_.refuse(k_too_few_values, key, std::to_string(count) + (count == 1 ? " value" : " values"), rule,
                     "add values, or state what is known of the quantity in another way");
        return false;
    }
    if (count > k_most_values) {
        keys_.refuse(k_too_many_quantities, key, text::count_of(count, "value"),
                     "at most " + std::to_string(k_most_values) + " values are read", "state fewer values");
        return false;
    }
    return true;
}

bool StatementReader::read_groups() {
    gum::GroupedReadings groups;
    const json* value = keys_.value("groups");
    const bool is_read = value != nullptr && (value->is_array() ? read_lists_of(groups) : read_summary_of(groups));
    if (!is_read || !count_fits("groups", groups.means.size(), 2, "an evaluation of groups needs at least 2 groups")) {
        return false;
    }
    const auto summary = summary_of("groups", groups.means);
    if (!summary) {
        return false;
    }
    set_value(summary->mean);
    for (std::vector<double>& group : groups.readings) {
        std::transform(group.begin(), group.end(), group.begin(), [&](double x) { return to_si(x); });
    }
    std::transform(groups.means.begin(), groups.means.end(), groups.means.begin(), [&](double x) { return to_si(x); });
    std::transform(groups.standard_deviations.begin(), groups.standard_deviations.end(),
                   groups.standard_deviations.begin(), [&](double s) { return difference_to_si(s); });
    quantity_.groups = std::move(groups);
    return set_type_a("groups", summary->standard_deviation_of_mean, summary->degrees_of_freedom);
}

bool StatementReader::read_lists_of(gum::GroupedReadings& groups) const {
    const json& lists = *keys_.value("groups");
    bool fits = true;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        const std::string pointer = child_pointer(keys_.pointer("groups"), i);
        const json& list = lists[i];
        std::vector<double> readings;
        for (std::size_t j = 0; list.is_array() && j < list.size(); ++j) {
            if (list[j].is_number()) {
                readings.push_back(list[j].get<double>());
            } else if (!list[j].is_discarded()) {
                keys_.problems("groups").refuse(k_wrong_type, keys_.document("groups").where(child_pointer(pointer, j)),
                                                described(list[j]), "must be a number",
                                                list[j].is_string()
                                                    ? advice_for_number(list[j].get_ref<const std::string&>())
                                                    : "correct the value");
                fits = false;
            } else {
                fits = false;
            }
        }
        if (!list.is_array() || (list.size() < 2)) {
            keys_.problems("groups").refuse(
                list.is_array() ? k_too_few_values : k_wrong_type, keys_.document("groups").where(pointer),
                list.is_array() ? text::count_of(list.size(), "reading") + " in a group" : described(list),
                "a group is an array of at least 2 readings",
                "for one reading a group, state the readings as \"observations\"");
            fits = false;
        }
        if (!fits || readings.empty()) {
            fits = false;
            continue;
        }
        const auto summary = summary_of("groups", readings);
        if (!summary) {
            return false;
        }
        groups.means.push_back(summary->mean);
        groups.standard_deviations.push_back(summary->standard_deviation);
        groups.sizes.push_back(readings.size());
        groups.readings.push_back(std::move(readings));
    }
    return fits;
}

bool StatementReader::read_summary_of(gum::GroupedReadings& groups) const {
    const auto object = keys_.object("groups", keys_of<GroupsStatement>());
    if (!object) {
        return false;
    }
    const StatementKeys inner(keys_.document("groups"), keys_.pointer("groups"), keys_of<GroupsStatement>(),
                              keys_.problems("groups"));
    bool has_all = true;
    for (const std::string_view key : keys_of<GroupsStatement>()) {
        has_all = object->require(key) && has_all;
    }
    const auto means = inner.numbers("means");
    const auto deviations = inner.numbers("standard_deviations");
    const auto sizes = inner.numbers("sizes");
    if (!has_all || !means || !deviations || !sizes) {
        return false;
    }
    if (means->size() != deviations->size() || means->size() != sizes->size()) {
        keys_.refuse(k_wrong_size, "groups",
                     text::count_of(means->size(), "mean") + ", " + std::to_string(deviations->size()) +
                         " standard deviations and " + text::count_of(sizes->size(), "size"),
                     "each group has one of each", "correct the arrays");
        return false;
    }
    for (std::size_t j = 0; j < means->size(); ++j) {
        const double size = (*sizes)[j];
        if (!(size >= 2.0 && size <= 1e9 && size == std::floor(size))) {
            inner.refuse(k_not_an_integer, "sizes",
                         text::shortest_plain(size) + " readings in group " + std::to_string(j + 1),
                         "a group has a whole number of readings, at least 2", "correct the array");
            return false;
        }
        if (!((*deviations)[j] >= 0.0)) {
            inner.refuse(k_number_out_of_range, "standard_deviations",
                         text::shortest_plain((*deviations)[j]) + " in group " + std::to_string(j + 1),
                         "a standard deviation must be at least 0", "correct the array");
            return false;
        }
        groups.sizes.push_back(static_cast<std::size_t>(size));
    }
    groups.means = *means;
    groups.standard_deviations = *deviations;
    return true;
}

// ---- distributions ----------------------------------------------------------------------------------------------

bool StatementReader::read_samples() {
    const json* value = keys_.value("samples");
    if (value == nullptr) {
        return false;
    }
    std::optional<std::vector<double>> samples;
    if (value->is_array()) {
        samples = keys_.numbers("samples");
    } else {
        samples = read_sample_file(*value);
    }
    if (!samples ||
        !count_fits("samples", samples->size(), k_least_samples,
                    "a distribution is not known from fewer than " + std::to_string(k_least_samples) +
                        " samples; readings are stated as \"observations\", which widens for their number")) {
        return false;
    }
    for (double& sample : *samples) {
        sample = to_si(sample);
    }
    if (!quantity_.sample_file.empty()) {
        quantity_.sample_rows = std::make_shared<const std::vector<double>>(*samples);
    }
    // u of n samples is known as well as that of n observations              (JCGM 100:2008, G.3.3: ν = n − 1)
    quantity_.degrees_of_freedom = static_cast<double>(samples->size()) - 1.0;
    std::sort(samples->begin(), samples->end());
    const auto summary = summary_of("samples", *samples);
    if (!summary) {
        return false;
    }
    quantity_.distribution = {.kind = DistributionKind::empirical,
                              .location = 0.0,
                              .scale = 1.0,
                              .samples = std::make_shared<const std::vector<double>>(std::move(*samples))};
    set_value_in_si(summary->mean);
    quantity_.u = gum::standard_deviation(quantity_.distribution);
    if (quantity_.u == 0.0) {
        keys_.refuse(k_no_uncertainty, "samples", "all samples are equal: u would be 0", "a distribution has a width",
                     "state \"constant\": true if the quantity has no uncertainty");
        return false;
    }
    return true;
}

void StatementReader::set_value_in_si(double value) {
    quantity_.value = value;
    quantity_.stated_value = context_.is_later_component ? unit_.difference_from_si(value) : unit_.from_si(value);
}

std::optional<std::vector<double>> StatementReader::read_sample_file(const json& value) {
    std::optional<std::string> name;
    std::string column{context_.input};
    if (value.is_string()) {
        name = keys_.name("samples");
        if (const auto objection = name ? JobFiles::file_name_objection(*name) : std::nullopt) {
            keys_.refuse(k_file_name, "samples", "the file name " + text::in_quotes(*name), *objection,
                         "put the file beside the job and give its name");
            return std::nullopt;
        }
    } else if (const auto object = keys_.object("samples", keys_of<SamplesStatement>())) {
        name = JobFiles::file_name(*object, "file", true);
        const auto stated = object->optional_name("column");
        if (object->has("column") && !stated) {
            return std::nullopt;
        }
        column = stated.value_or(column);
    }
    std::optional<JobFiles::File> file = name ? context_.files.open(*name) : std::nullopt;
    if (!file) {
        return std::nullopt;
    }
    // A file of samples often holds further quantities, which are no mistake.
    const std::vector<CsvHeaderField> header = csv_header(file->bytes);
    std::vector<std::string_view> others;
    for (const CsvHeaderField& field : header) {
        if (field.name != column) {
            others.push_back(field.name);
        }
    }
    const std::array<std::string_view, 1> required{column};
    const auto table = read_csv_table(std::move(file->bytes), required, others, *file->problems);
    if (!table) {
        return std::nullopt;
    }
    quantity_.sample_file = *name;
    std::vector<double> samples;
    for (std::size_t row = 0; row < table->rows(); ++row) {
        if (const auto sample = table->number(row, 0, {.unit = unit_text_})) {
            samples.push_back(*sample);
        }
    }
    return samples.size() == table->rows() && table->is_complete() ? std::optional{std::move(samples)} : std::nullopt;
}

bool StatementReader::read_distribution() {
    const std::string pointer = keys_.pointer("distribution");
    const JsonDocument& document = keys_.document("distribution");
    ProblemList& problems = keys_.problems("distribution");
    const json& object_value = *keys_.value("distribution");
    const auto kind = object_value.find("kind");
    std::vector<std::string_view> words;
    for (const DistributionForm& form : k_distribution_forms) {
        words.push_back(form.kind);
    }
    if (kind == object_value.end() || !kind->is_string()) {
        const bool is_absent = kind == object_value.end();
        problems.refuse(is_absent ? k_missing_key : k_wrong_type,
                        document.where(is_absent ? pointer : child_pointer(pointer, "kind")),
                        is_absent ? "the key \"kind\" is missing" : described(*kind), "must be " + text::any_of(words),
                        "state the kind of the distribution");
        return false;
    }
    const auto& word = kind->get_ref<const std::string&>();
    const auto form = std::find_if(k_distribution_forms.begin(), k_distribution_forms.end(),
                                   [&](const DistributionForm& known) { return known.kind == word; });
    if (form == k_distribution_forms.end()) {
        const std::optional<std::string_view> nearest = nearest_word(word, words);
        problems.refuse(k_unknown_choice, document.where(child_pointer(pointer, "kind")), text::in_quotes(word),
                        "must be " + text::any_of(words),
                        nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "choose one of them");
        return false;
    }
    std::vector<std::string_view> keys{"kind"};
    std::copy_if(form->keys.begin(), form->keys.end(), std::back_inserter(keys),
                 [](std::string_view key) { return !key.empty(); });
    const std::size_t problems_before = problems.refusals();
    const JsonObject object(document, pointer, keys, problems);
    for (std::size_t i = 0; i < form->required; ++i) {
        object.require(form->keys[i]);
    }
    quantity_.statement = "distribution";
    const auto bounded = std::find_if(k_bounded_words.begin(), k_bounded_words.end(),
                                      [&](const auto& known) { return known.first == word; });
    const bool is_read = bounded != k_bounded_words.end() ? read_bounded_form(object, bounded->second)
                                                          : read_positive_form(object, word);
    return is_read && problems.refusals() == problems_before;
}

bool StatementReader::read_bounded_form(const JsonObject& object, DistributionKind kind) {
    const NumberRange any{.unit = unit_text_};
    const auto lower = object.optional_number("lower", any);
    const auto upper = object.optional_number("upper", any);
    if (!lower || !upper) {
        return false;
    }
    if (!(*lower < *upper)) {
        object.refuse(k_empty_interval, "upper", "from " + any.with_unit(*lower) + " to " + any.with_unit(*upper),
                      "the lower limit must be less than the upper one", "correct the limits");
        return false;
    }
    const double half_width = 0.5 * *upper - 0.5 * *lower;
    set_value(0.5 * *lower + 0.5 * *upper);
    double shape = 0.0;
    if (kind == DistributionKind::trapezoidal) {
        const auto beta = object.optional_number("beta", between(0.0, 1.0, ""));
        if (!beta) {
            return false;
        }
        shape = *beta;
    } else if (kind == DistributionKind::curvilinear_trapezoid) {
        const auto d = object.optional_number("d", range_of_d(half_width));
        if (!d) {
            return false;
        }
        shape = *d / half_width;
    }
    set_bounded(kind, half_width, shape);
    return true;
}

bool StatementReader::read_positive_form(const JsonObject& object, std::string_view kind) {
    const NumberRange any{.unit = unit_text_};
    const NumberRange width = above_zero(difference_text_);
    const NumberRange positive = above_zero("");
    Distribution& d = quantity_.distribution;
    if (kind == "constant") {
        const auto value = object.optional_number("value", any);
        is_constant_ = true;
        set_value(value.value_or(0.0));
        d = Distribution::constant(quantity_.value);
        return value.has_value();
    }
    if (kind == "normal") {
        const auto mean = object.optional_number("mean", any);
        const auto sd = object.optional_number("sd", width);
        set_value(mean.value_or(0.0));
        quantity_.u = difference_to_si(sd.value_or(0.0));
        d = Distribution::normal(quantity_.value, quantity_.u);
        return mean && sd;
    }
    if (kind == "student_t" || kind == "t") {
        const auto location = object.optional_number("location", any);
        const auto scale = object.optional_number("scale", width);
        const StatementKeys inner(keys_.document("distribution"), keys_.pointer("distribution"),
                                  keys_of<DistributionStatement>(), keys_.problems("distribution"));
        const auto nu = inner.degrees_of_freedom("nu");
        set_value(location.value_or(0.0));
        // As for a Type A evaluation: the law of propagation takes the scale with ν, Monte Carlo the t itself, whose
        // standard deviation is larger.
        quantity_.u = difference_to_si(scale.value_or(0.0));
        quantity_.degrees_of_freedom = nu.value_or(k_infinity);
        d = Distribution::student_t(quantity_.value, quantity_.u, quantity_.degrees_of_freedom);
        return location && scale && nu;
    }
    bool is_read = false;
    if (kind == "gamma") {
        const auto shape = object.optional_number("shape", positive);
        const auto scale = object.optional_number("scale", width);
        const auto location = object.optional_number("location", any);
        d = {.kind = DistributionKind::gamma,
             .location = to_si(location.value_or(0.0)),
             .scale = difference_to_si(scale.value_or(0.0)),
             .shape = shape.value_or(1.0)};
        is_read = shape && scale;
    } else if (kind == "poisson_counts") {
        // The distribution of the mean of a Poisson variable after observing q counts: Ga(q + 1, 1) (JCGM 101:2008,
        // 6.4.11).
        const auto counts = object.optional_integer("counts", between(0.0, 9007199254740991.0, ""));
        d = {.kind = DistributionKind::gamma,
             .location = to_si(0.0),
             .scale = difference_to_si(1.0),
             .shape = static_cast<double>(counts.value_or(0)) + 1.0};
        is_read = counts.has_value();
    } else if (kind == "exponential") {
        const auto mean = object.optional_number("mean", width);
        d = {.kind = DistributionKind::exponential,
             .location = to_si(0.0),
             .scale = difference_to_si(mean.value_or(0.0))};
        is_read = mean.has_value();
    } else if (kind == "lognormal") {
        const auto mu = object.optional_number("mu", between(-300.0, 300.0, ""));
        const auto sigma = object.optional_number("sigma", {.low = 0.0, .high = 10.0, .low_open = true});
        d = {.kind = DistributionKind::lognormal,
             .location = to_si(0.0),
             .scale = difference_to_si(std::exp(mu.value_or(0.0))),
             .shape = sigma.value_or(1.0)};
        is_read = mu && sigma;
    } else if (kind == "beta") {
        const auto alpha = object.optional_number("alpha", positive);
        const auto beta = object.optional_number("beta", positive);
        const double lower = object.optional_number("lower", any).value_or(0.0);
        const double upper = object.optional_number("upper", any).value_or(1.0);
        if (!(lower < upper)) {
            object.refuse(k_empty_interval, "upper", "from " + any.with_unit(lower) + " to " + any.with_unit(upper),
                          "the lower limit must be less than the upper one", "correct the limits");
            return false;
        }
        d = {.kind = DistributionKind::beta,
             .location = to_si(lower),
             .scale = difference_to_si(upper - lower),
             .shape = alpha.value_or(1.0),
             .second_shape = beta.value_or(1.0)};
        is_read = alpha && beta;
    }
    set_value_in_si(gum::expectation(d));
    quantity_.u = gum::standard_deviation(d);
    return is_read;
}

bool StatementReader::read_specification() {
    const auto object = keys_.object("specification", keys_of<SpecificationStatement>());
    if (!object) {
        return false;
    }
    StatedSpecification& stated = specification_.emplace();
    ProblemList& problems = keys_.problems("specification");
    const std::size_t problems_before = problems.refusals();
    stated.percent_of_reading = object->optional_number("percent_of_reading", above_zero("%")).value_or(0.0);
    stated.percent_of_range = object->optional_number("percent_of_range", above_zero("%")).value_or(0.0);
    stated.range = object->optional_number("range", above_zero(difference_text_)).value_or(0.0);
    stated.floor = object->optional_number("floor", not_negative(difference_text_)).value_or(0.0);
    stated.of = object->optional_name("of");
    const bool has_value = read_value(object->has("of"));
    if (object->has("percent_of_range") != object->has("range")) {
        object->refuse(k_incomplete_statement, object->has("range") ? "range" : "percent_of_range",
                       "\"percent_of_range\" and \"range\" are not both given",
                       "a percentage of the range needs the range", "add the other one");
    }
    if (!object->has("percent_of_reading") && !object->has("percent_of_range") && !object->has("floor")) {
        object->refuse(k_incomplete_statement, "", "a specification without a part",
                       "a specification is a percentage of the reading, of the range, a floor, or a sum of them",
                       "add \"percent_of_reading\", \"percent_of_range\" with \"range\", or \"floor\"");
    }
    const auto nu = degrees_of_freedom();
    stated.degrees_of_freedom = nu.value_or(k_infinity);
    if (object->has("k") || object->has("p")) {
        if (object->has("distribution")) {
            object->refuse(k_two_statements, "distribution", "\"distribution\" beside \"k\" or \"p\"",
                           "a specification with a coverage factor is an expanded uncertainty", "keep one of them");
        }
        stated.coverage_factor = nu ? coverage_factor(*object, *nu, "specification") : std::nullopt;
    } else if (const auto word = object->optional_string("distribution")) {
        const auto known = std::find_if(k_plain_bounded_words.begin(), k_plain_bounded_words.end(),
                                        [&](const auto& one) { return one.first == *word; });
        if (known == k_plain_bounded_words.end()) {
            object->refuse(
                k_distribution_does_not_fit, "distribution", text::in_quotes(*word) + " beside \"specification\"",
                "must be " + text::any_of(words_of(k_plain_bounded_words)),
                *word == "normal" ? "state the \"k\" or the \"p\" of the specification" : "choose one of them");
        } else {
            stated.kind = known->second;
        }
    }
    if (nu && !stated.coverage_factor && problems.refusals() == problems_before && !limits_may_have(stated.kind, *nu)) {
        return false;
    }
    quantity_.degrees_of_freedom = stated.degrees_of_freedom;
    return has_value && nu && problems.refusals() == problems_before;
}

}  // namespace gumcert::jobs
