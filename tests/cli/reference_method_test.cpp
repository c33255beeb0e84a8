// A rotary table against a reference method as a user meets it: the tables of docs/comparison_with_a_dial_indicator.md
// from the simulated campaigns, the shipped budget of the indicator, and what is refused.
#include <cmath>
#include <map>
#include <vector>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path simulated_campaigns() {
    return fs::path(GUMCERT_SOURCE_DIR) / "tests" / "reference" / "campaigns";
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The cells of a row of a table in Markdown.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t at = 1; at < line.size();) {
        const std::size_t end = std::min(line.find('|', at), line.size());
        cells.push_back(trimmed(line.substr(at, end - at)));
        at = end + 1;
    }
    return cells;
}

/// The rows of every table of the document, by the heading above it.
std::map<std::string, std::vector<std::vector<std::string>>> tables_of_document() {
    std::map<std::string, std::vector<std::vector<std::string>>> tables;
    std::string heading;
    for (const std::string& line :
         lines_of(bytes_of(fs::path(GUMCERT_SOURCE_DIR) / "docs/comparison_with_a_dial_indicator.md"))) {
        if (line.starts_with("## ")) {
            heading = line.substr(3);
        } else if (line.starts_with("| ") && !line.starts_with("| set |")) {
            tables[heading].push_back(cells_of(line));
        }
    }
    return tables;
}

class ReferenceMethod : public ProgramTest {
protected:
    /// The comparison of a simulated campaign.
    /// \param change  of its reference_method
    json comparison_of(const std::string& name, const std::function<void(json&, const fs::path&)>& change) const {
        const fs::path job_folder = folder() / name;
        for (const fs::directory_entry& entry : fs::directory_iterator(simulated_campaigns() / name)) {
            write_bytes(job_folder / entry.path().filename(), bytes_of(entry.path()));
        }
        change_json(job_folder / "job.json", [&](json& job) {
            json& method = job.at("reference_method");
            method["published"] = {{"source", "a paper"}, {"mean_abs_En", {{"x", 0.77}, {"y", 0.39}, {"z", 0.32}}}};
            change(method, job_folder);
        });
        return comparison_of(job_folder / "job.json");
    }
    json comparison_of(const fs::path& job) const {
        const fs::path record = folder() / "comparison" / "record.json";
        const Ended ended = gumcert({"evaluate", job.string(), "-o", record.string()});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(bytes_of(record)).at("comparison");
    }
};

/// What a row of the document prints of one direction of one campaign.
std::vector<std::string> row_of(const std::string& name, const std::string& direction, const json& summary) {
    static const std::map<std::string, std::string> k_verdicts{
        {"disagreement", "disagreement"},
        {"side_refuted", "no verdict, a side is refuted"},
        {"points_above_1", "more points above 1 than by chance"},
        {"correlation_unknown", "agreement only if nothing is shared"},
        {"reference_not_better", "no proof: reference not better"},
        {"uncertainty_too_large", "uncertainty too large"},
        {"agreement_few_points", "agreement, too few points"},
        {"uncertainty_not_confirmed", "agreement, uncertainty not confirmed"},
        {"agreement_reference_limited", "agreement, limited by the reference"},
        {"validated", "validated"}};
    const json& printed = summary.at("printed");
    const auto text = [&](const char* key) { return printed.at(key).get<std::string>(); };
    const std::string published = text("published_mean_abs_En");
    return {name,
            direction,
            published.empty() ? "–" : published,
            text("mean_abs_En"),
            text("max_abs_En"),
            std::to_string(summary.at("count_above_1").get<int>()),
            text("rms_En"),
            text("rms_En_low") + " to " + text("rms_En_high"),
            text("p_low"),
            text("p_high"),
            text("D_fail"),
            text("ratio_reference"),
            std::to_string(summary.at("points").get<int>()),
            text("effective_points"),
            text("max_abs_En_worst"),
            k_verdicts.at(summary.at("verdict").get<std::string>())};
}

TEST_F(ReferenceMethod, SimulatedCampaignsGiveTheTablesOfTheDocument) {
    struct Variant {
        std::string heading;
        std::function<void(json&, const fs::path&)> change;
    };
    const std::vector<Variant> variants{
        {"The indicator as it is described", [](json&, const fs::path&) {}},
        {"The same MPE, as an error of each point apart",
         [](json&, const fs::path& job_folder) {
             change_json(job_folder / "dial_indicator.json", [](json& indicator) { indicator["mpe_common"] = false; });
         }},
        {"A calibrated indicator with its own budget", [](json& method, const fs::path& job_folder) {
             method["budget"] = "budget.json";
             write_bytes(job_folder / "budget.json", bytes_of(shipped_example() / "dial_indicator_budget.json"));
         }}};
    const auto tables = tables_of_document();
    const std::vector<std::string> names{"a_axis", "a_axis_outliers", "b_axis_perfect_table", "c_axis_single_target"};
    for (const Variant& variant : variants) {
        const auto& rows = tables.at(variant.heading);
        ASSERT_EQ(rows.size(), 4 * names.size()) << variant.heading;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const json comparison = comparison_of(names[i], variant.change);
            const std::vector<std::string> directions{"x", "y", "z", "all"};
            for (std::size_t d = 0; d < directions.size(); ++d) {
                EXPECT_EQ(rows[4 * i + d], row_of(names[i], directions[d], comparison.at("summary").at(directions[d])))
                    << variant.heading;
            }
            if (&variant != &variants.front()) {
                continue;
            }
            for (std::size_t d = 0; d < 3; ++d) {
                const auto& bias_row = tables.at("The bias line, and why the gain error is not in it")[3 * i + d];
                const json& bias = comparison.at("summary").at(directions[d]).at("bias").at("printed");
                EXPECT_EQ(bias_row[2],
                          bias.at("slope").get<std::string>() + " ± " + bias.at("U_slope").get<std::string>());
                EXPECT_EQ(bias_row[3], bias.at("p_value").get<std::string>());
            }
        }
    }
}

TEST_F(ReferenceMethod, ShippedBudgetOfTheIndicatorHoldsAtEveryPoint) {
    const fs::path job = copy_of_example(folder() / "job").parent_path() / "job_with_reference_budget.json";
    const json comparison = comparison_of(job);
    EXPECT_EQ(comparison.at("correlation"), "unknown");
    ASSERT_EQ(comparison.at("points").size(), 108U);
    for (const json& point : comparison.at("points")) {
        // By hand: gain within 2 %, calibration U = 0.2 µm with k = 2, step 0.1 µm, repeatability 0.177 µm.
        const double gain = 0.02 / std::sqrt(3.0) * point.at("reference_value").get<double>();
        const double u = std::sqrt(gain * gain + 0.1 * 0.1 + 0.1 * 0.1 / 12.0 + 0.177 * 0.177);
        EXPECT_NEAR(point.at("reference_u").get<double>(), u, 1e-12);
        EXPECT_TRUE(point.at("En_worst").is_number());
    }
    EXPECT_EQ(comparison.at("reference_budget").size(), 5U);
    const json record = json::parse(bytes_of(folder() / "comparison" / "record.json"));
    EXPECT_NE(record.at("job").at("files").dump().find("dial_indicator_budget.json"), std::string::npos);
}

TEST_F(ReferenceMethod, ProblemsOfAllFilesAreToldTogether) {
    const fs::path job = copy_of_example(folder() / "job").parent_path() / "job_with_reference_budget.json";
    change_json(job, [](json& document) {
        document["reference_method"]["correlation"] = 2;
        document["reference_method"]["published"] = {{"source", "a paper"}, {"mean_abs_En", {{"v", 1}}}};
        document["reference_method"]["audited"] = {{"factor", -1}, {"finding", "f"}};
    });
    replace_in(job.parent_path() / "dial_indicator_budget.json", "\"reading\": {", "\"indication\": {");
    replace_in(job.parent_path() / "dial_indicator_budget.json", "X = reading", "X = indication");
    const Ended ended = gumcert({"evaluate", job.string(), "-o", "-"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(ended.out, "");
    for (const char* const text :
         {"#/reference_method/correlation", "#/reference_method/published/mean_abs_En/v",
          "#/reference_method/audited/factor", "dial_indicator_budget.json#/inputs", "[GC-REFERENCE-0002]"}) {
        EXPECT_NE(ended.err.find(text), std::string::npos) << text << "\n" << ended.err;
    }
}

TEST_F(ReferenceMethod, BudgetThatIsNotThereIsTold) {
    const fs::path job = copy_of_example(folder() / "job").parent_path() / "job_with_reference_budget.json";
    fs::remove(job.parent_path() / "dial_indicator_budget.json");
    const Ended ended = gumcert({"evaluate", job.string(), "-o", "-"});
    EXPECT_EQ(ended.code, 5);
    EXPECT_NE(ended.err.find("dial_indicator_budget.json"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace gumcert::cli
