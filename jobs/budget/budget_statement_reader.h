#pragma once

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/coverage.h"
#include "gum/type_a.h"
#include "jobs/budget/budget_statement.h"
#include "jobs/budget/budget_statement_fields.h"
#include "text/numbers.h"

namespace gumcert::jobs {

/// A row of the table of statements.
enum class StatementRow {
    constant,
    standard_uncertainty,
    expanded_uncertainty,
    half_width,
    limits,
    resolution,
    maximum_permissible_error,
    observations,
    groups,
    samples,
    distribution,
    relative_standard_uncertainty,
    relative_expanded_uncertainty,
    specification,
    covariance,
};

/// The keys of a row.
struct StatementRowKeys {
    StatementRow row;
    std::string_view key;  ///< that leads the statement
    std::array<std::string_view, 6> others;
};

/// Reads one statement for `evaluate_statement`. Every step returns false, or nothing, when it refused something.
class StatementReader {
public:
    static constexpr double k_infinity = std::numeric_limits<double>::infinity();
    // Squares of uncertainties are added and divided: outside these, [SI], they would overflow or lose digits.
    static constexpr double k_least_u = 1e-140;
    static constexpr double k_largest_u = 1e140;
    static constexpr std::size_t k_most_values = 1'000'000;

    StatementReader(const StatementKeys& keys, const StatementContext& context)
        : keys_(keys),
          context_(context),
          unit_(context.unit),
          unit_text_(unit_.text() == "1" ? "" : unit_.text()),
          difference_text_(unit_.text() == "1" ? "" : gum::unit_of_difference(unit_.text())) {}

    std::optional<EvaluatedStatement> evaluate();

    /// Rectangular limits whose half-width has the relative uncertainty r = 1/√(2ν) become those of a curvilinear
    /// trapezoid, inexactly known within d = r a (JCGM 101:2008, 6.4.3); u stays a/√3, with ν.
    static void make_limits_inexact(gum::StatedQuantity& quantity, double nu);

private:
    // ---- which statement it is --------------------------------------------------------------------------------------

    [[nodiscard]] bool leads(const StatementRowKeys& row) const;
    [[nodiscard]] bool says_constant() const;

    std::optional<StatementRow> find_row();

    bool refuse_strangers(StatementRow row) const;

    // ---- what stands beside every statement -------------------------------------------------------------------------

    bool read_remarks(StatementRow row);

    /// ν as stated, or from the reliability of u; infinite without both.
    std::optional<double> degrees_of_freedom();

    // ---- values -----------------------------------------------------------------------------------------------------

    [[nodiscard]] double to_si(double value) const;
    [[nodiscard]] double difference_to_si(double difference) const { return unit_.difference_to_si(difference); }

    void set_value(double value);
    /// The key `value`; a component may leave it out: it adds nothing then.
    bool read_value(bool may_be_absent = false);
    [[nodiscard]] NumberRange uncertainty_range() const;
    bool is_representable(StatementRow row) const;

    // ---- rows -------------------------------------------------------------------------------------------------------

    bool read(StatementRow row);

    bool read_constant();

    /// Gaussian, or the scaled and shifted t when there are degrees of freedom (JCGM 101:2008, 6.4.7 and 6.4.9).
    bool set_standard_uncertainty(double u, double nu);

    /// |value| that a relative uncertainty refers to.
    std::optional<double> reference_of_relative(std::string_view key);
    [[nodiscard]] static NumberRange relative_range();

    bool read_standard_uncertainty(bool is_relative);

    /// k from the keys `k` or `p`.
    /// \param place  key of the statement that has them, for a warning
    template <typename Keys>
    std::optional<double> coverage_factor(const Keys& keys, double nu, std::string_view place) {
        const bool has_k = keys.has("k");
        if (has_k == keys.has("p")) {
            keys.refuse(has_k ? k_two_statements : k_incomplete_statement, has_k ? "p" : "",
                        has_k ? "\"k\" and \"p\" are given together" : "an expanded uncertainty without \"k\" or \"p\"",
                        "an expanded uncertainty has a coverage factor k or a coverage probability p",
                        has_k ? "keep one of them" : "add \"k\" or \"p\" from the certificate");
            return std::nullopt;
        }
        if (has_k) {
            const auto k = number_of(keys, "k", above_zero(""));
            if (k) {
                warn_of_unusual_coverage_factor(*k, nu, place);
            }
            return k;
        }
        const NumberRange probability{.low = 0.0,
                                      .high = 1.0,
                                      .low_open = true,
                                      .high_open = true,
                                      .hint = "state a probability, not a percentage, such as 0.95"};
        const auto p = number_of(keys, "p", probability);
        try {
            return p ? std::optional{gum::coverage_factor(*p, nu)} : std::nullopt;
        } catch (const gum::DiagnosedError&) {
            keys.refuse(
                k_not_representable, "p",
                "no coverage factor for p = " + text::shortest_plain(*p) + " and nu = " + text::shortest_plain(nu),
                "the factor must be representable", "check the degrees of freedom");
            return std::nullopt;
        }
    }
    void warn_of_unusual_coverage_factor(double k, double nu, std::string_view place) const;
    static std::optional<double> number_of(const StatementKeys& keys, std::string_view key, const NumberRange& range);
    static std::optional<double> number_of(const JsonObject& object, std::string_view key, const NumberRange& range);

    bool read_expanded_uncertainty(bool is_relative);

    bool read_from_covariance();

    /// A distribution within ± half_width about the value that is set.
    bool set_bounded(double half_width);
    /// Refuses degrees of freedom of limits that cannot be taken into account.
    [[nodiscard]] bool limits_may_have(gum::DistributionKind kind, double nu) const;
    void refuse_bounded_word(const std::string& word, bool is_plain) const;
    /// Of the key `d` of a curvilinear trapezoid, in the unit of the half-width.
    [[nodiscard]] NumberRange range_of_d(double half_width) const;
    /// Distribution and u of a quantity between two limits; its value is set before.
    void set_bounded(gum::DistributionKind kind, double half_width, double shape);
    void refuse_shape_keys(gum::DistributionKind kind) const;

    bool read_half_width(std::string_view key, double factor);

    bool read_limits();
    void refuse_interval(std::string_view key, double a, double b) const;

    // ---- Type A -----------------------------------------------------------------------------------------------------

    bool read_observations();

    bool set_type_a(std::string_view key, double u, double nu);

    /// Mean and scatter of readings, at least one; refused where they are too large for a result.
    [[nodiscard]] std::optional<gum::ObservationSummary> summary_of(std::string_view key,
                                                                    const std::vector<double>& readings) const;
    bool count_fits(std::string_view key, std::size_t count, std::size_t least, const std::string& rule) const;

    /// Readings in groups, valid with or without an effect between the groups: u = s(x̄_j)/√J with J − 1 degrees of
    /// freedom                                                                   (after JCGM 100:2008, H.5)
    bool read_groups();
    bool read_lists_of(gum::GroupedReadings& groups) const;
    bool read_summary_of(gum::GroupedReadings& groups) const;

    // ---- distributions ----------------------------------------------------------------------------------------------

    bool read_samples();
    void set_value_in_si(double value);

    /// `"samples": "earlier.csv"`, or an object with file and column; the column has the name of the input otherwise.
    std::optional<std::vector<double>> read_sample_file(const nlohmann::json& value);

    bool read_distribution();
    bool read_specification();
    bool read_bounded_form(const JsonObject& object, gum::DistributionKind kind);
    bool read_positive_form(const JsonObject& object, std::string_view kind);

    const StatementKeys& keys_;
    const StatementContext& context_;
    const gum::Unit& unit_;
    std::string unit_text_, difference_text_;  ///< empty for a number
    gum::StatedQuantity quantity_;
    bool is_constant_ = false;
    std::optional<StatedSpecification> specification_;
};

}  // namespace gumcert::jobs
