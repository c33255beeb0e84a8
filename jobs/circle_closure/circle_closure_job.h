#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "gum/circle_closure/circle_closure_request.h"
#include "gum/coverage_choice.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"
#include "jobs/input_codes.h"
#include "jobs/job_kind.h"

namespace gumcert::jobs {

// What is refused in a job of kind `circle_closure` beyond the form of its keys and tables.
inline constexpr InputCode k_closure_repeated_reading{"GC-CLOSURE-0001",
                                                      "two readings of one position, step and repetition"};
inline constexpr InputCode k_closure_positions{"GC-CLOSURE-0002",
                                               "positions of the artefact that do not determine the deviations"};
inline constexpr InputCode k_closure_not_read{"GC-CLOSURE-0003", "a step or a side that no reading ties to the others"};
inline constexpr InputCode k_closure_too_large{"GC-CLOSURE-0004", "more readings than the adjustment holds"};
inline constexpr InputCode k_closure_drift{"GC-CLOSURE-0005", "drift without a closing reading"};
inline constexpr InputCode k_closure_value{"GC-CLOSURE-0006", "an effect with a value that moves no result"};
inline constexpr std::array k_closure_codes{k_closure_repeated_reading, k_closure_positions, k_closure_not_read,
                                            k_closure_too_large,        k_closure_drift,     k_closure_value};

/// A job of kind `circle_closure`: the request, in whose unit readings and results are, and the job as it was read.
struct CircleClosureJob : gum::CircleClosureRequest {
    certificate::LocalisedText title;
    gum::CoverageChoice coverage = gum::CoverageChoice::as_validated;
    std::optional<char> axis;      ///< 'A', 'B' or 'C': deviations of the table are then named EAA, EBB or ECC
    double first_angle_deg = 0.0;  ///< of the table at step 0
    std::string artefact;          ///< what stands on the table: "polygon of 36 sides"; "" where not stated
    std::vector<std::string> readings_as_stated;  ///< one a reading, for documents
    std::string repeatability_source;
    nlohmann::json document;
    std::optional<certificate::CertificateData> certificate;
    std::vector<std::string> files;
    std::vector<gum::Diagnostic> warnings;

    /// Angle of a step or of a side [deg]; both begin at `first_angle_deg` and at 0.
    [[nodiscard]] double step_angle_deg(std::size_t step) const;
    [[nodiscard]] double side_angle_deg(std::size_t side) const;
};

/// The keys of a job of kind `circle_closure`, object by object; `*` in a pointer stands for any position.
[[nodiscard]] std::span<const JobKeys> circle_closure_job_keys();

/// Reads a job of kind `circle_closure` with its files and checks it completely.
/// \throws InputError    with every problem of every file
/// \throws StorageError  if a file cannot be read
[[nodiscard]] CircleClosureJob read_circle_closure_job(const std::filesystem::path& job_file);
[[nodiscard]] CircleClosureJob read_circle_closure_job(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::jobs
