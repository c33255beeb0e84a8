#include "reports/record/make/covariance_file.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "encoding/npy.h"
#include "reports/record/make/record_parts.h"
#include "text/csv_field.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

constexpr std::array<std::pair<std::string_view, CovarianceForm>, 5> k_words{{{"auto", CovarianceForm::automatic},
                                                                              {"none", CovarianceForm::none},
                                                                              {"csv", CovarianceForm::csv},
                                                                              {"npy", CovarianceForm::npy},
                                                                              {"parts", CovarianceForm::parts}}};

/// The lower element for both, so that the file is symmetric to the last bit, as a reader may check.
double element_in_unit(const engine::AnglewiseCovariance& covariance, const Eigen::VectorXd& per_unit, Eigen::Index i,
                       Eigen::Index j) {
    return covariance(std::max(i, j), std::min(i, j)) * (per_unit[i] * per_unit[j]);
}

std::string as_csv(const engine::AnglewiseCovariance& covariance, const std::vector<std::string>& names,
                   const Eigen::VectorXd& per_unit) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += (i == 0 ? "" : ",") + text::csv_field(names[i]);
    }
    text += '\n';
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        for (Eigen::Index j = 0; j < covariance.rows(); ++j) {
            text += (j == 0 ? "" : ",") + text::shortest(element_in_unit(covariance, per_unit, i, j));
        }
        text += '\n';
    }
    return text;
}

std::string as_npy(const engine::AnglewiseCovariance& covariance, const Eigen::VectorXd& per_unit) {
    const auto rows = static_cast<std::size_t>(covariance.rows());
    std::string file = encoding::npy_header(rows, rows);
    file.reserve(file.size() + 8 * rows * rows);
    std::vector<double> row(rows);
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        for (Eigen::Index j = 0; j < covariance.rows(); ++j) {
            row[static_cast<std::size_t>(j)] = element_in_unit(covariance, per_unit, i, j);
        }
        encoding::append_npy(file, row);
    }
    return file;
}

std::string as_parts(const engine::AnglewiseCovariance& covariance, const Eigen::VectorXd& per_unit) {
    const Eigen::Index r = covariance.shared().cols();
    const auto& own = covariance.own();
    const Eigen::Index q = own.rows() == 0 ? 0 : own.cols();
    const auto columns = static_cast<std::size_t>(2 * r + q);
    std::string file = encoding::npy_header(static_cast<std::size_t>(covariance.rows()), columns);
    file.reserve(file.size() + 8 * static_cast<std::size_t>(covariance.rows()) * columns);
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(2 * r + q);
        row.head(r) = covariance.shared().row(i) * per_unit[i];
        row.segment(r, r) = covariance.half().row(i) * per_unit[i];
        if (i < own.rows()) {
            const Eigen::Index first = i - i % q;
            row.tail(q) = own.row(i).cwiseProduct(per_unit.segment(first, q).transpose()) * per_unit[i];
        }
        encoding::append_npy(file, std::span<const double>(row.data(), columns));
    }
    return file;
}

}  // namespace

CovarianceForm chosen_form(CovarianceForm asked, std::size_t quantities) {
    if (asked != CovarianceForm::automatic) {
        return asked;
    }
    return quantities <= k_most_quantities_as_csv ? CovarianceForm::csv : CovarianceForm::parts;
}

std::optional<CovarianceForm> covariance_form(std::string_view word) {
    for (const auto& [name, form] : k_words) {
        if (name == word) {
            return form;
        }
    }
    return std::nullopt;
}

std::string covariance_ending(CovarianceForm form) {
    return form == CovarianceForm::parts ? "-parts.npy" : form == CovarianceForm::npy ? ".npy" : ".csv";
}

CovarianceForm form_of_file(std::string_view name) {
    return name.empty()                   ? CovarianceForm::none
           : name.ends_with("-parts.npy") ? CovarianceForm::parts
           : name.ends_with(".npy")       ? CovarianceForm::npy
                                          : CovarianceForm::csv;
}

std::string covariance_contents(const engine::AnglewiseCovariance& covariance, const std::vector<std::string>& names,
                                const std::vector<double>& units, CovarianceForm form) {
    const Eigen::VectorXd per_unit =
        Eigen::Map<const Eigen::VectorXd>(units.data(), static_cast<Eigen::Index>(units.size())).cwiseInverse();
    return form == CovarianceForm::parts ? as_parts(covariance, per_unit)
           : form == CovarianceForm::npy ? as_npy(covariance, per_unit)
                                         : as_csv(covariance, names, per_unit);
}

}  // namespace gumcert::reports
