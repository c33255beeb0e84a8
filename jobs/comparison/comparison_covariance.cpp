#include "jobs/comparison/comparison_covariance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

constexpr double k_same_variance = 1e-6;

/// A matrix that a file states for the points of one side, in the order of the comparison.
class PointCovariance {
public:
    PointCovariance(std::span<const SidePoint> points, double coverage_probability, ProblemList& problems)
        : points_(points),
          coverage_probability_(coverage_probability),
          problems_(problems),
          where_(text::visible(problems.file())) {}

    void read(Eigen::MatrixXd matrix, ComparisonSide& side) const {
        if (is_covariance(matrix)) {
            take(std::move(matrix), side);
        }
    }

private:
    [[nodiscard]] std::string name_of(Eigen::Index i) const {
        return text::in_quotes(description(points_[static_cast<std::size_t>(i)].point));
    }

    [[nodiscard]] bool is_covariance(const Eigen::MatrixXd& matrix) const {
        const NumberRange range =
            between(k_least_compared_u * k_least_compared_u, k_largest_compared * k_largest_compared, "");
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
            if (!range.contains(matrix(i, i))) {
                problems_.refuse(
                    k_number_out_of_range, where_,
                    "the variance of the point " + name_of(i) + " is " + text::shortest_plain(matrix(i, i)),
                    "a variance is u², from 1e-120 to 1e120", "correct the matrix, or choose another unit");
                return false;
            }
            const auto& stated = points_[static_cast<std::size_t>(i)].uncertainty;
            const double variance = stated ? stated->u * stated->u : matrix(i, i);
            if (std::abs(matrix(i, i) - variance) > k_same_variance * variance) {
                problems_.refuse(k_comparison_covariance_diagonal, where_,
                                 "the variance of the point " + name_of(i) + " is " +
                                     text::shortest_plain(matrix(i, i)) + ", and u² of the point is " +
                                     text::shortest_plain(variance),
                                 "they must agree within 1e-6", "state the uncertainty in one place only");
                return false;
            }
            for (Eigen::Index j = 0; j < i; ++j) {
                const double scale = std::sqrt(matrix(i, i)) * std::sqrt(matrix(j, j));
                if (!(std::abs(matrix(i, j) - matrix(j, i)) <= k_same_number * scale)) {
                    problems_.refuse(k_comparison_covariance_asymmetric, where_,
                                     "the covariance of the points " + name_of(i) + " and " + name_of(j) + " is " +
                                         text::shortest_plain(matrix(i, j)) + " in one place and " +
                                         text::shortest_plain(matrix(j, i)) + " in the other",
                                     "a covariance matrix is symmetric", "correct the matrix");
                    return false;
                }
            }
        }
        return is_positive(matrix);
    }

    [[nodiscard]] bool is_positive(const Eigen::MatrixXd& matrix) const {
        const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::MatrixXd correlation = scale.asDiagonal() * matrix * scale.asDiagonal();
        const auto negative = negative_eigenvalue(correlation);
        if (!negative) {
            return true;
        }
        std::vector<std::string> culprits;
        for (const std::size_t i : negative->culprits) {
            culprits.push_back(description(points_[i].point));
        }
        problems_.refuse(k_comparison_covariance, where_,
                         "the covariances of the points " + list_of(culprits) +
                             " cannot hold together: the smallest eigenvalue of their correlation matrix is " +
                             text::significant(negative->eigenvalue, 3),
                         "a covariance matrix is positive semi-definite", "correct the matrix");
        return false;
    }

    void take(Eigen::MatrixXd matrix, ComparisonSide& side) const {
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
            std::optional<gum::ResultUncertainty> uncertainty = points_[static_cast<std::size_t>(i)].uncertainty;
            if (!uncertainty) {
                uncertainty = of_standard_uncertainty(std::sqrt(matrix(i, i)), coverage_probability_);
            }
            if (!uncertainty) {
                problems_.refuse(k_not_representable, where_, "no expanded uncertainty of the point " + name_of(i),
                                 "the variance must be moderate", "choose another unit");
                return;
            }
            // A diagonal with fewer digits than u would not give u back.
            matrix(i, i) = uncertainty->u * uncertainty->u;
            for (Eigen::Index j = 0; j < i; ++j) {
                matrix(j, i) = matrix(i, j);
            }
            side.uncertainty.push_back(*uncertainty);
        }
        side.covariance = std::move(matrix);
    }

    std::span<const SidePoint> points_;
    double coverage_probability_;
    ProblemList& problems_;
    std::string where_;
};

}  // namespace

void covariance_of_points(std::span<const SidePoint> points, ComparisonSide& side) {
    if (std::any_of(points.begin(), points.end(), [](const SidePoint& point) { return !point.uncertainty; })) {
        return;  // refused while the text was read
    }
    const auto n = static_cast<Eigen::Index>(points.size());
    side.covariance = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const SidePoint& first = points[static_cast<std::size_t>(i)];
        side.uncertainty.push_back(*first.uncertainty);
        for (Eigen::Index j = 0; j < i; ++j) {
            const SidePoint& second = points[static_cast<std::size_t>(j)];
            side.covariance(i, j) = side.covariance(j, i) =
                first.u_common.value_or(0.0) * second.u_common.value_or(0.0);
        }
        side.covariance(i, i) = first.uncertainty->u * first.uncertainty->u;
    }
}

void read_point_covariance(const ComparisonReading& reading, const SideReading& read,
                           std::span<const std::size_t> order, ComparisonSide& side) {
    const auto file = reading.files.open(*read.covariance_name);
    const auto matrix =
        file ? read_csv_matrix(file->bytes, order.size(), reading.job.methods->unit.text(), *file->problems)
             : std::nullopt;
    if (!matrix) {
        return;
    }
    const auto place = [&](Eigen::Index row) {
        return static_cast<Eigen::Index>(order[static_cast<std::size_t>(row)]);
    };
    Eigen::MatrixXd ordered(matrix->rows(), matrix->cols());
    for (Eigen::Index i = 0; i < matrix->rows(); ++i) {
        for (Eigen::Index j = 0; j < matrix->cols(); ++j) {
            ordered(place(i), place(j)) = (*matrix)(i, j);
        }
    }
    PointCovariance(read.points, reading.job.coverage_probability, *file->problems).read(std::move(ordered), side);
}

}  // namespace gumcert::jobs
