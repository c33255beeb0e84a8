#include "reports/studies/simulation_explanation.h"

#include <array>
#include <cmath>

#include "gum/rounding.h"

namespace gumcert::reports::simulation {

using gum::AngleStudy;
using gum::DifferenceTally;
using gum::k_all_tally;
using gum::k_angular_tally;
using gum::k_linear_tally;
using gum::k_offset_tally;
using gum::k_tilt_tally;
using gum::Tallies;

namespace {

/// Ways to make one number of the differences of a simulation, each of which a paper may mean.
struct Definition {
    const char* name;
    double (*of)(const DifferenceTally&);
};
constexpr std::array<Definition, 4> k_definitions{
    {{"mean of the absolute values", [](const DifferenceTally& tally) { return tally.mean_absolute(); }},
     {"root mean square", [](const DifferenceTally& tally) { return tally.rms(); }},
     {"largest of a campaign, mean over campaigns", [](const DifferenceTally& tally) { return tally.mean_largest(); }},
     {"largest of all campaigns", [](const DifferenceTally& tally) { return tally.maximum; }}}};

/// Datum home: the one of the source paper.
const DifferenceTally& at_home(const AngleStudy& study, std::size_t tally) {
    return study.datum_only[1][tally];
}

/// N for which `definition` of the datum part is `figure` times the scale, with the datum part as a / sqrt(N) and a
/// from all studies.
double angles_for(const std::vector<AngleStudy>& studies, const Definition& definition, std::size_t tally,
                  double figure) {
    double squares = 0.0;
    for (const AngleStudy& study : studies) {
        const double value = definition.of(at_home(study, tally));
        squares += value * value * static_cast<double>(study.angles);
    }
    return squares / static_cast<double>(studies.size()) / (figure * figure);
}

/// The study with noise that speaks for all: the one with most campaigns, of these the one with most angles.
const AngleStudy* spokesman(const std::vector<AngleStudy>& studies) {
    const AngleStudy* chosen = nullptr;
    for (const AngleStudy& study : studies) {
        if (study.noisy.evaluated[0] > 0 &&
            (chosen == nullptr || study.noisy.evaluated[0] >= chosen->noisy.evaluated[0])) {
            chosen = &study;
        }
    }
    return chosen;
}

std::string pair_text(const Tallies& tallies, const Scales& scales, double (DifferenceTally::*part)() const,
                      std::size_t first, std::size_t second, int decimals = 1) {
    return percent_text((tallies[first].*part)() / scales.of(first), decimals) + " % and " +
           percent_text((tallies[second].*part)() / scales.of(second), decimals) + " %";
}

std::string counted_angles(std::size_t angles) {
    return std::to_string(angles) + " angles";
}

}  // namespace

std::string found_text(const std::vector<AngleStudy>& studies, const Scales& scales) {
    std::string text;
    if (scales.offset > 0.0 && scales.tilt > 0.0) {
        const auto change = [&](const AngleStudy& study) {
            return pair_text(study.datum_only[1], scales, &DifferenceTally::rms, k_offset_tally, k_tilt_tally) +
                   " with " + counted_angles(study.angles);
        };
        text = "Exact distances already give another set-up than the assumed one: offsets and tilts differ by " +
               change(studies.front());
        if (studies.size() > 1) {
            text += " and by " + change(studies.back());
        }
        text += " (root mean square, datum of the home position), which is the datum and not the measurement.";
    }
    const AngleStudy* study = spokesman(studies);
    if (study == nullptr) {
        return text;
    }
    const Tallies& joint = study->noisy.tallies[0];
    if (scales.complete()) {
        text += " What all measurement noise together adds in the joint adjustment, with " +
                counted_angles(study->angles) + " and in the datum of the axis average line, is " +
                pair_text(joint, scales, &DifferenceTally::measurement_rms, k_offset_tally, k_tilt_tally) +
                " of the assumed set-up and " +
                pair_text(joint, scales, &DifferenceTally::measurement_rms, k_linear_tally, k_angular_tally) +
                " of the amplitudes of the linear and angular error motions.";
    }
    const DifferenceTally& all = joint[k_all_tally];
    text += " These errors are " + gum::round_to_quantum(all.normalised_rms(), 2) +
            " times their stated standard uncertainties (root mean square), and " + percent_text(all.coverage(), 1) +
            " % of them are within the stated expanded uncertainty.";
    return text;
}

std::vector<std::string> parts_paragraphs(const std::vector<AngleStudy>& studies, const Scales& scales) {
    std::vector<std::string> paragraphs;
    paragraphs.emplace_back(
        "Distances do not tell error motions that are the same at all angles, or that turn with the table once per "
        "revolution, from another place of the axis or another set-up of the fixture. A datum decides where such a "
        "part is counted. The assumed error motions are independent random numbers at every angle: by chance they "
        "contain such parts, and every method that states its result in a datum moves them from one quantity to "
        "another. A comparison with the assumed numbers therefore differs even where every distance is exact.");
    paragraphs.emplace_back(
        "Datum part: the assumed values, carried to the datum of the result without any measurement, minus the assumed "
        "values. It becomes smaller with the square root of the number of angles, and better instruments do not change "
        "it. Measurement part: the result minus the truth in the same datum. It is what a stated uncertainty is "
        "about.");
    for (const AngleStudy& study : studies) {
        if (study.noisy.evaluated[0] == 0 || !scales.complete()) {
            continue;
        }
        const Tallies& joint = study.noisy.tallies[1];
        paragraphs.push_back(
            counted_angles(study.angles) + ", joint adjustment, datum of the home position, offsets and tilts: datum " +
            pair_text(joint, scales, &DifferenceTally::datum_rms, k_offset_tally, k_tilt_tally) + ", measurement " +
            pair_text(joint, scales, &DifferenceTally::measurement_rms, k_offset_tally, k_tilt_tally) + ", together " +
            pair_text(joint, scales, &DifferenceTally::rms, k_offset_tally, k_tilt_tally) + ".");
    }
    return paragraphs;
}

reports::StudyTable paper_angles_table(const std::vector<AngleStudy>& studies, const Scales& scales) {
    reports::StudyTable table{
        "Number of angles with which the datum alone, without any measurement, gives the figure of the source paper, "
        "by what the figure may mean",
        {{"definition of the figure", "", false}},
        {}};
    for (const PaperFigure& figure : k_paper) {
        table.columns.push_back({std::string(figure.name) + ", " + percent_text(figure.largest) + " %", "", true});
    }
    for (const Definition& definition : k_definitions) {
        std::vector<std::string> row{definition.name};
        for (const PaperFigure& figure : k_paper) {
            const double scale = scales.of(figure.tally);
            row.push_back(scale > 0.0 ? gum::round_to_quantum(
                                            angles_for(studies, definition, figure.tally, figure.largest * scale), 0)
                                      : "");
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<std::string> paper_paragraphs(const std::vector<AngleStudy>& studies, const Scales& scales) {
    std::vector<std::string> paragraphs;
    if (!scales.complete()) {
        return paragraphs;
    }
    paragraphs.emplace_back(
        "The source paper states at most 4.50 % and 4.35 % for offsets and tilts, 3.25 % and 2.30 % for linear and "
        "angular error motions. It states neither the number of angles nor whether single values, means or root mean "
        "squares are meant, nor whether its distances have noise. The datum part is proportional to one over the "
        "square root of the number of angles, so each definition has a number of angles with which the datum alone "
        "gives the paper's figure. The table takes it from all studies of this document, with the reflectors of its "
        "job, datum of the home position.");
    const auto angles = [&](std::size_t definition, std::size_t figure) {
        const PaperFigure& paper = k_paper[figure];
        return gum::round_to_quantum(
            angles_for(studies, k_definitions[definition], paper.tally, paper.largest * scales.of(paper.tally)), 0);
    };
    paragraphs.push_back(
        "As root mean squares the four figures need " + angles(1, 0) + ", " + angles(1, 1) + ", " + angles(1, 2) +
        " and " + angles(1, 3) + " angles; as largest values of all campaigns " + angles(3, 0) + ", " + angles(3, 1) +
        ", " + angles(3, 2) + " and " + angles(3, 3) +
        ". Where the numbers of a row of the table differ by much more than a fifth, no single number of "
        "angles explains all four figures with that definition. Differences of the mean of 100 "
        "campaigns from the assumed values are ten times smaller than the root mean square: the "
        "figures would need a hundredth of its angles, which cannot be meant.");
    if (const AngleStudy* study = spokesman(studies)) {
        const Tallies& joint = study->noisy.tallies[0];
        paragraphs.push_back(
            "The measurement parts of the joint adjustment, " +
            pair_text(joint, scales, &DifferenceTally::measurement_rms, k_offset_tally, k_tilt_tally) + ", " +
            pair_text(joint, scales, &DifferenceTally::measurement_rms, k_linear_tally, k_angular_tally) + " with " +
            counted_angles(study->angles) +
            " and the noise of this study (root mean square, datum of the axis average line), are what can be "
            "compared between instruments and methods. The paper's percentages, whichever definition they have, "
            "measure how much of the random numbers happens to look like a set-up error.");
    }
    return paragraphs;
}

}  // namespace gumcert::reports::simulation
