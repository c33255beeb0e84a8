// Parameters of ISO 230-2: a public data set, the definitions written out, and the derivatives.
#include "engine/rotary_table/positioning_accuracy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using Parameter = PositioningParameter;

struct DataSet {
    PositioningRuns runs;
    Eigen::VectorXd deviations;
};

/// Every row one target: target position and readings, [mm]; deviations in 1e-6 mm.
DataSet data_set(const std::vector<std::vector<double>>& up, const std::vector<std::vector<double>>& down) {
    DataSet result;
    std::vector<double> all;
    for (const auto* sense : {&up, &down}) {
        for (const std::vector<double>& row : *sense) {
            auto& targets = sense == &up ? result.runs.up : result.runs.down;
            targets.emplace_back();
            for (std::size_t j = 1; j < row.size(); ++j) {
                targets.back().push_back(static_cast<Eigen::Index>(all.size()));
                all.push_back(1e6 * (row[j] - row[0]));
            }
        }
    }
    result.deviations = Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
    return result;
}

// paulscherrerinstitute/ecmccfg, examples/test/fat_sat/report.md: "Data forward direction", "Data backward direction".
const std::vector<std::vector<double>> k_forward{
    {-10.0, -10.00008102, -10.00010202, -10.00008702, -10.00009202, -10.00010002},
    {-4.88, -4.88008702, -4.88009702, -4.88009702, -4.88009502, -4.88008202},
    {0.24, 0.23992798, 0.23990998, 0.23991198, 0.23991298, 0.23991298},
    {5.36, 5.35989798, 5.35991398, 5.35991398, 5.35990698, 5.35992198},
    {10.48, 10.47989998, 10.47988798, 10.47987098, 10.47989098, 10.47990298}};
const std::vector<std::vector<double>> k_backward{
    {-10.0, -10.00009902, -10.00009402, -10.00008202, -10.00009102, -10.00009402},
    {-4.88, -4.88010302, -4.88010402, -4.88009502, -4.88011102, -4.88009302},
    {0.24, 0.23991398, 0.23989798, 0.23990898, 0.23992398, 0.23990098},
    {5.36, 5.35992798, 5.35990798, 5.35990498, 5.35989698, 5.35991898},
    {10.48, 10.47989598, 10.47987398, 10.47986998, 10.47985898, 10.47989298}};

/// What the report prints, in 1e-6 mm, to half a unit in its last digit. It prints two parameters that are not those of
/// the standard: R = 62.9, the larger of R_fwd and R_bwd, while its own table has R(5) = 68.82; and E = 24.6, that of
/// one sense alone. By definition R = 68.8, and E = max(-84.82) - min(-121.62) = 36.8 from its own means.
void expect_values_of_the_report(const DataSet& data) {
    const PositioningAccuracy accuracy = evaluate_positioning(data.runs, data.deviations);
    EXPECT_NEAR(accuracy[Parameter::reversal].value(), 12.2, 0.05);
    EXPECT_NEAR(accuracy[Parameter::mean_reversal].value(), 5.4, 0.05);
    EXPECT_NEAR(accuracy[Parameter::repeatability].value(), 68.82, 0.005);
    EXPECT_NEAR(accuracy[Parameter::repeatability_up].value(), 50.33, 0.005);
    EXPECT_NEAR(accuracy[Parameter::repeatability_down].value(), 62.90, 0.005);
    EXPECT_NEAR(accuracy[Parameter::mean_deviation_range].value(), 27.7, 0.05);
    EXPECT_NEAR(accuracy[Parameter::systematic].value(), 36.8, 0.05);
    EXPECT_NEAR(accuracy[Parameter::systematic_up].value(), 24.6, 0.05);
    EXPECT_NEAR(accuracy[Parameter::systematic_down].value(), 33.0, 0.05);
    EXPECT_NEAR(accuracy[Parameter::accuracy].value(), 88.81, 0.005);
    EXPECT_NEAR(accuracy[Parameter::accuracy_up].value(), 64.28, 0.005);
    EXPECT_NEAR(accuracy[Parameter::accuracy_down].value(), 88.81, 0.005);
    ASSERT_EQ(accuracy.targets.size(), 5U);
    EXPECT_NEAR(accuracy.targets[1].mean_up.value(), -91.62, 0.005);
    EXPECT_NEAR(accuracy.targets[1].mean_down.value(), -101.22, 0.005);
    EXPECT_NEAR(accuracy.targets[1].s_up.value(), 6.77, 0.005);
    EXPECT_NEAR(accuracy.targets[4].s_down.value(), 15.73, 0.005);
    EXPECT_NEAR(accuracy.targets[1].reversal.value(), 9.6, 0.05);
}

TEST(PositioningAccuracy, PublicDataSetByDefinition) {
    expect_values_of_the_report(data_set(k_forward, k_backward));
}

/// Rows of the table under the heading: index | target | readings.
std::vector<std::vector<double>> table_under(std::istream& file, const std::string& heading) {
    std::vector<std::vector<double>> rows;
    std::string line;
    bool inside = false;
    while (std::getline(file, line)) {
        if (line.starts_with("### ")) {
            if (inside) {
                break;
            }
            inside = line == heading;
        }
        if (!inside || line.empty() || line[0] < '0' || line[0] > '9') {
            continue;
        }
        std::vector<double> values;
        for (std::size_t begin = 0; begin < line.size();) {
            const std::size_t end = std::min(line.find('|', begin), line.size());
            double value = 0.0;
            if (std::from_chars(line.data() + begin, line.data() + end, value).ec == std::errc{}) {
                values.push_back(value);
            }
            begin = end + 1;
        }
        values.erase(values.begin());
        rows.push_back(values);
        if (rows.size() == 5) {
            break;
        }
    }
    return rows;
}

TEST(PositioningAccuracy, PublicDataSetFromTheReportItself) {
    const std::filesystem::path path =
        std::filesystem::path(GUMCERT_SHARED_DIR) / "data/networks/iso230-2-ecmc/report.md";
    std::ifstream file(path);
    if (!file) {
        GTEST_SKIP() << "no shared data";
    }
    const auto forward = table_under(file, "### Data forward direction");
    file.clear();
    file.seekg(0);
    const auto backward = table_under(file, "### Data backward direction");
    EXPECT_EQ(forward, k_forward);
    EXPECT_EQ(backward, k_backward);
    expect_values_of_the_report(data_set(forward, backward));
}

/// Runs whose number differs from target to target.
DataSet uneven(std::uint64_t seed, double reversal) {
    synthetic::Noise noise(seed);
    std::vector<std::vector<double>> up;
    std::vector<std::vector<double>> down;
    for (std::size_t i = 0; i < 7; ++i) {
        const double at = 3e-6 * std::sin(static_cast<double>(i));
        for (auto* sense : {&up, &down}) {
            sense->push_back({0.0});
            for (std::size_t j = 0; j < 2 + (i + (sense == &up ? 0 : 1)) % 4; ++j) {
                sense->back().push_back(at + (sense == &up ? 0.5e-6 : -0.5e-6) * reversal + 1e-6 * noise.normal());
            }
        }
    }
    return data_set(up, down);
}

TEST(PositioningAccuracy, DerivativesAreCentralDifferences) {
    for (const double reversal : {0.0, 8.0, -8.0}) {  // R from one sense, and from both
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const DataSet data = uneven(seed, reversal);
            const Eigen::MatrixXd derivatives = positioning_derivatives(data.runs, data.deviations);
            constexpr double k_step = 1e-6;
            for (Eigen::Index j = 0; j < data.deviations.size(); ++j) {
                Eigen::VectorXd above = data.deviations;
                Eigen::VectorXd below = data.deviations;
                above[j] += k_step;
                below[j] -= k_step;
                const PositioningAccuracy high = evaluate_positioning(data.runs, above);
                const PositioningAccuracy low = evaluate_positioning(data.runs, below);
                for (std::size_t k = 0; k < k_positioning_parameters; ++k) {
                    const double numeric = (*high.parameters[k] - *low.parameters[k]) / (2.0 * k_step);
                    EXPECT_NEAR(derivatives(static_cast<Eigen::Index>(k), j), numeric, 1e-6)
                        << positioning_parameter_names()[k] << ", deviation " << j << ", seed " << seed;
                }
            }
        }
    }
}

// Every parameter but the mean of the reversals is the largest of these values less the smallest, with the same derivatives.
TEST(PositioningAccuracy, ExtremesAreThoseOfTheParameters) {
    for (const double reversal : {0.0, 8.0, -8.0}) {
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const DataSet data = uneven(seed, reversal);
            const PositioningAccuracy accuracy = evaluate_positioning(data.runs, data.deviations);
            const Eigen::MatrixXd derivatives = positioning_derivatives(data.runs, data.deviations);
            for (std::size_t k = 0; k < k_positioning_parameters; ++k) {
                const auto parameter = static_cast<Parameter>(k);
                if (parameter == Parameter::mean_reversal) {
                    continue;
                }
                const PositioningExtremes all = positioning_extremes(data.runs, data.deviations, parameter);
                const auto less = [&](Eigen::Index a, Eigen::Index b) { return all.value[a] < all.value[b]; };
                const Eigen::Index most = *std::max_element(all.upper.begin(), all.upper.end(), less);
                double value = all.value[most];
                Eigen::RowVectorXd by = all.by_deviation.row(most);
                if (!all.lower.empty()) {
                    const Eigen::Index least = *std::min_element(all.lower.begin(), all.lower.end(), less);
                    value -= all.value[least];
                    by -= all.by_deviation.row(least);
                }
                EXPECT_NEAR(value, *accuracy.parameters[k], 1e-12) << positioning_parameter_names()[k];
                EXPECT_LT((by - derivatives.row(static_cast<Eigen::Index>(k))).cwiseAbs().maxCoeff(), 1e-12)
                    << positioning_parameter_names()[k] << ", seed " << seed;
            }
        }
    }
}

TEST(PositioningAccuracy, RepeatabilityOfOneSenseCanExceedThatOfBoth) {
    // s↑ = √2 · 5, s↓ = √2, B = 0: 4 s↑ is more than 2 s↑ + 2 s↓.
    const DataSet data = data_set({{0.0, -5e-6, 5e-6}}, {{0.0, -1e-6, 1e-6}});
    const PositioningAccuracy accuracy = evaluate_positioning(data.runs, data.deviations);
    EXPECT_NEAR(accuracy[Parameter::repeatability].value(), 4.0 * 5.0 * std::sqrt(2.0), 1e-9);
    EXPECT_EQ(accuracy[Parameter::repeatability], accuracy[Parameter::repeatability_up]);
}

TEST(PositioningAccuracy, ZeroOfTheScaleAndOrderOfRunsDoNotMatter) {
    const DataSet data = uneven(3, 2.0);
    const PositioningAccuracy before = evaluate_positioning(data.runs, data.deviations);
    DataSet changed = data;
    changed.deviations.array() += 17.5;
    for (auto* sense : {&changed.runs.up, &changed.runs.down}) {
        std::reverse(sense->begin(), sense->end());
        for (auto& list : *sense) {
            std::reverse(list.begin(), list.end());
        }
    }
    const PositioningAccuracy after = evaluate_positioning(changed.runs, changed.deviations);
    for (std::size_t k = 0; k < k_positioning_parameters; ++k) {
        EXPECT_NEAR(*before.parameters[k], *after.parameters[k], 1e-12) << positioning_parameter_names()[k];
    }
    std::swap(changed.runs.up, changed.runs.down);
    const PositioningAccuracy swapped = evaluate_positioning(changed.runs, changed.deviations);
    EXPECT_NEAR(*swapped[Parameter::mean_reversal], -*before[Parameter::mean_reversal], 1e-12);
    EXPECT_NEAR(*swapped[Parameter::repeatability_up], *before[Parameter::repeatability_down], 1e-12);
    EXPECT_NEAR(*swapped[Parameter::accuracy], *before[Parameter::accuracy], 1e-12);
}

TEST(PositioningAccuracy, StatesOnlyWhatTheRunsAllow) {
    const auto stated = [](const DataSet& data) {
        std::string names;
        const PositioningAccuracy accuracy = evaluate_positioning(data.runs, data.deviations);
        const auto allowed = allowed_parameters(data.runs);
        const Eigen::MatrixXd derivatives = positioning_derivatives(data.runs, data.deviations);
        EXPECT_TRUE(derivatives.allFinite());
        for (std::size_t k = 0; k < k_positioning_parameters; ++k) {
            EXPECT_EQ(accuracy.parameters[k].has_value(), allowed[k]);
            if (allowed[k]) {
                names += std::string(names.empty() ? "" : " ") + std::string(positioning_parameter_names()[k]);
            } else {
                EXPECT_EQ(derivatives.row(static_cast<Eigen::Index>(k)).cwiseAbs().maxCoeff(), 0.0);
            }
        }
        return names;
    };
    EXPECT_EQ(stated(data_set(k_forward, {})), "E_up R_up A_up");
    EXPECT_EQ(stated(data_set({}, k_backward)), "E_down R_down A_down");
    auto single = k_forward;
    single[2].resize(2);  // one run at one target
    EXPECT_EQ(stated(data_set(single, k_backward)), "M E E_up E_down R_down B B_mean A_down");
    single[2].resize(1);  // none
    EXPECT_EQ(stated(data_set(single, k_backward)), "E_down R_down A_down");
    const DataSet partly = data_set(single, k_backward);
    const PositioningAccuracy accuracy = evaluate_positioning(partly.runs, partly.deviations);
    EXPECT_FALSE(accuracy.targets[2].mean_up.has_value());
    EXPECT_FALSE(accuracy.targets[2].reversal.has_value());
    EXPECT_TRUE(accuracy.targets[2].s_down.has_value());
    EXPECT_TRUE(accuracy.targets[1].reversal.has_value());
}

TEST(PositioningAccuracy, IdenticalRunsHaveDerivativesThatAreNumbers) {
    const DataSet data = data_set({{0.0, 1e-6, 1e-6}, {0.0, 2e-6, 2e-6}}, {{0.0, 1e-6, 1e-6}, {0.0, 2e-6, 2e-6}});
    EXPECT_TRUE(positioning_derivatives(data.runs, data.deviations).allFinite());
    EXPECT_EQ(*evaluate_positioning(data.runs, data.deviations)[Parameter::repeatability], 0.0);
}

}  // namespace
}  // namespace gumcert::engine
