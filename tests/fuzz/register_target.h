#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "jobs/laboratory/register_reader.h"
#include "laboratory/applicability.h"
#include "laboratory/recalibration.h"
#include "laboratory/standard_value.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::jobs::fuzz {

/// A file of the register: a standard, with what the library makes of each of its lines, or the data of a laboratory.
inline bool register_file(std::string_view bytes) {
    ProblemList problems("fuzz.json");
    const std::optional<JsonDocument> document = read_json_document(bytes, problems);
    if (!document) {
        demand(problems.refusals() > 0, "refused without a reason");
        return false;
    }
    ProblemList of_standard("fuzz.json"), of_laboratory("fuzz.json");
    const std::optional<laboratory::StandardRecord> record = read_standard(*document, of_standard);
    demand(record || of_standard.refusals() > 0 || document->value.is_discarded(), "refused without a reason");
    (void)read_laboratory(*document, of_laboratory);
    demand_honest(of_standard.refused());
    demand_honest(of_laboratory.refused());
    if (!record) {
        return false;
    }
    const laboratory::Calibration& last = record->calibrations.back();
    for (const laboratory::CalibrationResult& line : last.results) {
        const laboratory::StandardUse use{.quantity = line.quantity,
                                          .range = line.range,
                                          .mode = line.mode,
                                          .at = line.nominal,
                                          .date = laboratory::days_after(last.calibrated, 100)};
        demand((laboratory::applicability(*record, use).answer == laboratory::Answer::yes) ==
                   laboratory::applicability(*record, use).because.empty(),
               "an answer without a reason");
        try {
            (void)laboratory::value_of_standard(*record, use);
            (void)laboratory::next_calibration(*record, line);
        } catch (const gum::InputError& error) {
            demand_honest(error.diagnostics());
        }
    }
    return true;
}

}  // namespace gumcert::jobs::fuzz
