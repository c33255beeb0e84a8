#include "app/certificate_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/budget_record.h"
#include "app/read_file.h"
#include "gum/budget/budget_model.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/certificate/certificate_statement.h"
#include "reports/record/make/record_parts.h"
#include "text/lists.h"

namespace gumcert::app {

namespace {

namespace fs = std::filesystem;

/// An id is the name of a file: letters, digits, '-' and '_' only, so that it cannot lead out of the folder.
bool is_file_stem(const std::string& id) {
    constexpr std::size_t k_longest = 64;
    return !id.empty() && id.size() <= k_longest && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
}

std::string known_profiles(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".json") {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names.empty() ? "none" : text::listed(names);
}

/// A certificate names its profile: a file of the laboratory that is called as one of the program is the same as it.
void refuse_a_name_of_the_program(const certificate::Profile& own, const fs::path& folder) {
    const fs::path file = folder / (own.id + ".json");
    std::error_code error;
    if (!is_file_stem(own.id) || !fs::exists(file, error)) {
        return;
    }
    if (!(jobs::parse_profile(read_file(file), file.filename().string()) == own)) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-CERT-0301",
                            .where = "certificate/profile",
                            .what = "a profile of your own has the id \"" + own.id + "\" of one of the program",
                            .rule = "a document names its profile, and the two are not the same",
                            .action = "give it an id of its own, or name the profile of the program"});
    }
}

InputValues values_of(const jobs::BudgetJob& job, std::size_t input) {
    InputValues out{.unit = job.inputs[input].unit.text(), .values = {}};
    const auto add = [&](std::optional<std::size_t> point) {
        out.values.push_back(job.inputs[input].unit.from_si(gum::input_total(gum::input_at(job, input, point)).value));
    };
    if (job.points.empty()) {
        add(std::nullopt);
    }
    for (std::size_t p = 0; p < job.points.size(); ++p) {
        add(p);
    }
    return out;
}

/// P(Y ≤ x) and P(Y < x) of an output whose k comes from the convolution, x in its unit.
void add_convolution(const gum::BudgetPointResult& point, Eigen::Index output, const gum::Unit& unit,
                     const std::string& name, CapabilityInputs& inputs) {
    const auto terms = gum::convolution_terms(*point.model, point.propagation, output);
    if (!terms) {
        return;
    }
    const gum::ConvolutionDistribution distribution(*terms);
    const double centre = point.propagation.value(output);
    // A limit that is a possible value differs from it by roundings alone.
    constexpr double k_roundings = 8.0;
    const auto rounding = [centre](double x) {
        return k_roundings * std::numeric_limits<double>::epsilon() * std::max(std::abs(x), std::abs(centre));
    };
    inputs.distributions.emplace(name, [=](double x) {
        const double at = unit.to_si(x);
        return distribution(at - centre + rounding(at));
    });
    inputs.distributions_below.emplace(name, [=](double x) {
        const double at = unit.to_si(x);
        return distribution.below(at - centre - rounding(at));
    });
}

}  // namespace

certificate::Profile certificate_profile(const certificate::CertificateData& data, const fs::path& templates) {
    const fs::path folder = templates / "profiles";
    if (data.own_profile) {
        refuse_a_name_of_the_program(*data.own_profile, folder);
        return *data.own_profile;
    }
    const fs::path file = folder / (data.profile + ".json");
    std::error_code error;
    if (!is_file_stem(data.profile) || !fs::exists(file, error)) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-CERT-0300",
                                              .where = "certificate/profile",
                                              .what = "there is no profile \"" + data.profile + "\"",
                                              .rule = "the profiles are " + known_profiles(folder),
                                              .action = "name one of them, or a file of your own beside the job"});
    }
    return jobs::parse_profile(read_file(file), file.filename().string());
}

CapabilityInputs capability_inputs(const jobs::BudgetJob& job, const gum::BudgetResult& result, unsigned threads) {
    CapabilityInputs inputs;
    inputs.rounding = job.rounding;
    for (std::size_t i = 0; i < job.inputs.size(); ++i) {
        inputs.values.emplace(job.inputs[i].name, values_of(job, i));
    }
    if (!job.certificate || job.certificate->specifications.empty()) {
        return inputs;
    }
    const std::vector<std::string> names = gum::budget_result_names(job, result);
    const std::size_t outputs = result.output_names.size();
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const gum::BudgetPointResult& point = result.points[p];
        for (std::size_t i = 0; i < outputs; ++i) {
            const std::string& name = names[p * outputs + i];
            const gum::Unit& unit = result.output_units[i];
            const auto output = static_cast<Eigen::Index>(i);
            if (point.outputs[i].by_monte_carlo && point.monte_carlo) {
                inputs.trials.emplace(name, gum::TrialsOfOutput{.model = point.model,
                                                                .output = output,
                                                                .unit = unit,
                                                                .seed = point.monte_carlo->seed,
                                                                .streams = point.streams,
                                                                .trials = point.outputs[i].trials,
                                                                .threads = threads});
            } else if (point.outputs[i].coverage == "convolution") {
                add_convolution(point, output, unit, name, inputs);
            }
        }
    }
    return inputs;
}

}  // namespace gumcert::app
