#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "certificate/certificate_data.h"
#include "engine/job/file_source.h"
#include "engine/job/job_kind.h"
#include "engine/job/monte_carlo_request.h"
#include "gum/coverage_choice.h"
#include "gum/expression/equation_system.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/distribution.h"
#include "gum/quantity/measurement_model.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"

namespace gumcert::engine {

/// Readings taken in groups (days, operators, set-ups), for the analysis of variance of JCGM 100:2008, H.5.
struct GroupedReadings {
    std::vector<std::vector<double>> readings;  ///< one list a group, coherent SI; empty when only a summary is given
    std::vector<double> means, standard_deviations;  ///< one a group, coherent SI
    std::vector<std::size_t> sizes;                  ///< one a group
};

/// One statement of what is known of a quantity. An input is one of them, or the sum of several components.
struct StatedQuantity {
    std::string name;  ///< of the component; empty where the input is one statement
    gum::Evaluation evaluation = gum::Evaluation::type_b;
    std::string statement;  ///< which row of the contract: "u", "U, k", "U, p", "half_width", "limits", "resolution",
                            ///< "mpe", "observations", "groups", "samples", "distribution", "relative_u", "relative_U,
                            ///< k", "relative_U, p", "specification", "covariance", "constant"
    double stated_value = 0.0;  ///< the estimate as the job states it, in the unit of the input
    double value = 0.0;  ///< the same, coherent SI; of a second and later component without the origin of the scale, so
                         ///< that the sum of all is the value of the input
    double u = 0.0;      ///< standard uncertainty for the law of propagation, coherent SI; 0 for a constant
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< for the law of propagation
    gum::Distribution distribution;  ///< what Monte Carlo draws, coherent SI (JCGM 101:2008, 6.4)
    std::string source, note, significance;
    std::vector<double> observations;                 ///< coherent SI, in the order read
    std::optional<double> pooled_standard_deviation;  ///< coherent SI, where the job pools; its ν is degrees_of_freedom
    std::optional<GroupedReadings> groups;
    /// Samples from a file: its name, and the values in the order of its rows, coherent SI. Quantities with samples of
    /// one file belong together row by row.
    std::string sample_file;
    std::shared_ptr<const std::vector<double>> sample_rows;
    std::string where;  ///< place in the job, for messages
};

struct BudgetInput {
    std::string name;
    certificate::LocalisedText description;  ///< "length of the standard"; may be empty
    gum::Unit unit;
    bool constant = false;                   ///< u = 0 on purpose
    std::vector<StatedQuantity> components;  ///< one, or several that are added up
    /// Where the job has a table of points: true when all points share the quantity, so that their results are
    /// correlated through it; false when each point has one of its own.
    bool common = true;
    /// False where only the points of the table state the quantity: what stands here is what the first of them says.
    bool stated = true;
    std::string where;
};

/// Correlation coefficient of two inputs, from any of the ways to state it. Never 0.
struct InputCorrelation {
    std::size_t first = 0, second = 0;  ///< positions in BudgetJob::inputs
    double r = 0.0;
};

/// Inputs that were observed together (JCGM 100:2008, 5.2.3): their correlations are in `correlations` as well.
struct SimultaneousInputs {
    std::vector<std::size_t> inputs;
    std::size_t observations = 0;  ///< n, of each
};

/// A least-squares fit whose parameters become inputs of the model.
struct BudgetFit {
    std::string name;
    gum::EquationText equation;  ///< "V = a + b*t": the left side was observed
    struct Parameter {
        std::string name;
        gum::Unit unit;
        std::optional<double> start;  ///< coherent SI; needed unless the equation is linear in the parameters
    };
    std::vector<Parameter> parameters;
    std::string ordinate;  ///< name of the left side
    gum::Unit ordinate_unit;
    std::vector<std::string> regressors;  ///< names of the columns on the right side
    std::vector<gum::Unit> regressor_units;
    Eigen::MatrixXd x;              ///< n×q, coherent SI
    Eigen::VectorXd y;              ///< n, coherent SI
    Eigen::MatrixXd y_uncertainty;  ///< empty, n×1 standard uncertainties or n×n covariance, coherent SI
    Eigen::MatrixXd x_uncertainty;  ///< the same of the only regressor
    bool scale_by_residuals = false;
    std::string where;
};

/// One point of a table: the inputs that it states itself, in place of those of the job.
struct BudgetPoint {
    std::string name;                                         ///< from the column or key "point", else "1", "2" …
    std::vector<std::pair<std::size_t, BudgetInput>> inputs;  ///< position in BudgetJob::inputs and what stands there
};

struct BudgetOutput {
    std::string name;
    certificate::LocalisedText description;
    std::optional<gum::Unit> unit;
    std::optional<double> coverage_probability;
    std::optional<gum::CoverageChoice> coverage;  ///< none: that of the job
    std::string where;
};

/// A job of kind `budget`: the measurement model and its inputs in coherent SI, and the job as it was read.
struct BudgetJob {
    std::string title;
    double coverage_probability = 0.9545;
    gum::CoverageChoice coverage = gum::CoverageChoice::as_validated;  ///< of all results that do not state their own
    /// ν_eff is cut to the next lower whole number before k is taken, as the tables of JCGM 100:2008, G.4.1 and EA-4/02
    /// want it.
    bool truncate_degrees_of_freedom = false;
    gum::RoundingMode rounding = gum::RoundingMode::half_even;  ///< of printed expanded uncertainties
    std::vector<gum::EquationText> model;  ///< empty: the inputs and the parameters of the fits are the results
    std::vector<gum::UnknownSymbol> unknowns;
    std::vector<BudgetInput> inputs;
    std::vector<InputCorrelation> correlations;
    std::vector<SimultaneousInputs> simultaneous;
    std::vector<BudgetFit> fits;
    std::vector<BudgetOutput> outputs;  ///< empty: those of the model
    std::vector<BudgetPoint> points;    ///< empty: one evaluation
    std::optional<gum::MonteCarloRequest> monte_carlo;
    nlohmann::json document;
    std::optional<certificate::CertificateData> certificate;  ///< from the job or a file of its own
    std::vector<std::string> files;                           ///< names as the job gives them, each once, the job first
    std::vector<gum::Diagnostic> warnings;
};

/// The keys of a job of kind `budget`, object by object; `*` in a pointer stands for any name or position.
/// schemas/job-1.schema.json states the same ones.
[[nodiscard]] std::span<const JobKeys> budget_job_keys();

/// What the equations of a job may use: its inputs, then the parameters of its fits, each in the order of the job. The
/// value of a constant is with it unless a point of the table states another one.
[[nodiscard]] std::vector<gum::InputSymbol> model_inputs(const BudgetJob& job);
/// What is asked of the equations, in the order of the job; empty: what the model gives by itself.
[[nodiscard]] std::vector<gum::OutputSymbol> model_outputs(const BudgetJob& job);

/// Reads a job of kind `budget` with all its files, checks it completely and converts it to coherent SI.
///
/// Inputs, outputs, fits and parameters come in the order in which they stand in the file. The model and the equations
/// of the fits are compiled once to check them: syntax, names, units, cycles (gum/expression).
/// \throws InputError    with every problem of every file
/// \throws StorageError  if a file cannot be read
[[nodiscard]] BudgetJob read_budget_job(const std::filesystem::path& job_file);
[[nodiscard]] BudgetJob read_budget_job(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::engine
