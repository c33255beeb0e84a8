#include "gum/budget/stated_quantity.h"

#include <utility>

#include "gum/argument_check.h"
#include "gum/type_a.h"

namespace gumcert::gum {

StatedQuantity state_uncertainty(double value, double u, double degrees_of_freedom) {
    require_finite(value, "value");
    require_positive(u, "standard uncertainty");
    require_degrees_of_freedom(degrees_of_freedom, "degrees of freedom");
    StatedQuantity stated;
    stated.statement = "u";
    stated.value = value;
    stated.u = u;
    stated.degrees_of_freedom = degrees_of_freedom;
    // Scale u and ν say what repeated readings tell of the quantity (JCGM 101:2008, 6.4.9): for finite ν the trials
    // scatter by more than u. With ν infinite it is the normal distribution.
    stated.distribution = Distribution::student_t(value, u, degrees_of_freedom);
    return stated;
}

StatedQuantity state_distribution(Distribution distribution) {
    StatedQuantity stated;
    stated.statement = "distribution";
    stated.value = expectation(distribution);
    // u is worked out and not asked for: two statements could contradict each other.
    stated.u = standard_deviation(distribution);
    require_finite(stated.value, "expectation");
    require_positive(stated.u, "standard deviation");
    stated.distribution = std::move(distribution);
    return stated;
}

StatedQuantity state_observations(std::vector<double> observations) {
    const ObservationSummary summary = evaluate_type_a(observations);
    StatedQuantity stated =
        state_uncertainty(summary.mean, summary.standard_deviation_of_mean, summary.degrees_of_freedom);
    stated.evaluation = Evaluation::type_a;
    stated.statement = "observations";
    stated.observations = std::move(observations);
    return stated;
}

StatedQuantity with_scaled_uncertainty(StatedQuantity quantity, double factor) {
    if (factor == 0.0) {
        quantity.distribution = Distribution::constant(quantity.value);
    } else {
        Distribution& distribution = quantity.distribution;
        // About the estimate, which need not be the location of the distribution (of one that is not symmetric, say):
        // the estimate must not move.
        distribution.location = quantity.value + factor * (distribution.location - quantity.value);
        distribution.scale *= factor;
    }
    quantity.u *= factor;
    if (quantity.sample_rows) {
        std::vector<double> rows = *quantity.sample_rows;
        for (double& value : rows) {
            value = quantity.value + factor * (value - quantity.value);
        }
        quantity.sample_rows = std::make_shared<const std::vector<double>>(std::move(rows));
    }
    return quantity;
}

StatedQuantity state_constant(double value) {
    require_finite(value, "value");
    StatedQuantity stated;
    stated.statement = "constant";
    stated.value = value;
    stated.distribution = Distribution::constant(value);
    return stated;
}

}  // namespace gumcert::gum
