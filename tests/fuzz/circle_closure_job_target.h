#pragma once

#include <cmath>
#include <string_view>

#include "jobs/circle_closure/circle_closure_job.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::jobs::fuzz {

inline void demand_consistent(const CircleClosureJob& job) {
    const engine::CircleClosureMeasurement& m = job.measurement;
    demand(job.coverage_probability > 0.0 && job.coverage_probability < 1.0, "coverage probability");
    demand(m.steps >= 3 && m.steps <= 360 && engine::common_divisor(m) == 1, "a design");
    demand(job.readings_as_stated.size() == m.readings.size() && m.readings.size() >= 2 * m.steps, "readings");
    for (const engine::ClosureReading& reading : m.readings) {
        demand(reading.series < m.series.size() && reading.step <= m.steps && std::isfinite(reading.value),
               "a reading");
    }
    for (const engine::ClosureSeries& series : m.series) {
        demand(series.position < m.steps, "a series");
    }
    for (const engine::ClosureEffect& effect : m.effects) {
        demand(!effect.name.empty() && std::isfinite(effect.value) && std::isfinite(effect.u) && effect.u >= 0.0 &&
                   effect.degrees_of_freedom > 0.0,
               "an effect");
    }
    demand(!m.stated_u || (*m.stated_u > 0.0 && std::isfinite(*m.stated_u)), "a repeatability");
    demand(!m.uses_stated_u || m.stated_u, "a repeatability that is used and not stated");
    demand_honest(job.warnings);
}

/// \param bundle  the files of a job; the job itself is `job.json`
inline bool circle_closure_job(std::string_view bundle) {
    return read_or_refused(
        bundle, [](const MemoryFileSource& files) { demand_consistent(read_circle_closure_job(files, "job.json")); });
}

}  // namespace gumcert::jobs::fuzz
