#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "jobs/budget/budget_job.h"
#include "jobs/csv_table.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "tests/fuzz/json_target.h"

/// What must hold for any bytes, for the fuzz targets and for the test that replays their corpus. Every function ends
/// in a result or in a refusal; anything else throws std::logic_error or is caught by the sanitizers.
namespace gumcert::jobs::fuzz {

using gumcert::json::fuzz::demand;

/// A refusal has a code and is one line of text that cannot deceive a terminal.
inline void demand_honest(const std::vector<gum::Diagnostic>& diagnostics) {
    for (const gum::Diagnostic& diagnostic : diagnostics) {
        demand(diagnostic.code.starts_with("GC-"), "a refusal without a code");
        const std::string text = gum::message(diagnostic);
        demand(!text.empty(), "a refusal without a text");
        for (const char c : text) {
            demand(static_cast<unsigned char>(c) >= 0x20U && c != '\x7F', "a control character in a message");
        }
    }
}

inline bool csv_table(std::string_view bytes) {
    static constexpr std::array<std::string_view, 3> k_columns{"name", "x_mm", "run"};
    static constexpr std::array<std::string_view, 1> k_optional{"u_mm"};
    static constexpr std::array<std::string_view, 3> k_words{"+", "P1", "P2"};
    ProblemList problems("fuzz.csv");
    const std::optional<CsvTable> table =
        read_csv_table(std::string(bytes), k_columns, k_optional, problems, {.rows = 1000});
    demand(table || problems.refusals() > 0, "refused without a reason");
    if (table) {
        for (std::size_t row = 0; row < table->rows(); ++row) {
            (void)table->name(row, 0);
            (void)table->choice(row, 0, k_words);
            const auto number = table->number(row, 1, {});
            demand(!number || std::isfinite(*number), "a number that is not finite");
            (void)table->integer(row, 2, between(0.0, 100.0, ""));
            (void)table->number_if_any(row, 3, above_zero("mm"));
        }
    }
    ProblemList matrix_problems("fuzz.csv");
    const auto matrix = read_csv_matrix(std::string(bytes), 3, "µm²", matrix_problems);
    demand(matrix || matrix_problems.refusals() > 0, "refused without a reason");
    demand(!matrix || matrix->allFinite(), "a number that is not finite");
    demand_honest(problems.refused());
    demand_honest(problems.warnings());
    demand_honest(matrix_problems.refused());
    return problems.refusals() == 0;
}

/// Several files in one text: a line `=== name` begins a file.
inline std::map<std::string, std::string> files_of_bundle(std::string_view bundle) {
    std::map<std::string, std::string> files;
    std::string* current = nullptr;
    while (!bundle.empty()) {
        const std::size_t end = bundle.find('\n');
        const std::string_view line = bundle.substr(0, end == std::string_view::npos ? bundle.size() : end + 1);
        bundle.remove_prefix(line.size());
        if (line.starts_with("=== ")) {
            std::string_view name = line.substr(4);
            if (name.ends_with('\n')) {
                name.remove_suffix(1);
            }
            current = &files[std::string(name)];
        } else if (current != nullptr) {
            current->append(line);
        }
    }
    return files;
}

inline void demand_consistent(const RotaryTableJob& job) {
    const engine::RotaryTableMeasurement& m = job.measurement;
    const auto stations = static_cast<Eigen::Index>(m.stations.size());
    const auto reflectors = static_cast<Eigen::Index>(m.reflectors.size());
    demand(job.coverage_probability > 0.0 && job.coverage_probability < 1.0, "coverage probability");
    demand(m.angles.size() == m.angles_deg.size() && m.home < m.angles.size(), "angles");
    demand(m.fixture.rows() == reflectors && m.fixture.allFinite(), "fixture");
    demand(m.fixture_covariance.rows() == 3 * reflectors && m.fixture_covariance.cols() == 3 * reflectors &&
               m.fixture_covariance.allFinite(),
           "fixture covariance");
    // A budget of the fixture is evaluated by the application, which fills in the covariance.
    demand(job.fixture_budget ? job.fixture_budget->points.size() == 3 * m.reflectors.size()
                              : m.fixture_covariance.diagonal().minCoeff() > 0.0,
           "variances of the fixture");
    demand(job.stated_fixture_u.size() == 0 || job.stated_fixture_u.size() == 3 * reflectors, "columns u");
    demand(m.station_start.size() == m.stations.size() && m.temperature_difference.size() == stations &&
               m.u_temperature.size() == stations && m.temperature_difference.allFinite() &&
               m.u_temperature.allFinite(),
           "stations");
    demand(m.lengths.empty() != job.has_lengths && m.passes.empty() == m.lengths.empty(), "lengths");
    if (!job.has_lengths) {
        demand(job.plan && job.plan->angles_deg == m.angles_deg, "planned angles");
        for (const auto& start : m.station_start) {
            demand(start && start->allFinite(), "a station of a layout");
        }
    }
    if (job.plan) {
        const std::vector<double>& planned = job.plan->angles_deg;
        demand(std::is_sorted(planned.begin(), planned.end()) &&
                   static_cast<double>(planned.size() * m.stations.size() * m.reflectors.size()) <= 1e6 &&
                   job.plan->target_linear > 0.0 && job.plan->target_angular > 0.0 && job.plan->station_step > 0.0 &&
                   (!job.plan->station_region ||
                    ((*job.plan->station_region)[1] - (*job.plan->station_region)[0]).minCoeff() >= 0.0),
               "a plan");
        const gum::SightStatement& sight = job.plan->sight;
        demand(sight.obstacles.size() == sight.obstacles_where.size() && sight.reflector_diameter >= 0.0 &&
                   sight.acceptance_angle.value_or(1.0) > 0.0,
               "lines of sight");
        for (const engine::Obstacle& obstacle : sight.obstacles) {
            demand(obstacle.radius >= 0.0 && (obstacle.high - obstacle.low).minCoeff() > 0.0, "an obstacle");
        }
        for (const gum::SightStatement::Facing& facing : sight.facing) {
            demand(std::abs(facing.direction.norm() - 1.0) < 1e-9, "where a reflector looks");
        }
    }
    if (job.simulation) {
        demand(job.simulation->runs > 0 && job.simulation->outlier_size > 0.0 && job.simulation->set_up_offset >= 0.0 &&
                   job.simulation->error_angular >= 0.0,
               "a simulation");
    }
    if (job.monte_carlo && job.monte_carlo->trials) {
        demand(*job.monte_carlo->trials > 0, "trials");
    }
    for (const engine::LengthObservation& length : m.lengths) {
        demand(length.station < m.stations.size() && length.reflector < m.reflectors.size() &&
                   length.pass < m.passes.size() && length.angle < m.angles.size() &&
                   length.dead_path < m.dead_paths.size() && std::isfinite(length.length) && length.line > 1,
               "a length");
    }
    if (job.reference) {
        for (const engine::ReferenceReading& reading : job.reference->readings) {
            demand(reading.direction < 3 && reading.angle < m.angles.size() && std::isfinite(reading.reading),
                   "a reading");
        }
    }
    demand_honest(job.warnings);
}

/// Reads the files of a job with `read`, which either returns or refuses them with reasons that hold what they promise.
/// \return true when they were read
template <class Read>
bool read_or_refused(std::string_view bundle, const Read& read) {
    const auto demand_reasons = [](const gum::DiagnosedError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        demand_honest(error.diagnostics());
    };
    try {
        read(MemoryFileSource(files_of_bundle(bundle)));
        return true;
    } catch (const gum::InputError& error) {
        demand_reasons(error);
    } catch (const gum::StorageError& error) {
        demand_reasons(error);
    }
    return false;
}

/// \param bundle  the files of a job; the job itself is `job.json`. It is read to be evaluated and to be planned with.
inline bool rotary_table_job(std::string_view bundle) {
    bool any_read = false;
    for (const JobUse use : {JobUse::evaluate, JobUse::plan}) {
        const bool was_read = read_or_refused(bundle, [use](const MemoryFileSource& files) {
            demand_consistent(read_rotary_table_job(files, "job.json", use));
        });
        any_read = any_read || was_read;
    }
    return any_read;
}

}  // namespace gumcert::jobs::fuzz
