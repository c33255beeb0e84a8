#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jobs/budget/budget_job.h"
#include "jobs/comparison/comparison_codes.h"
#include "jobs/comparison/comparison_job.h"
#include "jobs/csv_table.h"
#include "jobs/job_fields.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"
#include "jobs/matrix_limits.h"

namespace gumcert::jobs {

// What the parts of the reader of comparisons share.

/// Values and uncertainties are squared, divided and added: beyond these, in the unit of the item, the sums could
/// overflow. No quantity that somebody compares comes near.
inline constexpr double k_largest_compared = 1e60;
inline constexpr double k_least_compared_u = 1e-60;

inline constexpr NumberRange k_compared_value = between(-k_largest_compared, k_largest_compared, "");
inline constexpr NumberRange k_compared_uncertainty{
    .low = 0.0,
    .low_open = true,
    .hint = "state the uncertainty of the certificate, or none where the laboratory states none"};
inline constexpr NumberRange k_correlation_coefficient{
    .low = -1.0, .high = 1.0, .hint = "state a correlation coefficient, not a covariance"};

/// Budget jobs that results name, each read once.
class ComparisonBudgets {
public:
    ComparisonBudgets(const FileSource& source, JobFiles& files) : source_(source), files_(files) {}
    /// \return null when it was refused; the problems are listed with the others
    [[nodiscard]] std::shared_ptr<const BudgetJob> read(const std::string& name);
    [[nodiscard]] const FileSource& source() const { return source_; }

private:
    const FileSource& source_;
    JobFiles& files_;
    std::map<std::string, std::shared_ptr<const BudgetJob>> read_;
};

/// Refuses a budget with more than one result, or with one of another kind of unit than wanted.
/// \param where  of the key that names the budget
void refuse_other_results(const BudgetJob& budget, const gum::Unit& wanted, const std::string& where,
                          ProblemList& problems);

struct ComparisonReading {
    const JsonDocument& document;
    JobFiles& files;
    ProblemList& problems;  ///< of the job file
    ComparisonBudgets& budgets;
    ComparisonJob& job;
};

/// Ids in the order in which they first appear, found without a search.
class LabelIndex {
public:
    [[nodiscard]] std::optional<std::size_t> find(std::string_view label) const {
        const auto found = positions_.find(label);
        return found == positions_.end() ? std::nullopt : std::optional{found->second};
    }
    /// \return its position, and whether it is new
    std::pair<std::size_t, bool> add(std::string_view label) {
        if (const auto found = find(label)) {
            return {*found, false};
        }
        return {positions_.emplace(std::string(label), positions_.size()).first->second, true};
    }
    [[nodiscard]] std::size_t size() const { return positions_.size(); }
    /// The label nearest to one that is not known, as an advice; `otherwise` without one.
    [[nodiscard]] std::string advice(std::string_view label, std::string otherwise) const;

private:
    struct Hash {
        using is_transparent = void;
        std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
    };
    std::unordered_map<std::string, std::size_t, Hash, std::equal_to<>> positions_;
};

/// What people write who do not say whether a number is u or U.
inline constexpr std::string_view k_bare_key = "uncertainty";

/// An object with some keys.
/// \return nothing when the value is no object
/// \param keys_and_bare  keys_and_bare_of(): "uncertainty" then has a message of its own, because it does not say whether
///     it is u or U; empty: it is an unknown key as any other
[[nodiscard]] std::optional<JsonObject> object_at(const ComparisonReading& reading, const std::string& pointer,
                                                  std::span<const std::string_view> keys,
                                                  std::span<const std::string_view> keys_and_bare = {});

/// The keys of a struct, and "uncertainty".
template <class Struct>
[[nodiscard]] std::span<const std::string_view> keys_and_bare_of() {
    static const std::vector<std::string_view> k_keys = [] {
        std::vector<std::string_view> keys(keys_of<Struct>().begin(), keys_of<Struct>().end());
        keys.push_back(k_bare_key);
        return keys;
    }();
    return k_keys;
}

/// Calls `use` with every element of an array; those that are no objects are refused.
template <typename Use>
void for_each_object(const ComparisonReading& reading, const nlohmann::json& array, const std::string& pointer,
                     std::span<const std::string_view> keys, std::span<const std::string_view> keys_and_bare,
                     const Use& use) {
    for (std::size_t i = 0; i < array.size(); ++i) {
        if (const auto object = object_at(reading, child_pointer(pointer, i), keys, keys_and_bare)) {
            use(*object);
        }
    }
}

/// Whether u, U or k is stated.
[[nodiscard]] bool states_uncertainty(const JsonObject& object);

/// The keys u | U with k, and nu, of an object.
/// \return nothing when none is stated or it was refused
[[nodiscard]] std::optional<gum::ResultUncertainty> read_uncertainty(const ComparisonReading& reading,
                                                                     const JsonObject& object);

/// A standard uncertainty of infinite degrees of freedom.
/// \return nothing beyond what is computed with
[[nodiscard]] std::optional<gum::ResultUncertainty> of_standard_uncertainty(double u, double coverage_probability);

/// Columns of a table that state uncertainties: positions as CsvTable knows them.
struct UncertaintyColumns {
    std::size_t u = 0, U = 0, k = 0, nu = 0, bare = 0;
    /// Columns that change no number: in other capitals they are left out with a warning.
    std::span<const std::string_view> idle = {};
};
/// Refuses columns that no row can use: a bare uncertainty, U without k; and columns that are not used, but would be under
/// another name: a known one in other capitals, or an uncertainty where the table has none that is known.
/// \param has_others  uncertainties come from elsewhere, a covariance or a budget
/// \return true when there was nothing to refuse
bool check_uncertainty_columns(const CsvTable& table, const UncertaintyColumns& columns, ProblemList& problems,
                               bool has_others = false);
[[nodiscard]] std::optional<gum::ResultUncertainty> read_uncertainty(const CsvTable& table, std::size_t row,
                                                                     const UncertaintyColumns& columns,
                                                                     double coverage_probability,
                                                                     ProblemList& problems);

/// Refuses a row that states its value in another unit: nothing is converted.
/// \param column  of the units; a table need not have it, nor a row state anything
/// \param of  whose unit `wanted` is, for the message
void check_unit_of_row(const CsvTable& table, std::size_t row, std::size_t column, const gum::Unit& wanted,
                       std::string_view of, ProblemList& problems);

/// Whether a table has a column, and the row a text in it.
[[nodiscard]] inline bool is_stated(const CsvTable& table, std::size_t row, std::size_t column) {
    return table.has_column(column) && !table.cell(row, column).text.empty();
}

/// The value of a result. "<0.3" and words such as "n/a" each have a message of their own.
/// \param if_none  what to do where no value was measured
[[nodiscard]] std::optional<double> read_value(const ComparisonReading& reading, const JsonObject& object,
                                               std::string_view if_none);
[[nodiscard]] std::optional<double> read_value(const CsvTable& table, std::size_t row, std::size_t column,
                                               std::string_view if_none, ProblemList& problems);

/// The key `sources`, signed parts of an uncertainty.
/// \param u  of the whole; nothing: not known here
[[nodiscard]] std::vector<gum::UncertaintySource> read_sources(const ComparisonReading& reading,
                                                               const JsonObject& object,
                                                               const std::optional<double>& u);

/// Rows of numbers, all of one length.
/// \return nothing when it was refused
[[nodiscard]] std::optional<Eigen::MatrixXd> read_rows(const ComparisonReading& reading, const JsonObject& object,
                                                       std::string_view key, std::size_t least_rows,
                                                       std::size_t least_columns);

/// Names of a list, for a message: "A", "B" and "C"; after `most` of them "and N more".
[[nodiscard]] std::string list_of(const std::vector<std::string>& names, std::size_t most = 10);

/// What keeps a symmetric matrix with ones on its diagonal from being a correlation matrix; nothing when it is one.
struct NegativeEigenvalue {
    double eigenvalue = 0.0;            ///< the smallest one
    std::vector<std::size_t> culprits;  ///< rows with the largest parts in its eigenvector
};
[[nodiscard]] std::optional<NegativeEigenvalue> negative_eigenvalue(const Eigen::MatrixXd& correlation);

/// An array of texts.
/// \return those that could be read
[[nodiscard]] std::vector<std::string> read_texts(const ComparisonReading& reading, const JsonObject& object,
                                                  std::string_view key);

}  // namespace gumcert::jobs
