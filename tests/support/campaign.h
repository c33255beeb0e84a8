#pragma once

#include <map>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "jobs/rotary_table/rotary_table_job.h"

namespace gumcert::jobs::test {

using Files = std::map<std::string, std::string>;

/// A small valid campaign with made-up numbers: 3 stations, 4 reflectors, 8 angles, two passes (one a direction) of
/// each station, and a dial indicator. The job reader checks form and not physics, so any lengths will do.
///
/// lengths.csv: line 1 is the header; the lines of P1+ come first, then P1-, P2+ …; within a pass angle after angle,
/// and within an angle reflector after reflector: line = 2 + 32 · pass + 4 · angle + reflector, all from 0.
inline Files small_campaign() {
    Files files;
    files["job.json"] = R"({
  "schema": "gumcert/job/1",
  "kind": "rotary_table",
  "title": "Small campaign",
  "axis": "A",
  "observations": { "lengths": "lengths.csv", "stations": "stations.csv", "environment": "environment.csv" },
  "length_uncertainty": { "u_constant_um": 0.05 },
  "fixture": {
    "coordinates": "fixture.csv",
    "thermal_expansion_per_K": { "value": 1.15e-5, "u": 5e-7 }
  },
  "reference_method": {
    "name": "dial indicator",
    "readings": "dial_indicator.csv",
    "description": "dial_indicator.json"
  }
}
)";
    std::string& lengths = files["lengths.csv"];
    lengths = "station,reflector,pass,direction,angle_deg,length_mm,dead_path\n";
    for (int station = 1; station <= 3; ++station) {
        for (const char sign : {'+', '-'}) {
            for (int angle = 0; angle < 360; angle += 45) {
                for (int reflector = 1; reflector <= 4; ++reflector) {
                    const std::string name = "P" + std::to_string(station);
                    lengths += name + ",R" + std::to_string(reflector) + "," + name + sign + "," + sign + "," +
                               std::to_string(angle) + ".0," + std::to_string(400 + 100 * station + angle) + "." +
                               std::to_string(10 + reflector) + "00" + std::to_string(reflector) + "," + name + "\n";
                }
            }
        }
    }
    files["stations.csv"] = "station,x_mm,y_mm,z_mm,u_mm\nP1,500,-800,-300,20\nP2,800,-700,550,20\nP3,1200,-200,0,20\n";
    files["environment.csv"] =
        "station,fixture_temperature_degC,u_temperature_K,air_temperature_degC,pressure_hPa,humidity_percent\n"
        "P1,20.25,0.03,20.3,1011.6,50\nP2,20.5,0.03,20.2,1014.9,50\nP3,19.75,0.04,20.1,1010.0,51\n";
    files["fixture.csv"] =
        "reflector,x_mm,y_mm,z_mm,u_x_um,u_y_um,u_z_um\n"
        "R1,33.25,136.5,5.25,0.4,0.5,0.4\nR2,85.5,28.25,72.0,0.4,0.4,0.4\n"
        "R3,152.75,-99.5,117.25,0.4,0.4,0.4\nR4,35.75,-87.5,-0.75,0.4,0.4,0.4\n";
    files["dial_indicator.csv"] = "direction,angle_deg,run,reading_um\nx,0.0,1,3.2\nx,45.0,1,2.7\ny,0.0,1,-1.5\n";
    files["dial_indicator.json"] =
        "{\"contact_point_mm\": [100.0, 4.0, 0.0], \"resolution_um\": 0.1, \"mpe_um\": 0.8,\n"
        " \"repeatability_um\": 0.25, \"temperature_degC\": 20.2, \"note\": \"as read\"}\n";
    return files;
}

/// Its reflectors in the frame of a machine.
inline std::string small_machine_points() {
    return "reflector,x_mm,y_mm,z_mm,u_um\nR1,533.25,136.5,5.25,2\nR2,585.5,28.25,72.0,2\nR3,652.75,-99.5,117.25,2\n";
}

/// Line of lengths.csv of the small campaign.
constexpr std::size_t lengths_line(std::size_t pass, std::size_t angle, std::size_t reflector) {
    return 2 + 32 * pass + 4 * angle + reflector;
}

/// Replaces the first occurrence; a test that changes nothing must fail.
inline void replace(std::string& text, const std::string& old_text, const std::string& new_text) {
    const std::size_t at = text.find(old_text);
    if (at == std::string::npos) {
        throw std::logic_error("the test wants to replace \"" + old_text + "\", which is not there");
    }
    text.replace(at, old_text.size(), new_text);
}

inline void replace_all(std::string& text, const std::string& old_text, const std::string& new_text) {
    std::size_t at = text.find(old_text);
    if (at == std::string::npos) {
        throw std::logic_error("the test wants to replace \"" + old_text + "\", which is not there");
    }
    for (; at != std::string::npos; at = text.find(old_text, at + new_text.size())) {
        text.replace(at, old_text.size(), new_text);
    }
}

/// The small campaign before it is measured: a layout in place of the lengths, and no readings.
inline Files small_layout() {
    Files files = small_campaign();
    std::string& job = files.at("job.json");
    replace(job, "\"lengths\": \"lengths.csv\", ", "");
    replace(job, R"(  "reference_method": {
    "name": "dial indicator",
    "readings": "dial_indicator.csv",
    "description": "dial_indicator.json"
  })",
            R"(  "plan": { "angles_deg": {"first": -90, "step": 30, "count": 12} })");
    files.erase("lengths.csv");
    return files;
}

/// Replaces a whole line, counted from 1; without its line end.
inline void replace_line(std::string& text, std::size_t line, const std::string& new_text) {
    std::size_t start = 0;
    for (std::size_t i = 1; i < line; ++i) {
        start = text.find('\n', start) + 1;
    }
    text.replace(start, text.find('\n', start) - start, new_text);
}

/// A budget of the fixture of the small campaign, with the points in a table: u = 0.3 µm, and 1e-6 of the coordinate in
/// common.
inline std::string small_fixture_budget() {
    return R"({ "schema": "gumcert/job/1", "kind": "budget", "model": ["x = l + d_cmm + l * d_scale"],
  "inputs": { "l": {"value": 0, "unit": "mm", "constant": true},
              "d_cmm": {"value": 0, "u": 0.3, "unit": "um", "between_points": "independent"},
              "d_scale": {"value": 0, "u": 1e-6} },
  "outputs": {"x": {"unit": "mm"}},
  "points": {"file": "fixture_points.csv"} }
)";
}

inline std::string small_fixture_points() {
    return "point,l\nR1.x,33.25\nR1.y,136.5\nR1.z,5.25\nR2.x,85.5\nR2.y,28.25\nR2.z,72.0\n"
           "R3.x,152.75\nR3.y,-99.5\nR3.z,117.25\nR4.x,35.75\nR4.y,-87.5\nR4.z,-0.75\n";
}

inline RotaryTableJob read(const Files& files, JobUse use = JobUse::evaluate) {
    return read_rotary_table_job(MemoryFileSource(files), "job.json", use);
}

/// The refusals of a campaign; empty when it was accepted.
inline std::vector<gum::Diagnostic> refusals(const Files& files, JobUse use = JobUse::evaluate) {
    try {
        (void)read(files, use);
    } catch (const gum::InputError& error) {
        return error.diagnostics();
    }
    return {};
}

/// "code where — what — rule — action", one line each.
inline std::string texts(const std::vector<gum::Diagnostic>& diagnostics) {
    std::string text;
    for (const gum::Diagnostic& diagnostic : diagnostics) {
        text += diagnostic.code + " " + gum::message(diagnostic) + "\n";
    }
    return text;
}

}  // namespace gumcert::jobs::test
