// Observations: Type A evaluation, resolution of a display, and an analysis of variance that decides which uncertainty
// the mean has.
#include <cmath>
#include <cstdio>
#include <vector>

#include "gum/analysis_of_variance.h"
#include "gum/quantity/diagnostic.h"
#include "gum/type_a.h"
#include "gum/type_b.h"

using namespace gumcert::gum;

int main() try {
    // JCGM 100:2008, 4.4.3 and table 1: twenty temperatures, [°C].
    const std::vector<double> t{96.90,  98.18,  98.25,  98.61,  99.03,  99.49,  99.56,  99.74,  99.89,  100.07,
                                100.33, 100.42, 100.68, 100.95, 101.11, 101.20, 101.57, 101.84, 102.36, 102.72};
    const ObservationSummary summary = evaluate_type_a(t);
    std::printf("mean %.2f, s = %.2f, u = %.2f, %.0f degrees of freedom\n", summary.mean, summary.standard_deviation,
                summary.standard_deviation_of_mean, summary.degrees_of_freedom);
    // 4.3.7: a quantity that lies within ±4 of its estimate, all values equally probable.
    std::printf("rectangular, half-width 4: u = %.1f\n", u_from_half_width(4.0));
    // F.2.2.1: an indicating device with steps of 1.
    std::printf("resolution of 1: u = %.2f\n", u_from_resolution(1.0));

    // H.5, table H.9: a Zener voltage on ten days, five readings a day. Means less 10 V and standard deviations, [µV].
    const std::vector<double> means{172, 116, 13, 144, 106, 31, 60, 125, 163, 41};
    const std::vector<double> deviations{60, 77, 111, 101, 67, 93, 80, 73, 88, 86};
    std::vector<ObservationGroup> days;
    for (std::size_t j = 0; j < means.size(); ++j) {
        days.push_back({.observations = 5, .mean = means[j], .standard_deviation = deviations[j]});
    }
    const OneWayAnalysis analysis = one_way_analysis(days, 0.05);
    std::printf("F = %.2f, critical value %.2f: an effect between days is %staken to exist\n", analysis.ratio.f,
                analysis.ratio.critical_value, analysis.ratio.significant ? "" : "not ");
    std::printf("mean %.0f uV, u = %.0f uV with the effect, %.0f uV without it\n", analysis.mean,
                analysis.u_with_between_effect, analysis.u_without_between_effect);
    return 0;
} catch (const DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
