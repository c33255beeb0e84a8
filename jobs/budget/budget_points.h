#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_job.h"
#include "jobs/budget/point_columns.h"
#include "jobs/budget/stated_point.h"
#include "jobs/job_files.h"
#include "jobs/laboratory/laboratory_use.h"

namespace gumcert::jobs {

/// The points of the table of a budget job, which state some of its inputs anew.
class BudgetPoints {
public:
    /// \param inputs  of the job, read
    /// \param job     with its inputs, correlations and fits; takes the points
    /// All of them must outlive this.
    BudgetPoints(const JsonDocument& document, BudgetInputs& inputs, JobFiles& files, LaboratoryUse& laboratory,
                 BudgetJob& job, ProblemList& problems);

    /// Reads the key `points` of the job or of a section. Of several sections the points come one after the other.
    /// \param used  names of the inputs that the results rest on, in the form in which names are compared; nothing: all.
    ///              A point leaves the others to the sections that use them
    void read(const JsonObject& object, const std::optional<std::set<std::string>>& used);
    /// What the points leave open, and what of the job they leave unused: after the last section.
    void finish();

    /// Whether the results of a section rest on an input; of a job without sections they may rest on all.
    [[nodiscard]] bool is_used(const std::string& input, std::size_t section) const;
    /// Decimals with which a point states the value of an input, or one more where it is a mean of several readings;
    /// nothing where the point does not state it by numbers of its own.
    [[nodiscard]] std::optional<int> decimals(const std::string& input, std::size_t point) const;

    /// What is printed at the points and used in no equation.
    [[nodiscard]] PointColumns& columns() { return columns_; }
    /// Every point of the section that is read states an input: it is used there, and be it to be printed only.
    void use(std::size_t input) { used_.back()[input] = true; }
    /// Evaluates what a point states, and adds it to the job.
    /// \param where  the point stands
    void add(const StatedPoint& stated, const std::string& where, ProblemList& problems);

private:
    /// What the points say of an input, of all sections.
    struct Coverage {
        std::size_t wanted = 0;                              ///< points whose results rest on the input
        bool is_wanted_alone = false;                        ///< by a section without points
        bool is_table_refused = false;                       ///< of points that may state it
        std::size_t stated = 0;                              ///< points that state the input, or were refused for it
        std::vector<std::string> silent;                     ///< names of the first points that leave it to the job
        std::map<std::string_view, std::size_t> overridden;  ///< keys of the job: points that replace them
        std::vector<int> decimals;                           ///< one a point, -1 where not stated
    };

    void set_used(const std::optional<std::set<std::string>>& names);
    void read_table(const JsonObject& table);
    [[nodiscard]] std::string name_point(const StatedPoint& stated, const std::string& where, ProblemList& problems);
    void note_coverage(const StatedPoint& stated, const std::string& name);
    [[nodiscard]] std::optional<BudgetInputs::Evaluated> evaluated_at(std::size_t input, const StatementKeys& keys);
    void refuse_unstated(std::size_t input);
    void report_open(std::size_t input);

    const JsonDocument& document_;
    BudgetInputs& inputs_;
    JobFiles& files_;
    LaboratoryUse& laboratory_;
    BudgetJob& job_;
    ProblemList& problems_;
    PointColumns columns_;
    std::vector<Coverage> coverage_;                  ///< as BudgetInputs::stated()
    std::vector<std::vector<bool>> used_;             ///< one a section, or one alone: of BudgetInputs::stated()
    std::map<std::string, std::string> point_names_;  ///< and where they stand
};

}  // namespace gumcert::jobs
