// What a rotary table job can ask for beyond the standard measurement, as the record states it; and what `simulate` and
// `plan` do with a wrong command or an input that they may not overwrite.
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path simulated_campaign(const std::string& name) {
    return fs::path(GUMCERT_SOURCE_DIR) / "tests" / "reference" / "campaigns" / name;
}

fs::path copy_of_campaign(const std::string& name, const fs::path& folder) {
    for (const fs::directory_entry& entry : fs::directory_iterator(simulated_campaign(name))) {
        write_bytes(folder / entry.path().filename(), bytes_of(entry.path()));
    }
    return folder / "job.json";
}

/// The shipped example at every 60°, without the dial indicator.
/// \return its job file
fs::path six_angles_of_example(const fs::path& folder) {
    const fs::path job = copy_of_example(folder);
    std::string lengths;
    for (const std::string& line : lines_of(bytes_of(folder / "lengths.csv"))) {
        static const std::regex multiple_of_60("[^,]*,[^,]*,[^,]*,[^,]*,(0|60|120|180|240|300)\\.0+,.*");
        if (lengths.empty() || std::regex_match(line, multiple_of_60)) {
            lengths += line + "\n";
        }
    }
    write_bytes(folder / "lengths.csv", lengths);
    change_json(job, [](json& document) { document.erase("reference_method"); });
    return job;
}

class RotaryDepth : public ProgramTest {
protected:
    /// Evaluates a job that may have a negative answer.
    /// \return its record
    json record_of(const fs::path& job, int expected_code) const {
        const fs::path record = folder() / "depth" / "record.json";
        const Ended ended = gumcert({"evaluate", job.string(), "-o", record.string()});
        EXPECT_EQ(ended.code, expected_code) << ended.err;
        // A negative answer is never silent.
        EXPECT_EQ(ended.err.find("[GC-VALIDATION-0001]") != std::string::npos, expected_code == 1) << ended.err;
        return fs::exists(record) ? json::parse(bytes_of(record)) : json();
    }
};

void expect_block(const json& block, const std::string& name) {
    ASSERT_TRUE(block.is_object()) << name;
    EXPECT_EQ(block.at("trials"), 2500) << name;
    EXPECT_EQ(block.at("seed"), 3) << name;
    for (const char* const interval : {"symmetric", "shortest"}) {
        EXPECT_LT(block[interval][0].get<double>(), block.at("mean").get<double>()) << name;
        EXPECT_GT(block[interval][1].get<double>(), block.at("mean").get<double>()) << name;
    }
    const json& validation = block.at("validation");
    ASSERT_TRUE(validation.is_object()) << name;
    EXPECT_GE(validation.at("d_low").get<double>(), 0.0) << name;
    EXPECT_GE(validation.at("d_high").get<double>(), 0.0) << name;
    EXPECT_GT(validation.at("delta").get<double>(), 0.0) << name;
    EXPECT_EQ(validation.at("validated").get<bool>(),
              validation.at("d_low").get<double>() <= validation.at("delta").get<double>() &&
                  validation.at("d_high").get<double>() <= validation.at("delta").get<double>())
        << name;
}

TEST_F(RotaryDepth, MonteCarloChecksEveryReportedQuantity) {
    const fs::path job = six_angles_of_example(folder() / "job");
    for (const bool validate : {true, false}) {
        SCOPED_TRACE(validate ? "validate" : "without validate");
        change_json(job, [&](json& document) {
            document["table_repeatability"] = {
                {"mode", "given"}, {"u_linear_um", 0.15}, {"u_axial_arcsec", 0.3}, {"u_tilt_arcsec", 0.1}};
            document["monte_carlo"] = {{"trials", 2500}, {"seed", 3}, {"validate", validate}};
        });
        // 2500 trials cannot decide for every quantity: a validation that was demanded and is not there is exit code 1.
        const json record = record_of(job, validate ? 1 : 0);
        ASSERT_TRUE(record.is_object());
        const json& rotary = record.at("rotary");
        const json& summary = rotary.at("monte_carlo");
        ASSERT_TRUE(summary.is_object());
        EXPECT_EQ(summary.at("trials"), 2500);
        EXPECT_EQ(summary.at("seed"), 3);
        EXPECT_GE(summary.at("mean_steps").get<double>(), 1.0);
        EXPECT_NE(summary.at("statement").get<std::string>().find("2500 trials"), std::string::npos);
        ASSERT_EQ(rotary.at("errors").size(), 6U);
        std::size_t blocks = 0;
        for (const json& row : rotary.at("errors")) {
            for (const std::string& name : k_error_motions) {
                expect_block(row.at(name).at("monte_carlo"), name);
                // The model is nearly linear here. The standard deviation of u of 2500 normal trials is 1.4 %.
                const double ratio =
                    row.at(name).at("monte_carlo").at("u").get<double>() / row.at(name).at("u").get<double>();
                EXPECT_NEAR(ratio, 1.0, 0.08) << name << " at " << row.at("angle_deg");
                ++blocks;
            }
        }
        for (const auto& [name, result] : record.at("results").items()) {
            expect_block(result.at("monte_carlo"), name);
            ++blocks;
        }
        // Extremes and standard deviations of deviations hold the noise already (ADR 0015).
        for (const json& parameter : rotary.at("ranges")) {
            EXPECT_TRUE(parameter.at("monte_carlo").is_null()) << parameter.at("name");
        }
        for (const char* const list : {"reversal", "axis_line"}) {
            for (const json& parameter : rotary.at(list)) {
                expect_block(parameter.at("monte_carlo"), parameter.at("name"));
                ++blocks;
            }
        }
        for (const json& parameter : rotary.at("iso230_2").at("parameters")) {
            const std::string name = parameter.at("name");
            EXPECT_EQ(parameter.at("monte_carlo").is_null(), name != "B_mean") << name;
            blocks += name != "B_mean" ? std::size_t{0} : std::size_t{1};
        }
        EXPECT_EQ(blocks, 36U + 4U + 6U + 4U + 1U);
        EXPECT_NE(summary.at("statement").get<std::string>().find("hold the noise already"), std::string::npos);
        EXPECT_EQ(summary.at("compared").get<std::size_t>(), blocks);
    }
}

TEST_F(RotaryDepth, TooFewTrialsForTheCoverageProbabilityAreRefused) {
    const fs::path job = six_angles_of_example(folder() / "job");
    change_json(job, [](json& document) { document["monte_carlo"] = {{"trials", 2000}}; });
    const auto before = contents_of(folder());
    const Ended ended =
        gumcert({"evaluate", job.string(), "-o", (folder() / "record.json").string(), "--json-messages"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(contents_of(folder()), before);
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_EQ(messages.size(), 1U) << ended.err;
    EXPECT_NE(messages[0].where.find("/monte_carlo/trials"), std::string::npos) << ended.err;
}

/// Three runs in each sense of approach at every station, whose axial motions are `k sin(2 theta)`, k of them stated.
fs::path runs_of_exact_campaign(const fs::path& folder) {
    std::string lengths;
    for (const auto& [pass, amplitude] : std::map<std::string, double>{
             {"-1,+,", 3.0}, {"-2,+,", 4.0}, {"-3,+,", 5.0}, {"-4,-,", 2.0}, {"-5,-,", 3.0}, {"-6,-,", 4.0}}) {
        ExactCampaign campaign;
        campaign.eaa_arcsec = amplitude;
        (void)campaign.write(folder);
        for (const std::string& line : lines_of(bytes_of(folder / "lengths.csv"))) {
            const std::size_t at = line.find("-1,+,");
            if (at != std::string::npos) {
                lengths += std::string(line).replace(at, pass.size(), pass) + "\n";
            } else if (lengths.empty()) {
                lengths = line + "\n";
            }
        }
    }
    write_bytes(folder / "lengths.csv", lengths);
    change_json(folder / "job.json", [](json& document) {
        document["table_repeatability"] = {
            {"mode", "given"}, {"u_linear_um", 0.001}, {"u_axial_arcsec", 1.0}, {"u_tilt_arcsec", 0.001}};
        document["outliers"] = {{"test", "none"}};
    });
    return folder / "job.json";
}

// The parameters of runs that are known: means 4 sin(2 theta) and 3 sin(2 theta), and by the definitions of ISO 230-2
// from the means and standard deviations that stand beside them.
TEST_F(RotaryDepth, PositioningParametersFollowFromTheRuns) {
    const json record = evaluate(runs_of_exact_campaign(folder() / "job"));
    ASSERT_TRUE(record.is_object());
    const json& iso = record.at("rotary").at("iso230_2");
    EXPECT_EQ(iso.at("unit"), "arcsec");
    EXPECT_EQ(iso.at("runs_up"), 18);
    EXPECT_EQ(iso.at("runs_down"), 18);
    ASSERT_EQ(iso.at("targets").size(), 12U);
    struct Span {
        double low = 1e300, high = -1e300;
        void take(double x) { low = std::min(low, x), high = std::max(high, x); }
        [[nodiscard]] double size() const { return high - low; }
    };
    Span mean, up, down, both, band_up, band_down, band;
    double R = 0.0, R_up = 0.0, R_down = 0.0, B = 0.0, B_sum = 0.0;
    for (const json& target : iso.at("targets")) {
        const double x_up = target.at("mean_up");
        const double x_down = target.at("mean_down");
        const double s_up = target.at("s_up");
        const double s_down = target.at("s_down");
        const double wave = std::sin(target.at("angle_deg").get<double>() * std::numbers::pi / 90.0);
        EXPECT_NEAR(x_up, 4.0 * wave, 0.01);
        EXPECT_NEAR(x_down, 3.0 * wave, 0.01);
        // Six stations see the same three runs: 12 squares of the amplitude step over 18 - 1.
        EXPECT_NEAR(s_up, std::sqrt(12.0 / 17.0) * std::abs(wave), 0.01);
        EXPECT_NEAR(s_down, std::sqrt(12.0 / 17.0) * std::abs(wave), 0.01);
        const double reversal = x_up - x_down;
        EXPECT_NEAR(target.at("reversal").get<double>(), reversal, 1e-12);
        mean.take(0.5 * (x_up + x_down));
        up.take(x_up), down.take(x_down);
        both.take(x_up), both.take(x_down);
        for (const double sign : {-2.0, 2.0}) {
            band_up.take(x_up + sign * s_up), band_down.take(x_down + sign * s_down);
            band.take(x_up + sign * s_up), band.take(x_down + sign * s_down);
        }
        R_up = std::max(R_up, 4.0 * s_up);
        R_down = std::max(R_down, 4.0 * s_down);
        R = std::max({R, 2.0 * s_up + 2.0 * s_down + std::abs(reversal), 4.0 * s_up, 4.0 * s_down});
        B = std::max(B, std::abs(reversal));
        B_sum += reversal;
    }
    const std::map<std::string, double> expected{{"M", mean.size()},
                                                 {"E", both.size()},
                                                 {"E_up", up.size()},
                                                 {"E_down", down.size()},
                                                 {"R", R},
                                                 {"R_up", R_up},
                                                 {"R_down", R_down},
                                                 {"B", B},
                                                 {"B_mean", B_sum / 12.0},
                                                 {"A", band.size()},
                                                 {"A_up", band_up.size()},
                                                 {"A_down", band_down.size()}};
    for (const auto& [name, value] : expected) {
        ASSERT_TRUE(iso.contains(name) && iso.at(name).is_number()) << name << " " << iso.at("remarks");
        EXPECT_NEAR(iso.at(name).get<double>(), value, 1e-9) << name;
        EXPECT_GT(iso.at("U").at(name).get<double>(), 0.0) << name;
    }
}

TEST_F(RotaryDepth, AxisLineHasTheLettersAcrossTheAxis) {
    const std::map<std::string, std::pair<std::string, std::vector<std::string>>> campaigns{
        {"a_axis", {"A", {"axis_y", "axis_z", "axis_b", "axis_c"}}},
        {"b_axis_perfect_table", {"B", {"axis_x", "axis_z", "axis_a", "axis_c"}}},
        {"c_axis_single_target", {"C", {"axis_x", "axis_y", "axis_a", "axis_b"}}}};
    for (const auto& [campaign, expected] : campaigns) {
        SCOPED_TRACE(campaign);
        const json record = evaluate(copy_of_campaign(campaign, folder() / campaign));
        ASSERT_TRUE(record.is_object());
        const json& rotary = record.at("rotary");
        EXPECT_EQ(rotary.at("axis"), expected.first);
        const json truth = json::parse(bytes_of(simulated_campaign(campaign) / "truth.json"));
        std::vector<std::string> names;
        for (const json& parameter : rotary.at("axis_line")) {
            const std::string name = parameter.at("name");
            names.push_back(name);
            // Place of the axis seen from the fixture: the axis of the set-up with the opposite sign.
            const char letter = name.back();
            const bool linear = letter >= 'x';
            const auto c = static_cast<std::size_t>(letter - (linear ? 'x' : 'a'));
            const double value = parameter.at("value");
            EXPECT_EQ(parameter.at("unit"), linear ? "um" : "arcsec") << name;
            EXPECT_NEAR(value, -rotary.at("set_up")[linear ? "O_um" : "S_arcsec"][c].get<double>(), 0.01) << name;
            // The data are fixed: 4 standard deviations, so that only a wrong sign, scale or axis fails.
            EXPECT_NEAR(value, -truth[linear ? "offset_um" : "tilt_arcsec"][c].get<double>(),
                        4.0 * parameter.at("u").get<double>())
                << name;
        }
        std::sort(names.begin(), names.end());
        std::vector<std::string> wanted = expected.second;
        std::sort(wanted.begin(), wanted.end());
        EXPECT_EQ(names, wanted);
        ASSERT_EQ(rotary.at("ranges").size(), 6U);
        EXPECT_EQ(rotary.at("ranges")[0].at("name").get<std::string>(), "EX" + expected.first);
    }
}

// A table that repeats perfectly has components near zero with hardly any degrees of freedom: trials must not draw
// deviations from distributions without a variance.
TEST_F(RotaryDepth, MonteCarloOfATableWhoseRepeatabilityIsHardlyDetermined) {
    const fs::path job = copy_of_campaign("b_axis_perfect_table", folder() / "job");
    change_json(job, [](json& document) { document["monte_carlo"] = {{"trials", 2500}, {"seed", 1}}; });
    const json record = record_of(job, 0);
    ASSERT_TRUE(record.is_object());
    for (const auto& [name, result] : record.at("results").items()) {
        const double ratio = result.at("monte_carlo").at("u").get<double>() / result.at("u").get<double>();
        EXPECT_NEAR(ratio, 1.0, 0.08) << name;
    }
}

TEST_F(RotaryDepth, FixtureBudgetOfTheExampleIsUsedAndShown) {
    const fs::path job = copy_of_example(folder() / "job").parent_path() / "job_with_fixture_budget.json";
    change_json(job, [](json& document) { document.erase("monte_carlo"); });
    const json record = record_of(job, 0);
    ASSERT_TRUE(record.is_object());
    const json& budget = record.at("rotary").at("fixture_budget");
    EXPECT_EQ(budget.at("method"), "budget");
    EXPECT_EQ(budget.at("file"), "fixture_budget.json");
    // The points file states six digits. R6.x: 160.2476 mm. MPE 0.4 µm + 1.176e-7 L as the half-width of a uniform
    // distribution; step 0.1 µm; 1.15e-5 1/K times 0.027 K and 5e-7 1/K times 0.2 K of the coordinate.
    EXPECT_EQ(budget.at("largest_coordinate"), "R6.x");
    const double L = 160247.6;
    const double u = std::sqrt(std::pow((0.4 + 1.176e-7 * L) / std::sqrt(3.0), 2) + 0.01 / 12.0 +
                               std::pow(1.15e-5 * 0.027 * L, 2) + std::pow(5e-7 * 0.2 * L, 2));
    EXPECT_NEAR(1e3 * record.at("rotary").at("reflectors")[5].at("u_cmm_mm")[0].get<double>(), u, 1e-6);
    std::map<std::string, double> contributions;
    for (const json& row : budget.at("largest")) {
        contributions[row.at("input")] = row.at("contribution");
    }
    EXPECT_NEAR(contributions["d_cmm"], (0.4 + 1.176e-7 * L) / std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(contributions["d_rep"], 0.1 / std::sqrt(12.0), 1e-6);
    EXPECT_NEAR(contributions["d_theta"], 1.15e-5 * 0.027 * L, 1e-6);
    EXPECT_NEAR(contributions["d_alpha"], 5e-7 * 0.2 * L, 1e-6);
    // Every file of the budget stands in the record with its digest.
    std::set<std::string> files;
    for (const json& file : record.at("job").at("files")) {
        files.insert(file.at("name"));
    }
    EXPECT_TRUE(files.contains("fixture_budget.json"));
    EXPECT_TRUE(files.contains("fixture_points.csv"));
}

TEST_F(RotaryDepth, EquationOfTheSourcePaperToTheDigitWithWhatIsWrongWithIt) {
    const fs::path job = six_angles_of_example(folder() / "job");
    change_json(job, [](json& document) { document["fixture"]["uncertainty"] = "source_paper"; });
    const json record = evaluate(job);
    ASSERT_TRUE(record.is_object());
    const json& rotary = record.at("rotary");
    EXPECT_EQ(rotary.at("fixture_budget").at("method"), "source_paper");
    std::string remarks;
    for (const json& remark : rotary.at("fixture_budget").at("remarks")) {
        remarks += remark.get<std::string>();
    }
    EXPECT_NE(remarks.find("3.334"), std::string::npos) << remarks;
    EXPECT_NE(remarks.find("maximum permissible error"), std::string::npos) << remarks;
    EXPECT_NE(remarks.find("cross term"), std::string::npos) << remarks;
    for (const json& reflector : rotary.at("reflectors")) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double L = 1e3 * reflector.at("cmm_mm")[c].get<double>();
            EXPECT_NEAR(1e3 * reflector.at("u_cmm_mm")[c].get<double>(), std::hypot(0.401, 3.32e-7 * L), 1e-10)
                << reflector.at("name") << c;
        }
    }
}

TEST_F(RotaryDepth, VarianceComponentsHaveTheirOwnUncertainty) {
    const json record = evaluate(six_angles_of_example(folder() / "job"));
    ASSERT_TRUE(record.is_object());
    const json& components = record.at("rotary").at("variance_components");
    std::vector<std::string> names;
    for (const json& row : components) {
        names.push_back(row.at("name"));
        EXPECT_TRUE(row.at("estimated").get<bool>()) << names.back();
        EXPECT_GT(row.at("u").get<double>(), 0.0) << names.back();
        EXPECT_LT(row.at("u").get<double>(), 0.5 * row.at("value").get<double>()) << names.back();
        // ν of a variance from the uncertainty of its root: (u(σ)/σ)² = 1/(2ν).
        const double relative = row.at("u").get<double>() / row.at("value").get<double>();
        EXPECT_NEAR(row.at("degrees_of_freedom").get<double>(), 0.5 / (relative * relative),
                    1e-6 * row.at("degrees_of_freedom").get<double>())
            << names.back();
    }
    EXPECT_EQ(names, (std::vector<std::string>{"length noise", "table linear", "table angular, axial",
                                               "table angular, tilt", "fixture CMM"}));
    EXPECT_FALSE(components.back().at("used").get<bool>()) << "check: reported and not used";
    const json& factor = record.at("rotary").at("adjustment").at("variance_factor");
    EXPECT_EQ(factor.at("a_priori"), 1);
    EXPECT_EQ(factor.at("used"), "a_priori") << "estimated components are in the weights, nothing is multiplied";
    EXPECT_NEAR(factor.at("a_posteriori").get<double>(),
                record.at("rotary").at("adjustment").at("chi_square").get<double>() /
                    record.at("rotary").at("adjustment").at("degrees_of_freedom").get<double>(),
                1e-9);
    EXPECT_FALSE(factor.at("reason").get<std::string>().empty());
}

TEST_F(RotaryDepth, FixedVariancesUseTheFactorAPriori) {
    const json record = evaluate(ExactCampaign{}.write(folder() / "job"));
    ASSERT_TRUE(record.is_object());
    const json& factor = record.at("rotary").at("adjustment").at("variance_factor");
    EXPECT_EQ(factor.at("used"), "a_priori");
    EXPECT_FALSE(factor.at("reason").get<std::string>().empty());
    for (const json& row : record.at("rotary").at("variance_components")) {
        EXPECT_FALSE(row.at("used").get<bool>() && row.at("estimated").get<bool>()) << row.at("name");
    }
}

TEST_F(RotaryDepth, PlantedOutliersAreRemovedOneAtATimeWithTheReason) {
    const auto key = [](const json& row) {
        return row.at("station").get<std::string>() + " " + row.at("reflector").get<std::string>() + " " +
               row.at("pass").get<std::string>();
    };
    std::multiset<std::string> planted;
    const json truth = json::parse(bytes_of(simulated_campaign("a_axis_outliers") / "truth.json"));
    for (const json& row : truth.at("outliers")) {
        planted.insert(key(row) + " " + digits(std::round(row.at("angle_deg").get<double>())));
    }
    ASSERT_EQ(planted.size(), 12U);
    const fs::path job = copy_of_campaign("a_axis_outliers", folder() / "job");
    for (const char* const action : {"remove", "report"}) {
        SCOPED_TRACE(action);
        change_json(job, [&](json& document) { document["outliers"] = {{"action", action}}; });
        const json record = evaluate(job);
        ASSERT_TRUE(record.is_object());
        const bool removes = std::string(action) == "remove";
        std::multiset<std::string> found;
        for (const json& row : record.at("rotary").at("flagged")) {
            found.insert(key(row) + " " + row.at("angle").get<std::string>());
            EXPECT_EQ(row.at("removed").get<bool>(), removes);
            EXPECT_FALSE(row.at("reason").get<std::string>().empty());
            EXPECT_NE(row.at("found_with").get<std::string>().find(" > "), std::string::npos);
        }
        EXPECT_EQ(found, planted);
        std::multiset<std::string> in_reliability;
        for (const json& row : record.at("rotary").at("reliability")) {
            EXPECT_EQ(row.at("removed").get<bool>(), row.at("flagged").get<bool>() && removes);
            if (row.at("flagged").get<bool>()) {
                in_reliability.insert(key(row) + " " + digits(row.at("angle_deg").get<double>()));
            }
        }
        EXPECT_EQ(in_reliability, planted);
    }
}

TEST_F(RotaryDepth, ReliabilityOfDistancesFixtureAndResults) {
    const json record = evaluate(six_angles_of_example(folder() / "job"));
    ASSERT_TRUE(record.is_object());
    const json& rotary = record.at("rotary");
    ASSERT_EQ(rotary.at("reliability").size(), 432U);
    double redundancy = 0.0;
    for (const json& row : rotary.at("reliability")) {
        redundancy += row.at("redundancy_number").get<double>();
        EXPECT_GT(row.at("minimal_detectable_bias_um").get<double>(), 0.0);
    }
    ASSERT_EQ(rotary.at("fixture_reliability").size(), 18U);
    std::set<std::string> coordinates;
    for (const json& row : rotary.at("fixture_reliability")) {
        coordinates.insert(row.at("reflector").get<std::string>() + "." + row.at("coordinate").get<std::string>());
        redundancy += row.at("redundancy_number").get<double>();
        EXPECT_GE(row.at("redundancy_number").get<double>(), 0.0);
        EXPECT_LE(row.at("redundancy_number").get<double>(), 1.0);
    }
    EXPECT_EQ(coordinates.size(), 18U);
    // All redundancy numbers add up to the degrees of freedom; 12 priors of scales, temperatures and the expansion are
    // not in these lists, and each has a number from 0 to 1.
    const double freedom = rotary.at("adjustment").at("degrees_of_freedom");
    EXPECT_LE(redundancy, freedom + 1e-6);
    EXPECT_GE(redundancy, freedom - 13.0);
    std::set<std::string> quantities;
    for (const json& row : rotary.at("external_reliability")) {
        quantities.insert(row.at("quantity"));
        EXPECT_TRUE(row.at("unit") == "um" || row.at("unit") == "arcsec") << row;
        EXPECT_TRUE(std::isfinite(row.at("influence").get<double>()));
        EXPECT_GT(row.at("ratio_to_U").get<double>(), 0.0) << row;
    }
    for (const std::string& name : k_error_motions) {
        EXPECT_TRUE(quantities.contains(name)) << name;
        EXPECT_TRUE(quantities.contains("reversal of " + name)) << name;
    }
    for (const char* const name : {"O_y", "O_z", "S_y", "S_z"}) {
        EXPECT_TRUE(quantities.contains(name)) << name;
    }
}

TEST_F(RotaryDepth, FreeScaleIsFoundWithoutStartValues) {
    ExactCampaign campaign;
    campaign.offset_y_um = 31.0;
    campaign.exa_um = 2.0;
    const fs::path job = campaign.write(folder() / "job");
    // Every displayed length, the dead path included, 5 ppm too long: s = 1 + 5e-6.
    std::string lengths;
    for (const std::string& line : lines_of(bytes_of(job.parent_path() / "lengths.csv"))) {
        const std::size_t last = line.rfind(',');
        const std::size_t before = line.rfind(',', last - 1);
        if (lengths.empty()) {
            lengths = line + "\n";
            continue;
        }
        double length = 0.0;
        std::from_chars(line.data() + before + 1, line.data() + last, length);
        lengths += line.substr(0, before + 1) + digits((length + 0.2) * (1.0 + 5e-6) - 0.2) + line.substr(last) + "\n";
    }
    write_bytes(job.parent_path() / "lengths.csv", lengths);
    change_json(job, [](json& document) { document["length_uncertainty"]["scale_model"] = "free"; });
    const json record = evaluate(job);
    ASSERT_TRUE(record.is_object());
    for (const json& station : record.at("rotary").at("stations")) {
        EXPECT_NEAR(station.at("scale_deviation").get<double>(), 5e-6, 1e-9) << station.at("name");
        EXPECT_GT(station.at("u_scale").get<double>(), 1e-7) << station.at("name");
    }
    EXPECT_NEAR(record.at("rotary").at("set_up").at("O_um")[1].get<double>(), 31.0, 1e-3);
    EXPECT_NEAR(record.at("rotary").at("errors")[1].at("EXA").at("value").get<double>(),
                2.0 * std::sin(std::numbers::pi / 3.0), 1e-3);
}

TEST_F(RotaryDepth, ADeadPathForEveryReflectorNeedsNoStartValues) {
    ExactCampaign campaign;
    campaign.tilt_z_arcsec = -25.0;
    campaign.eaa_arcsec = 4.0;
    const fs::path job = campaign.write(folder() / "job");
    // The beam was broken between reflectors: a constant of its own for each pair, 10 µm more from one to the next.
    std::string lengths;
    for (const std::string& line : lines_of(bytes_of(job.parent_path() / "lengths.csv"))) {
        if (lengths.empty()) {
            lengths = line + "\n";
            continue;
        }
        const std::size_t last = line.rfind(',');
        const std::size_t before = line.rfind(',', last - 1);
        const int reflector = line[4] - '0';
        double length = 0.0;
        std::from_chars(line.data() + before + 1, line.data() + last, length);
        lengths += line.substr(0, before + 1) + digits(length - 0.01 * reflector) + line.substr(last) + "-" +
                   line.substr(3, 2) + "\n";
    }
    write_bytes(job.parent_path() / "lengths.csv", lengths);
    const json record = evaluate(job);
    ASSERT_TRUE(record.is_object());
    const json& dead_paths = record.at("rotary").at("dead_paths");
    ASSERT_EQ(dead_paths.size(), 36U);
    for (const json& dead_path : dead_paths) {
        const int reflector = dead_path.at("name").get<std::string>().back() - '0';
        EXPECT_NEAR(dead_path.at("value_mm").get<double>(), 0.2 + 0.01 * reflector, 1e-6) << dead_path.at("name");
    }
    for (std::size_t j = 0; j < campaign.stations.size(); ++j) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(record.at("rotary").at("stations")[j].at("position_mm")[c].get<double>(),
                        campaign.stations[j][c], 1e-5);
        }
    }
    EXPECT_NEAR(record.at("rotary").at("set_up").at("S_arcsec")[2].get<double>(), -25.0, 1e-3);
    EXPECT_NEAR(record.at("rotary").at("errors")[1].at("EAA").at("value").get<double>(),
                4.0 * std::sin(std::numbers::pi / 3.0), 1e-3);
}

TEST_F(RotaryDepth, LessThanHalfATurnIsAWarning) {
    const fs::path job = ExactCampaign{}.write(folder() / "job");
    const auto keep_up_to = [&](int last_angle) {
        std::string lengths;
        for (const std::string& line : lines_of(bytes_of(job.parent_path() / "lengths.csv"))) {
            static const std::regex fifth("(?:[^,]*,){4}([0-9]+).*");
            std::smatch angle;
            if (lengths.empty() || (std::regex_match(line, angle, fifth) && std::stoi(angle[1].str()) <= last_angle)) {
                lengths += line + "\n";
            }
        }
        write_bytes(job.parent_path() / "lengths.csv", lengths);
    };
    const auto warns = [&] {
        const Ended ended =
            gumcert({"evaluate", job.string(), "-o", (folder() / "record.json").string(), "--json-messages", "-q"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        const std::vector<Message> messages = json_messages(ended);
        return std::any_of(messages.begin(), messages.end(), [](const Message& m) {
            return m.severity == "warning" && m.what.find("the angles span") != std::string::npos;
        });
    };
    EXPECT_FALSE(warns());
    keep_up_to(180);
    EXPECT_FALSE(warns()) << "half a turn";
    keep_up_to(150);
    EXPECT_TRUE(warns());
}

// The fixture frame is defined at the home angle: the same distances with all angle readings 90° larger and the home
// angle at 90° are the same measurement.
TEST_F(RotaryDepth, HomeAngleIsOnlyWhereTheReadingsBegin) {
    ExactCampaign campaign;
    campaign.offset_z_um = -22.0;
    campaign.tilt_y_arcsec = 14.0;
    campaign.exa_um = 2.0;
    const json at_zero = evaluate(campaign.write(folder() / "zero"));
    const fs::path job = campaign.write(folder() / "ninety");
    std::string lengths;
    for (const std::string& line : lines_of(bytes_of(job.parent_path() / "lengths.csv"))) {
        static const std::regex parts("((?:[^,]*,){4})([0-9]+)(,.*)");
        std::smatch found;
        lengths += std::regex_match(line, found, parts)
                       ? found[1].str() + std::to_string(std::stoi(found[2].str()) + 90) + found[3].str() + "\n"
                       : line + "\n";
    }
    write_bytes(job.parent_path() / "lengths.csv", lengths);
    for (const char* const datum : {"axis_average_line", "home"}) {
        change_json(job, [&](json& document) { document["home_angle_deg"] = 90, document["datum"] = datum; });
        const json at_ninety = evaluate(job);
        ASSERT_TRUE(at_zero.is_object() && at_ninety.is_object());
        EXPECT_EQ(at_ninety.at("rotary").at("home_angle_deg"), 90);
        EXPECT_NEAR(at_ninety.at("rotary").at("set_up").at("O_um")[2].get<double>(), -22.0, 1e-3);
        EXPECT_NEAR(at_ninety.at("rotary").at("set_up").at("S_arcsec")[1].get<double>(), 14.0, 1e-3);
        for (std::size_t i = 0; i < campaign.angles; ++i) {
            const json& row = at_ninety.at("rotary").at("errors")[i];
            EXPECT_DOUBLE_EQ(row.at("angle_deg").get<double>(), campaign.angle_deg(i) + 90.0);
            EXPECT_NEAR(row.at("EXA").at("value").get<double>(),
                        at_zero.at("rotary").at("errors")[i].at("EXA").at("value").get<double>(), 1e-3);
        }
        if (std::string(datum) == "home") {
            EXPECT_EQ(at_ninety.at("rotary").at("errors")[0].at("EXA").at("u").get<double>(), 0.0);
        }
    }
}

/// `simulate` and `plan`, each with a small job.
class Study : public ProgramTest {
protected:
    void SetUp() override {
        (void)copy_of_example(folder() / "job");
        const auto change = [&](const std::string& name, const std::function<void(json&)>& to) {
            json document = json::parse(bytes_of(folder() / "job" / name), nullptr, true, true);
            to(document);
            write_bytes(folder() / "job" / name, document.dump(1));
        };
        change("simulation.json", [](json& document) {
            document["simulation"]["runs"] = 2;
            document["simulation"]["seed"] = 1;
            document["simulation"]["error_linear_um"] = 10;
            document["simulation"]["angle_counts"] = {6};
        });
        change("plan.json", [](json& document) {
            document["plan"]["angles_deg"] = {{"first", 0}, {"step", 60}, {"count", 6}};
            document["plan"]["station_region"]["step_mm"] = 900;
        });
    }
    [[nodiscard]] std::string job(const std::string& command) const {
        return (folder() / "job" / (command == "plan" ? "plan.json" : "simulation.json")).string();
    }
    [[nodiscard]] std::string out(const std::string& name) const { return (folder() / name).string(); }
};

TEST_F(Study, WrongCommandsAreRefusedAndNothingIsWritten) {
    const std::string plan = job("plan");
    const std::string simulation = job("simulate");
    const std::vector<std::vector<std::string>> wrong{{"plan"},
                                                      {"simulate"},
                                                      {"plan", plan, "-o"},
                                                      {"plan", plan, "-o", "out.odt"},
                                                      {"plan", plan, "-o", "out"},
                                                      {"plan", plan, "--runs", "3"},
                                                      {"plan", plan, "another.json"},
                                                      {"plan", plan, "--threads", "0"},
                                                      {"simulate", simulation, "-o", "out.csv"},
                                                      {"simulate", simulation, "--runs", "0"},
                                                      {"simulate", simulation, "--runs", "-3"},
                                                      {"simulate", simulation, "--runs", "1000001"},
                                                      {"simulate", simulation, "--runs", "1e3"},
                                                      {"simulate", simulation, "--runs", "ten"},
                                                      {"simulate", simulation, "--seed", "-1"},
                                                      {"simulate", simulation, "--seed", "one"},
                                                      {"simulate", simulation, "--seed", "9007199254740993"},
                                                      {"simulate", simulation, "--seed", "18446744073709551616"},
                                                      {"simulate", simulation, "--frobnicate"}};
    const auto before = contents_of(folder());
    for (const std::vector<std::string>& arguments : wrong) {
        std::string command = "gumcert";
        for (const std::string& argument : arguments) {
            command += " " + argument;
        }
        SCOPED_TRACE(command);
        const Ended ended = gumcert(arguments, {.working_folder = folder(), .environment = {}, .out = {}});
        EXPECT_EQ(ended.code, 2);
        EXPECT_TRUE(ended.out.empty());
        const std::vector<std::string> lines = lines_of(ended.err);
        EXPECT_EQ(lines.size(), 1U) << ended.err;
        if (lines.empty()) {
            continue;
        }
        EXPECT_TRUE(is_message_line(lines[0])) << lines[0];
        EXPECT_TRUE(lines[0].ends_with("[GC-USAGE-0001]")) << lines[0];
        EXPECT_EQ(contents_of(folder()), before);
    }
}

TEST_F(Study, RefusedInputsWriteNothing) {
    // What is changed in both jobs, the exit code, and a word of the message.
    struct Case {
        std::string command;
        std::function<void(json&)> change;
        int code;
        std::string word;
    };
    const auto without_comments = [&](const std::string& command) {
        return json::parse(bytes_of(job(command)), nullptr, true, true);
    };
    const std::vector<Case> cases{
        {"plan",
         [](json& j) {
             j["plan"]["angles_deg"] = {{"first", 0}, {"step", 1e-7}, {"count", 1000000000}};
         },
         3, "/plan/angles_deg/count"},
        {"plan",
         [](json& j) {
             j["plan"]["angles_deg"] = {{"first", 0}, {"step", 0}, {"count", 36}};
         },
         3, "/plan/angles_deg/step"},
        {"plan", [](json& j) { j["plan"]["angles_deg"] = json::array(); }, 3, "/plan/angles_deg"},
        {"plan",
         [](json& j) {
             j["plan"]["angles_deg"] = {0, 10, 10, 20};
         },
         3, "10°"},
        {"plan",
         [](json& j) {
             j["plan"]["angles_deg"] = {5, 10, 20};
         },
         3, "/home_angle_deg"},
        {"plan",
         [](json& j) {
             j["plan"]["station_region"]["x_mm"] = {1300, 400};
         },
         3, "/station_region/x_mm"},
        {"plan",
         [](json& j) {
             j["plan"]["station_region"]["x_mm"] = {-1e300, 1e300};
         },
         3, "/station_region/x_mm"},
        {"plan", [](json& j) { j["plan"]["station_region"]["step_mm"] = 1e-9; }, 3, "/station_region/step_mm"},
        {"plan", [](json& j) { j["plan"]["station_region"]["step_mm"] = 0; }, 3, "/station_region/step_mm"},
        {"plan", [](json& j) { j["plan"]["least_distance_mm"] = -5; }, 3, "/plan/least_distance_mm"},
        {"plan", [](json& j) { j["plan"]["targets"]["linear_um"] = 0; }, 3, "/plan/targets/linear_um"},
        {"plan", [](json& j) { j["plan"]["seeds"] = 1; }, 3, "seeds"},
        {"plan", [](json& j) { j["observations"].erase("stations"); }, 3, "stations"},
        {"plan",
         [](json& j) {
             j["plan"]["angles_deg"] = {0, 120};
         },
         4, "angles"},
        {"simulate", [](json& j) { j["simulation"]["runs"] = 1e12; }, 3, "/simulation/runs"},
        {"simulate", [](json& j) { j["simulation"]["error_linear_um"] = 1e300; }, 3, "/simulation/error_linear_um"},
        {"simulate", [](json& j) { j["simulation"]["angle_counts"] = {2}; }, 3, "/simulation/angle_counts/0"},
        {"simulate", [](json& j) { j["simulation"]["angle_counts"] = {36001}; }, 3, "/simulation/angle_counts/0"},
        {"simulate", [](json& j) { j["simulation"]["outliers"]["count"] = -1; }, 3, "/simulation/outliers/count"},
        {"simulate", [](json& j) { j["simulation"]["table_repeatability"].erase("u_axial_arcsec"); }, 3,
         "u_axial_arcsec"},
        {"simulate", [](json& j) { j["observations"]["stations"] = "nowhere.csv"; }, 5, "nowhere.csv"}};
    for (const Case& c : cases) {
        json document = without_comments(c.command);
        c.change(document);
        const fs::path changed = folder() / "job" / "changed.json";
        write_bytes(changed, document.dump(1));
        SCOPED_TRACE(c.command + " " + c.word);
        const auto before = contents_of(folder());
        const Ended ended = gumcert({c.command, changed.string(), "-o", out("out.json"), "--json-messages"});
        EXPECT_EQ(ended.code, c.code) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(contents_of(folder()), before);
        EXPECT_NE(ended.err.find(c.word), std::string::npos) << ended.err;
        EXPECT_FALSE(json_messages(ended).empty());
    }
    // NaN is no JSON number, wherever it stands.
    replace_in(job("simulate"), "\"error_linear_um\": 10", "\"error_linear_um\": NaN");
    const Ended ended = gumcert({"simulate", job("simulate"), "-o", out("out.json")});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("/simulation/error_linear_um"), std::string::npos) << ended.err;
}

TEST_F(Study, OtherKindsAndMissingFiles) {
    for (const char* const command : {"plan", "simulate"}) {
        const Ended budget = gumcert({command, (folder() / "job" / "fixture_budget.json").string()});
        EXPECT_EQ(budget.code, 3);
        EXPECT_NE(budget.err.find("rotary_table"), std::string::npos) << budget.err;
        const Ended missing = gumcert({command, out("missing.json")});
        EXPECT_EQ(missing.code, 5);
        EXPECT_NE(missing.err.find("missing.json"), std::string::npos) << missing.err;
        EXPECT_TRUE(is_message_line(lines_of(missing.err).at(0))) << missing.err;
    }
    // A layout without lengths is no measurement.
    const Ended ended = gumcert({"evaluate", job("plan"), "-o", out("record.json")});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("lengths"), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(out("record.json")));
}

TEST_F(Study, InputsAreNeverOverwritten) {
    change_json(folder() / "job" / "job.json", [](json& document) {
        document["fixture"]["budget"] = "fixture_budget.json";
        document["simulation"] = {{"runs", 2}, {"angle_counts", {6}}};
        document["plan"] = {{"angles_deg", {0, 60, 120, 180, 240, 300}}};
    });
    const auto before = contents_of(folder());
    for (const char* const command : {"plan", "simulate"}) {
        for (const char* const input : {"job.json", "fixture_budget.json", "../job/./job.json"}) {
            SCOPED_TRACE(std::string(command) + " -o " + input);
            const Ended ended =
                gumcert({command, (folder() / "job" / "job.json").string(), "-o", (folder() / "job" / input).string()});
            EXPECT_EQ(ended.code, 5) << ended.err;
            EXPECT_NE(ended.err.find("overwritten"), std::string::npos) << ended.err;
            EXPECT_EQ(contents_of(folder()), before);
        }
    }
}

TEST_F(Study, AllFourFormsAndQuiet) {
    for (const std::string command : {"plan", "simulate"}) {
        SCOPED_TRACE(command);
        const Ended text = gumcert({command, job(command)});
        ASSERT_EQ(text.code, 0) << text.err;
        const std::map<std::string, std::string> begins{
            {"txt", "="}, {"json", "{"}, {"html", "<!DOCTYPE html>"}, {"pdf", "%PDF-"}};
        for (const auto& [ending, first] : begins) {
            if (ending == "pdf" && !why_no_pdf().empty()) {
                continue;
            }
            const std::string file = out(command + "." + ending);
            const Ended ended = gumcert({command, job(command), "-o", file, "--share", GUMCERT_SOURCE_DIR, "--quiet"});
            ASSERT_EQ(ended.code, 0) << ended.err;
            EXPECT_EQ(ended.out, "") << "--quiet";
            EXPECT_TRUE(bytes_of(file).starts_with(first)) << bytes_of(file).substr(0, 40);
        }
        EXPECT_EQ(bytes_of(out(command + ".txt")), text.out);
        for (const char* const word : {"nan", "inf ", "{{"}) {
            EXPECT_EQ(text.out.find(word), std::string::npos) << word;
        }
    }
}

TEST_F(Study, RunsAndSeedOfTheCommandLineStandAboveTheJob) {
    const auto study = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"simulate", job("simulate"), "-o", out("study.json")});
        const Ended ended = gumcert(more);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(bytes_of(out("study.json")));
    };
    const json as_job = study({});
    EXPECT_EQ(as_job.at("runs"), 2);
    EXPECT_EQ(as_job.at("seed"), 1);
    const json other = study({"--runs", "3", "--seed", "9007199254740992"});
    EXPECT_EQ(other.at("runs"), 3);
    EXPECT_EQ(other.at("seed"), 9007199254740992);
    EXPECT_EQ(study({"--seed", "1"}).dump(), as_job.dump());
}

}  // namespace
}  // namespace gumcert::cli
