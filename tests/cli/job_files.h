#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace gumcert::cli {

/// Error motions of a rotary table, as records name them (ISO 230-7:2015).
inline const std::vector<std::string> k_error_motions{"EXA", "EYA", "EZA", "EAA", "EBA", "ECA"};

inline fs::path shipped_example() {
    return fs::path(GUMCERT_SOURCE_DIR) / "examples" / "rotary_table";
}

/// A copy of the files of the shipped example that can be changed.
/// \return its job file
inline fs::path copy_of_example(const fs::path& folder) {
    for (const fs::directory_entry& entry : fs::directory_iterator(shipped_example())) {
        if (entry.is_regular_file()) {
            write_bytes(folder / entry.path().filename(), bytes_of(entry.path()));
        }
    }
    return folder / "job.json";
}

/// Changes a text file; the text must occur, and its first occurrence is replaced.
inline void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = bytes_of(file);
    const std::size_t at = text.find(from);
    if (at == std::string::npos) {
        throw std::runtime_error(file.string() + " has no \"" + from + "\"");
    }
    write_bytes(file, text.replace(at, from.size(), to));
}

inline void change_json(const fs::path& file, const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json document = nlohmann::json::parse(bytes_of(file));
    change(document);
    write_bytes(file, document.dump(1));
}

/// A number with all its digits, without the locale.
inline std::string digits(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

using Point = std::array<double, 3>;

inline Point sum(const Point& a, const Point& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// The point turned about x, y or z (0, 1, 2) by the right-hand rule, [rad].
inline Point turned(const Point& p, std::size_t axis, double angle) {
    const std::size_t a = (axis + 1) % 3;
    const std::size_t b = (axis + 2) % 3;
    Point result = p;
    result[a] = std::cos(angle) * p[a] - std::sin(angle) * p[b];
    result[b] = std::sin(angle) * p[a] + std::cos(angle) * p[b];
    return result;
}

/// A campaign without noise on an A axis (along x), whose distances are computed here from the equations of the
/// contract alone: P = E(theta) R_x(theta) T_s p, l + l0 = |P - q|. Lengths in mm.
struct ExactCampaign {
    std::vector<Point> stations{{544, -817, -284}, {790, -695, 557},  {1241, -191, 7},
                                {1103, 215, 253},  {1180, 300, -420}, {560, 640, 610}};
    std::vector<Point> reflectors{{33.2569, 136.3070, 5.2601},    {85.5062, 28.3355, 72.2368},
                                  {152.7594, -99.6639, 117.3576}, {35.7608, -87.4344, -0.7525},
                                  {120.0, -20.0, -125.0},         {70.0, 95.0, -60.0}};
    std::size_t angles = 12;
    double offset_y_um = 0.0, offset_z_um = 0.0;      ///< O of T_s
    double tilt_y_arcsec = 0.0, tilt_z_arcsec = 0.0;  ///< S of T_s
    double exa_um = 0.0, eaa_arcsec = 0.0;            ///< amplitudes of sin(2 theta), which no datum changes
    double dead_path_mm = 0.2;
    bool start_values = false;  ///< a stations file, some millimetres off

    [[nodiscard]] double angle_deg(std::size_t i) const {
        return 360.0 / static_cast<double>(angles) * static_cast<double>(i);
    }

    /// Writes the files of a job.
    /// \return its job file
    [[nodiscard]] fs::path write(const fs::path& folder) const {
        constexpr double k_degree = std::numbers::pi / 180.0;
        constexpr double k_arcsecond = k_degree / 3600.0;
        std::string lengths = "station,reflector,pass,direction,angle_deg,length_mm,dead_path\n";
        std::string fixture = "reflector,x_mm,y_mm,z_mm,u_x_um,u_y_um,u_z_um\n";
        for (std::size_t m = 0; m < reflectors.size(); ++m) {
            fixture += "R" + std::to_string(m + 1);
            for (const double coordinate : reflectors[m]) {
                fixture += "," + digits(coordinate);
            }
            fixture += ",0.4,0.4,0.4\n";
        }
        for (std::size_t j = 0; j < stations.size(); ++j) {
            const std::string station = "P" + std::to_string(j + 1);
            for (std::size_t i = 0; i < angles; ++i) {
                const double theta = angle_deg(i) * k_degree;
                for (std::size_t m = 0; m < reflectors.size(); ++m) {
                    const Point fixed = sum(
                        turned(turned(reflectors[m], 1, tilt_y_arcsec * k_arcsecond), 2, tilt_z_arcsec * k_arcsecond),
                        {0.0, 1e-3 * offset_y_um, 1e-3 * offset_z_um});
                    const double wave = std::sin(2.0 * theta);
                    const Point p = sum(turned(fixed, 0, theta + eaa_arcsec * k_arcsecond * wave),
                                        {1e-3 * exa_um * wave, 0.0, 0.0});
                    const double distance =
                        std::hypot(p[0] - stations[j][0], p[1] - stations[j][1], p[2] - stations[j][2]);
                    lengths += station + ",R" + std::to_string(m + 1) + "," + station + "-1,+," + digits(angle_deg(i)) +
                               "," + digits(distance - dead_path_mm) + "," + station + "\n";
                }
            }
        }
        write_bytes(folder / "lengths.csv", lengths);
        write_bytes(folder / "fixture.csv", fixture);
        const nlohmann::json job{{"schema", "gumcert/job/1"},
                                 {"kind", "rotary_table"},
                                 {"title", "Exact distances"},
                                 {"axis", "A"},
                                 {"observations", {{"lengths", "lengths.csv"}}},
                                 {"length_uncertainty", {{"u_constant_um", 0.05}}},
                                 {"fixture", {{"coordinates", "fixture.csv"}}},
                                 {"table_repeatability", {{"mode", "none"}}},
                                 {"variance_components", "fixed"}};
        write_bytes(folder / "job.json", job.dump(1));
        if (start_values) {
            std::string positions = "station,x_mm,y_mm,z_mm\n";
            for (std::size_t j = 0; j < stations.size(); ++j) {
                positions += "P" + std::to_string(j + 1) + "," + digits(stations[j][0] + 3.0) + "," +
                             digits(stations[j][1] - 4.0) + "," + digits(stations[j][2] + 2.0) + "\n";
            }
            write_bytes(folder / "stations.csv", positions);
            change_json(folder / "job.json",
                        [](nlohmann::json& document) { document["observations"]["stations"] = "stations.csv"; });
        }
        return folder / "job.json";
    }
};

/// Documents of the shipped example, made once in a test program.
class ExampleRun {
public:
    static const ExampleRun& shared() {
        static const ExampleRun run;
        return run;
    }

    [[nodiscard]] const fs::path& folder() const { return folder_; }
    [[nodiscard]] const Ended& ended() const { return ended_; }
    /// False when no PDF can be made here: then only record and covariance exist, written by `gumcert evaluate`.
    [[nodiscard]] bool has_documents() const { return why_no_pdf().empty(); }

private:
    ExampleRun() : folder_(root_.path() / "example") {
        const std::string job = (shipped_example() / "job.json").string();
        const std::vector<std::string> arguments =
            has_documents()
                ? std::vector<std::string>{"run", job, "-o", folder_.string(), "--share", GUMCERT_SOURCE_DIR}
                : std::vector<std::string>{"evaluate", job, "-o", (folder_ / "record.json").string()};
        ended_ = run_process(GUMCERT_PROGRAM, arguments, {}, root_.path());
    }

    TemporaryFolder root_;
    fs::path folder_;
    Ended ended_;
};

}  // namespace gumcert::cli
