#include "reports/record/make/reported_choice.h"

#include <optional>
#include <string>

#include "reports/record/reported_result.h"
#include "reports/record/stated_values.h"

namespace gumcert::reports {

namespace {

using gum::CoverageChoice;
using reports::MonteCarloSummary;
using reports::ReportedResult;

/// What the law of propagation states of a quantity.
struct Law {
    double value = 0.0, u = 0.0;
    std::optional<double> U, k;
    std::string unit;
};

bool is_contradicted(const MonteCarloSummary& trials) {
    return trials.validation && trials.validation->precise_enough && !trials.validation->validated;
}

/// Nothing where the law of propagation is reported and nothing speaks against it.
std::optional<ReportedResult> reported_of(const Law& law, const std::optional<MonteCarloSummary>& trials,
                                          CoverageChoice choice, double coverage_probability) {
    if (!trials || !law.U || law.u == 0.0) {
        return std::nullopt;
    }
    const bool contradicted = is_contradicted(*trials);
    ReportedResult reported;
    if (choice == CoverageChoice::monte_carlo || (choice == CoverageChoice::as_validated && contradicted)) {
        reported = reports::monte_carlo_result(trials->mean.number.value_or(law.value), trials->u.number,
                                               trials->symmetric.number, coverage_probability,
                                               choice == CoverageChoice::monte_carlo ? "asked" : "contradicted");
    } else if (contradicted) {
        reported = reports::law_of_propagation_result(law.value, law.u, law.U, law.k, coverage_probability);
        reported.against = "contradicted";
    } else {
        return std::nullopt;
    }
    reports::print_reported(reported, law.unit);
    return reported;
}

class Reporter {
public:
    Reporter(CoverageChoice choice, double coverage_probability) : choice_(choice), p_(coverage_probability) {}

    void report(reports::StatedValue& q, const std::string& unit) const {
        q.reported = reported_of({q.value, q.u, q.U, q.k, unit}, q.monte_carlo, choice_, p_);
        if (q.reported) {
            q.printed = q.reported->printed;
        }
    }

    void report(reports::Result& result) const {
        if (const auto reported = reported_of({result.value, result.u, result.U, result.k, result.unit},
                                              result.monte_carlo, choice_, p_)) {
            result.reported = *reported;
        }
    }

private:
    CoverageChoice choice_;
    double p_;
};

}  // namespace

void print_set_up(reports::RotaryTable& rotary, const reports::Result& result) {
    const std::string& name = result.name;
    if (name.size() != 3 || name[1] != '_' || name[2] < 'x' || name[2] > 'z') {
        return;
    }
    const auto coordinate = static_cast<std::size_t>(name[2] - 'x');
    for (reports::SetUp* side : {&rotary.set_up, &rotary.axis_in_fixture}) {
        reports::Printed& printed = (name[0] == 'O' ? side->printed_O : side->printed_S)[coordinate];
        const std::string& value = result.reported.printed.value;
        printed.value = side == &rotary.set_up ? value : reports::negated(value);
        printed.U = result.reported.printed.U;
    }
}

void report_result(reports::Result& result, CoverageChoice choice) {
    Reporter(choice, result.coverage_probability).report(result);
}

void report_rotary_results(reports::EvaluationRecord& record, CoverageChoice choice) {
    reports::RotaryTable& rotary = *record.rotary;
    const Reporter reporter(choice, record.coverage_probability.number);
    for (const auto& place : reports::stated_values(rotary)) {
        reporter.report(place.stated, place.unit);
    }
    for (reports::Result& result : record.results) {
        reporter.report(result);
        if (result.reported.method == "monte_carlo") {
            print_set_up(rotary, result);
        }
    }
}

}  // namespace gumcert::reports
