#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/job/file_source.h"
#include "engine/rotary_table_measurement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// The air about one station, as the environment file states it; for documents, the adjustment does not use it.
struct StationAir {
    std::optional<double> temperature_degC;
    std::optional<double> pressure_hPa;
    std::optional<double> humidity_percent;
};

/// A job of kind `rotary_table`: the measurement in SI, and the job as it was read.
struct RotaryTableJob {
    std::string title;                     ///< empty when the job has none
    double coverage_probability = 0.9545;  ///< [1]
    RotaryTableMeasurement measurement;
    std::optional<ReferenceMethod> reference;
    std::vector<StationAir> air;               ///< per station; empty without an environment file
    double reference_temperature_degC = 20.0;  ///< of the fixture coordinates
    nlohmann::json document;                   ///< the job file as read
    nlohmann::json certificate;                ///< the object, from the job or from a file of its own; null without
    /// Names as the job gives them, each once: the job file, lengths, stations, environment, fixture coordinates,
    /// fixture covariance, readings and description of the reference method, certificate.
    std::vector<std::string> files;
    std::vector<gum::Diagnostic> warnings;
};

/// One object of the job document and the keys that it may have.
struct JobKeys {
    std::string_view pointer;
    std::span<const std::string_view> keys;
};

/// The keys of a job of kind `rotary_table`, object by object. schemas/job-1.schema.json states the same ones.
[[nodiscard]] std::span<const JobKeys> rotary_table_job_keys();

/// Reads a job of kind `rotary_table` with all its files, checks it completely and converts it to SI.
///
/// Stations, passes and dead paths come in the order in which the lengths file first names them, reflectors in the
/// order of the fixture file, angles ascending (angles that agree within 1e-9° are one).
/// \throws InputError    with every problem of every file, those of the job file first
/// \throws StorageError  if a file cannot be read; with the problems of the other files after it
[[nodiscard]] RotaryTableJob read_rotary_table_job(const std::filesystem::path& job_file);

/// The same from any source. \param job_file  the name of the job in the source
[[nodiscard]] RotaryTableJob read_rotary_table_job(const FileSource& source, const std::string& job_file);

/// "budget", "rotary_table" or "comparison".
/// \throws InputError    if the file is not a job of this schema
/// \throws StorageError  if it cannot be read
[[nodiscard]] std::string job_kind(const std::filesystem::path& job_file);
[[nodiscard]] std::string job_kind(const FileSource& source, const std::string& job_file);

/// The kind that a job seems to be of, also where its text has faults: which reader should tell what is wrong with it.
/// \return nothing when that cannot be seen
[[nodiscard]] std::optional<std::string> probable_job_kind(const std::filesystem::path& job_file);

}  // namespace gumcert::engine
