#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/budget/budget_correlation.h"
#include "jobs/budget/budget_job.h"
#include "jobs/budget/budget_statement.h"
#include "jobs/job_files.h"
#include "jobs/laboratory/laboratory_use.h"

namespace gumcert::jobs {

/// The component that readings make beside others.
inline constexpr std::string_view k_component_of_readings = "readings";

/// The inputs of a budget job while it is read, and the points of its table, which state some of them anew.
///
/// Where there is a table, an input may be left to the points: what is wrong with its statement, or missing in it, is
/// reported only where a point takes it over.
class BudgetInputs {
public:
    /// \param covariance  of the job, for the inputs that take their variance from it; must outlive this
    /// \param laboratory  for the rows of a table that name standards; must outlive this
    BudgetInputs(const JsonDocument& document, const std::optional<StatedCovariance>& covariance, JobFiles& files,
                 LaboratoryUse& laboratory, ProblemList& problems);

    /// Reads the key `inputs`; the names of all of them are known then, those with problems included.
    void read(const JsonObject& root);
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// Every input has a name and a unit that an equation can use, whatever else is wrong with it.
    [[nodiscard]] bool symbols_are_whole() const { return symbols_are_whole_; }

    /// The inputs without problems, in the order of the job.
    /// \param positions  receives where each one is
    [[nodiscard]] std::vector<gum::BudgetInput> inputs(std::map<std::string, std::size_t>& positions);
    /// What the inputs are, by their names.
    [[nodiscard]] const std::map<std::string, certificate::LocalisedText>& descriptions() const {
        return descriptions_;
    }
    /// Names that the program gave to components: "readings", "resolution".
    [[nodiscard]] const std::set<std::string>& own_components() const { return own_components_; }
    /// Decimals with which a point states the value of an input, or one more where it is a mean of several readings;
    /// nothing where the point does not state it by numbers of its own.
    [[nodiscard]] std::optional<int> decimals(const std::string& input, std::size_t point) const;
    /// Those of the value that the job states for all points; nothing where it states none.
    [[nodiscard]] std::optional<int> decimals_of_job(const std::string& input) const;
    /// Names and units of all inputs, for the equations.
    [[nodiscard]] std::vector<gum::InputSymbol> symbols() const;
    /// True when the specification of another input refers to it.
    [[nodiscard]] bool is_read_by_specification(const std::string& name) const;

    /// What the inputs are to the reader of a certificate, by their names.
    [[nodiscard]] const std::map<std::string, QuantityPart>& parts() const { return parts_; }

    /// Reads the key `points` of the job or of a section; the inputs of the job must be in it already, with correlations
    /// and fits. Of several sections the points come one after the other.
    /// \param used  names of the inputs that the results rest on, in the form in which names are compared; nothing: all.
    ///              A point leaves the others to the sections that use them
    void read_points(const JsonObject& object, const std::optional<std::set<std::string>>& used, BudgetJob& job);
    /// What the points leave open, and what of the job they leave unused: after the last section.
    void finish_points(BudgetJob& job);
    /// Whether the results of a section rest on an input; of a job without sections they may rest on all.
    [[nodiscard]] bool is_used(const std::string& input, std::size_t section) const;

private:
    /// An input, and what is needed to evaluate it again at a point.
    struct Evaluated {
        gum::BudgetInput input;
        std::vector<std::optional<StatedSpecification>> specifications;  ///< one a component
        std::vector<StatementKeys> keys;                                 ///< one a component
        bool is_stated_common = false;
    };
    struct Stated {
        std::string name;
        gum::Unit unit;
        std::optional<StatementKeys> keys;
        std::optional<Evaluated> base;         ///< nothing when it was refused
        bool is_complete = true;               ///< false: its specification waits for the value of another input
        std::unique_ptr<ProblemList> pending;  ///< what is wrong with the base, in a job with points
        std::size_t wanted = 0;                ///< points whose results rest on the input
        bool is_wanted_alone = false;          ///< by a section without points
        bool is_table_refused = false;         ///< of points that may state it
        std::size_t points = 0;                ///< of these, that state the input, or were refused for it
        std::vector<std::string> silent;       ///< names of the first points that leave it to the job
        std::map<std::string_view, std::size_t> overridden;  ///< keys of the base: points that replace them
    };
    using Reading = std::function<const gum::BudgetInput*(const std::string&)>;  ///< the input of a name, or null

    void read_input(const std::string& name, const std::string& pointer, bool has_points);
    [[nodiscard]] std::optional<Evaluated> evaluate(const Stated& stated, const StatementKeys& keys);
    [[nodiscard]] bool evaluate_components(const Stated& stated, const StatementKeys& keys, Evaluated& out);
    [[nodiscard]] bool add_component(const Stated& stated, const StatementKeys& keys, bool is_component, Evaluated& out,
                                     bool holds_resolution = false);
    /// Readings, and the resolution that stands beside them.
    [[nodiscard]] bool add_readings_and_resolution(const Stated& stated, const StatementKeys& keys, Evaluated& out);
    void note_resolutions(const nlohmann::json& inputs);
    /// What holds the resolution of the readings of an input where it does not itself: "" where nothing does.
    [[nodiscard]] std::string other_resolution(const Stated& stated) const;
    /// Uncertainties from specifications, once the values of all inputs are known.
    [[nodiscard]] bool complete(Evaluated& evaluated, const Reading& reading) const;
    void warn_of_similar_names();
    /// Refuses numbers whose digits are lost beside the uncertainty of the input.
    static bool check_digits(const Evaluated& evaluated);
    /// An input that neither the job nor all of its points state.
    void refuse_unstated(const Stated& stated, std::size_t points);
    /// The inputs that what is read now rests on.
    void set_used(const std::optional<std::set<std::string>>& names);

    /// One column of a file of points.
    struct FileColumn {
        std::string name;
        std::optional<std::size_t> input = {};
        std::string_view key = {};
        std::optional<std::size_t> information = {};  ///< in BudgetJob::point_columns
        bool is_reading = false;
        bool is_reference = false;    ///< to a standard of the laboratory: NAME.standard, NAME.at …
        bool takes_standard = false;  ///< of these, the one that stands for all of its input
    };
    void read_columns(const JsonObject& points, BudgetJob& job);
    [[nodiscard]] std::optional<std::size_t> information(const std::string& name, BudgetJob& job);
    void read_information(const FileColumn& column, const CsvTable& table, std::size_t row, std::size_t position,
                          ProblemList& problems, BudgetJob& job);
    void read_information(std::size_t column, const nlohmann::json& value, const std::string& at, BudgetJob& job);
    /// Every column has a value for each of the first `points`.
    static void fill_columns(std::size_t points, BudgetJob& job);
    void note_decimals(std::size_t input, std::size_t point, int decimals);

    void read_point_array(const nlohmann::json& points, const std::string& pointer, BudgetJob& job);
    void read_point_file(const std::string& name, BudgetJob& job);
    /// \param told  inputs that were refused at this point already
    void read_point(gum::BudgetPoint& point, const std::map<std::size_t, StatementKeys>& overrides,
                    const std::set<std::size_t>& told, BudgetJob& job);
    /// \param column  of a file, as it is called there, for the advice; none of a point in the job
    [[nodiscard]] std::optional<std::size_t> point_input(const std::string& name, const std::string& where,
                                                         const BudgetJob& job, ProblemList& problems,
                                                         const std::string* column = nullptr) const;
    void name_point(gum::BudgetPoint& point, const std::optional<std::string>& name, const std::string& where,
                    const BudgetJob& job, ProblemList& problems);

    const JsonDocument& document_;
    const std::optional<StatedCovariance>& covariance_;
    JobFiles& files_;
    LaboratoryUse& laboratory_;
    ProblemList& problems_;
    std::vector<std::string> names_;
    std::vector<Stated> stated_;                     ///< those whose name and unit could be read
    std::map<std::string, std::size_t> of_name_;     ///< in stated_
    std::vector<std::size_t> positions_;             ///< stated_ → job.inputs
    std::vector<std::vector<std::size_t>> readers_;  ///< inputs whose specification refers to one, in stated_
    std::map<std::string, std::string> point_names_;
    std::map<std::string, certificate::LocalisedText> descriptions_;
    std::map<std::string, QuantityPart> parts_;
    std::vector<bool> has_words_;                       ///< columns of points that are declared, as in the job
    std::map<std::size_t, std::vector<int>> decimals_;  ///< of stated_: one a point, -1 where not stated
    std::vector<std::vector<bool>> used_;               ///< one a section, or one alone: of stated_
    std::set<std::string> own_components_;
    std::map<std::string, gum::Unit> resolutions_;  ///< of the inputs that state one, in the job or at a point
    bool symbols_are_whole_ = true;
};

}  // namespace gumcert::jobs
