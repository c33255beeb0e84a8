// The record and the documents of the shipped example against section 6 of the contract.
#include <charconv>
#include <cmath>
#include <set>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"
#include "tests/support/json_schema.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

constexpr std::size_t k_angles = 36;
constexpr std::size_t k_distances = 2592;

double number(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_TRUE(error == std::errc{} && end == text.data() + text.size()) << '"' << text << '"';
    return value;
}

class Record : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const ExampleRun& run = ExampleRun::shared();
        ASSERT_EQ(run.ended().code, 0) << run.ended().err;
        record_ = json::parse(bytes_of(run.folder() / "record.json"));
    }
    static void TearDownTestSuite() { record_ = {}; }
    void SetUp() override { ASSERT_TRUE(record_.is_object()); }

    static const json& rotary() { return record_["rotary"]; }

    static json record_;
};

json Record::record_;

TEST_F(Record, RunWritesTheDocumentsAndNothingElse) {
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf() << ": gumcert run was not tested";
    }
    const ExampleRun& run = ExampleRun::shared();
    std::set<std::string> names;
    for (const auto& [name, bytes] : contents_of(run.folder())) {
        names.insert(name);
    }
    EXPECT_EQ(names.erase(".gumcert-set.json"), 1U) << "the manifest, which people do not look at";
    EXPECT_EQ(names, (std::set<std::string>{"audit.html", "certificate.html", "certificate.pdf", "certificate.xml",
                                            "covariance.csv", "record.json"}));
    const std::string html = bytes_of(run.folder() / "certificate.html");
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>") || html.starts_with("<!doctype html>")) << html.substr(0, 80);
    EXPECT_NE(html.find("</html>"), std::string::npos);
    const std::string pdf = bytes_of(run.folder() / "certificate.pdf");
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos);
    for (const std::string& name : names) {
        EXPECT_NE(run.ended().out.find((run.folder() / name).string()), std::string::npos) << run.ended().out;
    }
}

TEST_F(Record, ValidatesAgainstTheSchema) {
    EXPECT_EQ(test::JsonSchema("record-1.schema.json").refusals(record_), "");
}

TEST_F(Record, IsCanonicalJson) {
    const std::string bytes = bytes_of(ExampleRun::shared().folder() / "record.json");
    EXPECT_EQ(bytes.find('\r'), std::string::npos);
    EXPECT_TRUE(bytes.ends_with("}\n"));
    EXPECT_EQ(bytes.find("NaN"), std::string::npos);
    EXPECT_EQ(bytes.find("nfinity"), std::string::npos);
}

TEST_F(Record, NamesProgramJobAndOptions) {
    EXPECT_EQ(record_["schema"], "gumcert/record/1");
    EXPECT_EQ(record_["kind"], "rotary_table");
    EXPECT_EQ(record_["coverage_probability"], 0.9545);
    EXPECT_EQ(record_["software"]["name"], "gumcert");
    EXPECT_TRUE(record_["software"]["version"].is_string());
    EXPECT_TRUE(record_["software"]["commit"].is_string());
    EXPECT_EQ(record_["job"]["document"], json::parse(bytes_of(shipped_example() / "job.json")));
    EXPECT_TRUE(record_["options"].is_object());
    EXPECT_TRUE(record_["options"]["solver"]["step_tolerance"].is_number());
    EXPECT_TRUE(record_["diagnostics"].is_array());
    EXPECT_EQ(record_["audit"]["schema"], "gumcert/audit/1");
}

TEST_F(Record, DigestsAreThoseOfTheFiles) {
    const std::set<std::string> expected{"job.json",    "lengths.csv",        "stations.csv",       "environment.csv",
                                         "fixture.csv", "dial_indicator.csv", "dial_indicator.json"};
    std::set<std::string> names;
    const fs::path other = on_search_path("sha256sum");
    TemporaryFolder scratch;
    for (const json& file : record_["job"]["files"]) {
        const std::string name = file["name"];
        names.insert(name);
        const std::string digest = file["sha256"];
        EXPECT_EQ(digest.size(), 64U);
        if (!other.empty()) {
            const Ended second = run_process(other, {(shipped_example() / name).string()}, {}, scratch.path());
            EXPECT_EQ(second.out.substr(0, 64), digest) << name;
        }
    }
    EXPECT_EQ(names, expected);
    if (other.empty()) {
        GTEST_SKIP() << "sha256sum is not installed: the digests were not compared";
    }
}

TEST_F(Record, ErrorMotionsOfEveryAngle) {
    const json& errors = rotary()["errors"];
    ASSERT_EQ(errors.size(), k_angles);
    for (std::size_t i = 0; i < k_angles; ++i) {
        EXPECT_EQ(errors[i]["angle_deg"], 10.0 * static_cast<double>(i));
        for (const std::string& name : k_error_motions) {
            const json& motion = errors[i].at(name);
            for (const char* const key : {"value", "u", "U", "k"}) {
                ASSERT_TRUE(motion.at(key).is_number()) << name << " " << key;
            }
            EXPECT_TRUE(motion.at("nu_eff").is_number() || motion.at("nu_eff").is_null());
            const double u = motion["u"];
            const double U = motion["U"];
            const double k = motion["k"];
            EXPECT_GT(u, 0.0);
            EXPECT_NEAR(U, k * u, 1e-12 * U);
            EXPECT_GE(k, 2.0 - 1e-3) << "k of 95.45 %";
            EXPECT_EQ(motion["printed"]["unit"], name[1] == 'X' || name[1] == 'Y' || name[1] == 'Z' ? "µm" : "″");
        }
    }
    EXPECT_EQ(rotary()["error_names"], json(k_error_motions));
    EXPECT_EQ(rotary()["datum"], "axis_average_line");
    EXPECT_EQ(rotary()["method"], "joint");
    EXPECT_EQ(rotary()["axis"], "A");
}

/// Digits after the point of a printed number.
std::size_t decimals(const std::string& text) {
    const std::size_t point = text.find('.');
    return point == std::string::npos ? 0 : text.size() - point - 1;
}

void expect_printed(const json& value) {
    const json& printed = value["printed"];
    const std::string text = printed["value"];
    const std::string U = printed["U"];
    EXPECT_EQ(decimals(text), decimals(U)) << text << " ± " << U;
    const double half_digit = 0.5000001 * std::pow(10.0, -static_cast<double>(decimals(text)));
    std::string sign_read = text;
    if (sign_read.starts_with("−")) {  // U+2212
        sign_read.replace(0, std::string("−").size(), "-");
    }
    EXPECT_NEAR(number(sign_read), value["value"].get<double>(), half_digit);
    EXPECT_NEAR(number(U), value["U"].get<double>(), 2.0 * half_digit) << "half a digit, or one when rounded upwards";
}

TEST_F(Record, PrintedNumbersAreTheNumbersRoundedToTheUncertainty) {
    for (const json& row : rotary()["errors"]) {
        for (const std::string& name : k_error_motions) {
            SCOPED_TRACE(name + " at " + row["printed_angle"].get<std::string>());
            expect_printed(row[name]);
        }
    }
    for (const auto& [name, result] : record_["results"].items()) {
        SCOPED_TRACE(name);
        expect_printed(result);
    }
    for (const json& row : rotary()["ranges"]) {
        SCOPED_TRACE(row["name"].get<std::string>());
        expect_printed(row);
    }
}

TEST_F(Record, AxisInFixtureHasTheOppositeSign) {
    const json& set_up = rotary()["set_up"];
    const json& axis = rotary()["axis_in_fixture"];
    const auto negative = [](const json& numbers) {
        std::vector<double> result;
        for (const json& n : numbers) {
            result.push_back(-n.get<double>());
        }
        return result;
    };
    for (const char* const key : {"O_um", "S_arcsec"}) {
        ASSERT_EQ(set_up[key].size(), 3U);
        const auto expected = negative(set_up[key]);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(axis[key][c].get<double>(), expected[c]) << key;
        }
        EXPECT_EQ(set_up[key][0].get<double>(), 0.0) << "nothing along the axis";
        EXPECT_NE(set_up[key][1].get<double>(), 0.0);
        EXPECT_NE(set_up[key][2].get<double>(), 0.0);
    }
    for (const char* const key : {"u_O_um", "u_S_arcsec", "U_O_um", "U_S_arcsec", "k"}) {
        EXPECT_EQ(set_up[key], axis[key]) << key;
    }
    EXPECT_EQ(set_up["O_um"][1], record_["results"]["O_y"]["value"]);
    EXPECT_EQ(set_up["O_um"][2], record_["results"]["O_z"]["value"]);
    EXPECT_EQ(set_up["S_arcsec"][1], record_["results"]["S_y"]["value"]);
    EXPECT_EQ(set_up["S_arcsec"][2], record_["results"]["S_z"]["value"]);
    EXPECT_EQ(set_up["U_O_um"][1], record_["results"]["O_y"]["U"]);
    EXPECT_EQ(set_up["U_S_arcsec"][2], record_["results"]["S_z"]["U"]);
}

TEST_F(Record, PositioningHasNumbersUnderTheNamesOfTheContract) {
    const json& p = rotary()["iso230_2"];
    ASSERT_TRUE(p.is_object());
    EXPECT_EQ(p["unit"], "arcsec");
    ASSERT_FALSE(p["parameters"].empty());
    for (const json& parameter : p["parameters"]) {
        const std::string name = parameter["name"];
        SCOPED_TRACE(name);
        EXPECT_EQ(p.at(name), parameter["value"]);
        EXPECT_EQ(p["U"].at(name), parameter["U"]);
        expect_printed(parameter);
    }
    for (const char* const name : {"M", "E_up", "E_down", "B_mean"}) {
        EXPECT_TRUE(p.contains(name)) << name << " needs runs in both senses, which the example has";
    }
    // M is the range of the means of both senses, hence not above the range of all means (ISO 230-2).
    EXPECT_LE(p["M"].get<double>(), p["E"].get<double>());
}

TEST_F(Record, LayoutOfTheCertificateComesFromTheRecord) {
    for (const json& station : rotary()["stations"]) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double u = station["u_mm"][c];
            EXPECT_NEAR(station["covariance_mm2"][c][c].get<double>(), u * u, 1e-9 * u * u);
        }
    }
    for (const json& reflector : rotary()["reflectors"]) {
        double apart = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double home = reflector["home_position_mm"][c];
            apart = std::max(apart, std::abs(home - reflector["position_mm"][c].get<double>()));
        }
        EXPECT_LT(apart, 1.0) << "the set-up moves the fixture by less than a millimetre";
    }
}

TEST_F(Record, CovarianceFileBelongsToTheRecord) {
    const json& about = rotary()["covariance"];
    const std::vector<std::string> lines =
        lines_of(bytes_of(ExampleRun::shared().folder() / about["file"].get<std::string>()));
    const auto cells = [](const std::string& line) {
        std::vector<std::string> result;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) {
            result.push_back(cell);
        }
        return result;
    };
    ASSERT_FALSE(lines.empty());
    const std::vector<std::string> order = cells(lines[0]);
    EXPECT_EQ(json(order), about["order"]);
    ASSERT_EQ(lines.size(), order.size() + 1);
    std::vector<std::vector<double>> matrix;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::vector<std::string> row = cells(lines[i]);
        ASSERT_EQ(row.size(), order.size()) << "row " << i;
        matrix.emplace_back();
        for (const std::string& cell : row) {
            matrix.back().push_back(number(cell));
        }
    }
    // u of every quantity that the record names, in the units of the record.
    std::map<std::string, double> u;
    for (const json& row : rotary()["errors"]) {
        for (const std::string& name : k_error_motions) {
            u[name + "@" + digits(row["angle_deg"])] = row[name]["u"];
        }
    }
    for (const auto& [name, result] : record_["results"].items()) {
        u[name] = result["u"];
    }
    for (const json& row : rotary()["reversal"]) {
        u[row["name"]] = row["u"];
    }
    std::size_t compared = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_GT(matrix[i][i], 0.0) << order[i];
        for (std::size_t j = 0; j < i; ++j) {
            ASSERT_NEAR(matrix[i][j], matrix[j][i], 1e-15 * std::abs(matrix[i][j])) << order[i] << ", " << order[j];
            EXPECT_LE(std::abs(matrix[i][j]), std::sqrt(matrix[i][i] * matrix[j][j]) * (1.0 + 1e-9))
                << order[i] << ", " << order[j];
        }
        if (const auto known = u.find(order[i]); known != u.end()) {
            ++compared;
            EXPECT_NEAR(matrix[i][i], known->second * known->second, 1e-9 * matrix[i][i]) << order[i];
        }
    }
    EXPECT_GE(compared, 6 * k_angles + 4);
}

TEST_F(Record, BudgetSharesSumToOne) {
    const json& sources = rotary()["budget_sources"];
    EXPECT_EQ(sources,
              (json{"length noise", "scale", "dead path", "fixture CMM", "fixture thermal", "table repeatability"}));
    ASSERT_GE(rotary()["budget"].size(), 6 * k_angles + 4);
    std::map<std::string, double> u;
    for (const json& row : rotary()["errors"]) {
        for (const std::string& name : k_error_motions) {
            u[name + "@" + digits(row["angle_deg"])] = row[name]["u"];
        }
    }
    for (const json& row : rotary()["budget"]) {
        double total = 0.0;
        for (const json& source : sources) {
            const double share = row["shares"].at(source.get<std::string>());
            EXPECT_GE(share, 0.0);
            total += share;
        }
        EXPECT_EQ(row["shares"].size(), sources.size());
        EXPECT_NEAR(total, 1.0, 1e-9) << row["quantity"];
        if (row["angle_deg"].is_number()) {
            EXPECT_EQ(row["u"].get<double>(),
                      u.at(row["quantity"].get<std::string>() + "@" + digits(row["angle_deg"])));
        }
    }
    for (const auto& [name, result] : record_["results"].items()) {
        double total = 0.0;
        double squares = 0.0;
        for (const json& row : result["budget"]) {
            total += row["share"].get<double>();
            squares += std::pow(row["contribution"].get<double>(), 2);
        }
        EXPECT_NEAR(total, 1.0, 1e-9) << name;
        const double u_c = result["u"];
        EXPECT_NEAR(squares, u_c * u_c, 1e-9 * u_c * u_c) << name;
    }
}

TEST_F(Record, AdjustmentIsConsistent) {
    const json& adjustment = rotary()["adjustment"];
    const auto integer = [&](const char* key) { return adjustment.at(key).get<std::int64_t>(); };
    EXPECT_EQ(integer("degrees_of_freedom"), integer("observations") - integer("parameters"));
    EXPECT_GE(integer("observations"), static_cast<std::int64_t>(k_distances));
    EXPECT_GT(integer("parameters"), static_cast<std::int64_t>(6 * k_angles));
    EXPECT_GT(integer("iterations"), 0);
    const double chi_square = adjustment["chi_square"];
    EXPECT_GT(chi_square, 0.0);
    EXPECT_GT(adjustment["p_value"].get<double>(), 0.0);
    EXPECT_LE(adjustment["p_value"].get<double>(), 1.0);
    EXPECT_GT(adjustment["condition_number"].get<double>(), 1.0);
    const json& factor = adjustment["variance_factor"];
    EXPECT_EQ(factor["a_priori"], 1.0);
    EXPECT_NEAR(factor["a_posteriori"].get<double>(), chi_square / adjustment["degrees_of_freedom"].get<double>(),
                1e-12);
    EXPECT_TRUE(factor["used"] == "a_priori" || factor["used"] == "a_posteriori");
}

TEST_F(Record, VarianceComponents) {
    ASSERT_FALSE(rotary()["variance_components"].empty());
    double redundancy = 0.0;
    for (const json& component : rotary()["variance_components"]) {
        EXPECT_TRUE(component["name"].is_string());
        EXPECT_TRUE(component["unit"] == "um" || component["unit"] == "arcsec");
        EXPECT_GE(component["value"].get<double>(), 0.0);
        EXPECT_GE(component["u"].get<double>(), 0.0);
        EXPECT_GT(component["redundancy"].get<double>(), 0.0) << component["name"];
        redundancy += component["redundancy"].get<double>();
    }
    EXPECT_LE(redundancy, rotary()["adjustment"]["degrees_of_freedom"].get<double>() * (1.0 + 1e-9));
}

TEST_F(Record, OneReliabilityRowPerDistanceInTheOrderOfTheFile) {
    const std::vector<std::string> lines = lines_of(bytes_of(shipped_example() / "lengths.csv"));
    const json& rows = rotary()["reliability"];
    ASSERT_EQ(rows.size(), k_distances);
    ASSERT_EQ(lines.size(), k_distances + 1);
    std::size_t flagged = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const json& row = rows[i];
        const std::string start = row["station"].get<std::string>() + "," + row["reflector"].get<std::string>() + "," +
                                  row["pass"].get<std::string>() + ",";
        EXPECT_TRUE(lines[i + 1].starts_with(start)) << lines[i + 1];
        EXPECT_GT(row["redundancy_number"].get<double>(), 0.0);
        EXPECT_LE(row["redundancy_number"].get<double>(), 1.0 + 1e-9);
        EXPECT_GT(row["minimal_detectable_bias_um"].get<double>(), 0.0);
        EXPECT_TRUE(row["residual_um"].is_number());
        const double critical = rotary()["outlier_test"]["critical_value"];
        EXPECT_EQ(row["flagged"].get<bool>(), std::abs(row["test_value"].get<double>()) > critical);
        flagged += row["flagged"].get<bool>() ? 1U : 0U;
    }
    EXPECT_EQ(rotary()["flagged"].size(), flagged);
}

TEST_F(Record, StationsReflectorsAndDeadPaths) {
    const auto names = [](const json& rows) {
        std::vector<std::string> result;
        for (const json& row : rows) {
            result.push_back(row["name"]);
        }
        return result;
    };
    EXPECT_EQ(names(rotary()["stations"]), (std::vector<std::string>{"P1", "P2", "P3", "P4", "P5", "P6"}));
    EXPECT_EQ(names(rotary()["reflectors"]), (std::vector<std::string>{"R1", "R2", "R3", "R4", "R5", "R6"}));
    EXPECT_EQ(names(rotary()["dead_paths"]), (std::vector<std::string>{"P1", "P2", "P3", "P4", "P5", "P6"}));
    for (const json& station : rotary()["stations"]) {
        EXPECT_EQ(station["position_mm"].size(), 3U);
        for (const json& u : station["u_mm"]) {
            EXPECT_GT(u.get<double>(), 0.0);
        }
    }
}

TEST_F(Record, ComparisonWithTheDialIndicator) {
    const json& comparison = record_["comparison"];
    ASSERT_EQ(comparison["points"].size(), 108U);
    double sum_of_en = 0.0;
    double largest = 0.0;
    double squares = 0.0;
    std::int64_t above = 0;
    for (const json& point : comparison["points"]) {
        const auto value = [&](const char* key) { return point.at(key).get<double>(); };
        EXPECT_NEAR(value("D"), value("value") - value("reference_value"), 1e-9);
        EXPECT_NEAR(value("U_D"), std::hypot(value("U"), value("reference_U")), 1e-9);
        EXPECT_NEAR(value("En"), value("D") / value("U_D"), 1e-9);
        EXPECT_NEAR(value("zeta"), value("D") / value("u_D"), 1e-9);
        sum_of_en += std::abs(value("En"));
        squares += value("En") * value("En");
        largest = std::max(largest, std::abs(value("En")));
        above += std::abs(value("En")) > 1.0 ? 1 : 0;
    }
    const json& summary = comparison["summary"];
    for (const char* const direction : {"x", "y", "z"}) {
        EXPECT_EQ(summary.at(direction).at("points"), 36) << direction;
    }
    const json& all = summary.at("all");
    EXPECT_EQ(all["points"], 108);
    EXPECT_NEAR(all["mean_abs_En"].get<double>(), sum_of_en / 108.0, 1e-9);
    EXPECT_NEAR(all["max_abs_En"].get<double>(), largest, 1e-9);
    EXPECT_NEAR(all["rms_En"].get<double>(), std::sqrt(squares / 108.0), 1e-9);
    EXPECT_EQ(all["count_above_1"].get<std::int64_t>(), above);
}

TEST_F(Record, CertificatePrintsTheNumbersOfTheRecord) {
    if (!ExampleRun::shared().has_documents()) {
        GTEST_SKIP() << why_no_pdf();
    }
    const std::string html = with_ascii_minus(bytes_of(ExampleRun::shared().folder() / "certificate.html"));
    for (const auto& [name, result] : record_["results"].items()) {
        EXPECT_NE(html.find(result["printed"]["value"].get<std::string>()), std::string::npos) << name;
        EXPECT_NE(html.find(result["printed"]["U"].get<std::string>()), std::string::npos) << name;
    }
    for (const json& row : rotary()["errors"]) {
        for (const std::string& name : k_error_motions) {
            EXPECT_NE(html.find(row[name]["printed"]["value"].get<std::string>()), std::string::npos) << name;
        }
    }
    for (const json& file : record_["job"]["files"]) {
        EXPECT_NE(html.find(file["sha256"].get<std::string>()), std::string::npos) << file["name"];
    }
}

}  // namespace
}  // namespace gumcert::cli
