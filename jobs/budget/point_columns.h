#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_job.h"
#include "jobs/csv_table.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"

namespace gumcert::jobs {

/// Columns of the points that no equation uses: nominal values, ranges, limits, words for people. They are kept in
/// BudgetJob::point_columns, one value a point.
class PointColumns {
public:
    /// All of them must outlive this.
    PointColumns(const JsonDocument& document, const BudgetInputs& inputs, BudgetJob& job, ProblemList& problems);

    /// Reads the key `columns` of the points of the job or of a section.
    void read_declared(const JsonObject& points);
    /// The column of a name: one that is declared, or one of limits, which needs no declaration.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name);
    [[nodiscard]] bool has_words(std::size_t column) const { return has_words_[column]; }

    /// Adds what the cell of a file says at the next point.
    /// \param cell  its place in the table
    void read_cell(std::size_t column, const CsvTable& table, std::size_t row, std::size_t cell, ProblemList& problems);
    /// Adds what a point of the job says, at the place `at` of the document.
    void read_value(std::size_t column, const nlohmann::json& value, const std::string& at);
    /// Every column has a value for each point that the job has so far: an empty one where nothing is said.
    void fill();

private:
    struct Column {
        certificate::PointColumn column;
        bool has_words = true;
    };

    [[nodiscard]] bool has_free_name(const std::string& name, const std::string& where) const;
    [[nodiscard]] std::optional<Column> declared(const std::string& name, const nlohmann::json& value,
                                                 const std::string& at) const;
    void add(Column declared, const std::string& where);

    const JsonDocument& document_;
    const BudgetInputs& inputs_;
    BudgetJob& job_;
    ProblemList& problems_;
    std::vector<bool> has_words_;  ///< as in the job
};

}  // namespace gumcert::jobs
