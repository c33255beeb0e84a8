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

namespace gumcert::jobs {

/// The component that readings make beside others.
inline constexpr std::string_view k_component_of_readings = "readings";

/// The inputs of a budget job while it is read.
///
/// Where there is a table, an input may be left to its points (BudgetPoints): what is wrong with its statement, or missing
/// in it, is reported only where a point takes it over.
class BudgetInputs {
public:
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
    };
    using Reading = std::function<const gum::BudgetInput*(const std::string&)>;  ///< the input of a name, or null

    /// \param covariance  of the job, for the inputs that take their variance from it; must outlive this
    BudgetInputs(const JsonDocument& document, const std::optional<StatedCovariance>& covariance, JobFiles& files,
                 ProblemList& problems);

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
    /// Decimals of the value that the job states for all points; nothing where it states none.
    [[nodiscard]] std::optional<int> decimals_of_job(const std::string& input) const;
    /// Names and units of all inputs, for the equations.
    [[nodiscard]] std::vector<gum::InputSymbol> symbols() const;
    /// True when the specification of another input refers to it.
    [[nodiscard]] bool is_read_by_specification(const std::string& name) const;

    /// What the inputs are to the reader of a certificate, by their names.
    [[nodiscard]] const std::map<std::string, QuantityPart>& parts() const { return parts_; }

    // ---- for the points ---------------------------------------------------------------------------------------------

    /// Those whose name and unit could be read.
    [[nodiscard]] const std::vector<Stated>& stated() const { return stated_; }
    /// Where an input is in stated(); nothing where there is none of the name, or it was refused.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
    /// Whether the job has an input of a name, refused or not.
    [[nodiscard]] bool is_named(std::string_view name) const;
    /// Where an input of stated() is in inputs(), which was called before.
    [[nodiscard]] std::size_t position(std::size_t input) const { return positions_[input]; }
    /// The inputs of stated() whose specification refers to one of them.
    [[nodiscard]] const std::vector<std::size_t>& readers(std::size_t input) const { return readers_[input]; }

    /// What keys say of an input; nothing when it was refused.
    [[nodiscard]] std::optional<Evaluated> evaluate(const Stated& stated, const StatementKeys& keys);
    /// Uncertainties from specifications, once the values of all inputs are known.
    [[nodiscard]] bool complete(Evaluated& evaluated, const Reading& reading) const;
    /// Refuses numbers whose digits are lost beside the uncertainty of the input.
    [[nodiscard]] static bool check_digits(const Evaluated& evaluated);
    /// A point states the resolution of an input.
    void note_resolution(std::size_t input);

private:
    void read_input(const std::string& name, const std::string& pointer, bool has_points);
    [[nodiscard]] bool evaluate_components(const Stated& stated, const StatementKeys& keys, Evaluated& out);
    [[nodiscard]] bool add_component(const Stated& stated, const StatementKeys& keys, bool is_component, Evaluated& out,
                                     bool holds_resolution = false);
    /// Readings, and the resolution that stands beside them.
    [[nodiscard]] bool add_readings_and_resolution(const Stated& stated, const StatementKeys& keys, Evaluated& out);
    void note_resolutions(const nlohmann::json& inputs);
    /// What holds the resolution of the readings of an input where it does not itself: "" where nothing does.
    [[nodiscard]] std::string other_resolution(const Stated& stated) const;
    void warn_of_similar_names();
    const JsonDocument& document_;
    const std::optional<StatedCovariance>& covariance_;
    JobFiles& files_;
    ProblemList& problems_;
    std::vector<std::string> names_;
    std::vector<Stated> stated_;                     ///< those whose name and unit could be read
    std::map<std::string, std::size_t> of_name_;     ///< in stated_
    std::vector<std::size_t> positions_;             ///< stated_ → job.inputs
    std::vector<std::vector<std::size_t>> readers_;  ///< inputs whose specification refers to one, in stated_
    std::map<std::string, certificate::LocalisedText> descriptions_;
    std::map<std::string, QuantityPart> parts_;
    std::set<std::string> own_components_;
    std::map<std::string, gum::Unit> resolutions_;  ///< of the inputs that state one, in the job or at a point
    bool symbols_are_whole_ = true;
};

}  // namespace gumcert::jobs
