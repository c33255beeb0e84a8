#include "jobs/budget/budget_correlation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "gum/nearest_correlation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/rounding.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/csv_table.h"
#include "jobs/matrix_limits.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr double k_same_variance = 1e-6;

constexpr double k_largest_repair = 5e-4;     // of a correlation coefficient
constexpr std::size_t k_most_repaired = 100;  // inputs in one matrix: eigenvalues again and again

/// Half a unit of the last digit of a number as it is written: 0.005 of "0.50", 5 of "1.5e2"; 0 of no number.
double half_of_last_digit(const std::string& written) {
    const std::size_t exponent_at = written.find_first_of("eE");
    const std::string digits = written.substr(0, exponent_at);
    if (digits.find_first_of("0123456789") == std::string::npos) {
        return 0.0;
    }
    int power = 0;
    if (exponent_at != std::string::npos) {
        const std::size_t sign = written[exponent_at + 1] == '+' ? 2 : 1;
        std::from_chars(written.data() + exponent_at + sign, written.data() + written.size(), power);
    }
    if (const std::size_t point = digits.find('.'); point != std::string::npos) {
        power -= static_cast<int>(digits.size() - point - 1);
    }
    return 0.5 * std::pow(10.0, power);
}

std::string unknown_action(std::string_view name, const std::vector<std::string>& names) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::optional<std::string_view> nearest = nearest_word(name, known);
    return nearest ? "did you mean " + text::in_quotes(*nearest) + "?" : "correct the name, or add the input";
}

/// A matrix in the job, row by row.
/// \return nothing when it was refused
std::optional<Eigen::MatrixXd> read_matrix(const json& rows, const std::string& pointer, std::size_t order,
                                           const JsonDocument& document, ProblemList& problems) {
    const auto size = static_cast<Eigen::Index>(order);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    const auto wrong_size = [&](const std::string& at, std::size_t count, const std::string& what) {
        problems.refuse(k_wrong_size, document.where(at), std::to_string(count) + " " + what,
                        "the matrix has " + std::to_string(order) + " rows and columns, one for each input",
                        "correct the matrix");
    };
    if (rows.size() != order) {
        wrong_size(pointer, rows.size(), "rows");
        return std::nullopt;
    }
    bool is_read = true;
    for (std::size_t i = 0; i < order; ++i) {
        const std::string at = child_pointer(pointer, i);
        if (!rows[i].is_array() || rows[i].size() != order) {
            if (rows[i].is_array()) {
                wrong_size(at, rows[i].size(), "columns");
            } else {
                problems.refuse(k_wrong_type, document.where(at), described(rows[i]), "must be an array",
                                "write a row as an array of numbers");
            }
            is_read = false;
            continue;
        }
        for (std::size_t j = 0; j < order; ++j) {
            const json& element = rows[i][j];
            if (element.is_number()) {
                matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = element.get<double>();
                continue;
            }
            is_read = false;
            if (!element.is_discarded()) {
                problems.refuse(k_wrong_type, document.where(child_pointer(at, j)), described(element),
                                "must be a number", "correct the value");
            }
        }
    }
    return is_read ? std::optional{std::move(matrix)} : std::nullopt;
}

/// Refuses what no covariance has: two values for one pair, a variance below 0.
bool is_covariance(const Eigen::MatrixXd& matrix, const std::vector<std::string>& inputs, const std::string& where,
                   ProblemList& problems) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        const std::string& name = inputs[static_cast<std::size_t>(i)];
        if (!(matrix(i, i) > 0.0)) {
            problems.refuse(k_number_out_of_range, where,
                            "the variance of " + text::in_quotes(name) + " is " + text::shortest_plain(matrix(i, i)),
                            "a variance must be greater than 0", "correct the matrix, or leave the input out of it");
            return false;
        }
        for (Eigen::Index j = 0; j < i; ++j) {
            const double scale = std::sqrt(std::abs(matrix(i, i))) * std::sqrt(std::abs(matrix(j, j)));
            if (!(std::abs(matrix(i, j) - matrix(j, i)) <= k_same_number * scale)) {
                problems.refuse(k_matrix_not_symmetric, where,
                                "the covariance of " + text::in_quotes(name) + " and " +
                                    text::in_quotes(inputs[static_cast<std::size_t>(j)]) + " is " +
                                    text::shortest_plain(matrix(i, j)) + " in one place and " +
                                    text::shortest_plain(matrix(j, i)) + " in the other",
                                "a covariance matrix is symmetric", "correct the matrix");
                return false;
            }
        }
    }
    return true;
}

/// Collects the correlations of the job.
class Correlations {
public:
    Correlations(const JsonDocument& document, const std::map<std::string, std::size_t>& positions,
                 const std::vector<std::string>& names, BudgetJob& job, ProblemList& problems)
        : document_(document), positions_(positions), names_(names), job_(job), problems_(problems) {}

    void read_pairs(const json& pairs, const std::string& pointer) {
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            read_pair(pairs[i], child_pointer(pointer, i));
        }
    }

    void read_stated(const StatedCovariance& stated, const std::string& pointer) {
        const auto n = static_cast<Eigen::Index>(stated.inputs.size());
        for (Eigen::Index i = 0; i < n; ++i) {
            const std::string at_name = child_pointer(pointer + "/inputs", static_cast<std::size_t>(i));
            const std::optional<std::size_t> first = position(stated.inputs[static_cast<std::size_t>(i)], at_name);
            if (!first || !is_variable(*first, at_name)) {
                continue;
            }
            check_variance(*first, stated.matrix(i, i), at_name);
            for (Eigen::Index j = 0; j < i; ++j) {
                const auto second = positions_.find(stated.inputs[static_cast<std::size_t>(j)]);
                if (second == positions_.end()) {
                    continue;
                }
                const double scale = std::sqrt(stated.matrix(i, i)) * std::sqrt(stated.matrix(j, j));
                const double r = stated.matrix(i, j) / scale;
                // The digits of the variances count as well: r has their relative half units, half of each.
                const double half_unit =
                    half_of_last_digit(text::shortest_plain(stated.matrix(i, j))) / scale +
                    0.5 * std::abs(r) *
                        (half_of_last_digit(text::shortest_plain(stated.matrix(i, i))) / stated.matrix(i, i) +
                         half_of_last_digit(text::shortest_plain(stated.matrix(j, j))) / stated.matrix(j, j));
                add(second->second, *first, r,
                    child_pointer(child_pointer(pointer + "/matrix", static_cast<std::size_t>(i)),
                                  static_cast<std::size_t>(j)),
                    half_unit);
            }
        }
    }

    void read_simultaneous(const json& sets, const std::string& pointer) {
        for (std::size_t i = 0; i < sets.size(); ++i) {
            read_set(sets[i], child_pointer(pointer, i));
        }
    }

    void finish() {
        check_clusters();
        std::sort(job_.correlations.begin(), job_.correlations.end(), [](const auto& a, const auto& b) {
            return std::pair{a.first, a.second} < std::pair{b.first, b.second};
        });
    }

private:
    std::optional<std::size_t> position(const std::string& name, const std::string& pointer) {
        if (const auto found = positions_.find(name); found != positions_.end()) {
            return found->second;
        }
        // An input with problems of its own has been refused already.
        if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
            const bool is_parameter = std::any_of(job_.fits.begin(), job_.fits.end(), [&](const gum::BudgetFit& fit) {
                return std::any_of(fit.parameters.begin(), fit.parameters.end(),
                                   [&](const gum::BudgetFit::Parameter& parameter) { return parameter.name == name; });
            });
            problems_.refuse(
                k_unknown_quantity, document_.where(pointer),
                text::in_quotes(name) + (is_parameter ? " is a parameter of a fit" : " is none of the inputs"),
                is_parameter ? "the fit gives the correlations of its parameters; with other inputs they have none"
                             : "correlations are those of inputs of the job",
                is_parameter ? "remove it" : unknown_action(name, names_));
        }
        return std::nullopt;
    }

    bool is_variable(std::size_t input, const std::string& pointer) {
        if (!job_.inputs[input].constant) {
            return true;
        }
        problems_.refuse(k_correlation_of_constant, document_.where(pointer),
                         text::in_quotes(job_.inputs[input].name) + " is a constant",
                         "a quantity without uncertainty has no correlation", "remove it");
        return false;
    }

    void read_pair(const json& pair, const std::string& pointer) {
        if (!pair.is_array() || pair.size() != 3 || !pair[0].is_string() || !pair[1].is_string() ||
            !pair[2].is_number()) {
            if (!pair.is_array() || pair.size() != 3 || !pair[2].is_discarded()) {
                problems_.refuse(
                    k_wrong_type, document_.where(pointer),
                    pair.is_array() ? "an array of " + std::to_string(pair.size()) + " elements" : described(pair),
                    "a correlation is two names and a number, [\"a\", \"b\", 0.5]", "correct it");
            }
            return;
        }
        const auto first = position(pair[0].get<std::string>(), pointer + "/0");
        const auto second = position(pair[1].get<std::string>(), pointer + "/1");
        const double r = pair[2].get<double>();
        if (!(r >= -1.0 && r <= 1.0)) {
            problems_.refuse(k_number_out_of_range, document_.where(pointer + "/2"),
                             "r(" + text::visible(pair[0].get<std::string>()) + ", " +
                                 text::visible(pair[1].get<std::string>()) + ") is " + text::shortest_plain(r),
                             "a correlation coefficient must be at least -1 and at most 1", "correct it");
            return;
        }
        if (first && second && is_variable(*first, pointer + "/0") && is_variable(*second, pointer + "/1")) {
            add(*first, *second, r, pointer, std::nullopt);
        }
    }

    /// \param half_unit  of the last digit of r; nothing: as the text of the job has it, at pointer/2
    void add(std::size_t first, std::size_t second, double r, const std::string& pointer,
             std::optional<double> half_unit) {
        if (first == second) {
            problems_.refuse(k_correlation_with_itself, document_.where(pointer),
                             "a correlation of " + text::in_quotes(job_.inputs[first].name) + " with itself",
                             "a correlation has two inputs", "correct the names");
            return;
        }
        const auto pair = std::minmax(first, second);
        const auto [entry, is_new] =
            stated_.try_emplace({pair.first, pair.second}, Statement{document_.where(pointer), pointer, half_unit});
        if (!is_new) {
            problems_.refuse(k_repeated_correlation, document_.where(pointer),
                             "the correlation of " + text::in_quotes(job_.inputs[first].name) + " and " +
                                 text::in_quotes(job_.inputs[second].name) + " is stated a second time, first at " +
                                 entry->second.where,
                             "a pair has one correlation", "keep one of them");
            return;
        }
        if (!(std::abs(r) <= 1.0 + k_same_number)) {
            problems_.refuse(k_number_out_of_range, document_.where(pointer),
                             "r(" + text::visible(job_.inputs[first].name) + ", " +
                                 text::visible(job_.inputs[second].name) + ") is " + text::shortest_plain(r),
                             "a correlation coefficient must be at least -1 and at most 1",
                             "correct the covariance or the variances");
            return;
        }
        if (r != 0.0) {
            job_.correlations.push_back({pair.first, pair.second, std::clamp(r, -1.0, 1.0), half_unit.has_value()});
        }
    }

    void check_variance(std::size_t index, double variance, const std::string& pointer) {
        const gum::BudgetInput& input = job_.inputs[index];
        if (!input.stated) {
            return;  // the points of the table state it, with this variance
        }
        double u2 = 0.0;
        for (const gum::StatedQuantity& component : input.components) {
            const double u = input.unit.difference_from_si(component.u);
            u2 += u * u;
        }
        if (!(std::abs(u2 - variance) <= k_same_variance * variance)) {
            problems_.refuse(k_covariance_diagonal, document_.where(pointer),
                             "the variance of " + text::in_quotes(input.name) + " is " +
                                 text::shortest_plain(variance) + " in the matrix, and u² of its statement is " +
                                 text::shortest_plain(u2),
                             "they must agree within 1e-6", "state the uncertainty in one place only");
        }
    }

    /// Covariance of the means of quantities that were observed together           (JCGM 100:2008, 5.2.3, eq. 17)
    void read_set(const json& set, const std::string& pointer) {
        if (!set.is_array() || set.size() < 2 ||
            !std::all_of(set.begin(), set.end(), [](const json& name) { return name.is_string(); })) {
            problems_.refuse(
                k_wrong_type, document_.where(pointer),
                set.is_array() ? "an array of " + std::to_string(set.size()) + " elements" : described(set),
                "inputs that were observed together are an array of at least 2 names", "correct it");
            return;
        }
        gum::SimultaneousInputs together;
        bool fits = true;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const std::string at = child_pointer(pointer, i);
            const auto index = position(set[i].get<std::string>(), at);
            if (!index || !is_variable(*index, at)) {
                fits = false;
                continue;
            }
            const gum::BudgetInput& input = job_.inputs[*index];
            const gum::StatedQuantity& quantity = input.components.front();
            const std::size_t n = quantity.observations.size();
            std::string objection;
            if (input.components.size() != 1 || n < 2) {
                objection = "is not one statement of at least 2 observations";
            } else if (quantity.pooled_standard_deviation) {
                objection = "has a pooled standard deviation";
            } else if (together.observations != 0 && n != together.observations) {
                objection = "has " + text::count_of(n, "observation") + ", and " +
                            text::in_quotes(job_.inputs[together.inputs.front()].name) + " has " +
                            std::to_string(together.observations);
            }
            if (!objection.empty()) {
                problems_.refuse(k_not_simultaneous, document_.where(at), text::in_quotes(input.name) + " " + objection,
                                 "inputs that were observed together have equally many observations, without pooling",
                                 "correct the observations, or state the correlation as a number");
                fits = false;
                continue;
            }
            together.observations = n;
            together.inputs.push_back(*index);
        }
        if (!fits) {
            return;
        }
        for (std::size_t i = 0; i < together.inputs.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                add(together.inputs[j], together.inputs[i], correlation_of(together.inputs[j], together.inputs[i]),
                    child_pointer(pointer, i), 0.0);
            }
        }
        job_.simultaneous.push_back(std::move(together));
    }

    [[nodiscard]] double correlation_of(std::size_t first, std::size_t second) const {
        const auto deviations = [&](std::size_t index) {
            const std::vector<double>& x = job_.inputs[index].components.front().observations;
            const Eigen::Map<const Eigen::VectorXd> values(x.data(), static_cast<Eigen::Index>(x.size()));
            Eigen::VectorXd d = values.array() - values(0);
            d.array() -= d.mean();
            return Eigen::VectorXd(d / d.norm());
        };
        return std::clamp(deviations(first).dot(deviations(second)), -1.0, 1.0);
    }

    void check_clusters() {
        // Union-find over the inputs.
        std::vector<std::size_t> parent(job_.inputs.size());
        std::iota(parent.begin(), parent.end(), std::size_t{0});
        const auto root_of = [&](std::size_t i) {
            while (parent[i] != i) {
                parent[i] = parent[parent[i]];
                i = parent[i];
            }
            return i;
        };
        for (const gum::InputCorrelation& pair : job_.correlations) {
            parent[root_of(pair.first)] = root_of(pair.second);
        }
        std::map<std::size_t, std::vector<std::size_t>> clusters;
        for (std::size_t i = 0; i < parent.size(); ++i) {
            clusters[root_of(i)].push_back(i);
        }
        for (const auto& [root, members] : clusters) {
            if (members.size() > 1) {
                check_cluster(members);
            }
        }
    }

    void check_cluster(const std::vector<std::size_t>& members) {
        const std::string& first_name = job_.inputs[members.front()].name;
        if (members.size() > k_most_in_matrix) {
            problems_.refuse(k_too_many_quantities, job_.inputs[members.front()].where,
                             text::count_of(members.size(), "input") + " are correlated with " +
                                 text::in_quotes(first_name) + " and with each other",
                             "at most " + std::to_string(k_most_in_matrix) + " inputs may be in one correlation matrix",
                             "state fewer correlations");
            return;
        }
        const auto n = static_cast<Eigen::Index>(members.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
        const auto place = [&](std::size_t input) {
            return static_cast<Eigen::Index>(std::lower_bound(members.begin(), members.end(), input) - members.begin());
        };
        const gum::InputCorrelation* last = nullptr;
        for (const gum::InputCorrelation& pair : job_.correlations) {
            if (std::binary_search(members.begin(), members.end(), pair.first)) {
                matrix(place(pair.first), place(pair.second)) = pair.r;
                matrix(place(pair.second), place(pair.first)) = pair.r;
                last = &pair;
            }
        }
        if (const Eigen::LLT<Eigen::MatrixXd> factor(matrix); factor.info() == Eigen::Success) {
            return;
        }
        if (gum::is_positive_semidefinite(matrix) || repair(matrix, members, place)) {
            return;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
        const auto at = stated_.find({last->first, last->second});
        const std::size_t pairs = members.size() * (members.size() - 1) / 2;
        const auto stated =
            static_cast<std::size_t>(std::count_if(stated_.begin(), stated_.end(), [&](const auto& entry) {
                return std::binary_search(members.begin(), members.end(), entry.first.first) &&
                       std::binary_search(members.begin(), members.end(), entry.first.second);
            }));
        problems_.refuse(
            k_correlation_not_positive, at == stated_.end() ? document_.where("") : at->second.where,
            "the correlations of " + culprits(solver.eigenvectors().col(0), members) +
                " cannot hold together: the smallest eigenvalue of their matrix is " +
                text::shortest_plain(solver.eigenvalues()(0)) +
                (stated < pairs ? "; " + std::to_string(stated) + " of " + std::to_string(pairs) +
                                      " pairs are stated, and the others count as 0"
                                : ""),
            "a correlation matrix is positive semi-definite, within half a unit of the last digits and 0.0005 at most",
            stated < pairs ? "state the other correlations of these inputs, or correct them"
                           : "correct the correlations of these inputs");
    }

    /// Moves correlations by less than half a unit of their last digits where that lets them hold together.
    template <typename Place>
    bool repair(const Eigen::MatrixXd& matrix, const std::vector<std::size_t>& members, const Place& place) {
        if (members.size() > k_most_repaired) {
            return false;
        }
        Eigen::MatrixXd tolerance = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
        for (const auto& [pair, statement] : stated_) {
            if (!std::binary_search(members.begin(), members.end(), pair.first) ||
                !std::binary_search(members.begin(), members.end(), pair.second)) {
                continue;
            }
            const double half_unit =
                statement.half_unit.value_or(half_of_last_digit(document_.number_as_written(statement.pointer + "/2")));
            const Eigen::Index i = place(pair.first);
            const Eigen::Index j = place(pair.second);
            if (matrix(i, j) == 0.0) {  // not among the correlations
                continue;
            }
            tolerance(i, j) = tolerance(j, i) = std::min(half_unit, k_largest_repair);
        }
        const std::optional<Eigen::MatrixXd> nearest = gum::nearest_correlation(matrix, tolerance);
        if (!nearest) {
            return false;
        }
        double most = 0.0;
        const gum::InputCorrelation* moved = nullptr;
        for (gum::InputCorrelation& pair : job_.correlations) {
            if (std::binary_search(members.begin(), members.end(), pair.first)) {
                const double r = std::clamp((*nearest)(place(pair.first), place(pair.second)), -1.0, 1.0);
                if (moved == nullptr || std::abs(r - pair.r) > most) {
                    most = std::abs(r - pair.r);
                    moved = &pair;
                }
                pair.r = r;
                pair.is_computed = true;
            }
        }
        const auto at = stated_.find({moved->first, moved->second});
        problems_.warn(k_warn_correlations_repaired, at->second.where,
                       "the correlations of " + std::to_string(members.size()) +
                           " inputs hold together only within the digits that are written; the nearest matrix that "
                           "does is used, where r(" +
                           text::visible(job_.inputs[moved->first].name) + ", " +
                           text::visible(job_.inputs[moved->second].name) + ") differs most, by " +
                           gum::round_significant(most, 2),
                       "a correlation matrix is positive semi-definite", "state more digits if there are some");
        return true;
    }

    /// The inputs with the largest parts in the eigenvector of the smallest eigenvalue.
    [[nodiscard]] std::string culprits(const Eigen::VectorXd& vector, const std::vector<std::size_t>& members) const {
        std::vector<std::size_t> order(members.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto part = [&](std::size_t i) { return std::abs(vector(static_cast<Eigen::Index>(i))); };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return part(a) > part(b) + k_same_number; });
        std::vector<std::size_t> chosen;
        for (const std::size_t i : order) {
            if (chosen.size() < 2 || (chosen.size() < 6 && part(i) > 0.1)) {
                chosen.push_back(i);
            }
        }
        std::sort(chosen.begin(), chosen.end());
        std::string text;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            text += (i == 0                   ? ""
                     : i + 1 == chosen.size() ? " and "
                                              : ", ") +
                    text::in_quotes(job_.inputs[members[chosen[i]]].name);
        }
        return text;
    }

    const JsonDocument& document_;
    const std::map<std::string, std::size_t>& positions_;
    const std::vector<std::string>& names_;
    BudgetJob& job_;
    ProblemList& problems_;
    struct Statement {
        std::string where, pointer;
        std::optional<double> half_unit;  ///< of the last digit of r; nothing: of the text at pointer/2
    };
    std::map<std::pair<std::size_t, std::size_t>, Statement> stated_;  ///< of a pair
};

}  // namespace

std::optional<double> StatedCovariance::variance_of(std::string_view input) const {
    const auto found = std::find(inputs.begin(), inputs.end(), input);
    if (found == inputs.end()) {
        return std::nullopt;
    }
    const auto i = static_cast<Eigen::Index>(found - inputs.begin());
    return matrix(i, i);
}

std::optional<StatedCovariance> read_covariance(const JsonObject& root, const JsonDocument& document, JobFiles& files,
                                                ProblemList& problems) {
    const std::optional<JsonObject> object = root.optional_object("covariance", keys_of<CovarianceStatement>());
    if (!object) {
        return std::nullopt;
    }
    const json* names = object->required_array("inputs");
    const bool has_matrix = object->require("matrix");
    const json* value = has_matrix ? object->find("matrix") : nullptr;
    if (names == nullptr || value == nullptr) {
        return std::nullopt;
    }
    StatedCovariance stated;
    for (std::size_t i = 0; i < names->size(); ++i) {
        const std::string at = child_pointer(object->pointer("inputs"), i);
        if (!(*names)[i].is_string()) {
            problems.refuse(k_wrong_type, document.where(at), described((*names)[i]), "must be the name of an input",
                            "correct it");
            return std::nullopt;
        }
        const auto& name = (*names)[i].get_ref<const std::string&>();
        if (std::find(stated.inputs.begin(), stated.inputs.end(), name) != stated.inputs.end()) {
            problems.refuse(k_repeated_correlation, document.where(at), text::in_quotes(name) + " occurs twice",
                            "an input has one row of the matrix", "remove one of the two");
            return std::nullopt;
        }
        stated.inputs.push_back(name);
    }
    if (stated.inputs.empty() || stated.inputs.size() > k_most_in_matrix) {
        object->refuse(k_wrong_size, "inputs", text::count_of(stated.inputs.size(), "input"),
                       "a covariance matrix has 1 to " + std::to_string(k_most_in_matrix) + " inputs",
                       "correct the list");
        return std::nullopt;
    }
    std::optional<Eigen::MatrixXd> matrix;
    std::string where = object->where("matrix");
    ProblemList* list = &problems;
    if (value->is_object()) {
        const auto source = object->optional_object("matrix", k_file_object_keys);
        const auto name = source ? JobFiles::file_name(*source, "file", true) : std::nullopt;
        const auto file = name ? files.open(*name) : std::nullopt;
        if (file) {
            list = file->problems;
            where = text::visible(*name);
            matrix = read_csv_matrix(file->bytes, stated.inputs.size(), "", *file->problems);
        }
    } else if (const json* rows = object->optional_array("matrix")) {
        matrix = read_matrix(*rows, object->pointer("matrix"), stated.inputs.size(), document, problems);
    }
    if (!matrix || !is_covariance(*matrix, stated.inputs, where, *list)) {
        return std::nullopt;
    }
    stated.matrix = std::move(*matrix);
    return stated;
}

void read_correlations(const JsonObject& root, const JsonDocument& document,
                       const std::optional<StatedCovariance>& covariance,
                       const std::map<std::string, std::size_t>& positions, const std::vector<std::string>& names,
                       BudgetJob& job, ProblemList& problems) {
    Correlations correlations(document, positions, names, job, problems);
    if (const json* pairs = root.optional_array("correlations")) {
        correlations.read_pairs(*pairs, root.pointer("correlations"));
    }
    if (covariance) {
        correlations.read_stated(*covariance, root.pointer("covariance"));
    }
    if (const json* sets = root.optional_array("simultaneous")) {
        correlations.read_simultaneous(*sets, root.pointer("simultaneous"));
    }
    correlations.finish();
}

}  // namespace gumcert::jobs
