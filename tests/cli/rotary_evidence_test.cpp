// What the record of a rotary table holds beside its results, computed again from the other numbers of the record and
// from the files of the job.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

class RotaryEvidence : public ProgramTest {
protected:
    json rotary_of(const fs::path& job) const {
        const fs::path record = folder() / "evidence" / "record.json";
        const Ended ended = gumcert({"evaluate", job.string(), "-o", record.string()});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(bytes_of(record)).at("rotary");
    }
};

TEST_F(RotaryEvidence, OfTheExample) {
    const json rotary = rotary_of(copy_of_example(folder() / "job"));

    // Every kind of test was made, each below its limit.
    std::set<std::string> kinds;
    for (const json& kind : rotary.at("group_tests").at("kinds")) {
        kinds.insert(kind.at("kind"));
        EXPECT_LT(kind.at("test_value"), kind.at("critical_value")) << kind;
        EXPECT_FALSE(kind.at("suspicious")) << kind;
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"visit_length", "visit_pose", "dead_path_change", "station_place",
                                            "pair_length", "drift", "angle_index", "succession", "station", "reflector",
                                            "reflector_at_angles", "reflector_from_visit", "fixture_scale",
                                            "station_scale", "fixture_place"}));

    // 6 stations, 36 angles, both senses; the largest deviation against its limit is the test of the visits.
    ASSERT_EQ(rotary.at("visits").size(), 432U);
    double largest = 0.0;
    for (const json& visit : rotary.at("visits")) {
        largest =
            std::max(largest, std::abs(visit.at("deviation_um").get<double>()) / visit.at("limit_um").get<double>());
    }
    for (const json& kind : rotary.at("group_tests").at("kinds")) {
        if (kind.at("kind") == "visit_length") {
            EXPECT_EQ(kind.at("tests"), 432);
            EXPECT_NEAR(largest,
                        std::sqrt(kind.at("test_value").get<double>() / kind.at("critical_value").get<double>()), 1e-3);
        }
    }

    // Harmonics of equally spaced angles are the discrete Fourier transform of the reported values.
    for (std::size_t m = 0; m < 6; ++m) {
        const json& motion = rotary.at("harmonics").at(m);
        ASSERT_EQ(motion.at("orders").size(), 10U);
        for (const json& order : motion.at("orders")) {
            std::complex<double> sum;
            for (const json& at : rotary.at("errors")) {
                const double angle = at.at("angle_deg").get<double>() * std::numbers::pi / 180.0;
                sum += at.at(motion.at("name").get<std::string>()).at("value").get<double>() *
                       std::polar(2.0 / 36.0, order.at("order").get<double>() * angle);
            }
            EXPECT_NEAR(order.at("amplitude").get<double>(), std::abs(sum), 1e-9) << motion.at("name");
            EXPECT_GT(order.at("U").get<double>(), order.at("u").get<double>());
        }
    }

    // The mean of the runs is that of the diagram; the curves of the senses lie about the curve of both.
    for (const json& target : rotary.at("iso230_2").at("targets")) {
        for (const char* sense : {"up", "down"}) {
            const json& runs = target.at(std::string("runs_") + sense);
            ASSERT_EQ(runs.size(), 6U);
            double sum = 0.0;
            for (const json& run : runs) {
                sum += run.get<double>();
            }
            EXPECT_NEAR(sum / 6.0, target.at(std::string("mean_") + sense).get<double>(), 1e-9);
        }
    }
    ASSERT_EQ(rotary.at("sense_curves").size(), 2U);
    for (std::size_t i = 0; i < 36; ++i) {
        for (std::size_t m = 0; m < 6; ++m) {
            const json& up = rotary["sense_curves"][0]["points"][i];
            const json& down = rotary["sense_curves"][1]["points"][i];
            const json& both = rotary["errors"][i][rotary["error_names"][m].get<std::string>()];
            EXPECT_NEAR(0.5 * (up["value"][m].get<double>() + down["value"][m].get<double>()),
                        both["value"].get<double>(), 3.0 * both["u"].get<double>());
            EXPECT_GT(up["u"][m].get<double>(), both["u"].get<double>()) << "half of the distances";
        }
    }

    // α ΔT of the largest distance of the fixture.
    const json& environment = rotary.at("environment");
    ASSERT_EQ(environment.at("stations").size(), 6U);
    for (const json& station : environment.at("stations")) {
        EXPECT_NEAR(station.at("expansion_um").get<double>(),
                    1.15e-5 * (station.at("fixture_degC").get<double>() - 20.0) *
                        environment.at("largest_distance_mm").get<double>() * 1e3,
                    1e-9);
    }
    EXPECT_EQ(environment["stations"][0]["fixture_degC"], 20.205);
    EXPECT_EQ(environment["stations"][0]["pressure_hPa"], 1011.6);
    EXPECT_EQ(rotary["reliability"][0]["printed_length"], "") << "2592 distances stay in their file";
}

TEST_F(RotaryEvidence, ListsTheDistancesOfASmallMeasurement) {
    const fs::path job = copy_of_example(folder() / "job");
    std::string lengths;
    for (const std::string& line : lines_of(bytes_of(folder() / "job" / "lengths.csv"))) {
        static const std::regex some("P[^,]*,[^,]*,[^,]*,\\+,(0|40|80|120|160|200|240|280|320)\\.0+,.*");
        if (lengths.empty() || std::regex_match(line, some)) {
            lengths += line + "\n";
        }
    }
    write_bytes(folder() / "job" / "lengths.csv", lengths);
    change_json(job, [](json& document) { document.erase("reference_method"); });
    const json rotary = rotary_of(job);
    ASSERT_EQ(rotary.at("reliability").size(), 324U);
    EXPECT_EQ(rotary["reliability"][0]["printed_length"], "808.831212");
    EXPECT_TRUE(rotary.at("sense_curves").empty()) << "one sense";
    EXPECT_EQ(rotary.at("harmonics").at(0).at("orders").size(), 4U);
}

/// Adds `size_arcsec` sin 2θ to the reversal about the axis of the example, by the stations and reflectors of its
/// files.
void plant_reversal(const fs::path& folder, double size_arcsec) {
    using Point = std::array<double, 3>;
    const auto points_of = [&](const char* file) {
        std::map<std::string, Point> points;
        for (const std::string& line : lines_of(bytes_of(folder / file))) {
            std::istringstream cells(line);
            std::string name, x, y, z;
            std::getline(std::getline(std::getline(std::getline(cells, name, ','), x, ','), y, ','), z, ',');
            if (name != "station" && name != "reflector") {
                points[name] = {std::stod(x), std::stod(y), std::stod(z)};
            }
        }
        return points;
    };
    const auto stations = points_of("stations.csv");
    const auto reflectors = points_of("fixture.csv");
    std::string planted;
    for (const std::string& line : lines_of(bytes_of(folder / "lengths.csv"))) {
        std::vector<std::string> cells;
        std::istringstream from(line);
        for (std::string cell; std::getline(from, cell, ',');) {
            cells.push_back(cell);
        }
        if (!planted.empty()) {
            const double angle = std::stod(cells[4]) * std::numbers::pi / 180.0;
            const double half = 0.5 * size_arcsec * std::sin(2.0 * angle) * std::numbers::pi / 648000.0;
            const Point& q = stations.at(cells[0]);
            const Point& p = reflectors.at(cells[1]);
            const auto length = [&](double a) {
                return std::hypot(p[0] - q[0], p[1] * std::cos(a) - p[2] * std::sin(a) - q[1],
                                  p[1] * std::sin(a) + p[2] * std::cos(a) - q[2]);
            };
            char text[32];
            std::snprintf(text, sizeof text, "%.6f",
                          std::stod(cells[5]) + length(angle + (cells[3] == "+" ? half : -half)) - length(angle));
            cells[5] = text;
        }
        for (std::size_t c = 0; c < cells.size(); ++c) {
            planted += (c == 0 ? "" : ",") + cells[c];
        }
        planted += "\n";
    }
    write_bytes(folder / "lengths.csv", planted);
}

double component(const json& rotary, const std::string& name) {
    for (const json& row : rotary.at("variance_components")) {
        if (row.at("name") == name) {
            return row.at("value");
        }
    }
    ADD_FAILURE() << name;
    return 0.0;
}

TEST_F(RotaryEvidence, AReversalThatDependsOnTheAngleIsModelledAtEveryAngle) {
    const fs::path job = copy_of_example(folder() / "job");
    change_json(job, [](json& document) { document.erase("reference_method"); });
    const json sound = rotary_of(job);
    EXPECT_EQ(sound.at("reversal_model").at("model"), "constant");
    plant_reversal(folder() / "job", 6.0);
    const json found = rotary_of(job);
    const json& model = found.at("reversal_model");
    EXPECT_EQ(model.at("model"), "by_angle");
    ASSERT_EQ(model.at("tests").size(), 6U);
    for (const json& test : model.at("tests")) {
        EXPECT_EQ(test.at("depends_on_angle").get<bool>(), test.at("name") == "EAA") << test;
    }
    const std::string axial = "table angular, axial";
    EXPECT_NEAR(component(found, axial), component(sound, axial), 0.05);

    // The curves of both senses differ by the mean reversal and what was planted, each within what U allows.
    double squares = 0.0;
    for (std::size_t i = 0; i < 36; ++i) {
        const json& up = found.at("sense_curves").at(0).at("points").at(i);
        const json& down = found.at("sense_curves").at(1).at("points").at(i);
        const double reversal = up.at("value").at(3).get<double>() - down.at("value").at(3).get<double>();
        const double expected = found.at("reversal").at(3).at("value").get<double>() +
                                6.0 * std::sin(2.0 * up.at("angle_deg").get<double>() * std::numbers::pi / 180.0);
        squares += std::pow((reversal - expected) / up.at("U").at(3).get<double>(), 2) / 36.0;
    }
    EXPECT_LT(std::sqrt(squares), 1.0);

    // With one reversal of all angles it is in the repeatability, and said.
    change_json(job, [](json& document) { document["reversal"] = "constant"; });
    const Ended warned = gumcert({"evaluate", job.string(), "-o", (folder() / "constant" / "record.json").string()});
    EXPECT_NE(warned.err.find("GC-REVERSAL-0002"), std::string::npos) << warned.err;
    const json constant = json::parse(bytes_of(folder() / "constant" / "record.json")).at("rotary");
    EXPECT_EQ(constant.at("reversal_model").at("model"), "constant");
    EXPECT_GT(component(constant, axial), 5.0 * component(found, axial));
}

}  // namespace
}  // namespace gumcert::cli
