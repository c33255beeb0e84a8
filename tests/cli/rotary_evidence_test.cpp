// What the record of a rotary table holds beside its results, computed again from the other numbers of the record and
// from the files of the job.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

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
    EXPECT_EQ(kinds, (std::set<std::string>{"visit_length", "visit_pose", "dead_path_change", "drift", "angle_index",
                                            "succession", "station", "reflector", "fixture_scale"}));

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

}  // namespace
}  // namespace gumcert::cli
