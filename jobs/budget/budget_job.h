#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "certificate/laboratory_register.h"
#include "certificate/localised_text.h"
#include "certificate/point_tables.h"
#include "gum/budget/budget.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"
#include "jobs/job_kind.h"
#include "jobs/laboratory/laboratory_use.h"

namespace gumcert::jobs {

/// What a quantity is to the reader of a certificate (certificate/point_tables.h); "" says nothing.
struct QuantityPart {
    std::string role, stage;
    std::string form = {};  ///< "sexagesimal": of numbers as documents print them
};

/// A job of kind `budget`: the budget, and the job as it was read.
struct BudgetJob : gum::Budget {
    certificate::LocalisedText title;
    std::map<std::string, QuantityPart> input_parts, output_parts;  ///< by their names; those that state one
    /// What points have beside their inputs, and then the inputs that tables and limits name.
    std::vector<certificate::PointColumn> point_columns;
    std::vector<certificate::TableRequest> tables;
    /// Titles of the sections, one a section of the budget; empty: the name of the section.
    std::vector<certificate::LocalisedText> section_titles;
    /// Units of results by their names, where a table shows a point in others; one a point, or empty.
    std::vector<std::map<std::string, gum::Unit>> point_units;
    /// What inputs and outputs are, by their names: "length of the standard"; those without are not here.
    std::map<std::string, certificate::LocalisedText> input_descriptions, output_descriptions;
    /// Components that the program named: those of standards, and "readings" and "resolution" that stand beside each other.
    LaboratoryUse::StandardComponents standard_components;
    std::set<std::string> own_components;
    nlohmann::json document;
    std::optional<certificate::CertificateData> certificate;  ///< from the job or a file of its own
    std::optional<certificate::LaboratoryRegister>
        registered;                  ///< as of register_of_job(), where there is a certificate
    std::vector<std::string> files;  ///< names as the job gives them, each once, the job first
    std::vector<gum::Diagnostic> warnings;
};

/// The keys of a job of kind `budget`, object by object; `*` in a pointer stands for any name or position.
/// schemas/job-1.schema.json states the same ones.
[[nodiscard]] std::span<const JobKeys> budget_job_keys();

/// Reads a job of kind `budget` with all its files, checks it completely and converts it to coherent SI.
///
/// Inputs, outputs, fits and parameters come in the order in which they stand in the file. The model and the equations
/// of the fits are compiled once to check them: syntax, names, units, cycles (gum/expression).
/// \throws InputError    with every problem of every file
/// \throws StorageError  if a file cannot be read
[[nodiscard]] BudgetJob read_budget_job(const std::filesystem::path& job_file);
[[nodiscard]] BudgetJob read_budget_job(const FileSource& source, const std::string& job_file);

/// The same for a budget that others build upon, which has one set of results: the budget of a fixture, of a reference
/// value, of one side of a comparison.
/// \throws InputError    as read_budget_job(), and GC-INPUT-0364 for a budget with sections
/// \throws StorageError  if a file cannot be read
[[nodiscard]] BudgetJob read_undivided_budget_job(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::jobs
