#include "reports/record/make/reported_choice.h"

#include <optional>
#include <string>

#include "reports/record/reported_result.h"

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
        reported = reports::monte_carlo_result(trials->mean.value_or(law.value), trials->u, trials->symmetric,
                                               coverage_probability,
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

    template <class Quantity>
    void report(Quantity& quantity, const std::string& unit, const std::optional<double>& k) const {
        quantity.reported =
            reported_of({quantity.value, quantity.u, quantity.U, k, unit}, quantity.monte_carlo, choice_, p_);
        print(quantity.reported, quantity.printed);
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

    static void print(const std::optional<ReportedResult>& reported, reports::Printed& printed) {
        if (reported) {
            printed = reported->printed;
        }
    }
};

/// The set-up as people read it, of the results of the record: "O_y" is coordinate 1 of the offsets.
void print_set_up(reports::RotaryTable& rotary, const reports::Result& result) {
    if (result.reported.method != "monte_carlo" || result.name.size() != 3 || result.name[1] != '_') {
        return;
    }
    const auto coordinate = static_cast<std::size_t>(result.name[2] - 'x');
    const bool offset = result.name[0] == 'O';
    const reports::Printed& printed = result.reported.printed;
    (offset ? rotary.set_up.printed_O : rotary.set_up.printed_S).at(coordinate) = printed;
    reports::Printed& seen =
        (offset ? rotary.axis_in_fixture.printed_O : rotary.axis_in_fixture.printed_S).at(coordinate);
    seen = printed;
    seen.value = reports::negated(printed.value);
}

}  // namespace

void report_result(reports::Result& result, CoverageChoice choice) {
    Reporter(choice, result.coverage_probability).report(result);
}

void report_rotary_results(reports::EvaluationRecord& record, CoverageChoice choice) {
    reports::RotaryTable& rotary = *record.rotary;
    const Reporter reporter(choice, record.coverage_probability);
    for (reports::ErrorsAtAngle& at : rotary.errors) {
        for (std::size_t i = 0; i < at.errors.size(); ++i) {
            reporter.report(at.errors[i], rotary.error_units[i], at.errors[i].k);
        }
    }
    for (std::size_t i = 0; i < rotary.reversal.size(); ++i) {
        reporter.report(rotary.reversal[i].value, rotary.error_units[i], rotary.reversal[i].value.k);
    }
    for (std::size_t i = 0; i < rotary.ranges.size(); ++i) {
        reporter.report(rotary.ranges[i], rotary.error_units[i], rotary.ranges[i].k);
    }
    for (auto* const parameters : {&rotary.axis_line, &rotary.location_errors}) {
        for (reports::TableParameter& parameter : *parameters) {
            reporter.report(parameter, parameter.unit, parameter.k);
        }
    }
    if (rotary.iso230_2) {
        for (reports::TableParameter& parameter : rotary.iso230_2->parameters) {
            reporter.report(parameter, parameter.unit, parameter.k);
        }
    }
    for (reports::Result& result : record.results) {
        reporter.report(result);
        print_set_up(rotary, result);
    }
}

}  // namespace gumcert::reports
